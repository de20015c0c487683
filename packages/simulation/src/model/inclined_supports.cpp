#include "model/inclined_supports.hpp"

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>

namespace mortise {
namespace {

/// A slave of a tie that supports hold.
struct HeldSlave {
  LocalOrdinal node = 0;
  std::vector<std::size_t> components;  ///< of the inclined ones
  Eigen::MatrixXd Q;                    ///< [dim squared]
  Eigen::MatrixXd inverse;              ///< [dim x components] C^T (C C^T)^-1
};

bool anywhere(const Communicator& comm, bool here) {
  const int mine = here ? 1 : 0;
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any != 0;
}

LocalOrdinal row_of(const FieldSpace& space, const InclinedComponent& component) { return space.row(component.node, component.component); }

HeldSlave held_slave(LocalOrdinal node, const std::vector<std::size_t>& which, const std::vector<InclinedComponent>& components, int dimension) {
  Eigen::MatrixXd C(static_cast<Eigen::Index>(which.size()), dimension);
  for (std::size_t m = 0; m < which.size(); ++m)
    for (int i = 0; i < dimension; ++i)
      C(static_cast<Eigen::Index>(m), i) = (components[which[m]].component == i ? 1.0 : 0.0) - components[which[m]].of[static_cast<std::size_t>(i)];
  HeldSlave slave{node, which, {}, C.transpose() * (C * C.transpose()).inverse()};
  slave.Q = Eigen::MatrixXd::Identity(dimension, dimension) - slave.inverse * C;
  return slave;
}

/// Rows of dofs: those of the identity but where `row_of` fills in columns (local dofs) and values.
template <class RowOf>
RCP<const Matrix> matrix(const FieldSpace& space, const RowOf& row_of) {
  const RCP<const Map>& dofs = space.dofs();
  const auto result = rcp(new Matrix(dofs, static_cast<std::size_t>(space.rows(0).components)));
  std::vector<GlobalOrdinal> columns;
  std::vector<double> values;
  for (LocalOrdinal dof = 0; dof < static_cast<LocalOrdinal>(dofs->getNodeNumElements()); ++dof) {
    columns.clear(), values.clear();
    const auto put = [&](LocalOrdinal column, double value) {
      if (value == 0.0) return;
      columns.push_back(dofs->getGlobalElement(column));
      values.push_back(value);
    };
    if (!row_of(dof, put)) put(dof, 1.0);
    result->insertGlobalValues(dofs->getGlobalElement(dof), static_cast<LocalOrdinal>(columns.size()), values.data(), columns.data());
  }
  result->fillComplete(dofs, dofs);
  return result;
}

RCP<const Matrix> product(const Matrix& A, const Matrix& B) {
  const auto result = rcp(new Matrix(A.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(A, false, B, false, *result);
  return result;
}

/// Common data of the functions of the rule.
struct Rule {
  std::shared_ptr<const FieldSpace> space;
  std::shared_ptr<const PrescribedMotion> motion;
  std::vector<std::size_t> on_others;  ///< inclined components of nodes that are no slaves
  std::vector<HeldSlave> slaves;
  RCP<const Matrix> Q_T_s;  ///< null: nothing is tied

  RCP<Vector> offset(double time, std::optional<StepFailure>& failure) const {
    const std::vector<double> values = motion->inclined_values(time, failure);
    Vector p_o(space->dofs());
    {
      const auto view = p_o.getLocalViewHost(Tpetra::Access::OverwriteAll);
      for (std::size_t dof = 0; dof < view.extent(0); ++dof) view(dof, 0) = 0.0;
      for (const std::size_t n : on_others) view(row_of(*space, motion->inclined()[n]), 0) = values[n];
    }
    const auto p = rcp(new Vector(p_o, Teuchos::Copy));
    if (Q_T_s.is_null()) return p;
    Q_T_s->apply(p_o, *p);
    const auto view = p->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const HeldSlave& slave : slaves)
      for (std::size_t m = 0; m < slave.components.size(); ++m)
        for (int i = 0; i < space->rows(0).components; ++i)
          view(space->row(slave.node, i), 0) += slave.inverse(i, static_cast<Eigen::Index>(m)) * values[slave.components[m]];
    return p;
  }

  void put_support_forces(const Vector& forces, Vector& gathered) const {
    Vector with_tied(forces, Teuchos::Copy);
    if (!Q_T_s.is_null()) Q_T_s->apply(forces, with_tied, Teuchos::TRANS);
    const auto to = gathered.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto r = forces.getLocalViewHost(Tpetra::Access::ReadOnly), on_node = with_tied.getLocalViewHost(Tpetra::Access::ReadOnly);
    std::vector<InclinedComponent> of_others;
    for (const std::size_t n : on_others) of_others.push_back(motion->inclined()[n]);
    for (const LocalOrdinal dof : held_dofs(*space, of_others)) to(dof, 0) = on_node(dof, 0);
    for (const HeldSlave& slave : slaves)
      for (int i = 0; i < space->rows(0).components; ++i) {
        if (slave.Q(i, i) == 1.0) continue;  // a component that no inclined support holds
        double kept = r(space->row(slave.node, i), 0);
        for (int k = 0; k < space->rows(0).components; ++k) kept -= slave.Q(i, k) * r(space->row(slave.node, k), 0);
        to(space->row(slave.node, i), 0) = kept;
      }
  }
};

}  // namespace

std::vector<LocalOrdinal> held_dofs(const FieldSpace& space, const std::vector<InclinedComponent>& components) {
  std::vector<LocalOrdinal> dofs;
  for (const InclinedComponent& component : components) {
    dofs.push_back(row_of(space, component));
    for (int i = 0; i < space.rows(0).components; ++i)
      if (component.of[static_cast<std::size_t>(i)] != 0.0) dofs.push_back(space.row(component.node, i));
  }
  std::sort(dofs.begin(), dofs.end());
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

std::shared_ptr<const TiedDisplacements> with_inclined_supports(const std::shared_ptr<const FieldSpace>& space,
                                                                const std::shared_ptr<const TiedDisplacements>& ties,
                                                                const std::shared_ptr<const PrescribedMotion>& motion) {
  const std::vector<InclinedComponent>& components = motion->inclined();
  const Communicator& comm = *space->mesh()->comm;
  if (!anywhere(comm, !components.empty())) return ties;
  const int dimension = space->rows(0).components;
  const auto rule = std::make_shared<Rule>(Rule{space, motion, {}, {}, {}});
  std::map<LocalOrdinal, std::vector<std::size_t>> on_slaves;
  std::map<LocalOrdinal, std::size_t> of_others;  // by dofs
  for (std::size_t n = 0; n < components.size(); ++n) {
    if (ties && std::binary_search(ties->dofs.begin(), ties->dofs.end(), row_of(*space, components[n]))) {
      on_slaves[components[n].node].push_back(n);
    } else {
      rule->on_others.push_back(n);
      of_others.emplace(row_of(*space, components[n]), n);
    }
  }
  for (const auto& [node, which] : on_slaves) rule->slaves.push_back(held_slave(node, which, components, dimension));

  const RCP<const Matrix> T_o = matrix(*space, [&](LocalOrdinal dof, const auto& put) {
    const auto found = of_others.find(dof);
    if (found == of_others.end()) return false;
    const InclinedComponent& component = components[found->second];
    for (int i = 0; i < dimension; ++i) put(space->row(component.node, i), component.of[static_cast<std::size_t>(i)]);
    return true;
  });
  TiedDisplacements result{{}, T_o, {}, {}};
  if (ties) {
    rule->Q_T_s = ties->T;
    if (anywhere(comm, !rule->slaves.empty())) {
      const RCP<const Matrix> Q = matrix(*space, [&](LocalOrdinal dof, const auto& put) {
        const FieldPlace at = space->place(dof);
        const auto found = std::lower_bound(rule->slaves.begin(), rule->slaves.end(), at.node,
                                            [](const HeldSlave& slave, LocalOrdinal node) { return slave.node < node; });
        if (found == rule->slaves.end() || found->node != at.node || at.field != 0) return false;
        for (int i = 0; i < dimension; ++i) put(space->row(at.node, i), found->Q(at.component, i));
        return true;
      });
      rule->Q_T_s = product(*Q, *ties->T);
    }
    result.T = product(*rule->Q_T_s, *T_o);
    result.dofs = ties->dofs;
  }
  for (const std::size_t n : rule->on_others) result.dofs.push_back(row_of(*space, components[n]));
  std::sort(result.dofs.begin(), result.dofs.end());
  result.offset = [rule](double time, std::optional<StepFailure>& failure) { return rule->offset(time, failure); };
  result.put_support_forces = [rule](const Vector& forces, Vector& gathered) { rule->put_support_forces(forces, gathered); };
  return std::make_shared<const TiedDisplacements>(std::move(result));
}

}  // namespace mortise
