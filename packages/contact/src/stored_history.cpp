// Histories in an archive: by ids of nodes, so that any number of ranks can go on from them.

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "evaluated_contact.hpp"

namespace mortise {

namespace detail {
namespace {

using Rows = std::vector<std::vector<double>>;

/// [nodes] of lists of numbers, as rows of different lengths, in both directions.
template <class List>
void serialize_lists(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& ids, std::vector<List>& lists) {
  Rows rows;
  for (const List& list : lists) rows.emplace_back(list.begin(), list.end());
  serialize(archive, comm, name, ids, rows);
  if (!archive.restores()) return;
  lists.resize(rows.size());
  for (std::size_t s = 0; s < rows.size(); ++s) {
    lists[s].resize(static_cast<typename List::size_type>(rows[s].size()));
    std::transform(rows[s].begin(), rows[s].end(), lists[s].begin(), [](double value) { return static_cast<typename List::value_type>(value); });
  }
}

/// The same of vectors of Eigen, empty ones among them.
template <class List>
void serialize_vectors(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& ids, std::vector<List>& vectors) {
  Rows rows;
  for (const List& vector : vectors) rows.emplace_back(vector.data(), vector.data() + vector.size());
  serialize(archive, comm, name, ids, rows);
  if (!archive.restores()) return;
  vectors.resize(rows.size());
  for (std::size_t s = 0; s < rows.size(); ++s) {
    rows[s].resize(std::min<std::size_t>(rows[s].size(), List::MaxSizeAtCompileTime));
    vectors[s].resize(static_cast<Eigen::Index>(rows[s].size()));
    std::copy(rows[s].begin(), rows[s].end(), vectors[s].data());
  }
}

// A facet by its place among the facets of its node, from 1; 0: none.
void serialize_kinks(StateArchive& archive, const std::string& name, const RowIds& nodes, SurfaceKinks& kinks) {
  bool chosen = !kinks.is_kink.empty();
  std::vector<int> facets;
  for (const auto& facet : kinks.takes_normal_of) facets.push_back(facet ? static_cast<int>(*facet) + 1 : 0);
  // Ranks without a node of the surface cannot tell whether kinks were chosen: one that has some does.
  kinks.is_kink.resize(nodes.ids.size(), 0);
  facets.resize(nodes.ids.size(), 0);
  std::vector<char> choices(nodes.ids.size(), chosen ? 1 : 0);
  serialize(archive, name + ".chosen", nodes, choices);
  serialize(archive, name + ".is_kink", nodes, kinks.is_kink);
  serialize(archive, name + ".facet", nodes, facets);
  if (!archive.restores()) {
    if (!chosen) kinks.is_kink.clear();
    return;
  }
  kinks.takes_normal_of.clear();
  for (const int facet : facets) kinks.takes_normal_of.push_back(facet > 0 ? std::optional(static_cast<std::size_t>(facet - 1)) : std::nullopt);
  chosen = std::any_of(choices.begin(), choices.end(), [](char one) { return one != 0; });
  if (!chosen) kinks = {};
}

void serialize_starts(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& slaves,
                      std::vector<NodeStart>& starts) {
  std::vector<SpatialVector> multipliers;
  std::vector<double> stiffening;
  for (const NodeStart& start : starts) {
    multipliers.push_back(start.multiplier);
    stiffening.push_back(start.stiffening);
  }
  serialize_vectors(archive, comm, name + ".multiplier", slaves, multipliers);
  serialize(archive, name + ".stiffening", slaves, stiffening);
  for (std::size_t s = 0; s < starts.size(); ++s) starts[s] = {multipliers[s], stiffening[s]};
}

void serialize_slip(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& slaves,
                    std::shared_ptr<const SlipReferences>& slip) {
  auto references = slip ? *slip : SlipReferences();
  serialize_lists(archive, comm, name + ".nodes", slaves, references.nodes);
  serialize_lists(archive, comm, name + ".coefficients", slaves, references.coefficients);
  serialize_vectors(archive, comm, name + ".positions", slaves, references.positions);
  serialize_vectors(archive, comm, name + ".ties", slaves, references.ties);
  serialize(archive, name + ".paths", slaves, references.paths);
  if (archive.restores()) slip = std::make_shared<const SlipReferences>(std::move(references));
}

/// All but positions and multipliers, which are those of the state.
void serialize_accepted(StateArchive& archive, const ContactModel& model, AcceptedContact& accepted) {
  const Communicator& comm = model.comm();
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const Pair& pair = *model.pairs[p];
    PairHistory& history = accepted.pairs[p];
    const std::string name = fmt::format("contact.{}", p);
    RowIds slaves{name + ".slaves", {}, 0};
    for (const SlaveNode& node : pair.slave_nodes()) slaves.ids.push_back(node.id);
    slaves.owned = slaves.ids.size();
    serialize(archive, name + ".axes", slaves, history.axes);
    if (pair.corner_rule() != CornerRule::averaged) {
      serialize_kinks(archive, name + ".kinks", {name + ".surface", pair.interface().nodes_of_kinks(), slaves.owned}, history.kinks);
      if (pair.corner_rule() == CornerRule::nearest_facet) serialize_lists(archive, comm, name + ".nearest", slaves, history.nearest_facets);
    }
    if (pair.friction() != nullptr) serialize_slip(archive, comm, name + ".slip", slaves, history.slip);
    if (pair.enforcement().starts_from_multipliers()) serialize_starts(archive, comm, name + ".start", slaves, history.starts);
    serialize(archive, name + ".hardening", history.settling.hardening);
    serialize(archive, name + ".ratio", history.settling.ratio);
    serialize(archive, name + ".last_change", history.settling.last_change);
    serialize(archive, name + ".allowed_overlap", history.allowed_overlap);
    std::vector<int> states;
    for (const ContactState state : accepted.states[p].states) states.push_back(static_cast<int>(state));
    serialize(archive, name + ".states", slaves, states);
    serialize(archive, name + ".covered", slaves, accepted.states[p].covered);
    for (std::size_t s = 0; s < states.size(); ++s) accepted.states[p].states[s] = static_cast<ContactState>(states[s]);
  }
}

}  // namespace
}  // namespace detail

void ContactSystem::store(StateArchive& archive, const ContactHistory& history) const {
  AcceptedContact accepted = *history;
  detail::serialize_accepted(archive, *model_, accepted);
}

ContactHistory ContactSystem::restore(StateArchive& archive, const NodalDisplacement& d, const Vector& z) const {
  AcceptedContact accepted = *initial_history(d);
  detail::serialize_accepted(archive, *model_, accepted);
  accepted.multipliers = rcp(new Vector(z, Teuchos::Copy));
  return ContactHistory(std::move(accepted));
}

}  // namespace mortise
