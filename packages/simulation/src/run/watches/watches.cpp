#include "run/watches/watches.hpp"

#include "run/watches/coarse_crossing.hpp"
#include "run/watches/coarse_slave.hpp"
#include "run/watches/heat_error.hpp"
#include "run/watches/heat_watch.hpp"
#include "run/watches/surface_watch.hpp"

namespace mortise {

StepGuards watches(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn) {
  StepGuards guards;
  if (model.edges() != nullptr) guards.push_back(std::make_shared<CrossingExamination>(model));
  if (model.contact()) guards.push_back(std::make_shared<SurfaceWatch>(model, scene, warn));
  if (model.contact()) guards.push_back(std::make_shared<CoarseSlaveWatch>(model, scene, warn));
  if (model.edges() != nullptr) guards.push_back(std::make_shared<CoarseCrossingWatch>(model, scene, warn));
  if (scene.heat.error_tolerance) guards.push_back(std::make_shared<HeatErrorGuard>(model, scene));
  if (model.heat().bodies) guards.push_back(std::make_shared<HeatWatch>(model, scene, warn));
  return guards;
}

}  // namespace mortise
