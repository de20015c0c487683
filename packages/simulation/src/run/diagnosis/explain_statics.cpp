#include "run/diagnosis/explain_statics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mortise/contact/holding_nodes.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/simulation/run/diagnosis/body_motion.hpp"
#include "mortise/simulation/run/diagnosis/contact_hold.hpp"
#include "mortise/simulation/run/diagnosis/contact_statics.hpp"
#include "run/diagnosis/held_bodies.hpp"

namespace mortise {
namespace {

constexpr double rough = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double rests = 1e-6;           ///< resistance() above minus which a node may bear what is borne: bear() knows the motion to 1e-9
constexpr double tilts = 1e-2;           ///< of free_motions(): what a surface's tilts by strains hold along it is next to nothing
constexpr int halvings = 40;             ///< of the interval in which a bound is looked for
constexpr std::size_t most_bodies = 10;  ///< that are looked at together: the rows of the problem are those of their motions

/// Loads and contact of the bodies at one state, in the works on motions that boundary conditions leave.
class BodyStatics {
 public:
  BodyStatics(const Model& model, const SystemEvaluation& evaluation, const std::vector<int>& held)
      : model_(model), mesh_(*model.mesh()), at_(places_at(model, evaluation.x())) {
    const ContactLaws& laws = evaluation.contact_laws();
    find_nodes(held, laws);
    if (bodies_.empty()) return;

    const Eigen::RowVectorXd mine = work_of_residual(model_.space(), *modes_, at_, *model_.supports().fixed, outer_forces(model, evaluation));
    motions_ = free_motions(held_by_supports(model, *modes_, at_), modes_->per_body());
    load_ = -motions_.transpose() * sum(mine).transpose();
    round_off_ = std::max(evaluation.norms().round_off, 100.0 * epsilon * load_.norm());
    for (const BearingNode& node : nodes_) cones_.push_back(cone_of(node));
  }

  /// Of the bodies that were asked for, those that contact reaches.
  bool has_bodies() const { return !bodies_.empty(); }
  bool is_whole() const { return is_whole_; }
  bool is_loaded() const { return load_.norm() > round_off_; }

  /// A load, with the coefficients of friction as they are or without bound.
  BorneLoad bear_with(bool as_rough, const Eigen::VectorXd& load) const {
    if (!as_rough) return bear(*mesh_.comm, cones_, load, round_off_);
    std::vector<BearingCone> cones = cones_;
    for (BearingCone& cone : cones)
      if (cone.along.cols() > 0) cone.friction = rough;
    return bear(*mesh_.comm, cones, load, round_off_);
  }
  const Eigen::VectorXd& load() const { return load_; }

  /// -load lies inside of the cone of all forces, farther than round-off from its boundary. To see that, loads on the corners of a cross around it
  /// are tried: if these are borne, all between are borne as well.
  bool is_borne_with_room() const {
    for (Eigen::Index m = 0; m < load_.size(); ++m)
      for (const double sign : {-4.0, 4.0}) {
        // of a cross of half-width w the inscribed ball has the radius w / sqrt(motions)
        const double width = sign * round_off_ * std::sqrt(static_cast<double>(load_.size()));
        if (bear_with(false, load_ + width * Eigen::VectorXd::Unit(load_.size(), m)).bearing != Bearing::borne) return false;
      }
    return true;
  }

  /// True if each motion is worked on by some force, whatever its sign.
  bool sees_all_motions() const {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(load_.size(), load_.size());
    for (const BearingCone& cone : cones_) {
      gram += cone.push * cone.push.transpose();
      if (cone.friction > 0.0) gram += cone.along * cone.along.transpose();
    }
    return free_motions(sum(gram), static_cast<int>(load_.size())).cols() == 0;
  }

  /// Bodies and what of the motion is at least half as large as the largest of it; of rotations alone if it turns bodies about places at rest.
  std::string names(const Eigen::VectorXd& motion, bool turns = false) const {
    Eigen::VectorXd all = motions_ * motion;
    for (std::size_t b = 0; turns && b < bodies_.size(); ++b)
      all.segment(modes_->per_body() * static_cast<int>(b), modes_->per_body() - modes_->rotations()).setZero();
    return names_of_motion(mesh_, *modes_, all);
  }

  /// The motion without what opens or closes places that bear the load: along them.
  Eigen::VectorXd along_surfaces(const Eigen::VectorXd& motion) const {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(load_.size(), load_.size());
    for (const BearingCone& cone : cones_)
      if (resistance(cone, motion) > -rests) gram += cone.push * cone.push.transpose();
    const Eigen::MatrixXd along = free_motions(sum(gram), static_cast<int>(load_.size()), tilts);
    return along * (along.transpose() * motion);
  }

  /// The largest share s of the load along a motion that is borne together with all of the load across it; none if not even s = 0 is.
  std::optional<double> borne_along(const Eigen::VectorXd& direction) const {
    const double along = load_.dot(direction);
    const auto is_borne = [&](double part) { return bear_with(false, load_ + (part - along) * direction).bearing == Bearing::borne; };
    if (!is_borne(0.0)) return std::nullopt;
    double low = 0.0, high = along;
    for (int halving = 0; halving < halvings; ++halving) (is_borne(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
  }

  /// Of the body that turns most: its rotation, and the places of contact that are at rest meanwhile, or at least stay closed.
  struct Turn {
    double angle = 0.0;  ///< of the motion
    std::string about;
  };
  Turn turn_of(const Eigen::VectorXd& motion) const {
    const Eigen::VectorXd all = motions_ * motion;
    int turning = 0;
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    for (int b = 0; b < static_cast<int>(bodies_.size()); ++b)
      if (const Eigen::Vector3d w = rotation_of(*modes_, all, b); w.norm() * modes_->size(b) > axis.norm() * modes_->size(turning))
        turning = b, axis = w;
    if (!(axis.norm() * modes_->size(turning) > tilts * all.cwiseAbs().maxCoeff())) return {};
    const auto stays_closed = [&](std::size_t i) {
      const auto& on = nodes_[i].normal;
      return resistance(cones_[i], motion) > -rests && std::any_of(on.begin(), on.end(), [&](const auto& wrench) { return wrench.body == turning; });
    };
    const auto is_at_rest = [&](std::size_t i) {
      const Eigen::Vector3d& x = at_.x[nodes_[i].owned_node];
      return resistance(cones_[i], motion) > -rests && std::all_of(nodes_[i].normal.begin(), nodes_[i].normal.end(), [&](const auto& wrench) {
               return motion_at(*modes_, all, wrench.body, modes_->centre(wrench.body), x).norm() <= tilts * all.norm();
             });
    };
    // Along the axis in 3D, else in x.
    const Eigen::Vector3d direction = mesh_.dimension == 3 ? Eigen::Vector3d(axis.normalized()) : Eigen::Vector3d::UnitX();
    std::vector<double> from = end_of(-direction, is_at_rest), to = end_of(direction, is_at_rest);
    if (from.empty()) from = end_of(-direction, stays_closed), to = end_of(direction, stays_closed);
    Turn turn{axis.norm(), {}};
    if (from.empty()) return turn;
    const double least = 1e-9 * modes_->size(turning);
    const auto point = [&](const std::vector<double>& x) {
      const auto shown = [&](int i) { return std::abs(x[i]) < least ? 0.0 : x[i]; };
      return mesh_.dimension == 3 ? fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(0), shown(1), shown(2))
                                  : fmt::format("({:.4g}, {:.4g})", shown(0), shown(1));
    };
    const double length = (Eigen::Vector3d(to.data()) - Eigen::Vector3d(from.data())).norm();
    turn.about = length > least ? fmt::format("from {} to {}", point(from), point(to)) : fmt::format("at {}", point(from));
    return turn;
  }

  bool leaves_all(const Eigen::VectorXd& motion) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const BearingCone& cone : cones_) most = std::max(most, resistance(cone, motion));
    return !(most_over_ranks(*mesh_.comm, most) > -rests);
  }

  /// True if the motion slips at a place with friction that bears the load, by more than strains make of places on an edge that turns.
  bool slips(const Eigen::VectorXd& motion) const {
    int slipping = 0;
    for (const BearingCone& cone : cones_)
      if (cone.along.cols() > 0 && resistance(cone, motion) > -rests &&
          (cone.along.transpose() * motion).norm() > tilts * cone.along.norm() * motion.norm())
        slipping = 1;
    return most_over_ranks(*mesh_.comm, slipping) > 0;
  }

  std::string contacts() const {
    std::vector<int> bear(model_.contact()->pairs(), 0);
    for (const BearingNode& node : nodes_) bear[node.pair] = 1;
    bear = most_over_ranks(*mesh_.comm, bear);
    std::vector<std::string> names;
    for (std::size_t p = 0; p < bear.size(); ++p)
      if (bear[p]) names.push_back(fmt::format("\"{}\"", model_.contact()->pair_name(p)));
    return fmt::format("contact {}", fmt::join(names, ", "));
  }

  std::string bodies() const { return names_of_bodies(mesh_, bodies_); }

 private:
  /// The farthest place of contact in a direction of those that `counts` says; empty if there is none.
  template <class Counts>
  std::vector<double> end_of(const Eigen::Vector3d& direction, const Counts& counts) const {
    double best = -std::numeric_limits<double>::infinity();
    std::vector<double> place(3);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Eigen::Vector3d& x = at_.x[nodes_[i].owned_node];
      if (const double score = direction.dot(x); score > best && counts(i)) best = score, place.assign(x.begin(), x.end());
    }
    return best_offer(*mesh_.comm, best, place, 3);
  }

  /// The nodes that may bear something, and of the bodies those that have any.
  void find_nodes(const std::vector<int>& held, const ContactLaws& laws) {
    const RigidModes all_modes = modes_at(model_, held, at_);
    std::vector<int> reached(held.size(), 0);
    for (const BearingNode& node : bearing_nodes(laws, *contact_places(mesh_, all_modes, at_.x)))
      for (const auto& wrench : node.normal) reached[wrench.body] = 1;
    reached = most_over_ranks(*mesh_.comm, reached);
    for (std::size_t b = 0; b < held.size(); ++b)
      if (reached[b]) bodies_.push_back(held[b]);
    is_whole_ = bodies_.size() == held.size();
    modes_.emplace(modes_at(model_, bodies_, at_));
    nodes_ = bearing_nodes(laws, *contact_places(mesh_, *modes_, at_.x));
  }

  Eigen::VectorXd works(const std::vector<HoldingRow::Wrench>& wrenches) const {
    return motions_.transpose() * work_of(*modes_, wrenches).transpose();
  }

  BearingCone cone_of(const BearingNode& node) const {
    BearingCone cone{-works(node.normal), Eigen::MatrixXd(load_.size(), static_cast<Eigen::Index>(node.along.size())), node.friction};
    for (std::size_t a = 0; a < node.along.size(); ++a) cone.along.col(static_cast<Eigen::Index>(a)) = works(node.along[a]);
    return cone;
  }

  Eigen::MatrixXd sum(const Eigen::MatrixXd& mine) const { return sum_over_ranks(*mesh_.comm, mine); }

  const Model& model_;
  const Mesh& mesh_;
  NodePlaces at_;
  std::vector<int> bodies_;
  bool is_whole_ = false;
  std::optional<RigidModes> modes_;
  std::vector<BearingNode> nodes_;
  std::vector<BearingCone> cones_;  ///< [nodes_]
  Eigen::MatrixXd motions_;         ///< orthonormal columns
  Eigen::VectorXd load_;
  double round_off_ = 0.0;
};

std::string describe_slide(const BodyStatics& statics, const Eigen::VectorXd& motion) {
  Eigen::VectorXd slide = statics.along_surfaces(motion);
  if (slide.isZero(0.0)) slide = motion;
  slide.normalize();
  const std::optional<double> most = statics.borne_along(slide);
  const std::string bound = most ? fmt::format("friction bears at most {:.6g}", *most) : "more than friction bears with any share of it";
  return fmt::format("no equilibrium: friction is used up by body {}, which slides: the load along this motion is {:.6g}, {}", statics.names(slide),
                     statics.load().dot(slide), bound);
}

// The motion that is left says what happens: it leaves all places, slips where the load is borne, turns about places that are at rest, or goes along
// them. A body that slips would not do so on rough surfaces: if these do not bear the load either, their motion is the reason.
std::string describe_fall(const BodyStatics& statics, Eigen::VectorXd motion) {
  if (statics.slips(motion)) {
    const BorneLoad if_rough = statics.bear_with(true, statics.load());
    if (if_rough.bearing == Bearing::borne) return describe_slide(statics, motion);
    if (if_rough.bearing == Bearing::not_borne) motion = if_rough.missing;
  }
  const double load = motion.norm();
  if (statics.leaves_all(motion))
    return fmt::format("no equilibrium: body {} is lifted off: a load of {:.6g} pulls it away from {}, which only pushes", statics.names(motion),
                       load, statics.contacts());
  if (const auto turn = statics.turn_of(motion); turn.angle > 0.0)
    return fmt::format(
        "no equilibrium: body {} tips over about its contact {}: the load turns it with a moment of {:.6g}, and no force of {} turns it back",
        statics.names(motion, true), turn.about, load * load / turn.angle, statics.contacts());
  return fmt::format("no equilibrium: body {} is not held along this motion: the load on it is {:.6g}, and no force of {} acts against it",
                     statics.names(motion), load, statics.contacts());
}

StaticsReason judge(const BodyStatics& statics) {
  if (!statics.has_bodies() || !statics.is_loaded()) return {};
  const BorneLoad borne = statics.bear_with(false, statics.load());
  if (borne.bearing == Bearing::not_borne) return {StaticsVerdict::falls, describe_fall(statics, borne.missing)};
  if (!statics.is_whole() || !statics.sees_all_motions()) return {};
  if (borne.bearing == Bearing::borne && statics.is_borne_with_room())
    return {StaticsVerdict::held,
            fmt::format("by statics {} can bear the load of {}: as rigid bodies they would be at rest", statics.contacts(), statics.bodies())};
  return {StaticsVerdict::marginal, fmt::format("the load of {} is at the limit of what {} bears: the difference is below round-off, so that statics "
                                                "does not tell whether there is an equilibrium",
                                                statics.bodies(), statics.contacts())};
}

}  // namespace

StaticsReason explain_statics(const Model& model, const SemiSmoothSystem& system, const Vector& x, const StepContext& context) {
  const std::vector<int> held = bodies_held_by_contact_only(model);
  if (held.empty() || held.size() > most_bodies || without_turning_points(*model.mesh(), held).size() < held.size()) return {};
  try {
    return judge(BodyStatics(model, system.evaluate(x, context), held));
  } catch (const StepFailure&) {  // on every rank: no state to judge by
    return {};
  }
}

}  // namespace mortise
