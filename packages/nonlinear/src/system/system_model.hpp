#pragma once
// Common data of the evaluations of a system: its parts, and buffers that have no influence on any value.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/core/timers.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "system/constraints.hpp"
#include "system/field_sizes.hpp"
#include "system/reduction.hpp"
#include "system/saddle_point_matrix.hpp"

namespace mortise::detail {

class SystemModel;

/// F at one x, and what it was summed from.
struct EvaluatedSystem {
  Vector x;
  RCP<const Vector> d, z;  ///< views into x
  StepContext context;
  RCP<const Vector> internal;                      ///< f_int at d
  Vector external;                                 ///< -f_ext at d
  RCP<const Vector> of_rates;                      ///< forces of contributions with time derivatives; null without
  RCP<const Vector> of_contact;                    ///< what contact contributions give; null without
  std::optional<DifferentiatedContact> contact;    ///< none without contact
  std::optional<ContactLaws> laws;                 ///< contact conditions; none without contact
  std::shared_ptr<const FollowedUnknowns> follow;  ///< null: nothing follows
  Vector forces;                                   ///< their sum on all dofs, those of followers not gathered
  Vector residual;
  ResidualNorms norms;
};

/// Parts of an evaluation that are known before it is made.
struct AtHand {
  RCP<const Vector> internal;                    ///< null: nothing
  std::optional<DifferentiatedContact> contact;  ///< of the same displacement and history
};

/// The parts of a system and what follows from them. Collective in all members but the views.
class SystemModel {
 public:
  SystemModel(SystemParts parts, Timers timers);

  const SystemParts& parts() const { return parts_; }
  const Timers& timers() const { return timers_; }
  const RCP<const Map>& map() const { return map_; }
  const RCP<const Map>& multipliers() const { return multipliers_; }
  const Communicator& comm() const { return *parts_.dofs->getComm(); }
  const std::vector<LocalOrdinal>& prescribed() const { return prescribed_; }  ///< owned dofs
  const Reduction* reduction() const { return reduction_.get(); }              ///< null: nothing follows
  const std::shared_ptr<const Reduction>& shared_reduction() const { return reduction_; }
  const FieldSizes& sizes() const { return sizes_; }
  /// s of a field; 0: not known yet.
  double stiffness_scale(std::size_t field = 0) const { return stiffness_scales_[field]; }
  /// s of the field of an owned dof.
  double stiffness_scale_of(LocalOrdinal dof) const { return stiffness_scales_[sizes_.field(dof)]; }
  /// Mean diagonal of the Jacobian in a step: that of forces, and that of inertia, which changes with the length of the step.
  double diagonal_scale(std::size_t field, const TimeStep* step) const;
  /// Of a residual of a field, in units of the first: residuals that changes by the fields' sizes bring about are alike.
  double weight(std::size_t field) const;
  /// The fields of the owned dofs, with their weights.
  FieldsOfRows field_rows() const;
  SaddlePointMatrix& saddle_point() const { return *saddle_point_; }  ///< with a contact that keeps multipliers
  Constraints& constraints() const { return constraints_; }

  RCP<const Vector> d(const Vector& x) const { return x.offsetView(parts_.dofs, 0); }
  RCP<Vector> d(Vector& x) const { return x.offsetViewNonConst(parts_.dofs, 0); }
  RCP<const Vector> z(const Vector& x) const { return x.offsetView(multipliers_, local_id_count(*parts_.dofs)); }
  RCP<Vector> z(Vector& x) const { return x.offsetViewNonConst(multipliers_, local_id_count(*parts_.dofs)); }

  /// True if internal forces at the end of a step differ from those at the start of the next one.
  bool depends_on_time() const;

  /// Stores or restores stiffness scales and the histories of the contributions.
  void serialize(StateArchive& archive) const;

  /// Unknowns with their ghosts. The buffer is that of the next call too.
  Configuration configuration(double time, const Vector& unknowns) const;
  /// The same with the rates of a step, if there is one.
  Configuration configuration(double time, const Vector& unknowns, const TimeStep* step) const;
  /// The same with rates on the owned dofs.
  Configuration configuration(double time, const Vector& unknowns, BlendedRates rates) const;
  /// An evaluation of which x and the context are known.
  std::shared_ptr<EvaluatedSystem> begin_evaluation(const Vector& x, const StepContext& context) const;
  /// Forces of contributions at `at`, and their sum.
  /// @param stiffness  null, or an open matrix to which the stiffness of internal forces is added with them
  void add_forces(EvaluatedSystem& at, Matrix* stiffness = nullptr) const;

  std::shared_ptr<const EvaluatedSystem> evaluate(const Vector& x, const StepContext& context, AtHand at_hand,
                                                  StiffnessIs stiffness = StiffnessIs::not_known_to_be_needed) const;

  /// K of an evaluation, assembled unless it is at hand. Filled.
  const RCP<Matrix>& stiffness(const std::shared_ptr<const EvaluatedSystem>& at) const;
  /// K of an evaluation, open, to be made into something else: then it is not at hand any more.
  RCP<Matrix> take_stiffness(const std::shared_ptr<const EvaluatedSystem>& at) const;

  /// Sums of the derivatives of all contact contributions; null: there are none. Collective.
  ContactContribution::Derivatives derivatives_of_contact_contributions(const EvaluatedSystem& at, const ContactLinearisation& linearised) const;

  /// Histories have changed: what is at hand is of states that are no more.
  void forget_stiffness() const {
    matrix_of_.reset();
    internal_forces_of_matrix_ = Teuchos::null;
  }

 private:
  /// Throws std::invalid_argument for contributions that know what the system has not.
  void check_contributions() const;
  void add_norms(EvaluatedSystem& at) const;
  /// Of an evaluation whose contact is known.
  void add_contact_contributions(EvaluatedSystem& at) const;
  /// What the matrix of an evaluation has to hold, whose contact is known.
  RCP<const Graph> graph_of(const EvaluatedSystem& at) const;
  /// The matrix, open and 0.
  void open_matrix(const RCP<const Graph>& graph) const;
  /// Puts what the matrix holds of internal forces into one with another graph.
  void widen_matrix(const RCP<const Graph>& graph) const;
  /// Jacobians of all contributions, or of those that the matrix does not hold yet.
  void add_jacobians(const EvaluatedSystem& at, bool with_internal, std::optional<StepFailure>& failure) const;
  JacobianWeights weights_of_forces(const TimeStep* step) const;
  /// Bound on |x| of all positions x, of a system of several fields; 0 with one, for which nothing is counted. Collective at the first call.
  double position_norm() const;
  /// Mean |diagonal| of the matrix, of each field. Collective.
  std::vector<double> scales_of_diagonal() const;

  SystemParts parts_;
  FieldSizes sizes_;
  Timers timers_;
  RCP<const Map> map_, multipliers_;
  std::vector<LocalOrdinal> prescribed_;
  std::shared_ptr<const Reduction> reduction_;
  std::unique_ptr<SaddlePointMatrix> saddle_point_;
  Import to_local_;
  mutable Constraints constraints_;
  /// Rates of a step, on owned dofs and with ghosts.
  struct RateBuffers {
    BlendedRates of_dofs;
    RCP<Vector> local_velocity, local_acceleration, local_shares;
  };

  mutable Vector local_unknowns_;
  mutable RateBuffers rates_;  ///< null in a system without time derivatives
  mutable std::optional<double> position_norm_;
  mutable std::vector<double> stiffness_scales_;             ///< [fields]
  mutable std::vector<double> static_scales_, mass_scales_;  ///< [fields] of the first Jacobian; empty in a system without time derivatives
  mutable RCP<Matrix> matrix_;
  mutable std::weak_ptr<const EvaluatedSystem> matrix_of_;  ///< of which it is the stiffness
  mutable RCP<const Vector> internal_forces_of_matrix_;     ///< whose derivatives alone it holds, and is open; null: it does not
};

}  // namespace mortise::detail
