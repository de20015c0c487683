#include "readers/abaqus/abaqus_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "readers/abaqus/abaqus_keyword.hpp"

namespace mortise {
namespace {

void keep_each_once(std::vector<std::int32_t>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

}  // namespace

AbaqusSets::AbaqusSets(const char* kind, const AbaqusScope& scope, const AbaqusNames<AbaqusSet>& sets, const std::vector<std::int64_t>& labels,
                       std::vector<std::int32_t> first, const AbaqusLines& lines, FileErrors& errors)
    : kind_(kind), scope_(scope), sets_(sets), first_(std::move(first)), lines_(lines), errors_(errors), table_(labels), count_(labels.size()) {}

std::vector<std::string> AbaqusSets::resolve(const Instances& instances) {
  std::vector<std::string> notes;
  members_.reserve(sets_.all().size());
  for (const AbaqusSet& set : sets_.all()) {
    std::vector<std::int32_t> members;
    bool may_repeat = false;
    std::int64_t missing = 0;
    std::size_t most = 2 * count_;  // members before repeated ones are looked for
    for (const AbaqusSetItem& item : set.items) {
      may_repeat = may_repeat || item.kind == AbaqusSetItem::Kind::set;
      const std::size_t before = members.size();
      const bool found = append(item, instances, members_.size(), members);
      if (found && item.kind == AbaqusSetItem::Kind::labels)
        missing += (std::int64_t{item.b} - item.a) / item.c + 1 - static_cast<std::int64_t>(members.size() - before);
      // Sets of sets of sets do not grow beyond the mesh.
      if (may_repeat && members.size() > most) {
        keep_each_once(members);
        most = 2 * (count_ + members.size());
      }
    }
    if (may_repeat) keep_each_once(members);
    if (missing > 0)
      notes.push_back(fmt::format("set \"{}\": {} of the numbers of its GENERATE lines are of no {}, and are left out", set.name, missing, kind_));
    members_.push_back(std::move(members));
  }
  return notes;
}

bool AbaqusSets::append(const AbaqusSetItem& item, const Instances& instances, std::size_t before, std::vector<std::int32_t>& to) const {
  const Place place = lines_.place(item.spot);
  if (item.instance >= 0) {
    const std::string& name = scope_.names[static_cast<std::size_t>(item.instance)];
    const auto found = instances.find(in_capitals(name));
    if (found == instances.end()) {
      errors_.add(place, fmt::format("there is no instance \"{}\"", name));
      return false;
    }
    const AbaqusSets& part = *found->second.sets;
    AbaqusSetItem own = item;
    own.instance = -1;
    std::vector<std::int32_t> members;
    if (item.kind == AbaqusSetItem::Kind::set) {
      const std::string& set = scope_.names[static_cast<std::size_t>(item.a)];
      const std::int32_t index = part.sets_.find(set);
      if (index < 0) {
        errors_.add(place, fmt::format("instance \"{}\" has no set \"{}\" of {}s", name, set, kind_));
        return false;
      }
      members = part.members(static_cast<std::size_t>(index));
    } else if (!part.append(own, {}, 0, members)) {
      return false;
    }
    for (const std::int32_t member : members) to.push_back(member + found->second.offset);
    return true;
  }
  switch (item.kind) {
    case AbaqusSetItem::Kind::label: {
      const std::int32_t index = table_.find(item.a);
      if (index < 0)
        errors_.add(place, fmt::format("there is no {} {}", kind_, item.a));
      else
        to.push_back(index);
      return index >= 0;
    }
    case AbaqusSetItem::Kind::labels: {
      const std::size_t had = to.size();
      table_.visit_range(item.a, item.b, item.c, [&](std::int32_t index) { to.push_back(index); });
      if (to.size() == had) errors_.add(place, fmt::format("none of the numbers {} to {} by {} is of a {}", item.a, item.b, item.c, kind_));
      return to.size() > had;
    }
    case AbaqusSetItem::Kind::set: {
      const std::string& name = scope_.names[static_cast<std::size_t>(item.a)];
      const std::int32_t index = sets_.find(name);
      if (index < 0 || static_cast<std::size_t>(index) >= before) {
        errors_.add(place, fmt::format("there is no set \"{}\" of {}s before this line", name, kind_));
        return false;
      }
      const auto& members = members_[static_cast<std::size_t>(index)];
      to.insert(to.end(), members.begin(), members.end());
      return true;
    }
    case AbaqusSetItem::Kind::indices:
      for (std::int32_t n = 0; n < item.b; ++n) to.push_back(first_[static_cast<std::size_t>(item.c)] + item.a + n);
      return true;
  }
  return false;
}

}  // namespace mortise
