// Histories in an archive: by ids of nodes, so that any number of ranks can go on from them.

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"

namespace mortise {

namespace detail {
namespace {

using Rows = std::vector<std::vector<double>>;

/// [nodes] of lists of ids of nodes, as rows of different lengths, in both directions.
template <class List>
void serialize_nodes(StateArchive& archive, const Map& nodes, const std::string& name, const RowIds& ids, std::vector<List>& lists) {
  Rows rows;
  for (const List& list : lists) rows.emplace_back(list.begin(), list.end());
  serialize(archive, *nodes.getComm(), name, ids, rows);
  if (!archive.restores()) return;
  const GlobalOrdinal last = nodes.getMaxAllGlobalIndex();
  std::optional<std::string> wrong;
  lists.assign(rows.size(), {});
  for (std::size_t s = 0; s < rows.size(); ++s) {
    if (rows[s].size() > lists[s].max_size())
      wrong = fmt::format("a row of \"{}\" has {} nodes; the most are {}", name, rows[s].size(), lists[s].max_size());
    for (std::size_t n = 0; n < rows[s].size() && !wrong; ++n) {
      const auto node = whole_number<GlobalOrdinal>(rows[s][n]);
      if (node && *node >= 0 && *node <= last)
        lists[s].push_back(*node);
      else
        wrong = fmt::format("\"{}\" holds the node {}; nodes are from 0 to {}", name, rows[s][n], last);
    }
  }
  archive.refuse_if(wrong);
}

/// Stores or restores vectors of `size` numbers, empty ones among them.
template <class List>
void serialize_vectors(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& ids, std::size_t size,
                       std::vector<List>& vectors) {
  Rows rows;
  for (const List& vector : vectors) rows.emplace_back(vector.data(), vector.data() + vector.size());
  serialize(archive, comm, name, ids, rows);
  if (!archive.restores()) return;
  const auto wrong = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return !row.empty() && row.size() != size; });
  archive.refuse_if(wrong == rows.end() ? std::nullopt
                                        : std::optional(fmt::format("a row of \"{}\" has {} numbers; expected are {}", name, wrong->size(), size)));
  vectors.resize(rows.size());
  for (std::size_t s = 0; s < rows.size(); ++s) {
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

void serialize_starts(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& slaves, std::size_t dimension,
                      std::vector<NodeStart>& starts) {
  std::vector<SpatialVector> multipliers;
  std::vector<double> stiffening;
  for (const NodeStart& start : starts) {
    multipliers.push_back(start.multiplier);
    stiffening.push_back(start.stiffening);
  }
  serialize_vectors(archive, comm, name + ".multiplier", slaves, dimension, multipliers);
  serialize(archive, name + ".stiffening", slaves, stiffening);
  for (std::size_t s = 0; s < starts.size(); ++s) starts[s] = {multipliers[s], stiffening[s]};
}

void serialize_slip(StateArchive& archive, const Map& nodes, const std::string& name, const RowIds& slaves, std::size_t dimension,
                    std::shared_ptr<const SlipReferences>& slip) {
  auto references = slip ? *slip : SlipReferences();
  const Communicator& comm = *nodes.getComm();
  serialize_nodes(archive, nodes, name + ".nodes", slaves, references.nodes);
  serialize(archive, comm, name + ".coefficients", slaves, references.coefficients);
  bool match = true;
  for (std::size_t s = 0; s < references.nodes.size() && s < references.coefficients.size(); ++s)
    match = match && references.nodes[s].size() == references.coefficients[s].size();
  if (archive.restores())
    archive.refuse_if(match ? std::nullopt : std::optional(fmt::format("\"{0}.nodes\" and \"{0}.coefficients\" differ in their numbers", name)));
  serialize_vectors(archive, comm, name + ".positions", slaves, dimension - 1, references.positions);
  serialize_vectors(archive, comm, name + ".ties", slaves, dimension - 1, references.ties);
  serialize_vectors(archive, comm, name + ".tractions", slaves, dimension - 1, references.tractions);
  serialize(archive, name + ".paths", slaves, references.paths);
  serialize(archive, name + ".gaps", slaves, references.gaps);
  if (archive.restores()) slip = std::make_shared<const SlipReferences>(std::move(references));
}

/// All but positions and multipliers, which are those of the state; slips are measured from these positions too.
void serialize_accepted(StateArchive& archive, const ContactModel& model, AcceptedContact& accepted) {
  const Communicator& comm = model.comm();
  const Map& nodes = *accepted.positions->getMap();
  const std::size_t dimension = accepted.positions->getNumVectors();
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
      if (pair.corner_rule() == CornerRule::nearest_facet) serialize_nodes(archive, nodes, name + ".nearest", slaves, history.nearest_facets);
    }
    if (pair.friction() != nullptr) serialize_slip(archive, nodes, name + ".slip", slaves, dimension, history.slip);
    if (pair.friction() != nullptr && pair.friction()->reads_temperature()) serialize(archive, name + ".temperatures", slaves, history.temperatures);
    if (pair.enforcement().starts_from_multipliers()) serialize_starts(archive, comm, name + ".start", slaves, dimension, history.starts);
    serialize(archive, name + ".hardening", history.settling.hardening);
    serialize(archive, name + ".ratio", history.settling.ratio);
    serialize(archive, name + ".last_change", history.settling.last_change);
    serialize(archive, name + ".allowed_overlap", history.allowed_overlap);
    if (pair.definition().has_conditions_on_rate) serialize(archive, name + ".start_gaps", slaves, history.start_gaps);
    std::vector<int> states;
    for (const ContactState state : accepted.states[p].states) states.push_back(static_cast<int>(state));
    serialize(archive, name + ".states", slaves, states);
    const auto wrong = std::find_if(states.begin(), states.end(), [](int one) { return one < 0 || one > static_cast<int>(ContactState::slip); });
    archive.refuse_if(wrong == states.end() ? std::nullopt : std::optional(fmt::format("\"{}.states\" holds {}, which is no state", name, *wrong)));
    serialize(archive, name + ".covered", slaves, accepted.states[p].covered);
    for (std::size_t s = 0; s < states.size(); ++s) accepted.states[p].states[s] = static_cast<ContactState>(states[s]);
  }
}

}  // namespace
}  // namespace detail

void ContactSystem::store(StateArchive& archive, const ContactHistory& history) const {
  detail::Arguments(*model_, "store").history(history).agree();
  AcceptedContact accepted = *history;
  detail::serialize_accepted(archive, *model_, accepted);
}

ContactHistory ContactSystem::restore(StateArchive& archive, const NodalDisplacement& d, const Vector& z) const {
  detail::Arguments(*model_, "restore").displacement(d).on_multipliers(z, "z").agree();
  AcceptedContact accepted = *initial_history(d);
  detail::serialize_accepted(archive, *model_, accepted);
  accepted.multipliers = rcp(new Vector(z, Teuchos::Copy));
  return ContactHistory(std::move(accepted));
}

}  // namespace mortise
