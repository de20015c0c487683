#pragma once
// A scene: everything a run is made of, as the scene file says it. Each list of the file is one struct here.

#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/material/material_options.hpp"
#include "mortise/mesh/mesh_options.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/nonlinear/linear_solver_options.hpp"
#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/nonlinear/newton_solver.hpp"
#include "mortise/simulation/quantities/quantity.hpp"
#include "mortise/simulation/scene/automatic_contact.hpp"
#include "mortise/simulation/scene/checks.hpp"
#include "mortise/simulation/scene/contact_start.hpp"
#include "mortise/simulation/scene/heat.hpp"
#include "mortise/simulation/scene/inertia.hpp"
#include "mortise/simulation/scene/pattern.hpp"
#include "mortise/simulation/scene/stabilisation.hpp"
#include "mortise/solid/connectors.hpp"
#include "mortise/solid/element_type.hpp"
#include "mortise/solid/loads.hpp"
#include "mortise/solid/point_masses.hpp"
#include "mortise/solid/prescribed_motion.hpp"
#include "mortise/thermal/thermal_properties.hpp"

namespace mortise {

/// A body: what it is made of and its mesh.
struct BodyOptions {
  Located<bool> rigid;
  std::vector<double> reference_point;     ///< of a rigid body: x, y(, z); empty: the middle of its box
  std::optional<double> density;           ///< of a rigid body with inertia; none: `mass`, or no mass
  std::optional<double> mass;              ///< of a rigid body with inertia
  std::vector<double> moments_of_inertia;  ///< about its centre of mass: in 2D one, in 3D about x, y, z; with `mass`
  std::vector<double> centre_of_mass;      ///< empty: the reference point; with `mass`
  std::optional<ScalarFunction> temperature;  ///< of a rigid body, over t; no value: it has none
  bool massless = false;                   ///< with inertia: a body without density has no mass
  Located<std::string> material;
  AssignmentList materials;                     ///< of blocks of a mesh file: name of the block, name of the material
  Located<std::optional<ElementType>> element;  ///< none: what the mesh has; see element_of()
  Choice<MeshOptions> mesh;
  Mirror mirror = Mirror::none;
  PatternOptions pattern;  ///< of a scene that was read each copy is a body of its own
  void describe(Parameters& parameters);
};

/// A set of nodes that follows a reference point.
struct TieOptions {
  Located<std::string> set;
  std::vector<double> position;  ///< x, y(, z); empty: the middle of the set's box
  bool rotates = true;
  enum class Follows { all, x, y, z };
  Follows follows = Follows::all;
  void describe(Parameters& parameters);
};

/// A material by name; the kind of law stands behind "type".
struct MaterialChoice {
  Choice<MaterialOptions> law;
  ThermalProperties heat;  ///< without a conductivity: bodies of it have no temperature
  void describe(Parameters& parameters);
};

/// A load; its kind stands behind "type".
struct LoadChoice {
  Choice<LoadOptions> load;
  void describe(Parameters& parameters);
};

/// Choice of the slave among a pair's surfaces.
enum class ContactRoles {
  as_given,
  automatic  ///< the better one
};

/// Two surfaces that may touch.
struct ContactPairOptions {
  Located<std::string> slave, master;
  ContactRoles roles = ContactRoles::as_given;
  ContactStartOptions start;
  std::string reason;  ///< why the slave is the slave, of pairs that the program found
  ContactOptions contact;
  ContactHeatOptions heat;
  void describe(Parameters& parameters);
};

/// Two surfaces that are glued together.
struct SurfaceTieOptions {
  Located<std::string> slave, master;
  MeshAtStart mesh = MeshAtStart::as_meshed;
  std::optional<double> tolerance;  ///< [length] up to which facets are tied; none: tie_tolerance() says
  void describe(Parameters& parameters);
};

/// Checkpoints, from which a run can be restarted. A run also leaves one when it stops before its end, and at the end if `every_step` is given or
/// one has been written before.
struct CheckpointOptions {
  int every_step = 0;           ///< after every so many steps; 0: not by steps
  double every_minutes = 10.0;  ///< after the first step that ends so long after the last one; 0: not by time
  int keep = 2;                 ///< the newest that stay
  void describe(Parameters& parameters);
};

/// Output of a run.
struct OutputOptions {
  std::vector<std::string> fields{"displacement", "contact_pressure", "cauchy_stress"};
  int every_step = 1;             ///< fields are written after every so many steps and at the end; 0: at the output times and the end only
  CheckpointOptions checkpoints;  ///< the list "checkpoints"
  bool contact_profiles = false;  ///< profiles.csv: contact along the arc length, at the output times and the end
  void describe(Parameters& parameters);
};

/// A quantity; its kind stands behind "type".
struct QuantityChoice {
  Choice<Quantity> quantity;
  void describe(Parameters& parameters);
};

/// A scene file's content. Variables and tables are read before all the rest and stand in `symbols`.
struct Scene {
  std::string name;  ///< of the scene file's outermost list
  Symbols symbols;

  Kinematics kinematics = Kinematics::plane_strain;
  double thickness = 1.0;
  std::vector<Named<MaterialChoice>> materials;
  std::vector<Named<BodyOptions>> bodies;
  std::vector<Named<SetOptions>> sets;
  std::vector<Named<TieOptions>> reference_points;
  std::vector<Named<BoundaryConditionOptions>> boundary_conditions;
  std::vector<Named<LoadChoice>> loads;
  std::vector<Named<SpringOptions>> springs;
  std::vector<Named<DashpotOptions>> dashpots;
  std::vector<Named<PointMassOptions>> point_masses;
  std::vector<Named<SurfaceTieOptions>> ties;
  std::vector<Named<ContactPairOptions>> contact;
  AutomaticContactOptions automatic_contact;
  InertiaOptions inertia;
  HeatOptions heat;
  std::vector<Named<InitialConditionOptions>> initial_conditions;
  StabilisationOptions stabilisation;
  SteppingOptions stepping;
  NewtonOptions newton;
  LinearSolverOptions linear_solver;
  OutputOptions output;
  std::vector<Named<QuantityChoice>> quantities;
  std::vector<Named<CheckOptions>> checks;

  void describe(Parameters& parameters);
};

}  // namespace mortise
