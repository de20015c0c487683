#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "mortise/core/names.hpp"
#include "mortise/input/parameter_tree.hpp"
#include "mortise/input/read_parameters.hpp"
#include "mortise/simulation/scene/file_kind.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "mortise/studies/study_points.hpp"
#include "peer/calculix_deck.hpp"
#include "shared/distinct_files.hpp"
#include "shared/throw_all.hpp"

namespace mortise {
namespace {

/// Texts without repeats, in their order: "Q4 + T3".
std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  std::set<std::string> seen;
  for (const auto& text : texts)
    if (seen.insert(text).second) all += (all.empty() ? "" : " + ") + text;
  return all;
}

const ParameterRecord* find_parameter(const ListRecord& list, const std::string& name) {
  const auto found = std::find_if(list.parameters.begin(), list.parameters.end(), [&](const auto& one) { return one.name == name; });
  return found == list.parameters.end() ? nullptr : &*found;
}

/// Formulation of contact: the parameter "formulation" of the pairs, or "type" in a list of that name.
std::string formulation_of(const Scene& scene) {
  const ListRecord tree = collect_parameters(scene.name, scene, CollectParameters::What::values);
  std::vector<std::string> found;
  if (const ListRecord* pairs = find_list(tree, "contact"))
    for (const ListRecord& pair : pairs->lists) {
      const ListRecord* list = find_list(pair, "formulation");
      const ParameterRecord* named = list ? find_parameter(*list, "type") : find_parameter(pair, "formulation");
      if (named) found.push_back(named->value);
    }
  return found.empty() ? "dual mortar" : joined(found);
}

/// "mesh file" where the scene leaves it to the file.
std::string element_text(const BodyOptions& body) {
  if (body.mesh.type == "file" && !body.element.value) return "mesh file";
  return to_string(body.mesh.type == "file" ? *body.element.value : element_of(body));
}

/// Reads the scene as the run will, and keeps of it what the report needs.
void complete(StudyPoint& point, const XmlList& root) {
  XmlList changed = root;
  for (const Assignment& one : point.settings) apply_override(changed, one.path, one.value, one.place);
  const Scene scene = make_scene(changed);
  point.formulation = formulation_of(scene);
  std::vector<std::string> elements;
  for (const auto& body : scene.bodies)
    if (!body.value.rigid.value) elements.push_back(element_text(body.value));
  point.element = joined(elements);
  penalty_multiple(point.penalty.value, scene.symbols, point.penalty.place);
  if (!has_penalty(point.peer)) point.penalty = {};
  if (point.peer != Peer::none) {
    point.formulation = peer_title(point.peer);
    std::vector<std::string> theirs;
    for (const auto& body : scene.bodies)
      if (const auto name = body.value.mesh.type == "file" ? "" : calculix_element(cell_shape(element_of(body.value)));
          !body.value.rigid.value && !name.empty())
        theirs.push_back(name);
    if (!theirs.empty()) point.element += " (CalculiX " + joined(theirs) + ")";
  }
  point.axisymmetric = scene.kinematics == Kinematics::axisymmetric;
  point.quantities = names_of(scene.quantities);
  point.symbols = scene.symbols;
}

/// Runs write what the study reads and nothing else.
void add_output(std::vector<Assignment>& settings, const StudyFile& study) {
  bool fields = false, profiles = false;
  for (const auto& quantity : study.quantities) fields |= quantity.value.is_field(), profiles |= quantity.value.is_profile();
  const Place place = study.scene.place;
  std::vector<Assignment> wanted{{"output/every step", "0", place}};
  if (fields) wanted.push_back({"output/fields", "displacement", place});
  if (profiles) wanted.push_back({"output/contact profiles", "true", place});
  std::vector<Assignment> defaults;
  if (!fields) defaults.push_back({"output/fields", "", place});
  if (!profiles) defaults.push_back({"output/contact profiles", "false", place});
  settings.insert(settings.begin(), defaults.begin(), defaults.end());
  settings.insert(settings.end(), wanted.begin(), wanted.end());
}

std::size_t find_axis(const StudyFile& study, const Located<std::string>& name, std::size_t otherwise, std::vector<Diagnostic>& diagnostics) {
  if (name.value.empty()) return otherwise;
  const std::vector<std::string> axes = names_of(study.axes);
  const auto found = std::find(axes.begin(), axes.end(), name.value);
  if (found == axes.end()) diagnostics.push_back({name.place, unknown_name("axis", name.value, axes)});
  return found == axes.end() ? otherwise : found - axes.begin();
}

/// Quantities that the scene does not have, references without a source, expressions that mean nothing.
void check_quantities(const StudyPlan& plan, const StudyPoint& point, std::vector<Diagnostic>& diagnostics) {
  const auto attempt = [&](const Located<std::string>& source) {
    try {
      evaluate(source, point, std::vector<double>(point.quantities.size(), 1.0), 1.0);
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  };
  attempt(plan.file.h);
  for (const auto& [name, place, quantity] : plan.file.quantities) {
    const std::string& wanted = quantity.quantity.value.empty() ? name : quantity.quantity.value;
    if (quantity.of_scalar() && std::find(point.quantities.begin(), point.quantities.end(), wanted) == point.quantities.end())
      diagnostics.push_back({quantity.quantity.value.empty() ? place : quantity.quantity.place, unknown_name("quantity", wanted, point.quantities)});
    if (!quantity.value.value.empty()) attempt(quantity.value);
    if (quantity.needs_finest() && !plan.finest)
      diagnostics.push_back({place, "its reference is the finest run; please add the list \"finest\" with the settings of that run"});
    if (quantity.extrapolated() && plan.labels[plan.along].size() < 3)
      diagnostics.push_back({place, fmt::format("to extrapolate takes three levels or more; the axis \"{}\" has {}", plan.file.axes[plan.along].name,
                                                plan.labels[plan.along].size())});
  }
}

}  // namespace

StudyPlan read_study(const Communicator& comm, const std::string& path, const std::vector<std::string>& settings) {
  StudyPlan plan;
  StudyFile& study = plan.file;
  XmlList root = parse_xml(read_text(comm, path), path);
  refuse_other_kinds(root, FileKind::study);
  for (const auto& setting : settings) apply_override(root, setting);
  std::vector<Diagnostic> diagnostics;
  study.name = root.name;
  read_parameters(study, root, {}, {}, diagnostics);
  plan.series = find_axis(study, study.series, 0, diagnostics);
  plan.along = find_axis(study, study.along, study.axes.empty() ? 0 : study.axes.size() - 1, diagnostics);
  for (const auto& axis : study.axes) plan.labels.push_back(names_of(axis.value.labelled()));
  if (study.axes.empty() || study.quantities.empty() || study.scene.value.empty()) {
    if (diagnostics.empty()) diagnostics.push_back({root.place, "a study needs an axis and a quantity"});
    throw_all(diagnostics);
  }
  DistinctFiles plots;
  for (const auto& quantity : study.quantities) plots.add(quantity.name, quantity.place, diagnostics);
  plan.points = study_points(study, diagnostics);
  if (plan.points.empty() && diagnostics.empty()) diagnostics.push_back({root.place, "all combinations are excluded"});
  if (!study.finest.all.empty()) {
    StudyFile alone;  // an axis of one value, so that "ranks" and the like are taken out of its settings too
    alone.settings = study.settings;
    alone.time_limit = study.time_limit;
    alone.axes.push_back({"finest", {}, {}});
    alone.axes.back().value.choices.push_back({"finest", {}, study.finest});
    plan.finest = study_points(alone, diagnostics).front();
    plan.finest->name = "finest";
    plan.finest->labels.clear();
  }

  const std::filesystem::path scene = std::filesystem::path(path).parent_path() / study.scene.value;
  std::optional<XmlList> base;
  try {
    plan.scene_text = read_text(comm, scene.string());
    base = parse_xml(plan.scene_text, scene.string());
  } catch (const InputError& error) {
    diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
  } catch (const FileError& error) {
    diagnostics.push_back({study.scene.place, error.what()});
  }
  if (base) {
    const auto attempt = [&](StudyPoint& point) {
      add_output(point.settings, study);
      try {
        complete(point, *base);
        check_quantities(plan, point, diagnostics);
      } catch (const InputError& error) {
        diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
      }
    };
    for (StudyPoint& point : plan.points) attempt(point);
    if (plan.finest) attempt(*plan.finest);
  }
  throw_all(diagnostics);
  return plan;
}

}  // namespace mortise
