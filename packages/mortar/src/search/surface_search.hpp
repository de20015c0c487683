#pragma once
// Master facets of any rank that lie near each slave facet of this rank.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "geometry/facet_geometry.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mortar/segment_2d.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace mortise {

/// A facet as it travels between ranks: the ids and positions of its nodes.
template <int dim>
struct PlacedFacet {
  std::array<GlobalOrdinal, most_facet_nodes<dim>> nodes{};
  std::array<std::array<double, dim>, most_facet_nodes<dim>> x{};
  int count = 0;

  PlacedFacet() = default;
  PlacedFacet(const SurfaceFacet& ids, const FacetPoints<dim>& points) : count(static_cast<int>(points.size())) {
    for (int a = 0; a < count; ++a) {
      if (!ids.empty()) nodes[a] = ids[a];
      for (int i = 0; i < dim; ++i) x[a][i] = points[a][i];
    }
  }
  SurfaceFacet ids() const { return {nodes.begin(), nodes.begin() + count}; }
  FacetPoints<dim> points() const {
    FacetPoints<dim> result;
    for (int a = 0; a < count; ++a) result.push_back(Eigen::Map<const Eigen::Matrix<double, dim, 1>>(x[a].data()));
    return result;
  }
};

/// Distance of two lines, of quadratic ones that of their linear parts; 0 if they cross.
double facet_distance(const LinePoints& a, const LinePoints& b);

/// Collective: for each slave facet the master facets, of all ranks, within its radius (in 3D: whose boxes, of control points, lie within it), in
/// ascending order of node ids. A rendezvous by regions: only one box per rank is known everywhere; master facets travel to the ranks whose box they
/// meet.
/// @param radius  [slave] > 0
template <int dim>
std::vector<std::vector<PlacedFacet<dim>>> facets_within(const Communicator& comm, const std::vector<PlacedFacet<dim>>& slave,
                                                         const std::vector<double>& radius, const std::vector<PlacedFacet<dim>>& master);

/// A straight line through a slave node along its unit normal.
template <int dim>
struct NormalLine {
  Eigen::Matrix<double, dim, 1> x, normal;
};

/// Collective: for each line the distance along its normal (negative: behind x) of the nearest master facet that faces the normal and that the line
/// meets. Facets of all ranks count, however far. No value if there is none. Master facets travel as in facets_within().
template <int dim>
std::vector<std::optional<double>> distances_along_normals(const Communicator& comm, const std::vector<NormalLine<dim>>& lines,
                                                           const std::vector<PlacedFacet<dim>>& master);

}  // namespace mortise
