#include "mortise/nonlinear/system_evaluation.hpp"

#include <stdexcept>

#include "system/system_model.hpp"

namespace mortise {

const detail::EvaluatedSystem& detail::evaluated(const SystemEvaluation& evaluation) { return *evaluation.evaluated_; }

const Vector& SystemEvaluation::x() const { return evaluated_->x; }
const StepContext& SystemEvaluation::context() const { return evaluated_->context; }
const Vector& SystemEvaluation::residual() const { return evaluated_->residual; }
const ResidualNorms& SystemEvaluation::norms() const { return evaluated_->norms; }

const Vector& SystemEvaluation::nodal_forces() const { return evaluated_->forces; }
const Vector& SystemEvaluation::internal_forces() const { return *evaluated_->internal; }
const Vector& SystemEvaluation::external_forces() const { return evaluated_->external; }

const Vector& SystemEvaluation::rate_forces() const {
  if (evaluated_->of_rates.is_null()) throw std::logic_error("SystemEvaluation: rate_forces() of a system without time derivatives");
  return *evaluated_->of_rates;
}

const ContactLaws& SystemEvaluation::contact_laws() const {
  if (!evaluated_->laws) throw std::logic_error("SystemEvaluation: contact_laws() of a system without contact");
  return *evaluated_->laws;
}

RCP<Vector> SystemEvaluation::forces() const {
  if (evaluated_->follow) return evaluated_->follow->support_forces(evaluated_->forces);
  return rcp(new Vector(evaluated_->forces, Teuchos::Copy));
}

}  // namespace mortise
