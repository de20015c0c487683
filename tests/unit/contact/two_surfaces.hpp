#pragma once
// A slave and a master surface facing each other, spread over the ranks, on a made-up bulk of springs.

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <vector>

#include "facets_with_middles.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/core/dof_map.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::test {

using Point = std::array<double, 3>;  // z = 0 in the plane

/// Node ids: slave nodes first, then master nodes. The slave lies above, travelling to +x with its outward normal down; the master below, travelling
/// to -x with its outward normal up. In 3D, and where they are quadratic, facets are listed.
struct TwoSurfaces {
  int dimension = 2;
  std::vector<Point> slave, master;
  SurfaceFacets slave_facets, master_facets;  ///< node ids; empty in 2D: the polylines
  std::vector<std::array<bool, 3>> fixed;     ///< [all nodes]
  ContactOptions options;
  InterfaceMeasure measure;
  bool has_conditions_on_rate = false;  ///< ContactPair::has_conditions_on_rate
  bool zeros_dropped = false;           ///< the bulk couples components of different nodes only with their likes, and its graph has nothing else

  std::size_t size() const { return slave.size() + master.size(); }
};

/// Slave: 6 nodes on a gentle arch over [0.1, 5.1]; master: 8 nodes over [0, 4.6], so the slave runs off at the right.
inline TwoSurfaces arch_on_ground() {
  TwoSurfaces surfaces;
  for (int i = 0; i < 6; ++i) surfaces.slave.push_back({0.1 + i, 0.02 * (i - 2.0) * (i - 2.0) - 0.03, 0.0});
  for (int i = 0; i < 8; ++i) surfaces.master.push_back({4.6 * (7 - i) / 7.0, 0.03 * std::sin(1.3 * i), 0.0});
  surfaces.fixed.assign(surfaces.size(), {});
  return surfaces;
}

/// Slave: 6 nodes along the ground up to a corner of 30 degrees, node 2, and up behind it, with two weaker ones; master: that of arch_on_ground().
inline TwoSurfaces corner_on_ground() {
  TwoSurfaces surfaces = arch_on_ground();
  surfaces.slave = {{0.1, 0.01, 0.0}, {1.1, -0.02, 0.0}, {2.1, -0.04, 0.0}, {2.85, 0.4, 0.0}, {3.4, 1.05, 0.0}, {3.7, 1.9, 0.0}};
  return surfaces;
}

/// Grids of quadrilaterals, or of triangles. Slave: 4 x 4 nodes of a gentle dome over [0.1, 3.1] x [0.2, 3.05]; master: 5 x 4 nodes of waves over
/// [0, 2.7] x [0, 3.3], so the slave runs off on one side.
inline TwoSurfaces dome_on_waves(bool triangles = false) {
  TwoSurfaces surfaces;
  surfaces.dimension = 3;
  const auto grid = [&](int along, int across, const std::function<Point(int, int)>& position, bool up, std::vector<Point>& points,
                        SurfaceFacets& facets) {
    const auto first = static_cast<GlobalOrdinal>(surfaces.size());
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < along; ++i) points.push_back(position(i, j));
    const auto add = [&](SurfaceFacet facet) {
      if (!up) std::reverse(facet.begin(), facet.end());
      facets.push_back(facet);
    };
    for (int j = 0; j + 1 < across; ++j)
      for (int i = 0; i + 1 < along; ++i) {
        const GlobalOrdinal a = first + i + along * j, b = a + 1, c = b + along, d = a + along;
        if (triangles) {
          add({a, b, c});
          add({a, c, d});
        } else {
          add({a, b, c, d});
        }
      }
  };
  grid(
      4, 4,
      [](int i, int j) {
        return Point{0.1 + i, 0.2 + 0.95 * j, 0.02 * (i - 1.2) * (i - 1.2) + 0.015 * (j - 1.7) * (j - 1.7) - 0.03};
      },
      false, surfaces.slave, surfaces.slave_facets);
  grid(
      5, 4,
      [](int i, int j) {
        return Point{2.7 * i / 4.0, 1.1 * j, 0.03 * std::sin(1.3 * i + 0.8 * j)};
      },
      true, surfaces.master, surfaces.master_facets);
  surfaces.fixed.assign(surfaces.size(), {});
  return surfaces;
}

/// Of dome_on_waves(): the master ends a tenth of a facet behind the nodes of the slave's last but one row. So the last row, nodes 3, 7, 11 and 15,
/// is tied to it.
inline TwoSurfaces hardly_covered(TwoSurfaces surfaces) {
  for (Point& x : surfaces.master) x[0] *= 2.2 / 2.7;
  return surfaces;
}

/// Of dome_on_waves(): the corner of the master lies a tenth of a facet behind slave node 10, in the facet of nodes 10, 11, 14 and 15.
inline TwoSurfaces hardly_covered_at_a_corner(TwoSurfaces surfaces) {
  for (Point& x : surfaces.master) {
    x[0] *= 2.2 / 2.7;
    x[1] *= 2.2 / 3.3;
  }
  return surfaces;
}

/// The same surfaces of quadratic facets on either side, with the mid-side nodes a little off the straight edges.
inline TwoSurfaces quadratic(const TwoSurfaces& linear, bool slave, bool master) {
  TwoSurfaces result = linear;
  const auto polyline = [](std::size_t first, std::size_t count) {
    SurfaceFacets facets;
    for (std::size_t n = first; n + 1 < first + count; ++n) facets.push_back({static_cast<GlobalOrdinal>(n), static_cast<GlobalOrdinal>(n + 1)});
    return facets;
  };
  if (linear.dimension == 2) {
    result.slave_facets = polyline(0, linear.slave.size());
    result.master_facets = polyline(linear.slave.size(), linear.master.size());
  }
  const auto raise = [](SurfaceFacets& facets, std::vector<Point>& points, GlobalOrdinal first_of_side) {
    const FacetsWithMiddles raised = with_middles(facets, first_of_side + static_cast<GlobalOrdinal>(points.size()));
    for (const auto& [a, b] : raised.edges) {
      const Point &x = points[static_cast<std::size_t>(a - first_of_side)], &y = points[static_cast<std::size_t>(b - first_of_side)];
      Point middle;
      for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (x[i] + y[i]);
      middle[1] += 0.01 * std::sin(1.7 * static_cast<double>(a + b));
      points.push_back(middle);
    }
    facets = raised.facets;
  };
  if (slave) raise(result.slave_facets, result.slave, 0);
  const auto shift = static_cast<GlobalOrdinal>(result.slave.size() - linear.slave.size());
  for (SurfaceFacet& facet : result.master_facets)
    for (GlobalOrdinal& node : facet) node += shift;
  if (master) raise(result.master_facets, result.master, static_cast<GlobalOrdinal>(result.slave.size()));
  result.fixed.assign(result.size(), {});
  return result;
}

/// Numbering of a host's dofs.
enum class HostNumbering {
  by_nodes,    ///< dim * node + component
  interleaved  ///< backwards, a scalar field before each node's displacements, and without those that are prescribed
};

/// Everything that is made from TwoSurfaces on `comm`. Node n belongs to rank n mod size.
class Fixture {
 public:
  /// @param transfers  the scalar field of the interleaved numbering gets what crosses the interface
  Fixture(const TwoSurfaces& surfaces, RCP<const Communicator> comm, HostNumbering numbering = HostNumbering::by_nodes, bool transfers = false)
      : surfaces_(surfaces), numbering_(numbering) {
    std::vector<GlobalOrdinal> ids;
    for (std::size_t n = 0; n < surfaces.size(); ++n)
      if (static_cast<int>(n) % comm->getSize() == comm->getRank()) ids.push_back(static_cast<GlobalOrdinal>(n));
    nodes = rcp(new Map(surfaces.size(), ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
    const int dim = surfaces.dimension;
    std::vector<GlobalOrdinal> rows, displacements;
    for (const GlobalOrdinal node : ids) {
      if (numbering == HostNumbering::interleaved) rows.push_back(scalar(node));
      for (int i = 0; i < dim; ++i) {
        displacements.push_back(number(dim * node + i));
        if (displacements.back() != NodalField::none) rows.push_back(displacements.back());
      }
    }
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    dofs = rcp(new Map(invalid, rows.data(), static_cast<LocalOrdinal>(rows.size()), 0, comm));
    const auto reference = rcp(new MultiVector(nodes, static_cast<std::size_t>(dim)));
    const auto fixed = rcp(new MultiVector(nodes, static_cast<std::size_t>(dim)));
    for (std::size_t n = 0; n < ids.size(); ++n)
      for (int i = 0; i < dim; ++i) {
        const std::size_t id = static_cast<std::size_t>(ids[n]);
        reference->replaceLocalValue(n, i, id < surfaces.slave.size() ? surfaces.slave[id][i] : surfaces.master[id - surfaces.slave.size()][i]);
        fixed->replaceLocalValue(n, i, surfaces.fixed[id][i] ? 1.0 : 0.0);
      }
    const auto slaves = static_cast<GlobalOrdinal>(surfaces.slave.size()), all = static_cast<GlobalOrdinal>(surfaces.size());
    const SurfaceFacets upper = surfaces.slave_facets.empty() ? polyline(0, slaves) : surfaces.slave_facets;
    const SurfaceFacets lower = surfaces.master_facets.empty() ? polyline(slaves, all) : surfaces.master_facets;
    std::vector<ContactPair> pairs{make_pair(upper, lower)};
    if (surfaces.options.formulation.options->two_pass()) {
      pairs.push_back(make_pair(lower, upper));
      pairs.back().second_pass_of = 0;
    }
    contact = std::make_unique<ContactSystem>(NodalField("displacement", nodes, dim, displacements), dofs, reference, fixed, surfaces.measure, pairs,
                                              Timers(), transfers ? std::vector<NodalField>{scalar_field()} : std::vector<NodalField>{});

    const auto graph = rcp(new Graph(dofs, 7 * dim + 1));
    visit_springs([&](GlobalOrdinal row, GlobalOrdinal column, double) { graph->insertGlobalIndices(row, 1, &column); });
    graph->fillComplete(dofs, dofs);
    bulk = graph;
  }

  /// A vector on `map` from a function of the global id; the same on any number of ranks.
  static RCP<Vector> vector(const RCP<const Map>& map, const std::function<double(GlobalOrdinal)>& value) {
    const auto result = rcp(new Vector(map));
    for (const GlobalOrdinal id : local_ids(*map)) result->replaceGlobalValue(id, value(id));
    return result;
  }

  /// Multipliers: pressure times the outward normal down, with a tangential part.
  RCP<Vector> multipliers(const std::function<double(std::size_t)>& pressure) const {
    const GlobalOrdinal offset = dofs->getMaxAllGlobalIndex() + 1;
    return vector(contact->multiplier_map(), [&](GlobalOrdinal id) {
      const int dim = surfaces_.dimension;
      const auto node = static_cast<std::size_t>((id - offset) / dim);
      const auto component = (id - offset) % dim;
      return component == 0 ? 0.07 * pressure(node) : component == dim - 1 ? -pressure(node) : 0.04 * pressure(node);
    });
  }

  /// The history of a first step from displacement d; no body is held by contact alone. The start rule changes z.
  ContactHistory first_step(const Vector& d, Vector& z) const { return contact->start_step(contact->initial_history(d), d, z); }

  /// K of springs: symmetric part with a dominant diagonal, and an antisymmetric one, on the condensed system's graph.
  RCP<Matrix> springs(const RCP<const Graph>& graph) const {
    const auto K = rcp(new Matrix(graph));
    visit_springs([&](GlobalOrdinal row, GlobalOrdinal column, double value) { K->sumIntoGlobalValues(row, 1, &value, &column); });
    return K;
  }

  /// Whole dense copy on every rank.
  static Eigen::MatrixXd dense(const Matrix& matrix, const std::vector<GlobalOrdinal>& rows, const std::vector<GlobalOrdinal>& columns) {
    Eigen::MatrixXd mine = Eigen::MatrixXd::Zero(rows.size(), columns.size()), all = mine;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const LocalOrdinal row = matrix.getRowMap()->getLocalElement(rows[r]);
      if (row < 0) continue;
      Matrix::local_inds_host_view_type indices;
      Matrix::values_host_view_type values;
      matrix.getLocalRowView(row, indices, values);
      for (std::size_t k = 0; k < indices.extent(0); ++k) {
        const GlobalOrdinal id = matrix.getColMap()->getGlobalElement(indices(k));
        mine(r, std::find(columns.begin(), columns.end(), id) - columns.begin()) += values(k);
      }
    }
    Teuchos::reduceAll(*matrix.getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
    return all;
  }
  static Eigen::VectorXd dense(const Vector& vector, const std::vector<GlobalOrdinal>& ids) {
    Eigen::VectorXd mine = Eigen::VectorXd::Zero(ids.size()), all = mine;
    const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const LocalOrdinal local = vector.getMap()->getLocalElement(ids[k]);
      if (local >= 0) mine[k] = view(local, 0);
    }
    Teuchos::reduceAll(*vector.getMap()->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
    return all;
  }
  /// All ids of a one-to-one map, ascending, on every rank.
  static std::vector<GlobalOrdinal> all_ids(const Map& map) {
    std::vector<int> mine(map.getMaxAllGlobalIndex() + 1, 0), all = mine;
    for (const GlobalOrdinal id : local_ids(map)) mine[id] = 1;
    Teuchos::reduceAll(*map.getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
    std::vector<GlobalOrdinal> ids;
    for (std::size_t id = 0; id < all.size(); ++id)
      if (all[id]) ids.push_back(static_cast<GlobalOrdinal>(id));
    return ids;
  }

  /// The host's id of a displacement, from dim * node + component; NodalField::none where the host has eliminated it.
  GlobalOrdinal number(GlobalOrdinal by_nodes) const {
    if (numbering_ == HostNumbering::by_nodes) return by_nodes;
    const GlobalOrdinal dim = surfaces_.dimension;
    const auto node = static_cast<std::size_t>(by_nodes / dim);
    if (surfaces_.fixed[node][static_cast<std::size_t>(by_nodes % dim)]) return NodalField::none;
    return scalar(by_nodes / dim) + 1 + by_nodes % dim;
  }
  /// The scalar field of the interleaved numbering.
  NodalField scalar_field() const {
    std::vector<GlobalOrdinal> ids;
    for (const GlobalOrdinal node : local_ids(*nodes)) ids.push_back(scalar(node));
    return {"scalar", nodes, 1, ids};
  }
  /// True for the id of a value of that field.
  bool is_scalar(GlobalOrdinal id) const { return id % (surfaces_.dimension + 1) == 0; }
  /// Displacements in the numbering of this host, by the ids dim * node + component.
  RCP<Vector> numbered(const Vector& by_nodes) const {
    const auto result = rcp(new Vector(dofs));
    const auto view = by_nodes.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t k = 0; k < view.extent(0); ++k)
      if (const GlobalOrdinal id = number(by_nodes.getMap()->getGlobalElement(static_cast<LocalOrdinal>(k))); id != NodalField::none)
        result->replaceGlobalValue(id, view(k, 0));
    return result;
  }

  RCP<const Map> nodes, dofs;
  RCP<const Graph> bulk;
  std::unique_ptr<ContactSystem> contact;

 private:
  GlobalOrdinal scalar(GlobalOrdinal node) const { return (surfaces_.dimension + 1) * (static_cast<GlobalOrdinal>(surfaces_.size()) - 1 - node); }
  /// The bulk's entries of this rank. The scalar field is coupled with the displacements of its node.
  template <class Visit>
  void visit_springs(const Visit& visit) const {
    const GlobalOrdinal dim = surfaces_.dimension;
    for (const GlobalOrdinal node : local_ids(*nodes)) {
      if (numbering_ == HostNumbering::interleaved) visit(scalar(node), scalar(node), 3.0);
      for (GlobalOrdinal row = dim * node; row < dim * (node + 1); ++row) {
        if (number(row) == NodalField::none) continue;
        if (numbering_ == HostNumbering::interleaved) {
          visit(number(row), scalar(node), 0.5);
          visit(scalar(node), number(row), -0.25);
        }
        for (GlobalOrdinal column = first_column(row); column < end_column(row); ++column) {
          if (!coupled(row, column) || number(column) == NodalField::none) continue;
          visit(number(row), number(column),
                row == column ? 900.0 + 7.0 * row : -60.0 * std::cos(0.3 * (row + column)) + 11.0 * std::sin(0.9 * (row - column)));
        }
      }
    }
  }
  static SurfaceFacets polyline(GlobalOrdinal first, GlobalOrdinal end) {
    SurfaceFacets facets;
    for (GlobalOrdinal node = first; node + 1 < end; ++node) facets.push_back({node, node + 1});
    return facets;
  }
  /// The pair as a rank gives it: slave facets of its nodes, master facets once.
  ContactPair make_pair(const SurfaceFacets& slave, const SurfaceFacets& master) const {
    ContactPair pair;
    pair.name = "pair";
    pair.youngs_modulus = 100.0;
    pair.options = surfaces_.options;
    pair.has_conditions_on_rate = surfaces_.has_conditions_on_rate;
    const auto mine = [&](GlobalOrdinal node) { return nodes->isNodeGlobalElement(node); };
    std::copy_if(slave.begin(), slave.end(), std::back_inserter(pair.slave),
                 [&](const SurfaceFacet& facet) { return std::any_of(facet.begin(), facet.end(), mine); });
    std::copy_if(master.begin(), master.end(), std::back_inserter(pair.master), [&](const SurfaceFacet& facet) { return mine(facet[0]); });
    return pair;
  }
  // The springs of a node go to the two nodes before and behind it.
  GlobalOrdinal first_column(GlobalOrdinal row) const {
    const GlobalOrdinal dim = surfaces_.dimension;
    return std::max<GlobalOrdinal>(0, (row / dim - 2) * dim);
  }
  GlobalOrdinal end_column(GlobalOrdinal row) const {
    const GlobalOrdinal dim = surfaces_.dimension;
    return std::min<GlobalOrdinal>(dim * static_cast<GlobalOrdinal>(surfaces_.size()), (row / dim + 3) * dim);
  }
  bool coupled(GlobalOrdinal row, GlobalOrdinal column) const {
    const GlobalOrdinal dim = surfaces_.dimension;
    return !surfaces_.zeros_dropped || row / dim == column / dim || row % dim == column % dim;
  }
  TwoSurfaces surfaces_;
  HostNumbering numbering_;
};

}  // namespace mortise::test
