#include "evaluation/arguments.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <boost/container_hash/hash.hpp>
#include <cmath>
#include <stdexcept>

#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {

void Arguments::refuse(const std::string& what) {
  if (!wrong_) wrong_ = fmt::format("contact: {}(): {}", call_, what);
}

// Nearly always it is the map itself. Other maps are compared without communication: agree() has it.
void Arguments::on_map(const Map& map, const Map& wanted, const char* name, const char* of_what) {
  if (&map == &wanted || map.locallySameAs(wanted)) return;
  refuse(fmt::format("`{}` has {} rows on this rank, and {} has {}; give a vector on that map", name, local_id_count(map), of_what,
                     local_id_count(wanted)) +
         (local_id_count(map) == local_id_count(wanted) ? ". Their ids differ" : ""));
}

Arguments& Arguments::on_dofs(const Vector& vector, const char* name) {
  on_map(*vector.getMap(), *model_.dofs, name, "the map `dofs` of the system");
  return *this;
}

Arguments& Arguments::on_multipliers(const Vector& vector, const char* name) {
  on_map(*vector.getMap(), *model_.multipliers, name, "multiplier_map()");
  return *this;
}

Arguments& Arguments::displacement(const NodalDisplacement& d) {
  on_dofs(d.dofs, "d");
  if (d.nodes == nullptr) return *this;
  on_map(*d.nodes->getMap(), *model_.owned_nodes, "NodalDisplacement::nodes", "the map of owned nodes");
  if (d.nodes->getNumVectors() != static_cast<std::size_t>(model_.dimension))
    refuse(fmt::format("`NodalDisplacement::nodes` has {} columns; expected are {}", d.nodes->getNumVectors(), model_.dimension));
  return *this;
}

Arguments& Arguments::history(const ContactHistory& history) {
  const AcceptedContact& accepted = *history;
  const char* remedy =
      "; take one that this system made. That of a system with other supports on the same nodes is taken over by carry_over(), that of another "
      "distribution by store() and restore()";
  const auto other = [&](const std::string& what) { refuse(fmt::format("the history is that of another system: {}{}", what, remedy)); };
  if (accepted.pairs.size() != model_.pairs.size() || accepted.states.size() != model_.pairs.size())
    other(fmt::format("it has {} pairs, this one {}", accepted.pairs.size(), model_.pairs.size()));
  else if (accepted.layout != 0 && accepted.layout != model_.layout)
    other("its slave nodes are others, or on other ranks");
  else if (accepted.positions.is_null() || accepted.multipliers.is_null())
    other("it has no positions, or no multipliers");
  if (wrong_) return *this;
  for (std::size_t p = 0; p < model_.pairs.size(); ++p) {
    const Pair& pair = *model_.pairs[p];
    const std::size_t slaves = pair.slave_nodes().size();
    const PairHistory& of_pair = accepted.pairs[p];
    const PairStates& states = accepted.states[p];
    const bool has_slip = of_pair.slip != nullptr;
    if (of_pair.axes.size() != slaves || states.states.size() != slaves || states.covered.size() != slaves)
      other(fmt::format("pair '{}' has {} slave nodes on this rank, in the history {}", pair.definition().name, slaves, states.states.size()));
    else if (has_slip != (pair.friction() != nullptr))
      other(fmt::format("pair '{}' is {} friction, in the history {}", pair.definition().name, has_slip ? "without" : "with",
                        has_slip ? "with" : "without"));
    else if (has_slip && of_pair.slip->paths.size() != slaves)
      other(fmt::format("pair '{}' has {} slave nodes on this rank, in the history {}", pair.definition().name, slaves, of_pair.slip->paths.size()));
    else if (pair.enforcement().starts_from_multipliers() != !(of_pair.starts.empty() && slaves > 0) && slaves > 0)
      other(fmt::format("pair '{}' has another enforcement", pair.definition().name));
  }
  on_map(*accepted.positions->getMap(), *model_.owned_nodes, "positions of the history", "the map of owned nodes");
  on_map(*accepted.multipliers->getMap(), *model_.multipliers, "multipliers of the history", "multiplier_map()");
  return *this;
}

Arguments& Arguments::states(const ContactStates& states) {
  bool fits = states.size() == model_.pairs.size();
  for (std::size_t p = 0; p < model_.pairs.size() && fits; ++p)
    fits = states[p].states.size() == model_.pairs[p]->slave_nodes().size() && states[p].covered.size() == states[p].states.size();
  if (!fits) refuse("the states are those of another system; take ContactLaws::states() of laws that this one gave");
  return *this;
}

Arguments& Arguments::number(double value, const char* name, bool allowed, const char* range) {
  if (!allowed || !std::isfinite(value)) refuse(fmt::format("`{}` is {}; give a finite number, {}", name, value, range));
  return *this;
}

void Arguments::agree() const {
  if (most_over_ranks(model_.comm(), wrong_ ? 1 : 0) == 0) return;
  throw std::invalid_argument(wrong_ ? *wrong_ : fmt::format("contact: {}(): an argument does not fit on another rank", call_));
}

std::size_t layout_of(const ContactModel& model) {
  std::size_t digest = model.pairs.size() + 1;
  for (const auto& pair : model.pairs) {
    boost::hash_combine(digest, pair->slave_nodes().size());
    for (const SlaveNode& slave : pair->slave_nodes()) boost::hash_combine(digest, slave.id);
  }
  return digest == 0 ? 1 : digest;
}

void require_pair(const ContactModel& model, std::size_t pair) {
  if (pair >= model.pairs.size()) throw std::out_of_range(fmt::format("contact: there is no pair {}; the system has {}", pair, model.pairs.size()));
}

void require_own(const ContactModel& model, const ContactModel& of_value, const char* call) {
  if (&model != &of_value) throw std::logic_error(fmt::format("contact: {}() with a value of another system; take one that this system made", call));
}

}  // namespace mortise::detail
