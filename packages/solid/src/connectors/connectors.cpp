#include "mortise/solid/connectors.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <stdexcept>

#include "bodies/host_view.hpp"
#include "connectors/links.hpp"

namespace mortise {

using Eigen::Vector3d;

namespace {

/// Dofs of a node in the columns of a matrix.
struct Column {
  LocalOrdinal first;     ///< that of component 0
  double weight;          ///< of the node in a link
  double velocity_share;  ///< factor of derivatives by its velocity
};

}  // namespace

Connectors::Connectors(std::shared_ptr<const Bodies> bodies, const std::vector<Named<SpringOptions>>& springs)
    : bodies_(std::move(bodies)), are_springs_(true) {
  LinkMaker make(*bodies_, "stiffness");
  for (const auto& spring : springs) {
    names_.push_back(spring.name);
    make.add(spring.value, spring.place);
  }
  links_ = make.finish();
}

Connectors::Connectors(std::shared_ptr<const Bodies> bodies, const std::vector<Named<DashpotOptions>>& dashpots)
    : bodies_(std::move(bodies)), are_springs_(false) {
  LinkMaker make(*bodies_, "coefficient");
  for (const auto& dashpot : dashpots) {
    names_.push_back(dashpot.name);
    make.add(dashpot.value, dashpot.place);
  }
  links_ = make.finish();
}

std::vector<Vector3d> Connectors::motions(const Vector& vector) const {
  const HostReadView values(vector);
  const int dimension = bodies_->dimension();
  std::vector<Vector3d> result(links_.size(), Vector3d::Zero());
  std::vector<double> mine;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    for (const ShareOfNode& share : links_[l].shares)
      for (int i = 0; i < dimension; ++i) result[l][i] += share.weight * values.data()[bodies_->space().row(share.node, i)];
    if (links_[l].is_spread) mine.insert(mine.end(), result[l].begin(), result[l].end());
  }
  int spread = 0;  // the same on all ranks
  for (const ConnectorLink& link : links_) spread += link.is_spread ? 1 : 0;
  if (spread == 0) return result;
  std::vector<double> all(mine.size());
  Teuchos::reduceAll(*bodies_->mesh()->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  std::size_t next = 0;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    if (!links_[l].is_spread) continue;
    result[l] = Vector3d(&all[next]);
    next += 3;
  }
  return result;
}

std::vector<ConnectorForce> Connectors::forces(const Vector& displacement, const Vector* velocity) const {
  const std::vector<Vector3d> e = motions(displacement);
  std::vector<Vector3d> rate;
  if (!are_springs_) rate = motions(*velocity);
  std::vector<ConnectorForce> result;
  result.reserve(links_.size());
  for (std::size_t l = 0; l < links_.size(); ++l)
    result.push_back(are_springs_ ? links_[l].law.spring(links_[l].start, e[l]) : links_[l].law.dashpot(links_[l].start, e[l], rate[l]));
  return result;
}

void Connectors::add_forces(const Vector& displacement, const Vector* velocity, Vector& residual, std::optional<StepFailure>& failure) const {
  const std::vector<ConnectorForce> forces = this->forces(displacement, velocity);
  const Mesh& mesh = *bodies_->mesh();
  const HostWriteView r(residual);
  for (std::size_t l = 0; l < links_.size(); ++l) {
    if (!forces[l].force.allFinite() && !failure)
      failure.emplace(FailureKind::not_finite,
                      "the ends of \"" + names_[links_[l].connector] + "\" meet, so that the line between them has no direction");
    for (const ShareOfNode& share : links_[l].shares)
      for (int i = 0; i < mesh.dimension && share.node < mesh.owned_count(); ++i)
        r.data()[bodies_->space().row(share.node, i)] += share.weight * forces[l].force[i];
  }
}

// Nodes of spread links may be neither owned nor ghosts here: their owners say.
std::vector<double> Connectors::shares_of_spread_links(const Vector* velocity_shares) const {
  std::vector<double> mine;
  if (velocity_shares == nullptr) return mine;
  const Mesh& mesh = *bodies_->mesh();
  const HostReadView shares(*velocity_shares);
  for (const ConnectorLink& link : links_) {
    if (!link.is_spread) continue;
    for (const auto& [id, weight] : link.all) {
      const LocalOrdinal node = mesh.owned_nodes->getLocalElement(id);
      mine.push_back(node < 0 ? 0.0 : shares.data()[bodies_->space().row(node, 0)]);
    }
  }
  std::vector<double> all(mine.size());
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

// d r_a / d u_b = w_a w_b (df/de) of a link, and alike for rates. A node has mass in all of its dofs, or in none.
void Connectors::add_derivatives(const Vector& displacement, const Vector* velocity, double by_motion, double by_velocity,
                                 const Vector* velocity_shares, Matrix& matrix) const {
  const std::vector<ConnectorForce> forces = this->forces(displacement, velocity);
  const Mesh& mesh = *bodies_->mesh();
  const int dimension = mesh.dimension;
  const std::vector<double> shares_of_spread = shares_of_spread_links(velocity_shares);
  std::optional<HostReadView> shares;
  if (velocity_shares != nullptr) shares.emplace(*velocity_shares);
  std::size_t next_spread = 0;
  std::vector<Column> columns;
  std::vector<double> values;
  std::vector<LocalOrdinal> places;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const ConnectorLink& link = links_[l];
    columns.clear();
    if (link.is_spread)
      for (const auto& [node, weight] : link.all) {
        const double share = shares ? shares_of_spread[next_spread++] : 1.0;
        columns.push_back({matrix.getColMap()->getLocalElement(bodies_->space().id(0, node, 0)), weight, share});
      }
    else
      for (const ShareOfNode& share : link.shares) {
        const LocalOrdinal first = bodies_->space().row(share.node, 0);
        columns.push_back({first, share.weight, shares ? shares->data()[first] : 1.0});
      }
    for (const ShareOfNode& share : link.shares)
      for (int i = 0; i < dimension && share.node < mesh.owned_count(); ++i) {
        values.clear(), places.clear();
        for (const Column& column : columns)
          for (int j = 0; j < dimension; ++j) {
            const double derivative = by_motion * forces[l].by_motion(i, j) + by_velocity * column.velocity_share * forces[l].by_velocity(i, j);
            if (derivative == 0.0) continue;
            values.push_back(share.weight * column.weight * derivative);
            places.push_back(column.first + j);
          }
        const auto count = static_cast<LocalOrdinal>(values.size());
        if (count > 0 && matrix.sumIntoLocalValues(bodies_->space().row(share.node, i), count, values.data(), places.data()) != count)
          throw std::logic_error("a matrix lacks entries of a spring or a dashpot");
      }
  }
}

ConnectorState Connectors::state(std::size_t n, const Vector& displacement, const Vector* velocity) const {
  const std::vector<Vector3d> e = motions(displacement);
  const std::vector<ConnectorForce> forces = this->forces(displacement, velocity);
  std::vector<Vector3d> rates;
  if (!are_springs_) rates = motions(*velocity);
  constexpr int size = 12;
  std::array<double, size> mine{}, all{};  // force, elongation, along, its elongation, moment, rotation, power, energy
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const ConnectorLink& link = links_[l];
    if (link.connector != n || !link.counts) continue;
    const ConnectorForce& force = forces[l];
    if (link.is_rotation) {
      const bool in_plane = bodies_->dimension() == 2;
      mine[8] += in_plane ? link.sign() * force.force[0] : force.force.norm();
      mine[9] += in_plane ? e[l][0] : e[l].norm();
    } else if (!link.law.is_axial) {
      for (int i = 0; i < 3; ++i) {
        mine[i] += link.sign() * force.force[i];
        mine[3 + i] += link.part * e[l][i];
      }
    }
    mine[6] += force.along;
    mine[7] += force.elongation;
    if (!are_springs_) mine[10] += force.force.dot(rates[l]);
    mine[11] += force.energy;
  }
  Teuchos::reduceAll(*bodies_->mesh()->comm, Teuchos::REDUCE_SUM, size, mine.data(), all.data());
  return {{all[0], all[1], all[2]}, {all[3], all[4], all[5]}, all[6], all[7], all[8], all[9], all[10], all[11]};
}

double Connectors::energy(const Vector& displacement) const {
  const std::vector<ConnectorForce> forces = this->forces(displacement, nullptr);
  double mine = 0.0, all = 0.0;
  for (std::size_t l = 0; l < links_.size(); ++l)
    if (links_[l].counts) mine += forces[l].energy;
  Teuchos::reduceAll(*bodies_->mesh()->comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> Connectors::coupled() const {
  const Mesh& mesh = *bodies_->mesh();
  std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> result;
  for (const ConnectorLink& link : links_)
    for (const ShareOfNode& row : link.shares) {
      if (row.node >= mesh.owned_count()) continue;
      const GlobalOrdinal id = mesh.local_nodes->getGlobalElement(row.node);
      if (link.is_spread)
        for (const auto& [node, weight] : link.all) result.emplace(id, node);
      else
        for (const ShareOfNode& column : link.shares) result.emplace(id, mesh.local_nodes->getGlobalElement(column.node));
    }
  return result;
}

}  // namespace mortise
