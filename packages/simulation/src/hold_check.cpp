#include "mortise/simulation/hold_check.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid_mode_names.hpp"

namespace mortise {
namespace {

using Position = Eigen::Vector3d;  // z = 0 in the plane
/// A null vector has an eigenvalue below this, relative to the largest one.
constexpr double rank_tolerance = 1e-12;

/// Rigid modes of all bodies: mode m of body b is column per_body() b + m. Axisymmetric: the translation along the axis; plane: two translations and
/// a rotation; space: three of each.
class RigidModes {
 public:
  RigidModes(const Mesh& mesh, bool axisymmetric) : axisymmetric_(axisymmetric), dimension_(mesh.dimension), bodies_(mesh.blocks.size()) {
    // Bounding boxes over all ranks: the largest of (x, y, z, -x, -y, -z).
    std::vector<double> mine(6 * bodies_, -std::numeric_limits<double>::max()), all(6 * bodies_);
    for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
      double* box = &mine[6 * mesh.body_of_node[node]];
      for (int i = 0; i < 3; ++i) {
        box[i] = std::max(box[i], mesh.coordinates[node][i]);
        box[3 + i] = std::max(box[3 + i], -mesh.coordinates[node][i]);
      }
    }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
    for (std::size_t b = 0; b < bodies_; ++b) {
      const Position high(&all[6 * b]), low = -Position(&all[6 * b + 3]);
      centres_.push_back(0.5 * (low + high));
      sizes_.push_back(std::max(0.5 * (high - low).norm(), std::numeric_limits<double>::min()));
    }
  }

  int per_body() const { return axisymmetric_ ? 1 : dimension_ == 2 ? 3 : 6; }
  int rotations() const { return axisymmetric_ ? 0 : dimension_ == 2 ? 1 : 3; }
  int count() const { return per_body() * static_cast<int>(bodies_); }
  const char* name(int mode) const { return rigid_mode_name(dimension_, axisymmetric_, mode); }

  /// row += rotation of `body` in the plane, over its size.
  void add_rotation(int body, int rotation, Eigen::RowVectorXd& row) const { row(per_body() * body + per_body() - rotations() + rotation) += 1.0; }

  /// row += direction . modes of `body` at position x.
  void add(int body, const Position& x, const Position& direction, Eigen::RowVectorXd& row) const {
    if (axisymmetric_) {
      row(body) += direction.y();
      return;
    }
    const Position arm = (x - centres_[body]) / sizes_[body];
    const Position turning = arm.cross(direction);
    if (dimension_ == 2)
      row.segment<3>(3 * body) += Eigen::RowVector3d(direction.x(), direction.y(), turning.z());
    else
      row.segment<6>(6 * body) << row.segment<3>(6 * body) + direction.transpose(), row.segment<3>(6 * body + 3) + turning.transpose();
  }

 private:
  bool axisymmetric_;
  int dimension_;
  std::size_t bodies_;
  std::vector<Position> centres_;
  std::vector<double> sizes_;
};

Position position(const Mesh& mesh, LocalOrdinal node) { return Position(mesh.coordinates[node].data()); }

Eigen::MatrixXd prescribed_gram(const Mesh& mesh, const RigidModes& modes, const MultiVector& fixed) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(modes.count(), modes.count());
  const auto values = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) {
      if (values(node, i) == 0.0) continue;
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
      modes.add(mesh.body_of_node[node], position(mesh, node), Position::Unit(i), row);
      gram += row.transpose() * row;
    }
  return gram;
}

/// What a point that turns with its followers holds of their body: the motion at the point, where prescribed.
void add_turning_point(const Mesh& mesh, const RigidModes& modes, const MultiVector& fixed, const ReferencePoint& point, Eigen::MatrixXd& gram) {
  if (point.node >= mesh.owned_count()) return;
  const auto values = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  const int body = mesh.body_of_node[point.node];
  const auto hold = [&](const auto& add) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
    add(row);
    gram += row.transpose() * row;
  };
  for (int i = 0; i < mesh.dimension; ++i)
    if (values(point.node, i) != 0.0) hold([&](Eigen::RowVectorXd& row) { modes.add(body, position(mesh, point.node), Position::Unit(i), row); });
  for (int i = 0; point.rotation_node >= 0 && i < modes.rotations(); ++i)
    if (values(point.rotation_node, i) != 0.0) hold([&](Eigen::RowVectorXd& row) { modes.add_rotation(body, i, row); });
}

/// What a shared translation holds: with m_i the motion of follower i in a component, sum (m_i - mean)(m_i - mean)^T, and mean mean^T where the
/// point is prescribed. Collective; the result counts on the rank of the point.
void add_shared_translation(const Mesh& mesh, const RigidModes& modes, const MultiVector& fixed, const ReferencePoint& point, Eigen::MatrixXd& gram) {
  const auto values = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int i = 0; i < mesh.dimension; ++i) {
    if (!point.follows[i]) continue;
    // Products of (1, m): the count, the sum, the sum of products.
    Eigen::MatrixXd mine = Eigen::MatrixXd::Zero(1 + modes.count(), 1 + modes.count()), all = mine;
    for (const LocalOrdinal node : point.followers) {
      if (node >= mesh.owned_count()) continue;
      Eigen::RowVectorXd motion = Eigen::RowVectorXd::Zero(modes.count()), row(1 + modes.count());
      modes.add(mesh.body_of_node[node], position(mesh, node), Position::Unit(i), motion);
      row << 1.0, motion;
      mine += row.transpose() * row;
    }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
    if (point.node >= mesh.owned_count()) continue;
    const Eigen::RowVectorXd mean = all.row(0).tail(modes.count()) / all(0, 0);
    gram += all.bottomRightCorner(modes.count(), modes.count()) - all(0, 0) * mean.transpose() * mean;
    if (values(point.node, i) != 0.0) gram += mean.transpose() * mean;
  }
}

/// Slave facets in the bounding box of the master surface, widened by the reach: what can touch at the start. Collective.
Eigen::MatrixXd contact_gram(const Mesh& mesh, const RigidModes& modes, const HoldingPair& pair) {
  const auto nodes_of = [&](const SurfaceFacet& facet) {
    Facet<LocalOrdinal> nodes;
    for (const GlobalOrdinal node : facet) nodes.push_back(mesh.local_nodes->getLocalElement(node));
    return nodes;
  };
  // (x, y, z, -x, -y, -z) of the master nodes, largest facet, body of the master: largest over all ranks.
  std::array<double, 8> mine, all;
  mine.fill(-std::numeric_limits<double>::max());
  for (const auto* facets : {pair.slave, pair.master})
    for (const auto& facet : *facets) {
      const auto nodes = nodes_of(facet);
      for (const LocalOrdinal node : nodes) mine[6] = std::max(mine[6], (position(mesh, node) - position(mesh, nodes[0])).norm());
    }
  for (const auto& facet : *pair.master)
    for (const LocalOrdinal node : nodes_of(facet)) {
      const Position x = position(mesh, node);
      for (int i = 0; i < 3; ++i) mine[i] = std::max(mine[i], x(i)), mine[3 + i] = std::max(mine[3 + i], -x(i));
      mine[7] = std::max<double>(mine[7], mesh.body_of_node[node]);
    }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, 8, mine.data(), all.data());
  const double reach = pair.reach > 0.0 ? pair.reach : all[6];
  const int master_body = static_cast<int>(all[7]);

  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(modes.count(), modes.count());
  for (const auto& facet : *pair.slave) {
    const auto nodes = nodes_of(facet);
    const std::size_t corners = mesh.dimension == 2 ? 2 : nodes.size() % 4 == 0 ? 4 : 3;
    Position middle = Position::Zero();
    for (std::size_t corner = 0; corner < corners; ++corner) middle += position(mesh, nodes[corner]) / static_cast<double>(corners);
    bool near = true;
    for (int i = 0; i < 3; ++i) near = near && middle(i) <= all[i] + reach && -middle(i) <= all[3 + i] + reach;
    if (!near) continue;
    const auto x = [&](std::size_t corner) { return position(mesh, nodes[corner % corners]); };
    const Position area = mesh.dimension == 2 ? (x(1) - x(0)).cross(Position::UnitZ()) : (x(2) - x(0)).cross(x(3) - x(1));
    const Position normal = area.normalized();
    std::vector<Position> held{normal};
    if (pair.rubs) held = {Position::UnitX(), Position::UnitY(), Position::UnitZ()};
    for (const Position& direction : held) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
      modes.add(mesh.body_of_node[nodes[0]], middle, direction, row);
      modes.add(master_body, middle, -direction, row);
      gram += row.transpose() * row;
    }
  }
  return gram;
}

Eigen::MatrixXd sum_over_ranks(const Mesh& mesh, const Eigen::MatrixXd& gram) {
  Eigen::MatrixXd sum(gram.rows(), gram.cols());
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(gram.size()), gram.data(), sum.data());
  return sum;
}

/// Columns span the null space.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const double bound = std::max(rank_tolerance * solver.eigenvalues().cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const auto count = (solver.eigenvalues().array() < bound).count();
  return solver.eigenvectors().leftCols(count);
}

}  // namespace

std::vector<char> check_held(const Mesh& mesh, bool axisymmetric, const MultiVector& fixed, const std::vector<HoldingPair>& pairs,
                             const std::vector<Place>& body_places) {
  const RigidModes modes(mesh, axisymmetric);
  Eigen::MatrixXd held = prescribed_gram(mesh, modes, fixed);
  for (const ReferencePoint& point : mesh.reference_points) {
    const bool is_rigid = topology(mesh.blocks[mesh.body_of_node[point.node]].shape).dimension < mesh.dimension;
    if (is_rigid || point.rotation_node >= 0)
      add_turning_point(mesh, modes, fixed, point, held);
    else
      add_shared_translation(mesh, modes, fixed, point, held);
  }
  const Eigen::MatrixXd prescribed = sum_over_ranks(mesh, held);
  Eigen::MatrixXd contact = Eigen::MatrixXd::Zero(modes.count(), modes.count());
  for (const auto& pair : pairs) contact += contact_gram(mesh, modes, pair);

  std::vector<Diagnostic> diagnostics;
  for (const auto& [body, mode] : distinct_modes(null_space(prescribed + sum_over_ranks(mesh, contact)), modes.per_body()))
    diagnostics.push_back(
        {body_places[body], fmt::format("body '{}' can move: {}; neither boundary conditions nor contact hold it; contact holds where a slave "
                                        "facet is within reach at the start, along its normal, and with friction along the surface",
                                        mesh.blocks[body].name, modes.name(mode))});
  if (!diagnostics.empty()) throw InputError(diagnostics);

  std::vector<char> only_contact;
  for (Eigen::Index body = 0; body < static_cast<Eigen::Index>(mesh.blocks.size()); ++body) {
    const auto block = prescribed.block(modes.per_body() * body, modes.per_body() * body, modes.per_body(), modes.per_body());
    only_contact.push_back(null_space(block).cols() > 0);
  }
  return only_contact;
}

}  // namespace mortise
