#include "mortise/simulation/model/hold_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/prescribed_rows.hpp"
#include "model/rigid_mode_names.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/core/symmetric_spectrum.hpp"
#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {
namespace {

using Position = Eigen::Vector3d;  // z = 0 in 2D

/// A null vector has an eigenvalue below this, relative to the largest one.
constexpr double rank_tolerance = 1e-12;

Position position(const Mesh& mesh, LocalOrdinal node) { return Position(mesh.coordinates[node].data()); }

/// Slave facets in the bounding box of what the master surface has of a body, widened by the reach: what can touch at the start. Collective.
Eigen::MatrixXd contact_gram(const Mesh& mesh, const RigidModes& modes, const HoldingPair& pair) {
  const auto nodes_of = [&](const SurfaceFacet& facet) {
    Facet<LocalOrdinal> nodes;
    for (const GlobalOrdinal node : facet) nodes.push_back(mesh.local_nodes->getLocalElement(node));
    return nodes;
  };
  // Over all ranks: the largest facet, and of each body (x, y, z, -x, -y, -z) of its master nodes.
  std::vector<double> mine(1 + 6 * mesh.bodies.size(), -std::numeric_limits<double>::max());
  const auto entry = [](std::size_t body, int i) { return 1 + 6 * body + static_cast<std::size_t>(i); };
  for (const auto* facets : {pair.slave, pair.master})
    for (const auto& facet : *facets) {
      const auto nodes = nodes_of(facet);
      for (const LocalOrdinal node : nodes) mine[0] = std::max(mine[0], (position(mesh, node) - position(mesh, nodes[0])).norm());
    }
  for (const auto& facet : *pair.master)
    for (const LocalOrdinal node : nodes_of(facet)) {
      const Position x = position(mesh, node);
      const auto body = static_cast<std::size_t>(mesh.body_of_node[node]);
      for (int i = 0; i < 3; ++i) {
        mine[entry(body, i)] = std::max(mine[entry(body, i)], x(i));
        mine[entry(body, 3 + i)] = std::max(mine[entry(body, 3 + i)], -x(i));
      }
    }
  const std::vector<double> all = most_over_ranks(*mesh.comm, mine);
  const double reach = pair.reach > 0.0 ? pair.reach : all[0];
  const auto is_near = [&](const Position& x, std::size_t body) {
    for (int i = 0; i < 3; ++i)
      if (x(i) > all[entry(body, i)] + reach || -x(i) > all[entry(body, 3 + i)] + reach) return false;
    return true;
  };

  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(modes.count(), modes.count());
  for (const auto& facet : *pair.slave) {
    const auto nodes = nodes_of(facet);
    const std::size_t corners = mesh.dimension == 2 ? 2 : nodes.size() % 4 == 0 ? 4 : 3;
    Position middle = Position::Zero();
    for (std::size_t corner = 0; corner < corners; ++corner) middle += position(mesh, nodes[corner]) / static_cast<double>(corners);
    const auto x = [&](std::size_t corner) { return position(mesh, nodes[corner % corners]); };
    const Position area = mesh.dimension == 2 ? (x(1) - x(0)).cross(Position::UnitZ()) : (x(2) - x(0)).cross(x(3) - x(1));
    const Position normal = area.normalized();
    std::vector<Position> held{normal};
    if (pair.rubs) held = {Position::UnitX(), Position::UnitY(), Position::UnitZ()};
    for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
      if (!is_near(middle, body)) continue;
      // At the corners, not the middle: one facet keeps a body from turning.
      for (std::size_t corner = 0; corner < corners; ++corner)
        for (const Position& direction : held) {
          Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(modes.count());
          modes.add(mesh.body_of_node[nodes[0]], x(corner), direction, row);
          modes.add(static_cast<int>(body), x(corner), -direction, row);
          gram += row.transpose() * row;
        }
    }
  }
  return gram;
}

/// Columns span the null space.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& gram) {
  const SymmetricSpectrum spectrum = symmetric_spectrum(gram);
  const double bound = std::max(rank_tolerance * spectrum.values.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const auto count = (spectrum.values.array() < bound).count();
  return spectrum.vectors.leftCols(count);
}

/// A free motion of a body in which `mode` is largest: its name, or the direction of a translation that is not along an axis.
/// @param translations  how many of the modes of a body are
std::string name_of_motion(const RigidModes& modes, const Eigen::MatrixXd& free, int body, int mode, int translations) {
  if (mode >= translations || translations == 1) return modes.name(mode);
  const Eigen::VectorXd motion = free * free.row(modes.per_body() * body + mode).transpose();
  Eigen::VectorXd along = motion.segment(modes.per_body() * body, translations).normalized();
  constexpr double on_axis = 1e-3;
  if (std::abs(along[mode]) > 1.0 - on_axis) return modes.name(mode);
  Eigen::Index first = 0;
  while (std::abs(along[first]) < on_axis) ++first;
  if (along[first] < 0.0) along = -along;
  std::vector<std::string> numbers;
  for (const double one : along) numbers.push_back(fmt::format("{:.3g}", std::abs(one) < on_axis ? 0.0 : one));
  return fmt::format("translation along ({})", fmt::join(numbers, ", "));
}

}  // namespace

std::vector<char> check_held(const FieldSpace& space, bool axisymmetric, const Supports& supports, const std::vector<HoldingPair>& pairs,
                             const std::vector<Place>& body_places, bool may_move) {
  const Mesh& mesh = *space.mesh();
  std::vector<int> bodies(mesh.bodies.size());
  std::iota(bodies.begin(), bodies.end(), 0);
  const NodePlaces at = node_places(mesh);
  const RigidModes modes(mesh, axisymmetric, std::move(bodies), at.x);
  const bool has_links = supports.ties || !supports.connectors.empty();  // between bodies
  Supports without_links = supports;
  without_links.ties = nullptr;
  without_links.connectors.clear();
  const Eigen::MatrixXd prescribed = sum_over_ranks(*mesh.comm, prescribed_gram(space, modes, at, without_links));
  const Eigen::MatrixXd without_contact = has_links ? sum_over_ranks(*mesh.comm, prescribed_gram(space, modes, at, supports)) : prescribed;
  Eigen::MatrixXd contact = Eigen::MatrixXd::Zero(modes.count(), modes.count());
  for (const auto& pair : pairs) contact += contact_gram(mesh, modes, pair);

  std::vector<Diagnostic> diagnostics;
  const Eigen::MatrixXd free = null_space(without_contact + sum_over_ranks(*mesh.comm, contact));
  for (const auto& [body, mode] : distinct_modes(free, modes.per_body()))
    diagnostics.push_back(
        {body_places[body], fmt::format("body '{}' can move: {}; neither boundary conditions nor contact hold it; contact holds where a slave "
                                        "facet is within reach at the start, along its normal, and with friction along the surface",
                                        mesh.bodies[body].name, name_of_motion(modes, free, body, mode, axisymmetric ? 1 : mesh.dimension))});
  if (!diagnostics.empty() && !may_move) throw InputError(diagnostics);

  std::vector<char> only_contact;
  const Eigen::MatrixXd loose = has_links ? null_space(without_contact) : Eigen::MatrixXd();
  constexpr double moves = 1e-6;  // in a motion of size 1 of all bodies
  for (Eigen::Index body = 0; body < static_cast<Eigen::Index>(mesh.bodies.size()); ++body) {
    const auto block = prescribed.block(modes.per_body() * body, modes.per_body() * body, modes.per_body(), modes.per_body());
    const bool is_tied_down = has_links && loose.middleRows(modes.per_body() * body, modes.per_body()).norm() < moves;
    only_contact.push_back(null_space(block).cols() > 0 && !is_tied_down);
  }
  return only_contact;
}

}  // namespace mortise
