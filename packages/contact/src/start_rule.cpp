// The initial guess of a step. Only the guess: no residual is changed by it.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "implementation.hpp"

namespace mortise {
namespace {

constexpr double touching = 1e-8;      // |g_j| / (A_j h) below which a node touches: then the sign of g is round-off
constexpr double small_strain = 1e-6;  // the pressure it starts with, over Young's modulus
constexpr double near = 0.1;           // distance over h up to which nodes of an unheld body are seeded

bool slave_is_unheld(const detail::PairCoupling& pair, const std::vector<char>& unheld) {
  for (const SlaveNode& slave : pair.slave_nodes())
    if (unheld[slave.owned_node]) return true;
  return false;
}

bool master_is_unheld(const detail::PairCoupling& pair, const Map& owned_nodes, const std::vector<char>& unheld) {
  for (const auto& facet : pair.definition().master)
    for (const GlobalOrdinal node : facet) {
      const LocalOrdinal owned = owned_nodes.getLocalElement(node);
      if (owned >= 0 && unheld[owned]) return true;
    }
  return false;
}

}  // namespace

// With the least gap g of a node, and the mean normal n of the nodes that are as near, the unheld bodies are moved by g + 1e-6 E / eps_n towards the
// other side: the nodes then bear 1e-6 E. Components that are prescribed stay. Two sides that are both unheld are left where they are.
void ContactSystem::Implementation::approach(std::size_t p, const std::vector<char>& unheld, Vector& d) const {
  const detail::PairCoupling& pair = *pairs[p];
  const bool slave_moves = maximum(slave_is_unheld(pair, unheld)) > 0.0;
  if (slave_moves == (maximum(master_is_unheld(pair, *owned_nodes, unheld)) > 0.0)) return;
  const auto gap = [&](std::size_t s) { return pair.rows()[s].gap / pair.rows()[s].covered; };
  double mine = -std::numeric_limits<double>::max();
  for (std::size_t s = 0; s < pair.rows().size(); ++s)
    if (pair.covered(s)) mine = std::max(mine, -gap(s));
  const double nearest = -maximum(mine);
  if (nearest > pair.interface().reach()) return;  // no node is covered
  SpatialVector normal = SpatialVector::Zero(dimension);
  for (std::size_t s = 0; s < pair.rows().size(); ++s)
    if (pair.covered(s) && gap(s) <= nearest + touching * pair.size()) normal += pair.rows()[s].normal;
  for (double& component : normal) component = sum(component);
  const double way = nearest + small_strain * pair.size() / pair.regularisation()->normal;
  const SpatialVector motion = (slave_moves ? way : -way) * normal.normalized();
  const auto prescribed = fixed->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto values = d.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < unheld.size(); ++node)
    for (int i = 0; i < dimension; ++i)
      if (unheld[node] && prescribed(node, i) == 0.0) values(dimension * node + i, 0) += motion[i];
}

// A node whose gap is zero up to round-off would be open or closed at random: it starts closed, at a pressure that no result can see.
// Where a body that only contact holds has no closed node, its system is singular: the nodes nearest to contact start closed,
// z_n = c_n g + 1e-6 E. Regularised conditions do not look at z: a touching node starts from that pressure as its multiplier, which moves it by
// 1e-6 E / eps_n; and bodies come up to contact.
void ContactSystem::start_step(Vector& d, const std::vector<char>& unheld, Vector& z) {
  Implementation& self = *implementation_;
  self.marked = self.accepted;  // after a step that was undone
  const auto evaluate_or_throw = [&](const RCP<const MultiVector>& x) {
    std::optional<StepFailure> failure;
    self.evaluate(x, false, failure);
    throw_if_any(*self.dofs->getComm(), failure);
  };
  const RCP<const MultiVector> x = self.positions(d);
  const bool first = self.accepted_at.is_null();
  if (first) {
    evaluate_or_throw(x);
    self.accept_cover();
  }
  bool adapted = false;
  for (const auto& pair : self.pairs) adapted |= pair->adapt_surface(*self.accepted_at);
  if (adapted) {
    self.pattern_changed = true;
    evaluate_or_throw(self.accepted_at);
  }
  if (first || adapted) self.take_slip_references();
  for (const auto& pair : self.pairs) pair->start_step();
  evaluate_or_throw(x);

  const auto values = z.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairCoupling& pair = *self.pairs[p];
    const double pressure = small_strain * pair.definition().youngs_modulus;
    const auto set = [&](std::size_t s, double z_n) {
      const LocalOrdinal first = self.multiplier_of[p][s];
      for (int i = 0; i < self.dimension; ++i) values(first + i, 0) = z_n * pair.rows()[s].normal[i];
    };
    double active = 0.0, nearest = std::numeric_limits<double>::max();
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      if (!pair.covered(s)) {
        if (self.multiplier_of[p][s] >= 0) set(s, 0.0);  // it may just have handed over
        continue;
      }
      const double gap = pair.rows()[s].gap / pair.slave_nodes()[s].weight;
      bool closed = pair.closed(s, self.z_of(values, p, s));
      if (!closed && std::abs(gap) < touching * pair.size()) {
        set(s, pressure);
        if (pair.regularisation()) self.pairs[p]->set_start_pressure(s, pressure);
        closed = true;
      }
      active += closed;
      nearest = std::min(nearest, gap);
    }
    const bool needed = self.maximum(slave_is_unheld(pair, unheld) || master_is_unheld(pair, *self.owned_nodes, unheld)) > 0.0;
    if (!needed || self.sum(active) > 0.0) continue;
    if (pair.regularisation()) {
      self.approach(p, unheld, d);
      continue;
    }
    nearest = -self.maximum(-nearest);
    const double reach = std::max(near * pair.size(), nearest + touching * pair.size());
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      if (!pair.covered(s) || pair.rows()[s].gap > reach * pair.slave_nodes()[s].weight) continue;
      set(s, std::max(0.0, pair.complementarity_constant(s) * pair.rows()[s].gap) + pressure);
    }
  }
}

}  // namespace mortise
