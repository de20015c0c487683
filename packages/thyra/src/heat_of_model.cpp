#include "heat_of_model.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "mortise/core/matrix_sum.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "tpetra_of_thyra.hpp"

namespace mortise::detail {
namespace {

// Every rank throws if any finds a fault.
void refuse(const Communicator& comm, bool wrong, const std::string& what) {
  if (most_over_ranks(comm, wrong ? 1 : 0) != 0) throw std::invalid_argument("contact: " + what);
}

ThermalContact checked(const HostHeat& heat, const NodalField& displacement, const ContactSystem& contact, const RCP<const Map>& dofs) {
  const Communicator& comm = *dofs->getComm();
  const bool rubs = std::any_of(heat.pairs.begin(), heat.pairs.end(), [](const ThermalPair& pair) { return pair.slave_share.has_value(); });
  refuse(comm, rubs && !heat.time_step, "HostHeat has friction that gives heat, and no time_step; give the time that a step takes");
  const RCP<const Map>& nodes = heat.temperature.nodes();
  refuse(comm, !heat.fixed.is_null() && !(heat.fixed->getNumVectors() == 1 && heat.fixed->getMap()->locallySameAs(*nodes)),
         "HostHeat::fixed is not one column on the owned nodes");
  std::set<GlobalOrdinal> moved;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(*displacement.nodes())); ++node)
    for (int i = 0; i < displacement.components(); ++i) moved.insert(displacement.id(node, i));
  bool is_shared = false;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(*nodes)); ++node)
    if (const GlobalOrdinal id = heat.temperature.id(node, 0); id != NodalField::none && moved.count(id) != 0) is_shared = true;
  refuse(comm, is_shared, "HostHeat::temperature has an entry of x that is a displacement");
  return {contact, heat.temperature, dofs, heat.pairs};
}

std::vector<LocalOrdinal> marked_rows(const HostHeat& heat, const Map& dofs) {
  std::vector<LocalOrdinal> result;
  if (heat.fixed.is_null()) return result;
  const auto marks = heat.fixed->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(marks.extent(0)); ++node)
    if (const GlobalOrdinal id = heat.temperature.id(node, 0); id != NodalField::none && marks(node, 0) != 0.0)
      result.push_back(dofs.getLocalElement(id));
  return result;
}

RCP<const Matrix> without_rows(const RCP<const Matrix>& matrix, const std::vector<LocalOrdinal>& rows) {
  Vector kept(matrix->getRangeMap());
  kept.putScalar(1.0);
  for (const LocalOrdinal row : rows) kept.replaceLocalValue(row, 0.0);
  const auto result = rcp(new Matrix(*matrix, Teuchos::Copy));
  result->leftScale(kept);
  return result;
}

NodalTemperature temperature(const Vector& x, const HeatConditions& at) {
  return at.of_nodes.is_null() ? NodalTemperature(x) : NodalTemperature(x, *at.of_nodes);
}

void add_to_system(const Matrix& rows, Matrix& system) {
  if (!add_entries(rows, system)) throw std::logic_error("contact: the graph has no place for an entry of the rows of heat");
}

}  // namespace

bool are_equal(const HeatConditions& one, const HeatConditions& other) {
  const bool have_nodes = !one.of_nodes.is_null();
  return one.time_step == other.time_step && have_nodes == !other.of_nodes.is_null() && (!have_nodes || are_equal(*one.of_nodes, *other.of_nodes));
}

HeatOfIterate::HeatOfIterate(const DifferentiatedHeat& rows, const HeatConditions& conditions, RCP<const Vector> z,
                             const std::vector<LocalOrdinal>& prescribed)
    : rows_(rows), conditions_(conditions), z_(std::move(z)), G_(rows.of_multipliers()) {
  if (!G_.is_null() && most_over_ranks(*z_->getMap()->getComm(), prescribed.empty() ? 0 : 1) != 0) G_ = without_rows(G_, prescribed);
}

void HeatOfIterate::add_slopes(Matrix& A) const {
  if (!G_.is_null()) add_to_system(*rows_.of_dofs(), A);
}

void HeatOfIterate::add_substituted(const NodeElimination& elimination, Matrix& A) const {
  if (!G_.is_null()) add_to_system(*elimination.substitute(*G_).of_dofs, A);
}

void HeatOfIterate::condense(const NodeElimination& elimination, Vector& right) const {
  if (G_.is_null()) return;
  Vector r(right.getMap());
  rows_.add_to(r);
  right.update(-1.0, r, 1.0);
  G_->apply(*z_, right, Teuchos::NO_TRANS, 1.0, 1.0);
  take_constant(elimination, right);
}

void HeatOfIterate::take_constant(const NodeElimination& elimination, Vector& right) const {
  if (G_.is_null()) return;
  Vector b(G_->getDomainMap());
  elimination.recover(Vector(right.getMap()), b);
  G_->apply(b, right, Teuchos::NO_TRANS, -1.0, 1.0);
}

HeatOfModel::HeatOfModel(HostHeat of_host, const NodalField& displacement, const ContactSystem& contact, const RCP<const Map>& dofs)
    : of_host_(std::move(of_host)), thermal_(checked(of_host_, displacement, contact, dofs)), prescribed_(marked_rows(of_host_, *dofs)) {}

HeatConditions HeatOfModel::conditions(const ThyraInArgs& at) const {
  HeatConditions result;
  if (of_host_.time_step) result.time_step = of_host_.time_step(at);
  if (!of_host_.eliminated) return result;
  const auto values = rcp(new Vector(of_host_.temperature.nodes()));
  values->putScalar(std::numeric_limits<double>::quiet_NaN());
  of_host_.eliminated(at, *values);
  result.of_nodes = values;
  return result;
}

ContactHeat HeatOfModel::evaluate(const ContactLaws& laws, const Vector& x, const HeatConditions& at) const {
  return thermal_.evaluate(laws, temperature(x, at), at.time_step);
}

HeatOfIterate HeatOfModel::differentiate(const ContactLinearisation& linearised, const Vector& x, const HeatConditions& at) const {
  const auto z = rcp(new Vector(linearised.laws().multipliers(), Teuchos::Copy));
  return {thermal_.differentiate(linearised, temperature(x, at), at.time_step), at, z, prescribed_};
}

}  // namespace mortise::detail
