#include "mortise/studies/study_file.hpp"

#include <fmt/format.h>

namespace mortise {

void StudyAxis::describe(Parameters& parameters) {
  parameters.add("setting", setting,
                 "path of what is varied, as `--set` takes it (\"variables/n\"), or \"ranks\", \"peer\", \"peer penalty\" or \"time limit\"; short "
                 "form, with \"values\"");
  parameters.add("values", values, "its values, each the label of itself");
  parameters.named(
      "choices", choices,
      "long form: values by labels of your choice; each holds the settings it makes, a parameter \"path\" or lists as in the scene for each");
  const bool short_form = !setting.value.empty() || !values.value.empty();
  if (short_form && !choices.empty()) parameters.error("setting", "either \"setting\" with \"values\", or \"choices\"; please remove one of them");
  if (short_form && setting.value.empty()) parameters.error("values", "\"setting\" is missing; please add it: path of what is varied");
  if (short_form && values.value.empty()) parameters.error("setting", "\"values\" is missing; please add it, for example \"4, 8, 16\"");
  if (!short_form && choices.empty()) parameters.error("", "the axis has no values; please add \"setting\" and \"values\", or \"choices\"");
}

std::vector<Named<AssignmentList>> StudyAxis::labelled() const {
  if (!choices.empty()) return choices;
  std::vector<Named<AssignmentList>> all;
  for (const auto& value : values.value) all.push_back({value, values.place, {{{setting.value, value, values.place}}}});
  return all;
}

void StudyQuantity::describe(Parameters& parameters) {
  parameters.add("measure", measure,
                 {{"relative difference", StudyMeasure::relative_difference},
                  {"itself", StudyMeasure::itself},
                  {"pressure profile", StudyMeasure::pressure_profile},
                  {"shear profile", StudyMeasure::shear_profile},
                  {"displacement", StudyMeasure::displacement},
                  {"displacement gradient", StudyMeasure::displacement_gradient}},
                 "relative difference: |q - q_ref| / |q_ref|; itself: the quantity is an error, such as an \"error norm\". The others are relative "
                 "L2 norms of differences to the finest run at the end. They are taken of contact tractions along the arc length, or of "
                 "displacements or their gradients over the bodies");
  parameters.add("quantity", quantity, "quantity of the scene; left out: the one with the name of this list");
  parameters.add("reference", reference,
                 {{"exact", StudyReference::exact}, {"finest", StudyReference::finest}, {"richardson", StudyReference::richardson}},
                 "of a relative difference: \"value\"; the finest run; or extrapolated from the three finest levels of each curve");
  parameters.add("value", value, "the exact value: an expression of the scene's variables and quantities");
  parameters.add("order", order, Says("order that the extrapolation takes for granted; left out: found from the three levels").above(0.0));
  const bool exact = measure == StudyMeasure::relative_difference && reference == StudyReference::exact;
  if (exact && value.value.empty())
    parameters.error("", "\"value\" is missing; please add it (the exact value), or another \"reference\" or \"measure\"");
  if (!exact && !value.value.empty()) parameters.error("value", "only an exact reference has a value; please remove it");
  if (!extrapolated() && order) parameters.error("order", "only the reference \"richardson\" has an order; please remove it");
  if (!of_scalar() && !quantity.value.empty())
    parameters.error("quantity", "this measure is taken of profiles or fields, not of a quantity; please remove it");
}

void StudyFile::describe(Parameters& parameters) {
  parameters.add("scene", scene, Says("path of the scene, relative to this file").required());
  parameters.list("settings", settings, "values of the scene that all runs share: a parameter \"path\", or lists as in the scene, for each");
  parameters.named("axes", axes, Says("varied values, by names of your choice; the runs are all combinations, the last axis first").required());
  parameters.named("exclude", exclude,
                   "combinations that are not run, by names of your choice; each holds parameters \"axis\" with one label or several, \"a, b\"");
  parameters.add("h", h, "mesh size of a run: an expression of the scene's variables and quantities, and of the number of unknowns `dofs`");
  parameters.named("quantities", quantities, Says("errors, by the names of their columns `error_<name>`").required());
  parameters.list("finest", finest, "settings of the reference run, on top of \"settings\"; it is kept aside and is no point of the plots");
  parameters.add("series", series, "axis whose values are compared, the first of them being the base of ratios; left out: the first axis");
  parameters.add("along", along, "axis whose values are the points of a curve, from coarse to fine; left out: the last axis");
  parameters.add("repeats", repeats, Says("timed runs of each point; times and memory are medians").at_least(1));
  parameters.add("time limit", time_limit,
                 Says("wall time after which a run is ended and its point has failed, unless its settings say another \"time limit\"; default: none")
                     .unit("s")
                     .above(0.0));
  parameters.add("targets", targets, Says("errors for which the cheapest configurations and the times are reported").above(0.0));
}

}  // namespace mortise
