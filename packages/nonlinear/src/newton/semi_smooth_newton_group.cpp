#include "newton/semi_smooth_newton_group.hpp"

#include <Thyra_TpetraThyraWrappers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>

namespace mortise::detail {
namespace {

/// Share of the closed nodes of which the states may still change where the geometric stiffness of contact is worth having.
constexpr double settled = 0.25;

using Extraction = ::Thyra::TpetraOperatorVectorExtraction<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;

RCP<NOX::Thyra::Vector> cloned(const NOX::Thyra::Vector& vector, NOX::CopyType type) {
  return Teuchos::rcp_dynamic_cast<NOX::Thyra::Vector>(vector.clone(type), true);
}

}  // namespace

RCP<Vector> tpetra_vector(NOX::Abstract::Vector& vector) {
  return Extraction::getTpetraVector(Teuchos::dyn_cast<NOX::Thyra::Vector>(vector).getThyraRCPVector());
}

RCP<const Vector> tpetra_vector(const NOX::Abstract::Vector& vector) {
  return Extraction::getConstTpetraVector(Teuchos::dyn_cast<const NOX::Thyra::Vector>(vector).getThyraRCPVector());
}

NOX::Thyra::Vector nox_vector(const RCP<Vector>& vector) {
  const auto space = ::Thyra::createVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(vector->getMap());
  return NOX::Thyra::Vector(::Thyra::createVector<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(vector, space));
}

SemiSmoothNewtonGroup::SemiSmoothNewtonGroup(const SemiSmoothSystem& system, SystemEvaluation start, const StepControl& control)
    : system_(&system),
      shared_(std::make_shared<Shared>()),
      number_(shared_->next++),
      x_(rcp(new NOX::Thyra::Vector(nox_vector(rcp(new Vector(start.x(), Teuchos::Copy)))))),
      F_(cloned(*x_, NOX::ShapeCopy)),
      newton_(cloned(*x_, NOX::ShapeCopy)),
      evaluation_(std::move(start)) {
  shared_->control = control;
  shared_->context = evaluation_->context();
}

SemiSmoothNewtonGroup::SemiSmoothNewtonGroup(const SemiSmoothNewtonGroup& other, NOX::CopyType type)
    : system_(other.system_),
      shared_(other.shared_),
      number_(shared_->next++),
      x_(cloned(*other.x_, NOX::ShapeCopy)),
      F_(cloned(*other.F_, NOX::ShapeCopy)),
      newton_(cloned(*other.newton_, NOX::ShapeCopy)) {
  if (type == NOX::DeepCopy) *this = static_cast<const NOX::Abstract::Group&>(other);
}

NOX::Abstract::Group& SemiSmoothNewtonGroup::operator=(const NOX::Abstract::Group& other) {
  const auto& from = dynamic_cast<const SemiSmoothNewtonGroup&>(other);
  if (&from == this) return *this;
  number_ = from.number_;
  evaluation_.reset();
  *x_ = *from.x_;
  has_F_ = from.has_F_;
  has_newton_ = from.has_newton_;
  starts_elsewhere_ = from.starts_elsewhere_;
  if (has_F_) *F_ = *from.F_;
  if (has_newton_) *newton_ = *from.newton_;
  increment_ = from.increment_;
  step_length_ = from.step_length_;
  shortened_ = from.shortened_;
  norms_ = from.norms_;
  linear_solve_ = from.linear_solve_;
  newton_solve_ = from.newton_solve_;
  failure_ = from.failure_;
  return *this;
}

RCP<NOX::Abstract::Group> SemiSmoothNewtonGroup::clone(NOX::CopyType type) const { return rcp(new SemiSmoothNewtonGroup(*this, type)); }

void SemiSmoothNewtonGroup::become_new_iterate() {
  number_ = shared_->next++;
  has_F_ = has_newton_ = starts_elsewhere_ = false;
  evaluation_.reset();
  increment_ = -1.0;
  step_length_ = shortened_ = 1.0;
  linear_solve_ = {};
  failure_.reset();
}

void SemiSmoothNewtonGroup::setX(const NOX::Abstract::Vector& y) {
  become_new_iterate();
  *x_ = y;
}

void SemiSmoothNewtonGroup::computeX(const NOX::Abstract::Group& group, const NOX::Abstract::Vector& direction, double step) {
  const auto& from = dynamic_cast<const SemiSmoothNewtonGroup&>(group);
  const LinearSolveReport solve = from.newton_solve_;
  const double shortened = from.shortened_;
  become_new_iterate();
  x_->update(1.0, *from.x_, step, direction);
  increment_ = step * system_->largest_unknown(*tpetra_vector(direction));
  step_length_ = step * shortened;
  linear_solve_ = solve;
}

NOX::Abstract::Group::ReturnType SemiSmoothNewtonGroup::computeF() {
  if (has_F_) return Ok;
  try {
    norms_ = evaluation().norms();
    Tpetra::deep_copy(*tpetra_vector(*F_), evaluation_->residual());
  } catch (const StepFailure& failure) {  // on every rank
    if (!shared_->control.trial || increment_ < 0.0) throw;
    failure_ = failure;
    norms_ = {};
    norms_.finite = false;
    norms_.merit = std::numeric_limits<double>::infinity();
  }
  has_F_ = true;
  return Ok;
}

const SystemEvaluation& SemiSmoothNewtonGroup::evaluation() {
  // Nothing has converged as long as corrections are large.
  const auto stiffness = increment_ > shared_->control.increment_tolerance ? StiffnessIs::needed_next : StiffnessIs::not_known_to_be_needed;
  if (!evaluation_) evaluation_ = system_->evaluate(*tpetra_vector(static_cast<const NOX::Abstract::Vector&>(*x_)), shared_->context, stiffness);
  if (auto followed = has_F_ ? std::nullopt : system_->follow_cover(*evaluation_)) {
    evaluation_ = std::move(followed);
    Tpetra::deep_copy(*tpetra_vector(*x_), evaluation_->x());
  }
  return *evaluation_;
}

const SystemLinearisation& SemiSmoothNewtonGroup::linearise(const SystemEvaluation& at) {
  shared_->jacobian_of = 0;
  shared_->linearised.reset();
  shared_->jacobian.reset();
  if (system_->parts().contact) shared_->context.states = at.contact_laws().states();
  shared_->jacobian = system_->linearise(at);
  shared_->linearised = LinearisedIterate{rcp(new Vector(at.x(), Teuchos::Copy)), shared_->context};
  return *shared_->jacobian;
}

NOX::Abstract::Group::ReturnType SemiSmoothNewtonGroup::computeJacobian() {
  if (isJacobian()) return Ok;
  linearise(evaluation());
  shared_->jacobian_of = number_;
  return Ok;
}

// `forcing`: the forcing term of Eisenstat and Walker. A tenth of what Newton's own test asks for is enough, whatever the forcing term is.
double SemiSmoothNewtonGroup::linear_tolerance(double forcing) const {
  const auto tolerances = system_->parts().linear_solver->tolerances();
  if (!tolerances) return 0.0;
  const double sufficient = 0.1 * shared_->control.momentum_tolerance / std::max(norms_.momentum, shared_->control.momentum_tolerance);
  return std::clamp(std::max(forcing, sufficient), tolerances->least, tolerances->largest);
}

// Where geometry does not change, the next multipliers follow from the states of the nodes, whatever the last ones are. As long as the states are
// wrong the last ones may be a thousand times too large, and so would be their geometric stiffness. So this stiffness has to wait for the states to
// settle.
NOX::Abstract::Group::ReturnType SemiSmoothNewtonGroup::computeNewton(Teuchos::ParameterList& list) {
  if (has_newton_) return Ok;
  if (!has_F_ || !isJacobian()) return BadDependency;
  const double tolerance = linear_tolerance(list.get("Tolerance", 0.0));
  const auto geometric_stiffness =
      norms_.changed <= settled * norms_.active ? GeometricContactStiffness::included : GeometricContactStiffness::left_out;
  const RCP<Vector> direction = tpetra_vector(*newton_);
  const bool moves = shared_->context.field.value_or(0) == 0;  // else all displacements stay
  const auto& better_start = system_->parts().better_start;
  const auto held_at = [&](const SystemEvaluation& at) {
    const auto& held_motions = system_->parts().held_motions;
    return held_motions && moves ? held_motions(at) : std::nullopt;
  };
  const SystemEvaluation here = shared_->jacobian->evaluation();
  if (const RCP<Vector> start = better_start && moves ? better_start(here) : Teuchos::null; !start.is_null()) {
    // x + direction is where Newton's method gets to from there.
    starts_elsewhere_ = true;
    const SystemEvaluation there = system_->evaluate(*start, shared_->context, StiffnessIs::needed_next);
    const SystemLinearisation& at_start = linearise(there);
    const std::optional<HeldMotions> held = held_at(there);
    newton_solve_ = at_start.newton_direction(there.residual(), *direction, tolerance, geometric_stiffness, held ? &*held : nullptr);
    direction->update(1.0, *start, -1.0, here.x(), 1.0);
  } else {
    const std::optional<HeldMotions> held = held_at(here);
    newton_solve_ = shared_->jacobian->newton_direction(here.residual(), *direction, tolerance, geometric_stiffness, held ? &*held : nullptr);
  }
  shared_->jacobian.reset();  // contact at an iterate takes memory
  shortened_ = 1.0;
  if (const auto& limit = shared_->control.largest_increment) {
    const double increment = system_->largest_unknown(*tpetra_vector(static_cast<const NOX::Abstract::Vector&>(*newton_)));
    if (increment > *limit) {
      shortened_ = *limit / increment;
      newton_->scale(shortened_);
    }
  }
  has_newton_ = true;
  return Ok;
}

const NOX::Abstract::Vector& SemiSmoothNewtonGroup::getGradient() const { throw std::logic_error("a semi-smooth residual has no gradient"); }

}  // namespace mortise::detail
