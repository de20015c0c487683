#pragma once
// A contact pair as the host application describes it: surfaces, stiffness and options.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/formulation/dual_mortar.hpp"
#include "mortise/contact/friction.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/core/scalar_function.hpp"
#include "mortise/mortar/mortar_options.hpp"

namespace mortise {

/// Configuration that carries the contact geometry.
enum class ContactGeometry { current, reference };

/// Options of one pair that do not depend on the mesh.
struct ContactOptions {
  MortarOptions mortar;                                 ///< of the integrals
  ContactGeometry geometry = ContactGeometry::current;  ///< reference: for small displacements
  double full_cover = 1.0;                              ///< c_0: a slave node of which less is covered is tied to its neighbours; 0: none is
  std::optional<ScalarFunction> clearance;              ///< of t and the reference position: added to the gap that is drawn [length]; none: 0
  std::optional<double> complementarity_constant;       ///< c_n A_j, and c_t A_j; default E / h times Enforcement::relative_constant()
  Choice<Formulation> formulation{"dual mortar", std::make_shared<DualMortar>(), {}};  ///< null is refused
  Choice<FrictionLaw> friction{"none", std::make_shared<NoFriction>(), {}};            ///< null is refused
  void describe(Parameters& parameters);                                               ///< the list of a pair
};

/// One pair as the host application gives it.
struct ContactPair {
  std::string name;  ///< as messages say it
  Place place;       ///< where it is given; may be empty
  /// As MortarInterface wants them: every slave facet on each rank that owns a node of it, every master facet on one rank. Oriented as
  /// surface_facet.hpp says, with their normals out of the bodies. In 2D the body is on the left of the way along the nodes. In 3D a facet's nodes go
  /// round anticlockwise as seen from outside. Facets turned inside out are not detected: they never touch.
  SurfaceFacets slave;
  SurfaceFacets master;  ///< facets of the master, oriented as those of the slave
  /// Above 0. Of the softer side: sets c_n, the start rule and the stiffness of conditions that give way.
  double youngs_modulus = 0.0;
  ContactOptions options;  ///< the rest of it
  /// [owned nodes] added to the gap that is drawn, beside the clearance [length]: what facets leave of round surfaces. Null: nothing.
  std::shared_ptr<const std::vector<double>> facet_gaps;
  /// Conditions of a node that touched at the start of a step are on the change of its gap, 0 <= z_n _|_ g - g_start >= 0; others stay open in it
  /// (Laursen, Chawla 1997). Contact whose forces are constant over a step then does no work. Exact conditions only.
  bool has_conditions_on_rate = false;
  std::optional<std::size_t> second_pass_of;  ///< an earlier pair of a two-pass formulation, with the sides exchanged
};

}  // namespace mortise
