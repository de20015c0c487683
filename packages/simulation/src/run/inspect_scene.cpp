#include <fmt/format.h>

#include "model/contact_at_start.hpp"
#include "model/precision.hpp"
#include "model/report_model.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/output/step_evaluation.hpp"
#include "mortise/simulation/run/run.hpp"

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
