#include "mortise/simulation/scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mortise/core/names.hpp"
#include "mortise/simulation/quantities/fields.hpp"
#include "scene/history_columns.hpp"

namespace mortise {

void MaterialChoice::describe(Parameters& parameters) {
  parameters.choose(law, material_registry(), "the law");
  parameters.list("heat", heat, "conduction and storage of heat, in a scene with temperatures; without a conductivity bodies have no temperature");
}

namespace {
/// The list "mesh" of a body.
struct MeshList {
  Choice<MeshOptions>& mesh;
  void describe(Parameters& parameters) { parameters.choose(mesh, mesh_registry(), "the shape of the body"); }
};
}  // namespace

namespace {
/// "x, y", "x, y, z" or nothing; the scene's dimension is asked for later.
void check_position(Parameters& parameters, const std::string& name, std::vector<double>& position) {
  if (position.empty() || position.size() == 2 || position.size() == 3) return;
  parameters.error(name, fmt::format("is \"{}\"; it needs two numbers, \"x, y\", or in 3D three, \"x, y, z\"", fmt::join(position, ", ")));
  position.clear();
}
}  // namespace

void BodyOptions::describe(Parameters& parameters) {
  parameters.add("rigid", rigid, "true: the body keeps its shape. It then has no material and no elements, and moves with \"body/reference\"");
  parameters.add("reference point", reference_point,
                 Says("of a rigid body, \"x, y\" or \"x, y, z\": the point about which it turns and at which forces on it act; left out: the middle "
                      "of the box around it")
                     .unit("length"));
  check_position(parameters, "reference point", reference_point);
  parameters.add("density", density, Says("of a rigid body with inertia, whose surface has to be closed").unit("mass / volume").above(0.0));
  parameters.add("mass", mass, Says("of a rigid body with inertia, in the place of a density").unit("mass").above(0.0));
  parameters.add(
      "moments of inertia", moments_of_inertia,
      Says("of a rigid body with a mass, about its centre of mass: in 2D one number, in 3D three, about x, y and z").unit("mass length^2"));
  parameters.add("centre of mass", centre_of_mass, Says("of a rigid body with a mass; left out: its reference point").unit("length"));
  check_position(parameters, "centre of mass", centre_of_mass);
  parameters.add("temperature", temperature,
                 Says("of a rigid body, over t: pairs conduct heat to it; left out: it has none").unit("temperature").arguments({"t"}));
  if (temperature && !rigid.value)
    parameters.error("temperature", "the temperature of a deformable body is unknown; please prescribe it in \"heat/temperatures\", or give an initial one");
  parameters.add("massless", massless, "with inertia: a body without density has no mass; it follows loads and contact at once");
  if (density && mass) parameters.error("mass", "is given beside \"density\"; please remove one of the two");
  if (!rigid.value && (density || mass || !moments_of_inertia.empty()))
    parameters.error("mass", "the mass of a deformable body is that of its material; please give that a \"density\"");
  if (!mass && !(moments_of_inertia.empty() && centre_of_mass.empty())) parameters.error("moments of inertia", "need a \"mass\" beside them");
  Says says("name of one of the scene's materials; a rigid body has none");
  parameters.list("materials", materials, "materials of blocks of a mesh file: the name of a block, and as its value the name of a material");
  if (!rigid.value && materials.all.empty()) says.required();
  parameters.add("material", material, says);
  if (rigid.value && !material.value.empty()) parameters.error("material", "a rigid body has no material; please remove one of the two");
  if (rigid.value && !materials.all.empty()) parameters.error("materials", "a rigid body has no materials; please remove one of the two");
  std::vector<std::pair<std::string, std::optional<ElementType>>> elements{{"automatic", std::nullopt}};
  for (const auto& [name, type] : element_names()) elements.emplace_back(name, type);
  parameters.add("element", element, elements,
                 "element of the body; automatic: Q4 in 2D, H8 in 3D, and the elements of the cells of a mesh file. Cells of a mesh file that have "
                 "another shape than the named element get the standard one of their shape");
  MeshList list{mesh};
  parameters.list("mesh", list, "the mesh of the body; its sides become the sets \"body/side\"");
  parameters.add("mirror", mirror, {{"none", Mirror::none}, {"x", Mirror::x}, {"y", Mirror::y}, {"z", Mirror::z}},
                 "reflects the placed mesh at the plane x = 0, y = 0 or z = 0");
  parameters.list("pattern", pattern, "copies of the body in a row or a ring, each a body of its own");
  if (!materials.all.empty() && mesh.options && mesh.type != "file")
    parameters.error("materials", "only a mesh of a file has blocks; please give \"material\" alone");
}

void LoadChoice::describe(Parameters& parameters) { parameters.choose(load, load_registry(), "the kind of load"); }

void TieOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("node or side set whose nodes follow the point").required());
  parameters.add("position", position, Says("\"x, y\" or \"x, y, z\"; left out: the middle of the box around the set").unit("length"));
  check_position(parameters, "position", position);
  parameters.add("rotation", rotates, "true: the nodes turn with the point; false: they share its translation alone");
  parameters.add("follows", follows, {{"all", Follows::all}, {"x", Follows::x}, {"y", Follows::y}, {"z", Follows::z}},
                 "components of the displacement that follow");
  if (rotates && follows != Follows::all)
    parameters.error("follows", "nodes that follow in one component cannot turn; please add \"rotation\" (bool, false)");
}

void ContactPairOptions::describe(Parameters& parameters) {
  parameters.add("slave", slave, Says("side set that carries the multipliers: the finer, softer or shorter one").required());
  parameters.add("master", master, Says("side set that it may touch").required());
  parameters.add("roles", roles, {{"as given", ContactRoles::as_given}, {"automatic", ContactRoles::automatic}},
                 "automatic: slave and master are exchanged if the master is the better slave. That is the deformable one, else the softer one if "
                 "moduli differ by more than a factor of 2, else the finer one");
  start.describe(parameters);
  parameters.add("reason", reason, "words on the choice of the sides, which the program writes for pairs that it found; they change nothing");
  contact.describe(parameters);
  parameters.list("heat", heat, "heat across the pair, in a scene with temperatures");
}

void SurfaceTieOptions::describe(Parameters& parameters) {
  parameters.add("slave", slave, Says("side set whose nodes are constrained to the master: the finer or softer one").required());
  parameters.add("master", master, Says("side set whose displacement constrains them").required());
  parameters.add("start", mesh, {{"as meshed", MeshAtStart::as_meshed}, {"adjust", MeshAtStart::adjusted}},
                 "as meshed: gaps stay as they are, and a rotation strains curved surfaces and gaps. adjust: slave nodes are moved onto the master "
                 "before anything is computed. That strains nothing, and rotations are exact");
  parameters.add("tolerance", tolerance,
                 Says("distance up to which the slave is tied, and nodes are adjusted; default: a tenth of the longest facet of the tie")
                     .unit("length")
                     .above(0.0));
}

void CheckpointOptions::describe(Parameters& parameters) {
  parameters.add("every step", every_step, Says("a checkpoint is written after every so many steps, and at the end; 0: not by steps").at_least(0));
  parameters.add("every minutes", every_minutes,
                 Says("a checkpoint is written after the first step that ends so long after the last one; 0: not by time").unit("min").at_least(0.0));
  parameters.add("keep", keep, Says("number of the newest checkpoints that stay").at_least(1));
}

void OutputOptions::describe(Parameters& parameters) {
  std::vector<std::string> known;
  for (const auto& [name, sentence] : field_names()) known.push_back(name);
  parameters.add("fields", fields,
                 "fields written to fields.xdmf and the files in fields/: any of " + quoted_list(known) + "; an empty text: no such files");
  for (const auto& field : fields)
    if (std::find(known.begin(), known.end(), field) == known.end()) parameters.error("fields", unknown_name("field", field, known));
  for (auto field = fields.begin(); field != fields.end(); ++field)
    if (std::find(fields.begin(), field, *field) != field) parameters.error("fields", "names \"" + *field + "\" twice");
  parameters.add("every step", every_step,
                 Says("fields are written after every so many steps, and at the end; 0: at the output times and the end only").at_least(0));
  parameters.list(
      "checkpoints", checkpoints,
      "files from which a run can be restarted. A run also leaves one when it stops before its end, and at its end if it has left one before");
  parameters.add(
      "contact profiles", contact_profiles,
      "pressure, shear traction and gap along the arc length of each slave surface are written to profiles.csv at the output times and the end");
}

void QuantityChoice::describe(Parameters& parameters) { parameters.choose(quantity, quantity_registry(), "the kind of quantity"); }

void Scene::describe(Parameters& parameters) {
  parameters.add("kinematics", kinematics, kinematics_names(),
                 "strain and stress in the third direction; axisymmetric: x is the radius, y the axis; three dimensional: bodies in 3D");
  parameters.add("thickness", thickness,
                 Says("thickness of the model out of the plane; axisymmetric scenes do not use it").unit("length").at_least(1e-30).at_most(1e30));
  parameters.named("materials", materials, "the materials, by names of your choice");
  parameters.named("bodies", bodies, "the bodies, by names of your choice; each is meshed by itself");
  parameters.named("sets", sets, "parts of sides and bodies, by names of your choice");
  parameters.named("reference points", reference_points, "sets of nodes that move like a rigid body or share a translation, by names of your choice");
  parameters.named("boundary conditions", boundary_conditions, "prescribed displacements");
  parameters.named("loads", loads, "loads, by names of your choice");
  parameters.named("springs", springs, "springs, by names of your choice: against the ground, between two sets, or along a line");
  parameters.named("dashpots", dashpots, "dashpots, by names of your choice; without inertia velocities are changes over a step by its length");
  parameters.named("point masses", point_masses,
                   "masses of nodes, sets and reference points, by names of your choice; without inertia they have weight alone");
  parameters.named("ties", ties, "mesh ties: surfaces that are glued together, by names of your choice");
  parameters.named("contact", contact, "contact pairs, by names of your choice");
  parameters.list("automatic contact", automatic_contact, "contact pairs that the program finds");
  parameters.list("inertia", inertia, "mass of the bodies and time integration; without a scheme the scene is static");
  parameters.locate("inertia", inertia.place);
  parameters.named("initial conditions", initial_conditions, "displacements and velocities at the start, with inertia");
  if (!inertia.acts() && !initial_conditions.empty())
    parameters.error("initial conditions", "need inertia; please give the list \"inertia\" a \"scheme\"");
  parameters.list("heat", heat, "temperatures of the bodies; without an analysis the scene has none");
  parameters.locate("heat", heat.place);
  parameters.list("stabilisation", stabilisation, "viscous forces on loose bodies, which vanish to the end; of static scenes");
  parameters.locate("stabilisation", stabilisation.place);
  parameters.list("stepping", stepping, "pseudo-time and its steps; with inertia time");
  parameters.list("newton", newton, "when a Newton solve is done, and when it is given up");
  parameters.list("linear solver", linear_solver, "how linear systems are solved");
  parameters.list("output", output, "what is written besides the summary");
  parameters.named("quantities", quantities, "numbers wanted of the run: every step's in history.csv, the last ones in summary.json");
  for (const auto& quantity : quantities)
    if (const auto& taken = history_columns(); std::find(taken.begin(), taken.end(), quantity.name) != taken.end())
      parameters.error("quantities",
                       fmt::format("a column of history.csv is called \"{}\" already; please give the quantity another name", quantity.name));
  parameters.named("checks", checks, "bounds on quantities at the end; a run that misses one ends with exit code 4");
  if (kinematics == Kinematics::three_dimensional && output.contact_profiles)
    parameters.error("output", "contact profiles are written in plane and axisymmetric scenes only; please remove \"contact profiles\"");
}

}  // namespace mortise
