#include "model/support_constraints.hpp"

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
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

/// Prescribed values, then those of inclined components, then those of other fields.
AffineConstraints::Values values_of(const std::shared_ptr<const PrescribedMotion>& motion, const AffineConstraints::Values& further) {
  return [motion, further](double time, std::optional<StepFailure>& failure) {
    std::vector<double> values = motion->values(time, failure);
    const auto append = [&](const std::vector<double>& more) { values.insert(values.end(), more.begin(), more.end()); };
    append(motion->inclined_values(time, failure));
    if (further) append(further(time, failure));
    return values;
  };
}

/// Inclined components, by where they are.
struct InclinedNodes {
  std::vector<std::size_t> on_others;  ///< of nodes that are no slaves
  std::vector<HeldSlave> slaves;       ///< by ascending nodes
};

InclinedNodes inclined_nodes(const FieldSpace& space, const TieRows* ties, const std::vector<InclinedComponent>& components) {
  InclinedNodes result;
  std::map<LocalOrdinal, std::vector<std::size_t>> on_slaves;
  for (std::size_t n = 0; n < components.size(); ++n) {
    if (ties != nullptr && std::binary_search(ties->dofs.begin(), ties->dofs.end(), row_of(space, components[n])))
      on_slaves[components[n].node].push_back(n);
    else
      result.on_others.push_back(n);
  }
  for (const auto& [node, which] : on_slaves) result.slaves.push_back(held_slave(node, which, components, space.rows(0).components));
  return result;
}

/// @param first_inclined  number of the value of the first inclined component
std::vector<AffineConstraints::Line> tie_lines(const FieldSpace& space, const TieRows& ties, const std::vector<HeldSlave>& slaves,
                                               std::size_t first_inclined) {
  const Map& columns = *ties.T->getColMap();
  const auto local = ties.T->getLocalMatrixHost();
  std::vector<AffineConstraints::Line> lines;
  for (const LocalOrdinal dof : ties.dofs) {
    AffineConstraints::Line line{dof, {}, {}};
    const auto add = [&](LocalOrdinal row, double factor) {
      for (LocalOrdinal k = 0; k < local.rowConst(row).length && factor != 0.0; ++k)
        line.terms.emplace_back(columns.getGlobalElement(local.rowConst(row).colidx(k)), factor * local.rowConst(row).value(k));
    };
    const FieldPlace at = space.place(dof);
    const auto slave =
        std::lower_bound(slaves.begin(), slaves.end(), at.node, [](const HeldSlave& one, LocalOrdinal node) { return one.node < node; });
    if (slave == slaves.end() || slave->node != at.node) {
      add(dof, 1.0);
    } else {
      for (int k = 0; k < space.rows(0).components; ++k) add(space.row(at.node, k), slave->Q(at.component, k));
      for (std::size_t m = 0; m < slave->components.size(); ++m)
        line.shares.emplace_back(first_inclined + slave->components[m], slave->inverse(at.component, static_cast<Eigen::Index>(m)));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// What inclined supports bear.
struct SupportForces {
  std::shared_ptr<const FieldSpace> space;
  std::vector<LocalOrdinal> rows_of_others;
  std::vector<HeldSlave> slaves;
  RCP<const Matrix> T;  ///< of ties alone; null: nothing is tied

  void put(const Vector& forces, Vector& gathered) const {
    Vector with_tied(forces, Teuchos::Copy);
    if (!T.is_null()) T->apply(forces, with_tied, Teuchos::TRANS);
    const auto to = gathered.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto r = forces.getLocalViewHost(Tpetra::Access::ReadOnly), on_node = with_tied.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal dof : rows_of_others) to(dof, 0) = on_node(dof, 0);
    const int components = space->rows(0).components;
    for (const HeldSlave& slave : slaves)
      for (int i = 0; i < components; ++i) {
        if (slave.Q(i, i) == 1.0) continue;  // a component that no inclined support holds
        double kept = r(space->row(slave.node, i), 0);
        for (int k = 0; k < components; ++k) kept -= slave.Q(i, k) * r(space->row(slave.node, k), 0);
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

SupportConstraints support_constraints(const std::shared_ptr<const FieldSpace>& space, const std::shared_ptr<const TieRows>& ties,
                                       const std::shared_ptr<const PrescribedMotion>& motion, const FurtherConstraints& further) {
  const std::vector<InclinedComponent>& components = motion->inclined();
  const std::size_t first_inclined = motion->dofs().size();
  InclinedNodes inclined = inclined_nodes(*space, ties.get(), components);
  std::vector<AffineConstraints::Line> of_ties;
  if (ties) of_ties = tie_lines(*space, *ties, inclined.slaves, first_inclined);

  std::vector<AffineConstraints::Line> lines = of_ties;
  for (std::size_t n = 0; n < first_inclined; ++n) lines.push_back({motion->dofs()[n], {}, {{n, 1.0}}});
  std::vector<InclinedComponent> of_others;
  for (const std::size_t n : inclined.on_others) {
    const InclinedComponent& component = components[n];
    of_others.push_back(component);
    AffineConstraints::Line line{row_of(*space, component), {}, {{first_inclined + n, 1.0}}};
    for (int i = 0; i < space->rows(0).components; ++i)
      if (const double of = component.of[static_cast<std::size_t>(i)]; of != 0.0)
        line.terms.emplace_back(space->dofs()->getGlobalElement(space->row(component.node, i)), of);
    lines.push_back(std::move(line));
  }
  for (AffineConstraints::Line line : further.lines) {
    for (auto& share : line.shares) share.first += first_inclined + components.size();
    lines.push_back(std::move(line));
  }
  SupportConstraints result{std::make_shared<const AffineConstraints>(space->dofs(), std::move(lines), values_of(motion, further.values)), {}};
  if (!anywhere(*space->mesh()->comm, !components.empty())) return result;
  RCP<const Matrix> T;
  if (ties) T = AffineConstraints(space->dofs(), std::move(of_ties), values_of(motion, {})).T();
  const auto forces =
      std::make_shared<const SupportForces>(SupportForces{space, held_dofs(*space, of_others), std::move(inclined.slaves), std::move(T)});
  result.put_support_forces = [forces](const Vector& r, Vector& gathered) { forces->put(r, gathered); };
  return result;
}

}  // namespace mortise
