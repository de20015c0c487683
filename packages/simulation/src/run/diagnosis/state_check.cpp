#include "run/diagnosis/state_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "model/rigid_mode_names.hpp"
#include "run/diagnosis/explain_statics.hpp"

namespace mortise {
namespace {

constexpr double allowance = 2.0;  // see StateCheck::verify()

double size_of(const RigidModes& modes, const Eigen::VectorXd& motion, int b) {
  return motion.segment(modes.per_body() * b, modes.per_body()).norm();
}

/// "translation in y by 1.95, rotation by 30 degrees": what is at least half as far as the largest.
std::string describe_motion(const RigidModes& modes, const Eigen::VectorXd& motion, int b) {
  const Eigen::VectorXd own = motion.segment(modes.per_body() * b, modes.per_body());
  const int translations = modes.per_body() - modes.rotations();
  std::vector<std::string> parts;
  for (int m = 0; m < modes.per_body(); ++m) {
    if (std::abs(own[m]) < 0.5 * own.cwiseAbs().maxCoeff()) continue;
    const double degrees = 360.0 / M_PI * std::atan(0.5 * own[m] / modes.size(b));
    parts.push_back(m < translations ? fmt::format("{} by {:.3g}", modes.name(m), own[m])
                                     : fmt::format("{} by {:.3g} degrees", modes.name(m), degrees));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

bool StateCheck::is_needed(const Model& model) { return model.contact() && !bodies_held_by_contact_only(model).empty(); }

StateCheck::StateCheck(const Model& model, double resolution, Timers timers, std::function<void(const std::string&)> warn)
    : model_(model), resolution_(resolution), timers_(std::move(timers)), warn_(std::move(warn)), bodies_(bodies_held_by_contact_only(model)) {}

RCP<Vector> StateCheck::verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) {
  const auto timer = timers_.scope("state check");
  try {
    return examine(system, *from.x, found, round);
  } catch (const StepFailure& far) {  // on every rank
    const StaticsReason statics = explain_statics(model_, system, *from.x, found.context());
    if (statics.words.empty()) throw;
    throw StepFailure(far.kind(), fmt::format("{}; the state that was found is too far away: {}", statics.words, far.what()));
  }
}

RCP<Vector> StateCheck::examine(const SemiSmoothSystem& system, const Vector& before, const SystemEvaluation& found, int round) {
  const Mesh& mesh = *model_.mesh();
  const NodePlaces from = places_at(model_, before), to = places_at(model_, found.x());
  auto modes = std::make_unique<RigidModes>(modes_at(model_, bodies_, to));
  const ContactHold hold = contact_hold(model_, *modes, to, found.contact_laws());
  const Eigen::MatrixXd gram = held_by_supports(model_, *modes, to) + hold.gram;

  const Eigen::MatrixXd free = free_motions(gram, modes->per_body());
  const BodyMotions motions = body_motions(model_.space(), *modes, from, to, model_.supports());
  const auto along = [&](const Eigen::MatrixXd& directions) { return Eigen::VectorXd(directions * (directions.transpose() * motions.rigid)); };
  const Eigen::VectorXd freely = along(free), formerly = free_before_.cols() > 0 ? along(free_before_) : freely;
  const Eigen::VectorXd loosely = formerly.norm() > freely.norm() ? formerly : freely, held = motions.rigid - loosely;

  const double deformation = *std::max_element(motions.deformation.begin(), motions.deformation.end());
  std::vector<std::string> gone;
  std::vector<int> which;
  std::vector<char> touches(bodies_.size(), 1);
  went_far_ = false;
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    double moved = motions.imposed;
    for (int other = 0; other < static_cast<int>(bodies_.size()); ++other)
      if (other != b) moved = std::max(moved, size_of(*modes, held, other));
    // A body that touched nothing when the step began and touches nothing now stays where it was, unless it has to go out of the way.
    touches[b] = !gram.middleRows(b * modes->per_body(), modes->per_body()).isZero(0.0);
    const bool stays = round == 1 && !touches[b] && !touches_before_.empty() && !touches_before_[b];
    const double around = stays ? motions.deformation[b] : moved + deformation;
    const double allowed = allowance * (around + resolution_), length = model_.parts().length;
    went_far_ = went_far_ || size_of(*modes, motions.rigid, b) > allowed;
    const bool is_flight = size_of(*modes, motions.rigid, b) > std::max(allowed, length);
    // A body that has just been let go was carried that far at most: its centre has no rim that goes farther.
    const bool is_let_go = !touches[b] && !touches_before_.empty() && touches_before_[b];
    const double centre = loosely.segment(b * modes->per_body(), modes->per_body() - modes->rotations()).norm();
    const bool is_shot = is_let_go && centre > around + allowance * resolution_;
    if (size_of(*modes, loosely, b) <= allowed && !is_flight && !is_shot) continue;
    gone.push_back(fmt::format("body '{}' ({}; allowed: {:.3g}, twice what moves and deforms around it)", mesh.bodies[bodies_[b]].name,
                               describe_motion(*modes, is_flight ? motions.rigid : loosely, b), allowed));
    which.push_back(bodies_[b]);
  }
  if (!gone.empty()) {
    refused_ = fmt::format("free to move: {}; {}", fmt::join(gone, ", "), record_.describe(model_, which, hold.pairs));
    if (round > 1 || loosely.isZero(0.0))
      throw StepFailure(FailureKind::lost_contact,
                        refused_ +
                            ". Between two states at rest that are that far apart there is motion with inertia: hold the body in this direction, "
                            "by a boundary condition or by friction, or end before");
    NodePlaces half_way = to;
    for (std::size_t node = 0; node < to.x.size(); ++node) half_way.x[node] = 0.5 * (from.x[node] + to.x[node]);
    const auto start = rcp(new Vector(found.x(), Teuchos::Copy));
    move_bodies(model_.space(), *modes, loosely, motions.middle, half_way, -1.0, *system.unknowns(*start));
    warn_(fmt::format("  {}. Put back, and solved again from there", refused_));
    return start;
  }

  pairs_ = hold.pairs;
  touches_ = touches;
  free_ = free;
  freely_ = freely;
  middle_ = motions.middle;
  modes_ = std::move(modes);
  say_new(*modes_, free, motions);
  return Teuchos::null;
}

void StateCheck::say_new(const RigidModes& modes, const Eigen::MatrixXd& free, const BodyMotions& motions) {
  if (free.cols() == 0) return;
  std::vector<std::vector<const char*>> names(bodies_.size());
  for (const auto& [b, mode] : distinct_modes(free, modes.per_body()))
    if (said_.insert({b, mode}).second) names[b].push_back(modes.name(mode));
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    if (names[b].empty()) continue;
    const double far = size_of(modes, freely_, b);
    const bool turns = size_of(modes, freely_, b) > 2.0 * motion_at(modes, freely_, b, motions.middle[b], motions.middle[b]).norm();
    const std::string does =
        far <= allowance * resolution_ ? "is at rest" : fmt::format("{} ({})", turns ? "spins" : "is carried", describe_motion(modes, freely_, b));
    warn_(fmt::format("  body '{}' is free to move ({}) and {}; {}", model_.mesh()->bodies[bodies_[b]].name, fmt::join(names[b], ", "), does,
                      record_.describe(model_, {bodies_[b]}, pairs_)));
  }
}

void StateCheck::accept(const SemiSmoothSystem&, const SystemEvaluation&) {
  record_.accept(pairs_);
  free_before_ = free_;
  touches_before_ = touches_;
}

void StateCheck::predict(const SemiSmoothSystem& system, const Vector& x, double dt, Vector& rate) {
  if (!modes_ || freely_.isZero(0.0)) return;
  const Mesh& mesh = *model_.mesh();
  NodePlaces half_way = places_at(model_, x);
  const RCP<Vector> velocity = system.unknowns(rate);
  {
    const auto v = velocity->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      for (int i = 0; i < mesh.dimension; ++i) half_way.x[node][i] -= 0.5 * dt * v(model_.space().row(node, i), 0);
  }
  move_bodies(model_.space(), *modes_, freely_, middle_, half_way, -1.0 / dt, *velocity);
}

void StateCheck::serialize(StateArchive& archive) {
  std::vector<double> free(free_before_.data(), free_before_.data() + free_before_.size());
  mortise::serialize(archive, "state_check.free", free);
  Eigen::Index rows = free_before_.rows();
  mortise::serialize(archive, "state_check.rows", rows);
  archive.refuse_if(rows >= 0 ? std::nullopt : std::optional(fmt::format("\"state_check.rows\" is {}; there cannot be fewer than 0", rows)));
  std::vector<int> said;
  mortise::serialize(archive, "state_check.touches", touches_before_);
  for (const auto& [body, mode] : said_) said.insert(said.end(), {body, mode});
  mortise::serialize(archive, "state_check.said", said);
  record_.serialize(archive);
  if (!archive.restores()) return;
  free_before_ = Eigen::Map<const Eigen::MatrixXd>(free.data(), rows, rows > 0 ? static_cast<Eigen::Index>(free.size()) / rows : 0);
  said_.clear();
  for (std::size_t n = 0; n + 1 < said.size(); n += 2) said_.insert({said[n], said[n + 1]});
}

}  // namespace mortise
