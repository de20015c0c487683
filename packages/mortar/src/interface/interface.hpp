#pragma once
// One interface in 2D or 3D: search and numbering stand in interface_implementation.cpp, integrals in interface_evaluation.cpp.

#include <memory>
#include <optional>
#include <vector>

#include "coupling/facet_coupling_2d.hpp"
#include "coupling/facet_coupling_3d.hpp"
#include "distribution/guest_facets.hpp"
#include "interface/interface_implementation.hpp"

namespace mortise {

struct SettledCorner;

template <int dim>
struct IntegratorOf;
template <>
struct IntegratorOf<2> : FacetIntegrator2d {
  IntegratorOf(const InterfaceMeasure& measure, const MortarOptions& options) : FacetIntegrator2d(measure, options) {}
};
template <>
struct IntegratorOf<3> : FacetIntegrator3d {
  IntegratorOf(const InterfaceMeasure&, const MortarOptions& options) : FacetIntegrator3d(options) {}
};

// Candidates of a slave facet, kept from search to search: a superset of the master facets it can overlap now. Those that take part are chosen in
// evaluate() from positions alone, so no result depends on when the last search was. The facet takes part if a master facet that it overlaps lies
// within the reach. Then all within reach + its longest edge do.
template <int dim>
class Interface final : public InterfaceImplementation {
 public:
  explicit Interface(const InterfaceInput& input);
  bool search(const MultiVector& x) override;
  void evaluate(const MultiVector& x, bool derivatives, std::vector<FacetCoupling>& couplings, std::vector<NodalNormal>& normals,
                std::optional<StepFailure>& failure) override;
  std::vector<GapCurvature> gap_curvatures(const MultiVector& x, const std::vector<double>& pressures) override;
  SurfaceKinks find_kinks(const MultiVector& x, const std::vector<Facet<LocalOrdinal>>& nearest, const SurfaceKinks& before) override;
  bool set_kinks(const SurfaceKinks& kinks) override;
  bool retain(const std::shared_ptr<const RetainedNodes>& nodes) override;
  long kinks(const MultiVector& x) override;
  std::vector<std::optional<double>> distances_to_master(const MultiVector& x, const std::vector<std::size_t>& nodes,
                                                         const std::vector<SpatialVector>& normals) override;

 private:
  using Candidates = std::vector<SurfaceFacets>;

  void measure_facets(const MultiVector& reference, const Place& place);
  /// Normals of nodes at supports keep the components that are prescribed there; those at planes of symmetry do not.
  void release_leaning_nodes(const MultiVector& reference);
  bool moved(const MultiVector& x) const;
  std::vector<PlacedFacet<dim>> place_master(const MultiVector& x);
  double least_height(const Positions<dim>& slave_x, const std::vector<PlacedFacet<dim>>& placed_master) const;
  Candidates find(const Positions<dim>& x, const std::vector<PlacedFacet<dim>>& placed_master, const Motion& motion) const;
  void number_nodes();
  void couple_beyond_corners(std::size_t facet, std::vector<LocalOrdinal>& nodes) const;
  void collect_met();
  bool balance(const Positions<dim>& slave_x);
  FacetReach limits_of(const Facet<LocalOrdinal>& nodes, const Positions<dim>& x) const {
    return {reach, reach + longest_edge<dim>(points_of<dim>(nodes, x))};
  }
  std::size_t segments_of(SlaveFacetData& data, const std::vector<Facet<LocalOrdinal>>& candidates, const Positions<dim>& x, bool derivatives,
                          FacetCoupling& coupling);
  void couple_facets(const Positions<dim>& x, bool derivatives, std::vector<NodalNormal>& normals, std::vector<FacetCoupling>& couplings,
                     std::optional<StepFailure>& failure);
  void pass_couplings(std::vector<FacetCoupling>& couplings);
  /// Kinks of owned nodes get the normals that their facets' couplings [facets] call for, and their rows the weights.
  void settle_corners(bool derivatives, std::vector<NodalNormal>& normals, std::vector<FacetCoupling>& couplings) const;
  bool settle_node(std::size_t s, const Positions<dim>& x, bool derivatives, std::vector<NodalNormal>& normals, SettledCorner& corner);
  std::size_t couple_nodes(const Positions<dim>& x, bool derivatives, std::vector<NodalNormal>& normals, std::vector<FacetCoupling>& couplings,
                           std::optional<StepFailure>& failure);

  RCP<const Map> owned_nodes_;
  InterfaceMeasure measure_;
  MortarOptions options_;
  SurfaceFacets master_;
  std::unique_ptr<Gathered<dim>> slave_positions_, master_positions_;
  Candidates candidate_ids_;                                  ///< [facets] ascending
  std::vector<std::vector<Facet<LocalOrdinal>>> candidates_;  ///< [facets] as local nodes
  std::vector<std::vector<Facet<LocalOrdinal>>> met_;         ///< [owned slave nodes] candidates of their facets; node to segment only
  RCP<MultiVector> searched_at_;                              ///< owned positions of the last real search
  double free_distance_ = 0.0;                                ///< that every node may move from there without another one
  IntegratorOf<dim> integrator_;
  std::unique_ptr<FacetDistribution> distribution_;  ///< null where this rank integrates all that it owns
  GuestFacets guests_;
  std::vector<FacetCoupling> guest_couplings_;                      ///< [guests]
  std::vector<std::size_t> segments_of_facet_, segments_of_guest_;  ///< [facets], [guests] of the last evaluation
  SurfaceKinks kinks_;                                              ///< those that are set; at first none
  std::shared_ptr<const RetainedNodes> retained_;                   ///< null: none
  bool retained_is_new_ = false;                                    ///< the next search numbers the nodes again
  bool counted_ = false;                                            ///< there has been one
};

}  // namespace mortise
