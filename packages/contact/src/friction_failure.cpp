// Where a law of friction has no bound: said once the residual is found not to be finite.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Vector.hpp>

#include "implementation.hpp"

namespace mortise {

void ContactSystem::find_friction_failure(const Vector& z, std::optional<StepFailure>& failure) const {
  const Implementation& self = *implementation_;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto reference = self.reference->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const std::vector<detail::NodeMultiplier> multipliers = self.multipliers_of(values, p);
    for (std::size_t s = 0; s < self.multiplier_of[p].size() && !failure; ++s) {
      if (self.multiplier_of[p][s] < 0) continue;
      std::optional<Diagnostic> missing_bound;
      self.pairs[p]->complementarity(s, multipliers[s], &missing_bound);
      if (!missing_bound) continue;
      std::vector<double> position;
      for (int i = 0; i < self.dimension; ++i) position.push_back(reference(self.pairs[p]->slave_nodes()[s].owned_node, i));
      missing_bound->message += fmt::format("; at the slave node of reference position ({:g})", fmt::join(position, ", "));
      failure.emplace(FailureKind::input, to_string(*missing_bound));
    }
  }
}

}  // namespace mortise
