#pragma once
// The scripts in packages/studies/plots, part of the program so that it needs no files of its own to draw.

namespace mortise {

extern const char* const plot_style;  ///< comes before every other one
extern const char* const point_plot;
extern const char* const page_needs;       ///< ends as plot_style does without matplotlib if what pages need beyond it is not here
extern const char* const paper_page;       ///< argument: the directory of run_paper; page_needs comes before
extern const char* const study_fields;     ///< arguments: the file to write, the finest run, runs: errors of displacements; page_needs comes before
extern const char* const study_page;       ///< argument: the directory of run_study; page_needs comes before
extern const char* const scale_page;       ///< argument: the directory of run_scale; page_needs comes before
extern const char* const results_module;   ///< the python module mortise_results: its text, which results_loader takes as an argument
extern const char* const results_loader;   ///< first argument: results_module; page_needs comes before
extern const char* const picture_plot;     ///< argument: the picture as JSON; results_loader comes before. Code 2: input, 5: files, with the reason
extern const char* const scale_plan_plot;  ///< arguments: plan.csv, stem of the images, title

}  // namespace mortise
