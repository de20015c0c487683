#pragma once
// Implementation of MortarInterface: the same in 2D and in 3D.

#include <memory>
#include <optional>
#include <vector>

#include "geometry/facet_geometry.hpp"
#include "mortise/mortar/auxiliary_plane.hpp"
#include "mortise/mortar/mortar_interface.hpp"
#include "search/surface_search.hpp"
#include "slave/slave_surface.hpp"

namespace mortise {

/// Arguments of an interface.
struct InterfaceInput {
  RCP<const Map> owned_nodes;
  RCP<const MultiVector> reference, fixed;
  const SurfaceFacets &slave, &master;
  InterfaceMeasure measure;
  MortarOptions options;
  Place place;
};

/// Functions are those of MortarInterface.
class InterfaceImplementation {
 public:
  virtual ~InterfaceImplementation() = default;
  virtual bool search(const MultiVector& x) = 0;
  virtual void evaluate(const MultiVector& x, bool derivatives, std::vector<FacetCoupling>& couplings, std::vector<NodalNormal>& normals,
                        std::optional<StepFailure>& failure) = 0;
  virtual std::vector<GapCurvature> gap_curvatures(const MultiVector& x, const std::vector<double>& pressures) = 0;
  virtual SurfaceKinks find_kinks(const MultiVector& x, const std::vector<Facet<LocalOrdinal>>& nearest, const SurfaceKinks& before) = 0;
  virtual bool set_kinks(const SurfaceKinks& kinks) = 0;
  virtual bool retain(const std::shared_ptr<const RetainedNodes>& nodes) = 0;
  virtual long kinks(const MultiVector& x) = 0;
  virtual std::vector<std::optional<double>> distances_to_master(const MultiVector& x, const std::vector<std::size_t>& nodes,
                                                                 const std::vector<SpatialVector>& normals) = 0;

  SlaveSurface slave;
  double shortest = 0.0, longest = 0.0, reach = 0.0;
  InterfaceLoad load;
  std::vector<std::size_t> segments;  ///< [couplings of the last evaluation]
  std::shared_ptr<const InterfacePattern> pattern;
  RCP<const Map> local_nodes;  ///< of the pattern
};

template <int dim>
std::unique_ptr<InterfaceImplementation> make_interface(const InterfaceInput& input);

/// Positions of some nodes of all ranks.
template <int dim>
class Gathered {
 public:
  Gathered(const RCP<const Map>& owned_nodes, const std::vector<GlobalOrdinal>& ids);
  /// Collective.
  Positions<dim> operator()(const MultiVector& x);
  LocalOrdinal local(GlobalOrdinal node) const { return map_->getLocalElement(node); }

 private:
  RCP<const Map> map_;
  Import import_;
  MultiVector positions_;
};

/// Effect of motions between two searches on a pair of facets: ends come nearer by `approach`, facets and so nodal normals turn by `turn`.
struct Motion {
  double approach, turn;
};

/// Finds master facets that may lie under a slave facet after a motion, seen along its nodal normals in 2D, along its own normal in 3D.
template <int dim>
class OverlapTest;

template <>
class OverlapTest<2> {
 public:
  OverlapTest(const FacetPoints<2>& slave, const std::vector<NodalNormal>& normals, const Motion& motion);
  bool operator()(const FacetPoints<2>& master) const;

 private:
  FacetPoints<2> slave_;  ///< control points
  Eigen::Vector2d normal_, tangent_;
  double approach_, lean_ = 0.0;  ///< of the nodal normals to the sides, as an angle
};

template <>
class OverlapTest<3> {
 public:
  OverlapTest(const FacetPoints<3>& slave, const std::vector<NodalNormal>& normals, const Motion& motion);
  bool operator()(const FacetPoints<3>& master) const;

 private:
  bool stay_apart(const FacetVectors& slave, const FacetVectors& master) const;  ///< linear parts, in the frame of the plane

  std::optional<AuxiliaryPlane> plane_;
  std::vector<FacetVectors> parts_;       ///< linear, of the slave, in the frame of the plane
  double approach_, tangent_, same_way_;  ///< tan of the turn; sine of what two normals can turn against one another
};

}  // namespace mortise
