#pragma once
// The scripts in packages/simulation/plots, part of the program so that it needs no files of its own to draw.

namespace mortise {

extern const char* const plot_style;  ///< comes before every other one
extern const char* const point_plot;

}  // namespace mortise
