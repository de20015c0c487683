#include "readers/abaqus/abaqus_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "readers/abaqus/abaqus_keyword.hpp"

namespace mortise {
namespace {

constexpr std::int64_t most_elements = most_indices;  ///< that a set is counted to have

void keep_each_once(std::vector<std::int32_t>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

}  // namespace

AbaqusSets::AbaqusSets(const char* kind, const AbaqusScope& scope, const AbaqusNames<AbaqusSet>& sets, const std::vector<std::int64_t>& labels,
                       const std::vector<std::int64_t>& left_out, std::vector<std::int32_t> first, const AbaqusLines& lines, FileErrors& errors)
    : kind_(kind),
      scope_(scope),
      sets_(sets),
      first_(std::move(first)),
      lines_(lines),
      errors_(errors),
      table_(labels),
      left_out_(left_out),
      count_(labels.size()) {
  if (!table_.repeated()) return;
  for (const std::int64_t label : labels) first_of_label_.push_back(table_.find(label));
}

std::vector<std::string> AbaqusSets::resolve(const Instances& instances, const AppendNodes& nodes_of_elements) {
  std::vector<std::string> notes;
  members_.reserve(sets_.all().size());
  for (const AbaqusSet& set : sets_.all()) {
    std::vector<std::int32_t> members;
    bool may_repeat = !first_of_label_.empty();
    std::int64_t missing = 0, left_out = 0;
    std::size_t most = 2 * count_;  // members before repeated ones are looked for
    for (const AbaqusSetItem& item : set.items) {
      may_repeat = may_repeat || item.kind == AbaqusSetItem::Kind::set || item.kind == AbaqusSetItem::Kind::of_elements;
      const std::size_t before = members.size();
      const Appended appended = append(item, instances, members_.size(), nodes_of_elements, members);
      left_out += appended.left_out;
      if (appended.found && item.kind == AbaqusSetItem::Kind::labels)
        missing += (std::int64_t{item.b} - item.a) / item.c + 1 - static_cast<std::int64_t>(members.size() - before) - appended.left_out;
      // Sets of sets of sets do not grow beyond the mesh.
      if (may_repeat && members.size() > most) {
        keep_each_once(members);
        most = 2 * (count_ + members.size());
      }
    }
    if (may_repeat) keep_each_once(members);
    if (missing > 0)
      notes.push_back(fmt::format("set \"{}\": {} of the numbers of its GENERATE lines are of no {}, and are left out", set.name, missing, kind_));
    if (left_out > 0 && !members.empty())
      notes.push_back(fmt::format("set \"{}\": {} of its {} elements are of types that are not read, and are left out", set.name, left_out,
                                  left_out + static_cast<std::int64_t>(members.size())));
    members_.push_back(std::move(members));
    left_out_of_sets_.push_back(std::min(left_out, most_elements));  // sets of sets of sets
  }
  return notes;
}

AbaqusSets::Appended AbaqusSets::append_of_instance(const AbaqusSetItem& item, const Instances& instances, std::vector<std::int32_t>& to) const {
  const Place place = lines_.place(item.spot);
  const std::string& name = scope_.names[static_cast<std::size_t>(item.instance)];
  const auto found = instances.find(in_capitals(name));
  if (found == instances.end()) {
    errors_.add(place, fmt::format("there is no instance \"{}\"", name));
    return {false};
  }
  const AbaqusSets& part = *found->second.sets;
  AbaqusSetItem own = item;
  own.instance = -1;
  std::vector<std::int32_t> members;
  Appended appended;
  if (item.kind == AbaqusSetItem::Kind::set) {
    const std::string& set = scope_.names[static_cast<std::size_t>(item.a)];
    const std::int32_t index = part.sets_.find(set);
    if (index < 0) {
      errors_.add(place, fmt::format("instance \"{}\" has no set \"{}\" of {}s", name, set, kind_));
      return {false};
    }
    members = part.members(static_cast<std::size_t>(index));
    appended.left_out = part.left_out(static_cast<std::size_t>(index));
  } else {
    appended = part.append(own, {}, 0, {}, members);
  }
  for (const std::int32_t member : members) to.push_back(member + found->second.offset);
  return appended;
}

AbaqusSets::Appended AbaqusSets::append(const AbaqusSetItem& item, const Instances& instances, std::size_t before,
                                        const AppendNodes& nodes_of_elements, std::vector<std::int32_t>& to) const {
  const Place place = lines_.place(item.spot);
  if (item.kind == AbaqusSetItem::Kind::of_elements) {
    nodes_of_elements(item, to);
    return {};
  }
  if (item.instance >= 0) return append_of_instance(item, instances, to);
  switch (item.kind) {
    case AbaqusSetItem::Kind::label: {
      const std::int32_t index = table_.find(item.a);
      if (index >= 0) {
        to.push_back(index);
        return {};
      }
      if (left_out_.find(item.a) >= 0) return {true, 1};
      errors_.add(place, fmt::format("there is no {} {}", kind_, item.a));
      return {false};
    }
    case AbaqusSetItem::Kind::labels: {
      const std::size_t had = to.size();
      std::int64_t left_out = 0;
      table_.visit_range(item.a, item.b, item.c, [&](std::int32_t index) { to.push_back(index); });
      left_out_.visit_range(item.a, item.b, item.c, [&](std::int32_t) { ++left_out; });
      const bool found = to.size() > had || left_out > 0;
      if (!found) errors_.add(place, fmt::format("none of the numbers {} to {} by {} is of a {}", item.a, item.b, item.c, kind_));
      return {found, left_out};
    }
    case AbaqusSetItem::Kind::set: {
      const std::string& name = scope_.names[static_cast<std::size_t>(item.a)];
      const std::int32_t index = sets_.find(name);
      if (index < 0 || static_cast<std::size_t>(index) >= before) {
        errors_.add(place, fmt::format("there is no set \"{}\" of {}s before this line", name, kind_));
        return {false};
      }
      const auto& members = members_[static_cast<std::size_t>(index)];
      to.insert(to.end(), members.begin(), members.end());
      return {true, left_out_of_sets_[static_cast<std::size_t>(index)]};
    }
    case AbaqusSetItem::Kind::indices:
      for (std::int32_t n = 0; n < item.b; ++n) {
        const std::int32_t index = first_[static_cast<std::size_t>(item.c)] + item.a + n;
        to.push_back(first_of_label_.empty() ? index : first_of_label_[static_cast<std::size_t>(index)]);
      }
      return {};
    case AbaqusSetItem::Kind::left_out:
      return {true, item.a};
    case AbaqusSetItem::Kind::of_elements:
      break;
  }
  return {false};
}

}  // namespace mortise
