#include "connectors/links.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <numeric>

#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/solid/loaded_side.hpp"

namespace mortise {

using Eigen::Vector3d;

namespace {

/// Nodes of the two ends of one connector: each is coupled with each, in a full block of the matrix.
constexpr std::size_t most_nodes = 500;

constexpr double no_length = 1e-12;  ///< of the positions of the ends

/// Entries of all ranks, in the order of ranks. Collective.
std::vector<std::pair<GlobalOrdinal, double>> gathered(const Mesh& mesh, const std::vector<std::pair<GlobalOrdinal, double>>& mine) {
  const int ranks = mesh.comm->getSize();
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks));
  Teuchos::gatherAll(*mesh.comm, 1, &count, ranks, counts.data());
  const int most = *std::max_element(counts.begin(), counts.end());
  std::vector<GlobalOrdinal> ids(static_cast<std::size_t>(most)), all_ids(static_cast<std::size_t>(most * ranks));
  std::vector<double> weights(ids.size()), all_weights(all_ids.size());
  for (std::size_t n = 0; n < mine.size(); ++n) ids[n] = mine[n].first, weights[n] = mine[n].second;
  Teuchos::gatherAll(*mesh.comm, most, ids.data(), most * ranks, all_ids.data());
  Teuchos::gatherAll(*mesh.comm, most, weights.data(), most * ranks, all_weights.data());
  std::vector<std::pair<GlobalOrdinal, double>> result;
  for (int rank = 0; rank < ranks; ++rank)
    for (int n = 0; n < counts[static_cast<std::size_t>(rank)]; ++n) {
      const auto at = static_cast<std::size_t>(most * rank + n);
      result.emplace_back(all_ids[at], all_weights[at]);
    }
  return result;
}

}  // namespace

void LinkMaker::add(const ConnectorOptions& options, const Place& place) {
  bool is_sound = true;
  try {
    check(options, place);
  } catch (const InputError& error) {  // on all ranks: it depends on names and options alone
    diagnostics_.insert(diagnostics_.end(), error.diagnostics().begin(), error.diagnostics().end());
    is_sound = false;
  }
  if (is_sound) {
    if (std::any_of(options.components.begin(), options.components.end(), [](const auto& one) { return one.has_value(); })) add_components(options);
    if (options.axial) add_axial(options, place);
    if (options.rotational) add_rotation(options);
  }
  ++number_;
}

std::vector<ConnectorLink> LinkMaker::finish() {
  throw_if_any(*mesh_.comm, diagnostics_);
  return std::move(links_);
}

void LinkMaker::check(const ConnectorOptions& options, const Place& place) const {
  const bool in_space = mesh_.dimension == 3;
  require_node_set(mesh_, options.set);
  if (!options.to.value.empty()) require_node_set(mesh_, options.to);
  if (options.components[2] && !in_space) throw InputError(place, fmt::format("\"{} z\" is for 3D; the model is in the plane of x and y", word_));
  if (!options.anchor.empty() && static_cast<int>(options.anchor.size()) != mesh_.dimension)
    throw InputError(place, fmt::format("\"anchor\" has {} numbers; {} are needed", options.anchor.size(), mesh_.dimension));
  if (!options.rotational) return;
  require_rotating_point(mesh_, options.set);
  if (!options.to.value.empty()) require_rotating_point(mesh_, options.to);
  if (in_space && (!options.to.value.empty() || word_ != "stiffness"))
    throw InputError(place, fmt::format("\"rotational {}\" between two points, and of dashpots, is for 2D: rotation vectors in 3D have no difference "
                                        "that is a rotation",
                                        word_));
}

ConnectorLaw LinkMaker::law_of_components(const ConnectorOptions& options) const {
  ConnectorLaw law;
  for (int i = 0; i < 3; ++i) law.components[i] = options.components[static_cast<std::size_t>(i)].value_or(0.0);
  return law;
}

void LinkMaker::add_components(const ConnectorOptions& options) {
  const ConnectorLaw law = law_of_components(options);
  if (!options.to.value.empty())
    add_between(options);
  else if (options.per == ConnectorOptions::Per::set && mesh_.side_sets.count(options.set.value) > 0)
    add_over_sides(options, law);
  else
    add_at_nodes(options, law);
}

// W = 1/2 integral of u . (K/A) u dGamma by the rule of the sides: a spring at each of its points, with the share w dGamma / A.
void LinkMaker::add_over_sides(const ConnectorOptions& options, const ConnectorLaw& law) {
  double mine = 0.0;
  for (const LoadedSide& side : owned_sides(mesh_, options.set))
    for (const SidePoint& point : *side.rule) mine += reference_area(bodies_, side, point);
  const double area = sum_over_ranks(*mesh_.comm, mine);
  const SideSet& set = mesh_.side_sets.at(options.set.value);
  const auto add = [&](const LoadedSide& side, bool is_owned) {
    for (const SidePoint& point : *side.rule) {
      ConnectorLink link;
      link.connector = number_;
      link.part = reference_area(bodies_, side, point) / area;
      link.law = law;
      link.law.components *= link.part;
      link.counts = is_owned;
      for (std::size_t a = 0; a < side.nodes.size(); ++a) link.shares.push_back({side.nodes[a], point.N[a]});
      links_.push_back(std::move(link));
    }
  };
  for (std::size_t n = 0; n < set.sides.size(); ++n) {
    const bool is_owned = static_cast<LocalOrdinal>(n) < set.owned;
    const LoadedSide side = side_of(mesh_, set.sides[n]);
    const bool touches = std::any_of(side.nodes.begin(), side.nodes.end(), [&](LocalOrdinal node) { return node < mesh_.owned_count(); });
    if (is_owned || touches) add(side, is_owned);
  }
}

void LinkMaker::add_at_nodes(const ConnectorOptions& options, const ConnectorLaw& law) {
  std::vector<LocalOrdinal> nodes;
  for (const LocalOrdinal node : require_node_set(mesh_, options.set))
    if (node < mesh_.owned_count()) nodes.push_back(node);
  const double count = sum_over_ranks(*mesh_.comm, static_cast<double>(nodes.size()));
  for (const LocalOrdinal node : nodes) {
    ConnectorLink link;
    link.connector = number_;
    link.part = 1.0 / count;
    link.law = law;
    if (options.per == ConnectorOptions::Per::set) link.law.components *= link.part;
    link.shares.push_back({node, 1.0});
    links_.push_back(std::move(link));
  }
}

void LinkMaker::add_mean(const Located<std::string>& set, double sign, ConnectorLink& link) const {
  std::vector<double> weights(static_cast<std::size_t>(mesh_.owned_count()), 0.0);
  if (mesh_.side_sets.count(set.value) > 0) {
    for (const LoadedSide& side : sides_at_owned_nodes(mesh_, set))
      for (const SidePoint& point : *side.rule) {
        const double area = reference_area(bodies_, side, point);
        for (std::size_t a = 0; a < side.nodes.size(); ++a)
          if (side.nodes[a] < mesh_.owned_count()) weights[static_cast<std::size_t>(side.nodes[a])] += area * point.N[a];
      }
  } else {
    for (const LocalOrdinal node : require_node_set(mesh_, set))
      if (node < mesh_.owned_count()) weights[static_cast<std::size_t>(node)] = 1.0;
  }
  const double all = sum_over_ranks(*mesh_.comm, std::accumulate(weights.begin(), weights.end(), 0.0));
  for (const LocalOrdinal node : require_node_set(mesh_, set))
    if (node < mesh_.owned_count()) link.shares.push_back({node, sign * weights[static_cast<std::size_t>(node)] / all});
}

ConnectorLink LinkMaker::link_of_means(const ConnectorOptions& options) {
  ConnectorLink link;
  link.connector = number_;
  link.is_spread = true;
  link.is_grounded = options.to.value.empty();
  link.counts = mesh_.comm->getRank() == 0;
  add_mean(options.set, link.is_grounded ? 1.0 : -1.0, link);
  if (!link.is_grounded) add_mean(options.to, 1.0, link);
  std::vector<std::pair<GlobalOrdinal, double>> mine;
  for (const ShareOfNode& share : link.shares) mine.emplace_back(mesh_.local_nodes->getGlobalElement(share.node), share.weight);
  const double count = sum_over_ranks(*mesh_.comm, static_cast<double>(mine.size()));
  if (count > static_cast<double>(most_nodes)) {
    diagnostics_.push_back({options.set.place, fmt::format("the ends have {:.0f} nodes together, of which each is coupled with each; at most {} are "
                                                           "allowed; please let the sets follow reference points, and name those",
                                                           count, most_nodes)});
    return link;
  }
  link.all = gathered(mesh_, mine);
  return link;
}

void LinkMaker::add_between(const ConnectorOptions& options) {
  ConnectorLink link = link_of_means(options);
  link.law = law_of_components(options);
  links_.push_back(std::move(link));
}

void LinkMaker::add_axial(const ConnectorOptions& options, const Place& place) {
  ConnectorLink link = link_of_means(options);
  Vector3d mine = Vector3d::Zero(), line;
  double size = 0.0, largest = 0.0;
  for (const ShareOfNode& share : link.shares) {
    const Vector3d X(mesh_.coordinates[static_cast<std::size_t>(share.node)].data());
    mine += share.weight * X;
    size = std::max(size, X.norm());
  }
  Teuchos::reduceAll(*mesh_.comm, Teuchos::REDUCE_SUM, 3, mine.data(), line.data());
  Teuchos::reduceAll(*mesh_.comm, Teuchos::REDUCE_MAX, size, Teuchos::outArg(largest));
  for (std::size_t i = 0; i < options.anchor.size(); ++i) line[static_cast<Eigen::Index>(i)] -= options.anchor[i];
  if (!(line.norm() > no_length * largest))
    diagnostics_.push_back({place, fmt::format("its ends lie at one place, so that the line between them has no direction; please give \"{} x\" and "
                                               "the like",
                                               word_)});
  link.start = line;
  link.law.is_axial = true;
  link.law.axial = *options.axial;
  link.law.rest_length = options.rest_length.value_or(line.norm());
  links_.push_back(std::move(link));
}

void LinkMaker::add_rotation(const ConnectorOptions& options) {
  ConnectorLink link;
  link.connector = number_;
  link.is_spread = true;
  link.is_rotation = true;
  link.is_grounded = options.to.value.empty();
  link.counts = mesh_.comm->getRank() == 0;
  const auto add = [&](const Located<std::string>& name, double sign) {
    const ReferencePoint& point = require_rotating_point(mesh_, name);
    if (point.rotation_node < mesh_.owned_count()) link.shares.push_back({point.rotation_node, sign / point.arm});
    link.all.emplace_back(mesh_.local_nodes->getGlobalElement(point.rotation_node), sign / point.arm);
  };
  add(options.set, link.is_grounded ? 1.0 : -1.0);
  if (!link.is_grounded) add(options.to, 1.0);
  link.law.components[0] = *options.rotational;
  if (mesh_.dimension == 3) link.law.components.setConstant(*options.rotational);
  links_.push_back(std::move(link));
}

}  // namespace mortise
