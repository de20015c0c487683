#include "mortise/studies/describe_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "mortise/core/names.hpp"
#include "mortise/input/parameter_tree.hpp"
#include "mortise/material/hardening.hpp"
#include "mortise/simulation/quantities/exact_solution.hpp"
#include "mortise/simulation/quantities/fields.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "mortise/studies/hard_file.hpp"
#include "mortise/studies/machine_file.hpp"
#include "mortise/studies/point_file.hpp"
#include "mortise/studies/study_file.hpp"

namespace mortise {
namespace {

ListRecord scene_tree() {
  Scene scene;
  return collect_parameters("scene", scene, CollectParameters::What::declarations);
}

ListRecord point_tree() {
  PointFile point;
  return collect_parameters("point", point, CollectParameters::What::declarations);
}

ListRecord study_tree() {
  StudyFile study;
  return collect_parameters("study", study, CollectParameters::What::declarations);
}

ListRecord hard_tree() {
  HardFile ledger;
  return collect_parameters("hard", ledger, CollectParameters::What::declarations);
}

ListRecord machine_tree() {
  MachineFile machine;
  return collect_parameters("machine", machine, CollectParameters::What::declarations);
}

/// Lists that a user names to use them in expressions; read apart from the other lists, before them.
std::vector<ListRecord> free_lists() {
  using Kind = ParameterRecord::Kind;
  ListRecord variables;
  variables.name = "variables";
  variables.says = Says("numbers with names of your choice, for expressions below them; --set variables/NAME=VALUE replaces one");
  variables.parameters.push_back(
      {"<name>",
       Kind::number,
       "",
       Says("a number by a name of your choice, for use in expressions; it may itself be an expression of the variables above it").required(),
       {}});
  ListRecord tables;
  tables.name = "tables";
  tables.says = Says("piecewise linear functions with names of your choice; an expression calls one as NAME(t)");
  tables.kind = ListRecord::Kind::named;
  ListRecord table;
  table.name = "<name>";
  table.says = Says("a piecewise linear function by a name of your choice, for use in expressions: <name>(t)");
  table.parameters.push_back({"times", Kind::numbers, "", Says("where values are given, in growing order").required(), {}});
  table.parameters.push_back({"values", Kind::numbers, "", Says("values at these times").required(), {}});
  tables.lists.push_back(std::move(table));
  return {std::move(variables), std::move(tables)};
}

/// A kind of files besides scenes, by its name.
struct OtherFile {
  std::string name, sentence;
  ListRecord (*tree)();
  bool symbols;  ///< true if such a file has variables and tables
};

const std::vector<OtherFile>& other_files() {
  static const std::vector<OtherFile> kinds{
      {"point", "input of `mortise point`: a material and the path of one point of it", point_tree, true},
      {"study", "input of `mortise study`: a scene, its varied values, and the references of errors", study_tree, false},
      {"hard", "input of `mortise hard`: hard cases and their expected results", hard_tree, false},
      {"machine", "input of `mortise scale --machine`: nodes and network of a cluster, and how fast runs were there", machine_tree, false}};
  return kinds;
}

std::string formatted(const ListRecord& list, DescriptionFormat format) {
  if (format == DescriptionFormat::json) return to_json(list);
  return format == DescriptionFormat::markdown ? to_markdown(list) : to_text(list);
}

std::string file_name(std::string list) {
  std::replace(list.begin(), list.end(), ' ', '_');
  return list + ".md";
}

using Choices = std::vector<std::pair<std::string, std::string>>;

template <class Base>
Choices choices_of(const Registry<Base>& registry) {
  Choices choices;
  for (const auto& entry : registry.entries()) choices.emplace_back(entry.name, entry.sentence);
  return choices;
}

Choices elements() {
  Choices choices;
  visit_each_element([&](const auto& entry) { choices.emplace_back(entry.name, entry.sentence); });
  return choices;
}

Choices contact_choices() {
  return {{"friction: none | coulomb | tresca", "shear tractions of closed nodes"},
          {"geometry: current | reference", "configuration that carries the contact geometry"},
          {"gap weighting: dual | standard", "functions that weight the gap"}};
}

Choices solvers() {
  return {{"automatic", "iterative in 3D from 10 000 unknowns on where it can solve the systems, else mumps"},
          {"mumps", "MUMPS: direct, any number of ranks"},
          {"klu2", "direct, one rank only"},
          {"iterative", "Belos GMRES preconditioned by MueLu with rigid body modes"}};
}

struct Topic {
  std::string name;
  std::function<Choices()> choices;
};

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all{{"materials", [] { return choices_of(material_registry()); }},
                                      {"hardening", [] { return choices_of(hardening_registry()); }},
                                      {"paths", [] { return choices_of(point_path_registry()); }},
                                      {"elements", elements},
                                      {"meshes", [] { return choices_of(mesh_registry()); }},
                                      {"loads", [] { return choices_of(load_registry()); }},
                                      {"contact", contact_choices},
                                      {"solvers", solvers},
                                      {"quantities", [] { return choices_of(quantity_registry()); }},
                                      {"exact", [] { return choices_of(exact_solution_registry()); }},
                                      {"fields", [] { return field_names(); }}};
  return all;
}

}  // namespace

std::string describe_scene(const std::string& path, DescriptionFormat format) {
  const std::string first = path.substr(0, path.find('/'));
  const auto kind = std::find_if(other_files().begin(), other_files().end(), [&](const OtherFile& one) { return one.name == first; });
  const bool of_scene = kind == other_files().end();
  ListRecord tree = of_scene ? scene_tree() : kind->tree();
  if (format == DescriptionFormat::relax_ng) return to_relax_ng(tree, of_scene || kind->symbols);
  const std::string below = of_scene ? path : path.substr(std::min(path.size(), first.size() + 1));
  if (!below.empty() && (of_scene || kind->symbols))
    for (ListRecord& list : free_lists()) tree.lists.push_back(std::move(list));
  const ListRecord* list = below.empty() ? &tree : find_list(tree, below);
  if (list == nullptr) {
    std::vector<std::string> names;
    for (const auto& known : tree.lists) names.push_back(known.name);
    throw InputError({{}, unknown_name(of_scene ? "list of a scene" : "list of a " + first + " file", below, names)});
  }
  return formatted(*list, format);
}

std::vector<std::string> described_lists() {
  std::vector<std::string> names;
  for (const ListRecord& list : free_lists()) names.push_back(list.name);
  for (const ListRecord& list : scene_tree().lists) names.push_back(list.name);
  for (const OtherFile& kind : other_files()) names.push_back(kind.name);
  return names;
}

std::vector<ReferencePage> reference_pages() {
  const ListRecord tree = scene_tree();
  std::vector<ReferencePage> pages;
  std::string index =
      "# Reference\n\nEvery parameter of a scene, made by `mortise describe --format md -o docs/reference`; do not edit. In a terminal\n`mortise "
      "describe [LIST]` prints the same text, and `scene.rng` is a RELAX NG schema for editors.\n\n";
  ListRecord top = tree;
  top.lists.clear();
  index += to_markdown(top) + "\n## Lists\n\n";
  for (const auto& list : tree.lists) {
    index += fmt::format("- [{}]({}): {}\n", list.name, file_name(list.name), list.says.sentence());
    pages.push_back({file_name(list.name), to_markdown(list)});
  }
  index += "\n## Other files\n\n";
  for (const OtherFile& kind : other_files()) {
    index += fmt::format("- [{0}]({0}.md): {1}. Its schema is `{0}.rng`.\n", kind.name, kind.sentence);
    const ListRecord other = kind.tree();
    pages.push_back({kind.name + ".md", to_markdown(other)});
    pages.push_back({kind.name + ".rng", to_relax_ng(other, kind.symbols)});
  }
  pages.push_back({"index.md", index});
  pages.push_back({"scene.rng", to_relax_ng(tree)});
  return pages;
}

const std::vector<std::string>& choice_topics() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& topic : topics()) list.push_back(topic.name);
    return list;
  }();
  return names;
}

std::string list_choices(const std::string& topic) {
  for (const auto& known : topics()) {
    if (known.name != topic) continue;
    const Choices choices = known.choices();
    std::size_t width = 0;
    for (const auto& [name, sentence] : choices) width = std::max(width, name.size());
    std::string text;
    for (const auto& [name, sentence] : choices) text += fmt::format("{:<{}}  {}\n", name, width, sentence);
    return text;
  }
  throw InputError({{}, unknown_name("topic", topic, choice_topics())});
}

}  // namespace mortise
