#pragma once
// Where double precision ends: places and ratios of stiffness.

#include <array>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"

namespace mortise {

/// From where contact measures positions: the origin, or the middle of the model where that is so far away that round-off of coordinates would be
/// felt in gaps. Along the axis alone where the scene is axisymmetric. Collective.
/// @param length  size of the model
std::array<double, 3> contact_origin(const Mesh& mesh, double length, bool axisymmetric);

/// Warnings of what round-off makes uncertain: models far from the origin, slaves that are much stiffer than their masters. Collective.
void report_precision(const Model& model, const Scene& scene, RunLog& log);

}  // namespace mortise
