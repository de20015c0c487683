// From lines to parts: keywords and their data.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "readers/abaqus/abaqus_context.hpp"
#include "readers/abaqus/abaqus_keywords.hpp"
#include "readers/abaqus/abaqus_mesh_lines.hpp"
#include "readers/abaqus/abaqus_set_lines.hpp"

namespace mortise {
namespace {

class AbaqusParser {
 public:
  AbaqusParser(AbaqusLines& lines, FileErrors& errors) : context_(lines, errors) {}

  AbaqusModel parse() {
    std::string_view line;
    while (context_.lines.next(line)) {
      if (line.front() != '*') {
        read_data(line);
        continue;
      }
      const AbaqusKeyword keyword = read_abaqus_keyword(line, context_.lines);
      if (keyword.name == "INCLUDE" && !is_in_steps_) {
        context_.require_parameters(keyword, {"INPUT"});
        context_.lines.include(context_.required(keyword, "INPUT"), keyword.spot);
        continue;
      }
      end_data();
      is_in_steps_ = is_in_steps_ || keyword.name == "STEP";
      const bool is_set = keyword.name == "NSET" || keyword.name == "ELSET" || keyword.name == "SURFACE";
      if (!is_in_steps_ || is_set) read_keyword(keyword);
    }
    end_data();
    if (part_ != nullptr) context_.error(part_spot_, fmt::format("*PART {} has no *END PART", part_->name));
    return std::move(model_);
  }

 private:
  enum class Data { none, passed_over, mesh, sets, instance };

  AbaqusScope& scope() { return part_ != nullptr ? *part_ : has_own_mesh_ ? model_.parts.back() : model_.outside; }

  void read_keyword(const AbaqusKeyword& keyword) {
    data_ = Data::passed_over;
    const std::string& name = keyword.name;
    if (instance_open_) read_keyword_of_instance(keyword);
    if (name == "NODE") {
      mesh_lines_.begin_nodes(keyword, scope());
      data_ = Data::mesh;
    } else if (name == "ELEMENT") {
      if (mesh_lines_.begin_elements(keyword, scope())) data_ = Data::mesh;
    } else if (name == "NSET" || name == "ELSET") {
      set_lines_.begin_set(keyword, scope());
      data_ = Data::sets;
    } else if (name == "SURFACE") {
      if (set_lines_.begin_surface(keyword, scope())) data_ = Data::sets;
    } else if (name == "PART")
      read_part(keyword);
    else if (name == "ENDPART")
      part_ = nullptr;
    else if (name == "ASSEMBLY" || name == "ENDASSEMBLY")
      part_ == nullptr ? void() : context_.stop(keyword.spot, fmt::format("*{} stands inside of *PART", name));
    else if (name == "INSTANCE")
      read_instance(keyword);
    else if (name == "ENDINSTANCE")
      instance_open_ = has_own_mesh_ = false;
    else if (is_refused_keyword(name))
      context_.error(keyword.spot, fmt::format("*{} is not read; write the file with all nodes and elements, as preprocessors do", name));
    else if (const auto known = keyword_without_mesh(name))
      ++model_.passed_over[*known];
    else
      context_.error(keyword.spot, unknown_keyword(name));
  }

  // ---- parts and instances

  /// An instance of a part without a mesh may have one of its own.
  void read_keyword_of_instance(const AbaqusKeyword& keyword) {
    static const std::set<std::string> of_meshes{"NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"};
    AbaqusInstance& instance = model_.instances.back();
    if (of_meshes.count(keyword.name) == 0) {
      if (keyword.name != "ENDINSTANCE" && !keyword_without_mesh(keyword.name))
        context_.stop(keyword.spot, fmt::format("*{} inside of *INSTANCE is not read; give it in the part or in the assembly", keyword.name));
      return;
    }
    if (has_own_mesh_) return;
    if (!model_.parts[instance.part].coordinates.empty())
      context_.stop(keyword.spot, fmt::format("instance {} has *{}, and its part {} has nodes: only an instance of a part without nodes has its own",
                                              instance.name, keyword.name, model_.parts[instance.part].name));
    instance.part = model_.parts.size();
    model_.parts.emplace_back().name = instance.name;
    has_own_mesh_ = true;
  }

  void read_part(const AbaqusKeyword& keyword) {
    const std::string name = context_.required(keyword, "NAME");
    if (part_ != nullptr) context_.stop(keyword.spot, fmt::format("*PART {} begins before *END PART of {}", name, part_->name));
    if (!part_places_.emplace(in_capitals(name), model_.parts.size()).second) context_.stop(keyword.spot, fmt::format("part {} stands twice", name));
    part_ = &model_.parts.emplace_back();
    part_->name = name;
    part_spot_ = keyword.spot;
  }

  void read_instance(const AbaqusKeyword& keyword) {
    context_.require_parameters(keyword, {"NAME", "PART"});
    AbaqusInstance instance;
    instance.name = context_.required(keyword, "NAME");
    instance.spot = keyword.spot;
    const std::string part = context_.required(keyword, "PART");
    const auto found = part_places_.find(in_capitals(part));
    if (part_ != nullptr) context_.stop(keyword.spot, "*INSTANCE stands inside of *PART");
    if (found == part_places_.end())
      context_.stop(keyword.spot, fmt::format("instance {}: there is no part \"{}\" before this line", instance.name, part));
    if (!instance_names_.insert(in_capitals(instance.name)).second)
      context_.stop(keyword.spot, fmt::format("instance {} stands twice", instance.name));
    instance.part = found->second;
    model_.instances.push_back(std::move(instance));
    instance_open_ = true;
    data_ = Data::instance;
  }

  /// A translation, then an axis and an angle.
  void read_position(std::string_view line) {
    AbaqusInstance& instance = model_.instances.back();
    const bool is_rotation = !instance.translation.empty();
    std::vector<double>& numbers = is_rotation ? instance.rotation : instance.translation;
    const std::size_t wanted = is_rotation ? 7 : 3;
    if (!numbers.empty())
      return context_.error(fmt::format("instance {}: expected no more than two lines, a translation and a rotation", instance.name));
    std::string_view field;
    while (take_abaqus_field(line, field)) {
      const auto value = field.empty() ? std::optional(0.0) : real_number_of(field);
      if (!value) return context_.error(fmt::format("instance {}: \"{}\" is no finite number", instance.name, field));
      numbers.push_back(*value);
    }
    if (numbers.size() > wanted || (is_rotation && numbers.size() < wanted))
      context_.error(fmt::format("instance {}: expected {} numbers of a {}, found {}", instance.name, wanted,
                                 is_rotation ? "rotation" : "translation", numbers.size()));
    numbers.resize(wanted);
  }

  // ---- data lines

  void read_data(std::string_view line) {
    switch (data_) {
      case Data::none:
        return context_.stop(context_.lines.spot(),
                             fmt::format("expected a keyword, as *NODE, found \"{}\": this is no input file of Abaqus or CalculiX", line));
      case Data::passed_over:
        return;
      case Data::mesh:
        return mesh_lines_.read(line);
      case Data::sets:
        return set_lines_.read(line);
      case Data::instance:
        return read_position(line);
    }
  }

  /// The data since the last keyword is whole.
  void end_data() {
    if (data_ == Data::mesh) mesh_lines_.end();
    data_ = Data::passed_over;
  }

  AbaqusContext context_;
  AbaqusModel model_;
  std::set<std::string> instance_names_;
  AbaqusMeshLines mesh_lines_{context_, model_};
  AbaqusSetLines set_lines_{context_, instance_names_};
  Data data_ = Data::none;
  std::unordered_map<std::string, std::size_t> part_places_;
  AbaqusScope* part_ = nullptr;  ///< that is open
  AbaqusSpot part_spot_;
  bool instance_open_ = false, has_own_mesh_ = false;  ///< the instance that is open
  bool is_in_steps_ = false;
};

}  // namespace

AbaqusModel parse_abaqus(AbaqusLines& lines, FileErrors& errors) { return AbaqusParser(lines, errors).parse(); }

}  // namespace mortise
