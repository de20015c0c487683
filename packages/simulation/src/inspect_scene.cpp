#include <fmt/format.h>

#include "contact_at_start.hpp"
#include "mortise/simulation/model.hpp"
#include "mortise/simulation/run.hpp"
#include "precision.hpp"
#include "report_model.hpp"
#include "run_log.hpp"
#include "step_evaluation.hpp"

namespace mortise {

void inspect_scene(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options) {
  RunLog log(comm, options.verbosity);
  const Timers timers;
  const Model model(comm, scene, timers);
  SemiSmoothSystem system(model.parts(), timers);
  const StepEvaluation evaluation(scene, model, system);
  report_model(options.scene, scene, model, log);
  report_precision(model, scene, log);
  report_contact_at_start(model, scene, log);
  log.info(fmt::format("  diagonal of the model {:.6g}, shortest side of an element {:.6g}", model.size().length, model.size().shortest_side));
  report_memory(model, log);
  log.info("no errors");
}

}  // namespace mortise
