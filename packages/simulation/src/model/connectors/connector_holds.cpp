#include "model/connectors/connector_holds.hpp"

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>

namespace mortise {
namespace {

using Eigen::RowVectorXd;
using Eigen::Vector3d;

/// gram += sum of row^2 over nodes of this rank, on which components act one by one.
void add_nodes(const Mesh& mesh, const ConnectorLink& link, const RigidModes& modes, const NodePlaces& at, Eigen::MatrixXd& gram) {
  for (const ShareOfNode& share : link.shares)
    for (int i = 0; i < mesh.dimension && share.node < mesh.owned_count(); ++i) {
      if (link.law.components[i] == 0.0 || share.weight == 0.0) continue;
      RowVectorXd row = RowVectorXd::Zero(modes.count());
      const auto node = static_cast<std::size_t>(share.node);
      modes.add(mesh.body_of_node[node], at.x[node], Vector3d::Unit(i), row);
      gram += row.transpose() * row;
    }
}

/// Directions in which a link with means at its ends acts now. Collective.
std::vector<Vector3d> directions(const Mesh& mesh, const ConnectorLink& link, const NodePlaces& at) {
  std::vector<Vector3d> result;
  if (!link.law.is_axial) {
    for (int i = 0; i < 3; ++i)
      if (link.law.components[i] != 0.0) result.emplace_back(Vector3d::Unit(i));
    return result;
  }
  Vector3d mine = Vector3d::Zero(), moved;  // of the line since the start
  for (const ShareOfNode& share : link.shares) {
    const auto node = static_cast<std::size_t>(share.node);
    mine += share.weight * (at.x[node] - Vector3d(mesh.coordinates[node].data()));
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 3, mine.data(), moved.data());
  const Vector3d line = link.start + moved;
  if (link.law.axial != 0.0 && line.norm() > 0.0) result.emplace_back(line.normalized());
  return result;
}

}  // namespace

void add_connectors(const Connectors& connectors, const RigidModes& modes, const NodePlaces& at, Eigen::MatrixXd& gram) {
  const Mesh& mesh = *connectors.bodies()->mesh();
  for (const ConnectorLink& link : connectors.links()) {
    if (!link.is_spread) {
      add_nodes(mesh, link, modes, at, gram);
      continue;
    }
    for (const Vector3d& direction : directions(mesh, link, at)) {
      RowVectorXd mine = RowVectorXd::Zero(modes.count()), row(modes.count());
      for (const ShareOfNode& share : link.shares) {
        const auto node = static_cast<std::size_t>(share.node);
        const int body = mesh.body_of_node[node];
        if (link.is_rotation)
          modes.add_rotation(body, (share.weight < 0.0 ? -1.0 : 1.0) * (mesh.dimension == 2 ? Vector3d(Vector3d::UnitZ()) : direction), mine);
        else
          modes.add(body, at.x[node], share.weight * direction, mine);
      }
      Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), row.data());
      if (mesh.comm->getRank() == 0) gram += row.transpose() * row;
    }
  }
}

}  // namespace mortise
