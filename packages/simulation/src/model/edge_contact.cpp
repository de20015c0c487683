#include "model/edge_contact.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>

#include "model/edges/widened_graph.hpp"

namespace mortise {
namespace {

constexpr int in_space = 3;

std::string piece_text(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return fmt::format("from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", a[0], a[1], a[2], b[0], b[1], b[2]);
}

}  // namespace

EdgeContact::EdgeContact(std::shared_ptr<const Bodies> bodies, EdgeSearch search, std::vector<std::string> names,
                         std::function<PlacedBodies(const Vector& displacement)> displaced, const Timers& timers)
    : CountedContribution("crossing edges", timers),
      bodies_(std::move(bodies)),
      search_(std::move(search)),
      names_(std::move(names)),
      displaced_(std::move(displaced)) {}

std::vector<Eigen::Vector3d> EdgeContact::places(const Vector& local_displacement) const {
  const Mesh& mesh = *bodies_->mesh();
  const auto u = local_displacement.getLocalViewHost(Tpetra::Access::ReadOnly);
  return places_on_all_ranks(mesh, active_.nodes, [&](LocalOrdinal node) {
    Eigen::Vector3d x(mesh.coordinates[static_cast<std::size_t>(node)].data());
    for (int i = 0; i < in_space; ++i) x[i] += u(in_space * node + i, 0);
    return x;
  });
}

RCP<Vector> EdgeContact::local(const Vector& displacement) const {
  const RCP<Vector> local = rcp(new Vector(bodies_->space().local_dofs()));
  local->doImport(displacement, *bodies_->space().ghost_import(), Tpetra::INSERT);
  return local;
}

void EdgeContact::visit_forces(const Vector& local_displacement,
                               const std::function<void(const EdgeSpot&, const EdgeCrossing&, const CrossingForce&)>& visit) const {
  if (active_.spots.empty()) return;
  const std::vector<Eigen::Vector3d> x = places(local_displacement);
  for (const EdgeSpot& spot : active_.spots)
    for (const EdgeCrossing& crossing : crossings_of(spot.edges, x))
      if (const auto force = force_of(spot.edges, crossing, x)) visit(spot, crossing, *force);
}

void EdgeContact::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) {
  if (active_.spots.empty()) return;
  const auto timer = count("crossing edges");
  const Mesh& mesh = *bodies_->mesh();
  visit_forces(at.local_unknowns, [&](const EdgeSpot&, const EdgeCrossing&, const CrossingForce& force) {
    for (std::size_t n = 0; n < force.nodes.size(); ++n) {
      const LocalOrdinal node = mesh.owned_nodes->getLocalElement(active_.nodes[static_cast<std::size_t>(force.nodes[n])]);
      for (int i = 0; i < in_space && node >= 0; ++i)
        residual.sumIntoLocalValue(in_space * node + i, force.residual[in_space * static_cast<Eigen::Index>(n) + i]);
    }
  });
}

void EdgeContact::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) {
  if (active_.spots.empty()) return;
  const auto timer = count("crossing edges");
  const Mesh& mesh = *bodies_->mesh();
  visit_forces(at.local_unknowns, [&](const EdgeSpot&, const EdgeCrossing&, const CrossingForce& force) {
    for (std::size_t n = 0; n < force.nodes.size(); ++n) {
      const LocalOrdinal node = mesh.owned_nodes->getLocalElement(active_.nodes[static_cast<std::size_t>(force.nodes[n])]);
      if (node < 0) continue;
      for (std::size_t m = 0; m < force.nodes.size(); ++m)
        for (int j = 0; j < in_space; ++j) {
          const LocalOrdinal column = jacobian.getColMap()->getLocalElement(in_space * active_.nodes[static_cast<std::size_t>(force.nodes[m])] + j);
          for (int i = 0; i < in_space; ++i) {
            const double value =
                weights.unknowns * force.tangent(in_space * static_cast<Eigen::Index>(n) + i, in_space * static_cast<Eigen::Index>(m) + j);
            if (value != 0.0) jacobian.sumIntoLocalValues(in_space * node + i, 1, &value, &column);
          }
        }
    }
  });
}

// The graph stays as long as it holds what is coupled.
void EdgeContact::take(EdgeSpots spots) {
  active_ = std::move(spots);
  std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> coupled;
  for (const EdgeSpot& spot : active_.spots) {
    std::set<GlobalOrdinal> nodes;
    for (const EdgeLine* line : {&spot.edges.slave, &spot.edges.master}) {
      for (const int node : line->nodes) nodes.insert(active_.nodes[static_cast<std::size_t>(node)]);
      for (const auto& ends : line->tangent)
        for (const int node : ends) nodes.insert(active_.nodes[static_cast<std::size_t>(node)]);
    }
    for (const GlobalOrdinal one : nodes)
      for (const GlobalOrdinal other : nodes) coupled.emplace(one, other);
  }
  if (std::includes(coupled_.begin(), coupled_.end(), coupled.begin(), coupled.end())) return;
  coupled_ = std::move(coupled);
  ++version_;
}

RCP<const Graph> EdgeContact::graph(const RCP<const Graph>& bulk) const {
  return coupled_.empty() ? bulk : widened(*bulk, bodies_->space(), coupled_);
}

void EdgeContact::start_step(const Vector& displacement) {
  bool is_known = false;
  if (!searched_at_.is_null()) {
    Vector difference(displacement, Teuchos::Copy);
    difference.update(-1.0, *searched_at_, 1.0);
    is_known = difference.normInf() == 0.0;
  }
  if (!is_known) {
    next_ = search_.find(displaced_(displacement));
    searched_at_ = rcp(new Vector(displacement, Teuchos::Copy));
  }
  take(next_);
}

// Edges that overlap at the end of a step without a force were not near when the step began.
void EdgeContact::examine(const Vector& displacement) {
  const PlacedBodies bodies = displaced_(displacement);
  next_ = search_.find(bodies);
  searched_at_ = rcp(new Vector(displacement, Teuchos::Copy));
  std::vector<Eigen::Vector3d> acting;
  acting_.clear();
  crossings_.clear();
  const std::vector<Eigen::Vector3d> now = places(*local(displacement)), then = places_on_all_ranks(bodies.mesh, next_.nodes, bodies.at);
  const auto fail = [&](const EdgeSpot& spot, const EdgeCrossing& crossing, const std::vector<Eigen::Vector3d>& x, const std::string& why) {
    const auto& [slave, master] = std::tie(spot.edges.slave, spot.edges.master);
    const auto at = [&](const EdgeLine& line, std::size_t k) { return x[static_cast<std::size_t>(line.nodes[k])]; };
    throw StepFailure(
        FailureKind::lost_contact,
        fmt::format("contact \"{}\": an edge of the slave {} lies {:.3g} deep behind an edge of the master {}, {}; please take a smaller "
                    "\"maximum step\", or a larger \"search reach\" than {:.3g}",
                    names_[spot.contact], piece_text(at(slave, crossing.slave), at(slave, crossing.slave + 1)), -crossing.gap,
                    piece_text(at(master, crossing.master), at(master, crossing.master + 1)), why, spot.reach));
  };
  for (const EdgeSpot& spot : active_.spots)
    for (const EdgeCrossing& crossing : crossings_of(spot.edges, now)) {
      if (crossing.gap < -spot.reach && crossing.stiffness > 0.0) fail(spot, crossing, now, "deeper than the search reach");
      acting.push_back(crossing.on_slave);
      if (!(crossing.stiffness > 0.0)) continue;
      if (crossing.gap < 0.0) acting_.insert(spot.contact);
      const auto length = [&](const EdgeLine& line, std::size_t k) {
        return (now[static_cast<std::size_t>(line.nodes[k + 1])] - now[static_cast<std::size_t>(line.nodes[k])]).norm();
      };
      crossings_.push_back({spot.contact, 0.5 * (crossing.on_slave + crossing.on_master), crossing.normal, crossing.gap,
                            crossing.gap < 0.0 ? crossing.stiffness * crossing.gap * crossing.gap : 0.0, crossing.stiffness, spot.area,
                            std::max(length(spot.edges.slave, crossing.slave), length(spot.edges.master, crossing.master))});
    }
  const auto acts_at = [&](const Eigen::Vector3d& x) {
    return std::any_of(acting.begin(), acting.end(), [&](const Eigen::Vector3d& one) { return (one - x).norm() <= bodies.touching; });
  };
  for (const EdgeSpot& spot : next_.spots)
    for (const EdgeCrossing& crossing : crossings_of(spot.edges, then))
      if (crossing.gap < -bodies.touching && crossing.stiffness > 0.0 && !acts_at(crossing.on_slave))
        fail(spot, crossing, then, "and no force acts between them: when the step began they were out of reach");
}

std::array<double, 3> EdgeContact::resultant(std::size_t pair, const Vector& local_displacement) const {
  std::array<double, 3> sum{};
  visit_forces(local_displacement, [&](const EdgeSpot& spot, const EdgeCrossing& crossing, const CrossingForce&) {
    if (spot.contact != pair) return;
    const double force = crossing.stiffness * crossing.gap * crossing.gap;
    for (std::size_t i = 0; i < 3; ++i) sum[i] -= force * crossing.normal[static_cast<Eigen::Index>(i)];
  });
  return sum;
}

}  // namespace mortise
