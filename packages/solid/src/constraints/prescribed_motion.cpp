#include "mortise/solid/prescribed_motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <map>
#include <optional>

#include "constraints/component_name.hpp"
#include "constraints/node_conditions.hpp"
#include "loads/load_support.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/solid/followers.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;

/// Two conditions on one dof must agree; they are compared at these pseudo-times.
constexpr double compared_times[] = {0.0, 0.37, 1.0};

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
    if (std::binary_search(followers.dofs().begin(), followers.dofs().end(), bodies.space().row(node, component)))
      for (const ReferencePoint& point : mesh.reference_points)
        if (std::binary_search(point.followers.begin(), point.followers.end(), node)) return point.name;
  return {};
}

/// Name of the reference point that is among `nodes`.
std::optional<std::string> reference_point_of(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes) {
  for (const ReferencePoint& point : mesh.reference_points)
    if (std::find(nodes.begin(), nodes.end(), point.node) != nodes.end()) return point.name;
  return {};
}

}  // namespace

/// The conditions, node by node.
class PrescribedMotion::Collected {
 public:
  Collected(PrescribedMotion& motion, const Bodies& bodies, const std::vector<Named<BoundaryConditionOptions>>& conditions)
      : motion_(motion), bodies_(bodies), mesh_(*bodies.mesh()), conditions_(conditions), followers_(bodies), length_(mesh_size(mesh_).length) {}

  void add(std::size_t n);
  /// Directions at nodes become components.
  void solve();
  void add_idle_dofs();
  void finish();

 private:
  /// A dof, or a direction at a node, and what it is.
  struct Prescribed {
    std::vector<Source> sum;
    std::size_t condition;
  };
  struct Directed {
    Vector3d direction;
    Source source;
    std::size_t condition;
  };

  void say(std::size_t n, const std::string& what) { diagnostics_.push_back({conditions_[n].place, what}); }
  void check(std::size_t n);
  void add_rotations(std::size_t n);
  void add_displacements(std::size_t n, const std::vector<LocalOrdinal>& nodes);
  void solve_node(LocalOrdinal node, std::vector<Directed>& directed);
  double value_of(const std::vector<Source>& sum, double time) const;
  std::string said_by(std::size_t n) const {
    return fmt::format("\"{}\" ({}:{})", conditions_[n].name, conditions_[n].place.file, conditions_[n].place.line);
  }

  PrescribedMotion& motion_;
  const Bodies& bodies_;
  const Mesh& mesh_;
  const std::vector<Named<BoundaryConditionOptions>>& conditions_;
  Followers followers_;
  double length_;
  std::map<LocalOrdinal, Prescribed> prescribed_;           // by dofs
  std::map<LocalOrdinal, std::vector<Directed>> directed_;  // by nodes
  std::vector<std::vector<Source>> sums_of_inclined_;       // [motion_.inclined_]
  std::vector<char> said_;                                  // [conditions] that another one contradicts it
  std::vector<Diagnostic> diagnostics_;
};

double PrescribedMotion::Collected::value_of(const std::vector<Source>& sum, double time) const {
  std::optional<StepFailure> none;
  double value = 0.0;
  for (const Source& source : sum) value += motion_.value(source, time, none);
  return value;
}

void PrescribedMotion::Collected::check(std::size_t n) {
  const auto& [name, place, condition] = conditions_[n];
  const auto& turns = condition.rotation_vector;
  const bool turns_in_space = std::any_of(turns.begin(), turns.end(), [](const auto& one) { return one.has_value(); });
  if (!condition.x && !condition.y && !condition.z && !condition.rotation && !turns_in_space)
    say(n, fmt::format("boundary condition \"{}\" prescribes nothing; give {}, or \"rotation\" of a reference point", name,
                       mesh_.dimension == 3 ? "\"x\", \"y\", \"z\"" : "\"x\", \"y\""));
  if (condition.z && mesh_.dimension == 2)
    say(n, fmt::format("boundary condition \"{}\" prescribes z, which needs kinematics \"three dimensional\"; the model is in the plane of x and y",
                       name));
  if (mesh_.dimension == 2 ? turns_in_space : condition.rotation.has_value())
    say(n, fmt::format("boundary condition \"{}\" prescribes a rotation {}; please give {}", name,
                       mesh_.dimension == 2 ? "for 3D in a 2D model" : "for 2D in a 3D model",
                       mesh_.dimension == 2 ? "\"rotation\"" : "\"rotation x\", \"rotation y\", \"rotation z\""));
  if (!condition.x_axis.empty() && static_cast<int>(condition.x_axis.size()) != mesh_.dimension)
    say(n, fmt::format("\"x axis\" of boundary condition \"{}\" has {} numbers; this {}D model needs {}", name, condition.x_axis.size(),
                       mesh_.dimension, mesh_.dimension));
}

void PrescribedMotion::Collected::add(std::size_t n) {
  check(n);
  try {
    const auto& nodes = require_node_set(mesh_, conditions_[n].value.set);
    add_rotations(n);
    if (conditions_[n].value.x_axis.empty() || static_cast<int>(conditions_[n].value.x_axis.size()) == mesh_.dimension) add_displacements(n, nodes);
  } catch (const InputError& error) {
    diagnostics_.insert(diagnostics_.end(), error.diagnostics().begin(), error.diagnostics().end());
  }
}

void PrescribedMotion::Collected::add_rotations(std::size_t n) {
  const BoundaryConditionOptions& condition = conditions_[n].value;
  for (int k = 0; k < (mesh_.dimension == 2 ? 1 : 3); ++k) {
    const std::optional<ScalarFunction>& rotation =
        mesh_.dimension == 2 ? condition.rotation : condition.rotation_vector[static_cast<std::size_t>(k)];
    if (!rotation) continue;
    const ReferencePoint& point = require_rotating_point(mesh_, condition.set);
    motion_.functions_.push_back(*rotation);
    const Source source{static_cast<LocalOrdinal>(motion_.functions_.size() - 1), mesh_.coordinates[point.node],
                        point.arm * boost::math::constants::degree<double>()};
    if (point.rotation_node < mesh_.owned_count()) prescribed_.insert_or_assign(bodies_.space().row(point.rotation_node, k), Prescribed{{source}, n});
  }
}

void PrescribedMotion::Collected::add_displacements(std::size_t n, const std::vector<LocalOrdinal>& nodes) {
  const auto& [name, place, condition] = conditions_[n];
  const bool inclined = !condition.x_axis.empty();
  const auto axes = axes_of(condition);
  const std::array<const std::optional<ScalarFunction>*, 3> components{&condition.x, &condition.y, &condition.z};
  for (int component = 0; component < mesh_.dimension; ++component) {
    const auto& function = *components[static_cast<std::size_t>(component)];
    if (!function) continue;
    std::optional<std::string> followed;
    for (int i = inclined ? 0 : component; i < (inclined ? mesh_.dimension : component + 1) && !followed; ++i)
      followed = follower(bodies_, followers_, nodes, i);
    if (followed) {
      say(n, fmt::format("boundary condition \"{}\" prescribes {} at nodes that follow \"{}\"; please prescribe \"{}\"", name,
                         component_name(component), *followed, *followed));
      continue;
    }
    if (const auto point = inclined ? reference_point_of(mesh_, nodes) : std::nullopt) {
      say(n, fmt::format("boundary condition \"{}\" has an \"x axis\", but \"{}\" is a reference point; please prescribe its x, y and z in the "
                         "axes of the model",
                         name, *point));
      continue;
    }
    motion_.functions_.push_back(*function);
    for (const LocalOrdinal node : nodes) {
      if (node >= mesh_.owned_count()) continue;
      const Source source{static_cast<LocalOrdinal>(motion_.functions_.size() - 1), mesh_.coordinates[static_cast<std::size_t>(node)]};
      if (inclined) {
        directed_[node].push_back({Vector3d(axes[static_cast<std::size_t>(component)].data()), source, n});
        continue;
      }
      const auto [other, is_new] = prescribed_.try_emplace(bodies_.space().row(node, component), Prescribed{{source}, n});
      if (is_new) continue;
      const bool same = std::all_of(std::begin(compared_times), std::end(compared_times),
                                    [&](double t) { return agree(value_of({source}, t), value_of(other->second.sum, t), length_); });
      if (same) continue;
      say(n, fmt::format("boundary conditions {} and \"{}\" prescribe {} differently at the node of reference position {}",
                         said_by(other->second.condition), name, component_name(component), to_string(source.position, mesh_.dimension)));
      break;
    }
  }
}

void PrescribedMotion::Collected::solve() {
  said_.assign(conditions_.size(), 0);
  for (auto& [node, directed] : directed_) solve_node(node, directed);
}

void PrescribedMotion::Collected::solve_node(LocalOrdinal node, std::vector<Directed>& directed) {
  for (int i = 0; i < mesh_.dimension; ++i) {
    const auto along_axis = prescribed_.find(bodies_.space().row(node, i));
    if (along_axis == prescribed_.end()) continue;
    directed.push_back({Vector3d::Unit(i), along_axis->second.sum.front(), along_axis->second.condition});
    prescribed_.erase(along_axis);
  }
  Eigen::MatrixXd normals(static_cast<Eigen::Index>(directed.size()), mesh_.dimension);
  for (std::size_t m = 0; m < directed.size(); ++m) normals.row(static_cast<Eigen::Index>(m)) = directed[m].direction.head(mesh_.dimension);
  const SolvedConditions solved = solve_conditions(normals);
  const auto weighted = [&](const Eigen::RowVectorXd& weights) {
    std::vector<Source> sum;
    for (std::size_t m = 0; m < directed.size(); ++m)
      if (const double weight = weights[static_cast<Eigen::Index>(m)]; weight != 0.0) {
        sum.push_back(directed[m].source);
        sum.back().factor *= weight;
      }
    return sum;
  };
  for (const Eigen::RowVectorXd& check : solved.checks) {
    const std::vector<Source> sum = weighted(check);
    const bool agrees =
        std::all_of(std::begin(compared_times), std::end(compared_times), [&](double t) { return agree(value_of(sum, t), 0.0, length_); });
    Eigen::Index last = check.size() - 1;
    while (check[last] == 0.0) --last;
    const std::size_t n = directed[static_cast<std::size_t>(last)].condition;
    if (agrees || said_[n] != 0) continue;
    said_[n] = 1;
    std::vector<std::string> others;
    for (Eigen::Index m = 0; m < check.size(); ++m)
      if (check[m] != 0.0) others.push_back(said_by(directed[static_cast<std::size_t>(m)].condition));
    say(n,
        fmt::format("boundary conditions {} contradict one another at the node of reference position {}: they ask for different displacements along "
                    "the same direction",
                    fmt::join(others, ", "), to_string(directed.front().source.position, mesh_.dimension)));
  }
  for (const SolvedConditions::Component& one : solved.components) {
    if (one.of.isZero(0.0)) {
      prescribed_.emplace(bodies_.space().row(node, one.component), Prescribed{weighted(one.weights), directed.front().condition});
      continue;
    }
    InclinedComponent inclined{node, one.component, {}};
    for (int i = 0; i < mesh_.dimension; ++i) inclined.of[static_cast<std::size_t>(i)] = one.of[i];
    motion_.inclined_.push_back(inclined);
    sums_of_inclined_.push_back(weighted(one.weights));
  }
}

void PrescribedMotion::Collected::add_idle_dofs() {
  motion_.functions_.emplace_back(0.0);
  for (const LocalOrdinal dof : Followers::idle_dofs(bodies_)) {
    const auto [entry, is_new] = prescribed_.try_emplace(dof, Prescribed{{{static_cast<LocalOrdinal>(motion_.functions_.size() - 1), {}}}, 0});
    if (is_new) continue;
    const auto& [sum, condition] = entry->second;
    const bool zero = std::all_of(std::begin(compared_times), std::end(compared_times), [&, &s = sum](double t) { return value_of(s, t) == 0.0; });
    if (!zero)
      say(condition, fmt::format("boundary condition \"{}\" moves a reference point in {}, in which nothing follows it", conditions_[condition].name,
                                 component_name(bodies_.space().place(dof).component)));
  }
}

void PrescribedMotion::Collected::finish() {
  throw_if_any(*mesh_.comm, diagnostics_);
  const auto put = [](Sums& sums, const std::vector<Source>& sum) {
    sums.sources.insert(sums.sources.end(), sum.begin(), sum.end());
    sums.ends.push_back(sums.sources.size());
  };
  for (const auto& [dof, entry] : prescribed_) {
    motion_.dofs_.push_back(dof);
    put(motion_.of_dofs_, entry.sum);
  }
  for (const auto& sum : sums_of_inclined_) put(motion_.of_inclined_, sum);
}

PrescribedMotion::PrescribedMotion(const Bodies& bodies, const std::vector<Named<BoundaryConditionOptions>>& conditions) {
  Collected collected(*this, bodies, conditions);
  for (std::size_t n = 0; n < conditions.size(); ++n) collected.add(n);
  collected.solve();
  collected.add_idle_dofs();
  collected.finish();
}

double PrescribedMotion::value(const Source& source, double time, std::optional<StepFailure>& failure) const {
  return source.factor * evaluate(functions_[source.function], time, source.position, failure);
}

std::vector<double> PrescribedMotion::values(const Sums& sums, double time, std::optional<StepFailure>& failure) const {
  std::vector<double> values;
  values.reserve(sums.ends.size());
  std::size_t source = 0;
  for (const std::size_t end : sums.ends) {
    double sum = 0.0;
    for (; source < end; ++source) sum += value(sums.sources[source], time, failure);
    values.push_back(sum);
  }
  return values;
}

std::vector<double> PrescribedMotion::values(double time, std::optional<StepFailure>& failure) const { return values(of_dofs_, time, failure); }

std::vector<double> PrescribedMotion::inclined_values(double time, std::optional<StepFailure>& failure) const {
  return values(of_inclined_, time, failure);
}

}  // namespace mortise
