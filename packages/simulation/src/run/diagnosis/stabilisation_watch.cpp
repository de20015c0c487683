#include "run/diagnosis/stabilisation_watch.hpp"

#include <fmt/format.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <numeric>

#include "model/connectors/stabilisation.hpp"

namespace mortise {
namespace {

constexpr double much = 0.05;  ///< of the energy in bodies and springs

}  // namespace

std::optional<StepFailure> StabilisationWatch::end(const SemiSmoothSystem& system, const EndOfSteps& end) {
  if (!end.is_converged || end.last == nullptr) return std::nullopt;
  const Stabilisation& stabilisation = *model_.connectors().stabilisation;
  const Bodies& bodies = *model_.bodies();
  Vector local(bodies.space().local_dofs());
  local.doImport(*system.unknowns(end.last->x()), *bodies.space().ghost_import(), Tpetra::INSERT);
  double energy = 0.0;
  for (const std::vector<double>& of_bodies : {bodies.stored_energies(local), bodies.plastic_works(local)})
    energy = std::accumulate(of_bodies.begin(), of_bodies.end(), energy);
  if (model_.connectors().springs) energy += model_.connectors().springs->energy(local);
  const double work = stabilisation.work(), last = stabilisation.force().norm2();
  const std::string words = fmt::format(
      "stabilisation took {:.3g}, {:.3g} times the energy {:.3g} in bodies and springs; its forces had a norm of up to "
      "{:.3g}, and of {:.3g} in the last state",
      work, work / energy, energy, stabilisation.largest_force(), last);
  if (work > much * energy)
    warn_(words + "; where friction or plasticity remember the way, please compare with a smaller \"factor\" or a prescribed motion");
  else
    say_(words);
  if (last == 0.0) return std::nullopt;
  return StepFailure(FailureKind::lost_contact, "the last state is in balance with viscous stabilisation alone");  // on every rank
}

}  // namespace mortise
