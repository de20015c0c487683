#include "run/diagnosis/start_rule.hpp"

#include <fmt/format.h>

#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <utility>

#include "mortise/contact/holding_nodes.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/simulation/run/diagnosis/contact_hold.hpp"
#include "run/diagnosis/free_bodies.hpp"

namespace mortise {
namespace {

constexpr double tilted_normals = 1e-4;  ///< of free_motions(): what contact normals that turn with the loads seem to hold
constexpr double works_against = 1e-3;   ///< share of a motion that closes a gap, below which a node does not hinder it
constexpr double as_near = 1.0 + 1e-6;   ///< nodes that are as near but for round-off close together
constexpr double no_way = std::numeric_limits<double>::max();

/// Motion that a node hinders.
struct Hindrance {
  int group = -1;       ///< -1: nothing
  bool slides = false;  ///< the motion comes from without the cone of friction: a node that stuck would not let it come
  double way = no_way;  ///< distance that the bodies of the group may move until the node bears pressure
};

/// The groups that bear a load, and the motion that it drives each of them along: v = V V^T f. The body that moves most in it moves by 1.
struct DrivenBodies {
  DrivenBodies(const std::vector<FreeGroup>& groups, int per_body, std::size_t bodies) : group_of(bodies, -1), motion_of(bodies) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!groups[g].is_loaded()) continue;
      Eigen::VectorXd motion = groups[g].motions * groups[g].load;
      motion /= Eigen::Map<const Eigen::MatrixXd>(motion.data(), per_body, motion.size() / per_body).colwise().norm().maxCoeff();
      for (std::size_t i = 0; i < groups[g].bodies.size(); ++i) {
        group_of[groups[g].bodies[i]] = static_cast<int>(g);
        motion_of[groups[g].bodies[i]] = motion.segment(per_body * static_cast<Eigen::Index>(i), per_body);
      }
    }
  }

  bool any() const {
    return std::any_of(group_of.begin(), group_of.end(), [](int group) { return group >= 0; });
  }

  /// A pressure acts on bodies as the negative of BearingNode::normal. Its work on v over its force is the share of v that closes the gap.
  Hindrance hindered_by(const BearingNode& node, const RigidModes& modes) const {
    Hindrance hindrance;
    const auto work_over_force = [&](const std::vector<HoldingRow::Wrench>& wrenches) {
      double work = 0.0, largest = 0.0;
      for (const auto& wrench : wrenches) {
        const Eigen::Vector3d force(wrench.force.data());
        largest = std::max(largest, force.norm());
        if (group_of[wrench.body] < 0) continue;
        hindrance.group = group_of[wrench.body];
        work += modes.works_of_wrench(force, Eigen::Vector3d(wrench.moment.data())).dot(motion_of[wrench.body]);
      }
      return largest > 0.0 ? work / largest : 0.0;
    };
    const double closes = work_over_force(node.normal);
    if (!(closes > works_against)) return {};
    hindrance.way = node.gap / closes;
    double along = 0.0;
    for (const auto& tangent : node.along) along = std::hypot(along, work_over_force(tangent));
    hindrance.slides = along > node.friction * closes;
    return hindrance;
  }

  std::vector<int> group_of;               ///< [bodies] -1: no load drives it
  std::vector<Eigen::VectorXd> motion_of;  ///< [bodies]
};

Eigen::Index count_of_motions(const std::vector<FreeGroup>& groups) {
  Eigen::Index count = 0;
  for (const FreeGroup& group : groups) count += group.motions.cols();
  return count;
}

/// Of one pair, what started closed.
struct ClosedNodes {
  int count = 0;
  double farthest = 0.0;  ///< gap
  std::string why;
};

}  // namespace

StartRule::StartRule(const Model& model, std::vector<int> bodies, double momentum_tolerance, std::function<void(const std::string&)> say)
    : model_(model), bodies_(std::move(bodies)), tolerance_(momentum_tolerance), say_(std::move(say)) {}

// Once the nearest nodes that hinder the motion are closed, less is free: again, until nothing is that bears a load, or nothing hinders it.
RCP<Vector> StartRule::close(const SemiSmoothSystem& system, const SystemEvaluation& start) {
  FreeBodies free(model_, start, bodies_, tolerance_);
  const RigidModes& modes = free.modes();
  const int n = modes.per_body();
  std::vector<FreeGroup> groups = free.groups(free.held(), tilted_normals);
  std::optional<DrivenBodies> driven(std::in_place, groups, n, modes.bodies().size());
  if (!driven->any()) return Teuchos::null;

  const Communicator& comm = *model_.mesh()->comm;
  std::vector<BearingNode> open = bearing_nodes(start.contact_laws(), *contact_places(*model_.mesh(), modes, free.places()), OpenNodes::covered);
  open.erase(std::remove_if(open.begin(), open.end(), [](const BearingNode& node) { return node.closed; }), open.end());

  Eigen::MatrixXd held = free.held(), by_normals = held;
  std::vector<std::pair<BearingNode, bool>> started;  // and whether it slides
  const auto z = rcp(new Vector(*system.multipliers(start.x()), Teuchos::Copy));
  std::vector<ClosedNodes> closed(model_.contact()->pairs());
  while (driven->any()) {
    std::vector<double> nearest(groups.size(), no_way);
    for (const BearingNode& node : open)
      if (const Hindrance hindrance = driven->hindered_by(node, modes); hindrance.group >= 0)
        nearest[hindrance.group] = std::min(nearest[hindrance.group], hindrance.way);
    nearest = least_over_ranks(comm, nearest);
    if (std::all_of(nearest.begin(), nearest.end(), [](double way) { return way == no_way; })) break;

    const auto squared = static_cast<std::size_t>(modes.count() * modes.count());
    std::vector<double> works(2 * squared, 0.0), gaps(closed.size(), 0.0);  // of normals, then of tangents
    std::vector<int> counts(closed.size(), 0), of_group(closed.size(), -1);
    const auto gram_of = [&](std::size_t which) { return Eigen::Map<Eigen::MatrixXd>(&works[which * squared], modes.count(), modes.count()); };
    open.erase(std::remove_if(open.begin(), open.end(),
                              [&](const BearingNode& node) {
                                const Hindrance hindrance = driven->hindered_by(node, modes);
                                if (hindrance.group < 0 || hindrance.way > std::max(node.near, as_near * nearest[hindrance.group])) return false;
                                guess_closed(start.contact_laws(), node, *z);
                                add_squared_work(modes, node.normal, gram_of(0));
                                for (const auto& along : node.along) add_squared_work(modes, along, gram_of(1));
                                started.emplace_back(node, hindrance.slides);
                                ++counts[node.pair];
                                gaps[node.pair] = std::max(gaps[node.pair], node.gap);
                                of_group[node.pair] = std::max(of_group[node.pair], hindrance.group);
                                return true;
                              }),
               open.end());
    works = sum_over_ranks(comm, works);
    counts = sum_over_ranks(comm, counts);
    gaps = most_over_ranks(comm, gaps);
    of_group = most_over_ranks(comm, of_group);
    for (std::size_t p = 0; p < closed.size(); ++p) {
      if (of_group[p] < 0) continue;
      const FreeGroup& group = groups[of_group[p]];
      closed[p].count += counts[p];
      closed[p].farthest = std::max(closed[p].farthest, gaps[p]);
      if (closed[p].why.empty())
        closed[p].why = fmt::format("{}, where a load of {:.3g} acts", names_of(model_, modes, group, group.motions * group.load), group.load.norm());
    }
    by_normals += gram_of(0);
    held += gram_of(0) + gram_of(1);
    groups = free.groups(held, tilted_normals);
    driven.emplace(groups, n, modes.bodies().size());
  }
  // Friction that holds nothing yet would keep the bodies from coming along the surfaces. A motion that it alone can hold it has to hold from the
  // first iterate on.
  if (count_of_motions(free.groups(by_normals, tilted_normals)) == count_of_motions(groups))
    for (const auto& [node, slides] : started) guess_closed(start.contact_laws(), node, *z, slides && node.gap > 0.0);
  bool any = false;
  for (std::size_t p = 0; p < closed.size(); ++p) {
    if (closed[p].count == 0) continue;
    any = true;
    say_(fmt::format("  contact \"{}\" starts with {} nodes closed that are up to {:.3g} away: nothing else holds body {}",
                     model_.contact()->pair_name(p), closed[p].count, closed[p].farthest, closed[p].why));
  }
  return any ? z : Teuchos::null;
}

}  // namespace mortise
