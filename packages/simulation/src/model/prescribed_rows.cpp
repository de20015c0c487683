#include "model/prescribed_rows.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>

#include "model/connectors/connector_holds.hpp"
#include "mortise/solid/rotation_vector.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;

void add_nodes(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed, Eigen::MatrixXd& gram) {
  const auto values = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  const int size = modes.per_body();
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    const int body = mesh.body_of_node[node], b = modes.number(body);
    for (int i = 0; i < mesh.dimension && b >= 0; ++i) {
      if (values(node, i) == 0.0) continue;
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
      modes.add(body, at.x[node], Vector3d::Unit(i), row);
      const Eigen::RowVectorXd own = row.segment(size * b, size);
      gram.block(size * b, size * b, size, size) += own.transpose() * own;
    }
  }
}

void add_inclined(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const std::vector<InclinedComponent>& inclined,
                  Eigen::MatrixXd& gram) {
  for (const InclinedComponent& component : inclined) {
    const LocalOrdinal node = component.node;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
    modes.add(mesh.body_of_node[node], at.x[node], Vector3d(direction_of(component).data()), row);
    gram += row.transpose() * row;
  }
}

/// Adds what a point that turns with its followers holds of their body: the motion at the point, where prescribed. In 3D the rates of the components
/// of the rotation vector are T^-1 times the spin.
void add_turning_point(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed, std::size_t p,
                       Eigen::MatrixXd& gram) {
  const ReferencePoint& point = mesh.reference_points[p];
  if (point.node >= mesh.owned_count()) return;
  const auto values = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  const int body = mesh.body_of_node[point.node];
  const auto hold = [&](const auto& add) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
    add(row);
    gram += row.transpose() * row;
  };
  for (int i = 0; i < mesh.dimension; ++i)
    if (values(point.node, i) != 0.0) hold([&](Eigen::RowVectorXd& row) { modes.add(body, at.x[point.node], Vector3d::Unit(i), row); });
  for (int i = 0; point.rotation_node >= 0 && i < modes.rotations(); ++i) {
    if (values(point.rotation_node, i) == 0.0) continue;
    const Vector3d axis = mesh.dimension == 2 ? Vector3d(Vector3d::UnitZ()) : spatial_moment(at.turned[p], Vector3d::Unit(i));
    if (axis.allFinite()) hold([&](Eigen::RowVectorXd& row) { modes.add_rotation(body, axis, row); });
  }
}

/// Adds what a shared translation holds: with m_i the motion of follower i in a component, sum (m_i - mean)(m_i - mean)^T, and mean mean^T where the
/// point is prescribed. Collective; the result counts on the rank of the point.
void add_shared_translation(const Mesh& mesh, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed, const ReferencePoint& point,
                            Eigen::MatrixXd& gram) {
  const auto values = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int i = 0; i < mesh.dimension; ++i) {
    if (!point.follows[i]) continue;
    // Products of (1, m): the count, the sum, the sum of products.
    Eigen::MatrixXd mine = Eigen::MatrixXd::Zero(1 + modes.count(), 1 + modes.count()), all = mine;
    for (const LocalOrdinal node : point.followers) {
      if (node >= mesh.owned_count()) continue;
      Eigen::RowVectorXd motion = Eigen::RowVectorXd::Zero(modes.count()), row(1 + modes.count());
      modes.add(mesh.body_of_node[node], at.x[node], Vector3d::Unit(i), motion);
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

// A slave that stands off its master would hold rotations by its gap, as meshed: so weakly that they count as free.
void add_ties(const FieldSpace& space, const RigidModes& modes, const NodePlaces& at, const TieRows& tied, Eigen::MatrixXd& gram) {
  const Mesh& mesh = *space.mesh();
  const Map& columns = *tied.T->getColMap();
  const auto local = tied.T->getLocalMatrixHost();
  std::vector<GlobalOrdinal> ids;  // of the nodes of columns
  for (const LocalOrdinal dof : tied.dofs)
    for (LocalOrdinal k = 0; k < local.rowConst(dof).length; ++k)
      ids.push_back(space.node_of(columns.getGlobalElement(local.rowConst(dof).colidx(k))));
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto nodes = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, mesh.comm));
  MultiVector owned(mesh.owned_nodes, 4), sources(nodes, 4);  // position and body
  {
    const auto view = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
      for (int i = 0; i < 3; ++i) view(node, i) = at.x[static_cast<std::size_t>(node)][i];
      view(node, 3) = mesh.body_of_node[static_cast<std::size_t>(node)];
    }
  }
  sources.doImport(owned, Import(mesh.owned_nodes, nodes), Tpetra::INSERT);
  const auto source = sources.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (const LocalOrdinal dof : tied.dofs) {
    const FieldPlace of_slave = space.place(dof);
    const Vector3d direction = Vector3d::Unit(of_slave.component);
    const auto of_dof = local.rowConst(dof);
    Vector3d place = Vector3d::Zero();
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
    for (LocalOrdinal k = 0; k < of_dof.length; ++k) {
      const LocalOrdinal n = nodes->getLocalElement(space.node_of(columns.getGlobalElement(of_dof.colidx(k))));
      const Vector3d x(source(n, 0), source(n, 1), source(n, 2));
      place += of_dof.value(k) * x;
      modes.add(static_cast<int>(source(n, 3)), x, -of_dof.value(k) * direction, row);
    }
    modes.add(mesh.body_of_node[static_cast<std::size_t>(of_slave.node)], place, direction, row);
    gram += row.transpose() * row;
  }
}

}  // namespace

Eigen::MatrixXd prescribed_gram(const FieldSpace& space, const RigidModes& modes, const NodePlaces& at, const Supports& supports) {
  const Mesh& mesh = *space.mesh();
  const MultiVector& fixed = *supports.fixed;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(modes.count(), modes.count());
  add_nodes(mesh, modes, at, fixed, gram);
  add_inclined(mesh, modes, at, supports.inclined, gram);
  for (std::size_t p = 0; p < mesh.reference_points.size(); ++p) {
    const ReferencePoint& point = mesh.reference_points[p];
    const bool is_rigid = mesh.bodies[mesh.body_of_node[point.node]].is_surface;
    if (is_rigid || point.rotation_node >= 0)
      add_turning_point(mesh, modes, at, fixed, p, gram);
    else
      add_shared_translation(mesh, modes, at, fixed, point, gram);
  }
  if (supports.ties) add_ties(space, modes, at, *supports.ties, gram);
  for (const auto& connectors : supports.connectors) add_connectors(*connectors, modes, at, gram);
  return gram;
}

}  // namespace mortise
