#pragma once
// The scripts in packages/simulation/plots, part of the program so that it needs no files of its own to draw.

namespace mortise {

extern const char* const plot_style;  ///< comes before every other one
extern const char* const point_plot;
extern const char* const paper_needs;  ///< ends as plot_style does without matplotlib if what paper_page needs beyond it is not here
extern const char* const paper_page;   ///< argument: the directory of run_paper; paper_needs comes before

}  // namespace mortise
