#include "mortise/solid/prescribed_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <map>
#include <optional>

#include "load_support.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/solid/followers.hpp"

namespace mortise {
namespace {

/// Two conditions on one dof must agree; they are compared at these pseudo-times.
constexpr double compared_times[] = {0.0, 0.37, 1.0};

const char* component_name(int component) { return component == 0 ? "x" : component == 1 ? "y" : "z"; }

std::string to_string(const std::array<double, 3>& position, int dimension) {
  return dimension == 2 ? fmt::format("({:g}, {:g})", position[0], position[1])
                        : fmt::format("({:g}, {:g}, {:g})", position[0], position[1], position[2]);
}

/// To the round-off of positions in a model of size `length`, from which values may be made.
bool agree(double a, double b, double length) { return a == b || std::abs(a - b) <= 1e-12 * std::max({std::abs(a), std::abs(b), length}); }

/// Name of the reference point that an owned node of `nodes` follows in `component`.
std::optional<std::string> follower(const Bodies& bodies, const Followers& followers, const std::vector<LocalOrdinal>& nodes, int component) {
  const Mesh& mesh = *bodies.mesh();
  for (const LocalOrdinal node : nodes)
    if (std::binary_search(followers.dofs().begin(), followers.dofs().end(), mesh.dimension * node + component))
      for (const ReferencePoint& point : mesh.reference_points)
        if (std::binary_search(point.followers.begin(), point.followers.end(), node)) return point.name;
  return {};
}

}  // namespace

void BoundaryConditionOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("node or side set whose displacement is prescribed").required());
  parameters.add("x", x, Says("displacement in x (axisymmetric: r), an expression of t, x, y; left out: free").unit("length"));
  parameters.add("y", y, Says("displacement in y (axisymmetric: z), an expression of t, x, y; left out: free").unit("length"));
  parameters.add("z", z, Says("displacement in z, in three dimensions, an expression of t, x, y, z; left out: free").unit("length"));
  parameters.add("rotation", rotation,
                 Says("of a reference point of the plane, counterclockwise, an expression of t; left out: free").unit("degrees").arguments({"t"}));
  for (int i = 0; i < 3; ++i)
    parameters.add(
        fmt::format("rotation {}", component_name(i)), rotation_vector[i],
        Says(fmt::format("{} component of the rotation vector of a reference point in 3D: the point turns by its length about its direction, "
                         "counterclockwise seen from its tip; an expression of t; left out: free",
                         component_name(i)))
            .unit("degrees")
            .arguments({"t"}));
}

PrescribedMotion::PrescribedMotion(const Bodies& bodies, const std::vector<Named<BoundaryConditionOptions>>& conditions) {
  const Mesh& mesh = *bodies.mesh();
  const double length = mesh_size(mesh).length;
  std::vector<Diagnostic> diagnostics;
  struct Prescribed {
    Source source;
    std::size_t condition;
  };
  std::map<LocalOrdinal, Prescribed> prescribed;
  const Followers followers(bodies);
  const auto compared = [this](const Source& source, double time) {
    std::optional<StepFailure> none;
    return value(source, time, none);
  };
  for (std::size_t n = 0; n < conditions.size(); ++n) {
    const auto& condition = conditions[n];
    const std::array<const std::optional<ScalarFunction>*, 3> components{&condition.value.x, &condition.value.y, &condition.value.z};
    const auto& turns = condition.value.rotation_vector;
    const bool turns_in_space = std::any_of(turns.begin(), turns.end(), [](const auto& one) { return one.has_value(); });
    if (!condition.value.x && !condition.value.y && !condition.value.z && !condition.value.rotation && !turns_in_space)
      diagnostics.push_back(
          {condition.place, fmt::format("boundary condition \"{}\" prescribes nothing; give {}, or \"rotation\" of a reference point", condition.name,
                                        mesh.dimension == 3 ? "\"x\", \"y\", \"z\"" : "\"x\", \"y\"")});
    if (condition.value.z && mesh.dimension == 2)
      diagnostics.push_back({condition.place, fmt::format("boundary condition \"{}\" prescribes z, which needs kinematics \"three dimensional\"; the "
                                                          "model is in the plane of x and y",
                                                          condition.name)});
    if (mesh.dimension == 2 ? turns_in_space : condition.value.rotation.has_value())
      diagnostics.push_back({condition.place, fmt::format("boundary condition \"{}\" prescribes a rotation {}; please give {}", condition.name,
                                                          mesh.dimension == 2 ? "for 3D in a 2D model" : "for 2D in a 3D model",
                                                          mesh.dimension == 2 ? "\"rotation\"" : "\"rotation x\", \"rotation y\", \"rotation z\"")});
    try {
      const auto& nodes = require_node_set(mesh, condition.value.set);
      for (int k = 0; k < (mesh.dimension == 2 ? 1 : 3); ++k) {
        const std::optional<ScalarFunction>& rotation = mesh.dimension == 2 ? condition.value.rotation : turns[k];
        if (!rotation) continue;
        const ReferencePoint& point = require_rotating_point(mesh, condition.value.set);
        functions_.push_back(*rotation);
        const Source source{static_cast<LocalOrdinal>(functions_.size() - 1), mesh.coordinates[point.node],
                            point.arm * boost::math::constants::degree<double>()};
        if (point.rotation_node < mesh.owned_count()) prescribed.insert_or_assign(mesh.dimension * point.rotation_node + k, Prescribed{source, n});
      }
      for (int component = 0; component < mesh.dimension; ++component) {
        const auto& function = *components[component];
        if (!function) continue;
        if (const auto found = follower(bodies, followers, nodes, component)) {
          diagnostics.push_back(
              {condition.place, fmt::format("boundary condition \"{}\" prescribes {} at nodes that follow \"{}\"; please prescribe \"{}\"",
                                            condition.name, component_name(component), *found, *found)});
          continue;
        }
        functions_.push_back(*function);
        for (LocalOrdinal node : nodes) {
          if (node >= mesh.owned_count()) continue;
          const Source source{static_cast<LocalOrdinal>(functions_.size() - 1), mesh.coordinates[node]};
          const auto [other, is_new] = prescribed.try_emplace(mesh.dimension * node + component, Prescribed{source, n});
          if (is_new) continue;
          const bool same = std::all_of(std::begin(compared_times), std::end(compared_times),
                                        [&](double t) { return agree(compared(source, t), compared(other->second.source, t), length); });
          if (same) continue;
          const auto& first = conditions[other->second.condition];
          diagnostics.push_back({condition.place, fmt::format("boundary conditions \"{}\" ({}:{}) and \"{}\" prescribe {} differently at the node of "
                                                              "reference position {}",
                                                              first.name, first.place.file, first.place.line, condition.name,
                                                              component_name(component), to_string(source.position, mesh.dimension))});
          break;
        }
      }
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  functions_.emplace_back(0.0);
  for (const LocalOrdinal dof : Followers::idle_dofs(bodies)) {
    const auto [entry, is_new] = prescribed.try_emplace(dof, Prescribed{{static_cast<LocalOrdinal>(functions_.size() - 1), {}}, 0});
    if (is_new) continue;
    const auto& [source, condition] = entry->second;
    const bool zero = std::all_of(std::begin(compared_times), std::end(compared_times), [&, &s = source](double t) { return compared(s, t) == 0.0; });
    if (!zero)
      diagnostics.push_back(
          {conditions[condition].place, fmt::format("boundary condition \"{}\" moves a reference point in {}, in which nothing follows it",
                                                    conditions[condition].name, component_name(dof % mesh.dimension))});
  }
  throw_if_any(*mesh.comm, diagnostics);
  for (const auto& [dof, entry] : prescribed) {
    dofs_.push_back(dof);
    sources_.push_back(entry.source);
  }
}

double PrescribedMotion::value(const Source& source, double time, std::optional<StepFailure>& failure) const {
  return source.factor * evaluate(functions_[source.function], time, source.position, failure);
}

std::vector<double> PrescribedMotion::values(double time, std::optional<StepFailure>& failure) const {
  std::vector<double> values;
  values.reserve(sources_.size());
  for (const Source& source : sources_) values.push_back(value(source, time, failure));
  return values;
}

}  // namespace mortise
