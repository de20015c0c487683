#include "mortise/studies/hard_file.hpp"

namespace mortise {
namespace {

constexpr const char* names_known =
    "an expression of the scene's variables and quantities, of those of companions as `companion_quantity`, and of `t`, `steps`, `iterations`, "
    "`cutbacks`, "
    "`output_seconds`";

}  // namespace

void HardExpectation::describe(Parameters& parameters) {
  parameters.add("figure", figure, std::string("the figure: ") + names_known + "; left out: the quantity with the name of this list");
  parameters.add("value", value, "expected value of the figure, with \"bound\"; an expression like \"figure\"");
  parameters.add("bound", bound, "largest distance of the figure from \"value\", in its unit; an expression like \"figure\"");
  parameters.add("low", low, "the least value allowed; the same kind of expression");
  parameters.add("high", high, "the largest value allowed; the same kind of expression");
  const bool near = !value.value.empty(), between = !low.value.empty() || !high.value.empty();
  if (near == between) parameters.error("", "either \"value\" with \"bound\", or \"low\", \"high\" or both; please give one of these");
  if (near != !bound.value.empty()) parameters.error("", "\"value\" and \"bound\" go together; please give both or none");
}

void HardCompanion::describe(Parameters& parameters) {
  parameters.add("scene", scene, "its scene, relative to this file; left out: that of the case, with the case's settings below these");
  parameters.list("settings", settings, "values of the scene: a parameter \"path\", or lists as in the scene, for each");
  parameters.add("follows axes", follows_axes, "true: values of the case's axes are set here too; a scene of its own has none");
}

void HardStop::describe(Parameters& parameters) {
  parameters.add("reason", reason, "regular expression that the text of the last failure has to match somewhere; left out: no stop is true");
  parameters.add("codes", codes, Says("exit codes of a true stop").at_least(1));
  parameters.add("required", required, "true: the case has no answer, so that coming to the end is wrong");
  if (required && reason.value.empty()) parameters.error("required", "\"reason\" is missing; please add what the failure has to say");
}

void HardCase::describe(Parameters& parameters) {
  parameters.add("scene", scene, Says("path of the scene, relative to this file").required());
  parameters.add("hard", hard, Says("difficulty of the case, in words").required());
  parameters.add("expectation", expectation, Says("expected result, in words").required());
  parameters.add(
      "source", source,
      Says("source of the expectation: closed form, symmetry, equality with another scene, an independent computation, a bound of the theory")
          .required());
  parameters.list("settings", settings,
                  "values of the scene: a parameter \"path\", or lists as in the scene, for each; \"time limit\" is that of the run");
  parameters.named("axes", axes, "varied values, as in a study; a case with axes is a sweep and has a line for each combination");
  parameters.named("companions", companions, "runs that expectations name, by names of your choice");
  parameters.named("expected", expected, "expected figures at the end, by names of your choice");
  parameters.add("always", always, "expression of t, the scene's variables and quantities that has to hold after each step, before a stop as well");
  parameters.list("stop", stop, "stops that are true");
  every_ranks = axes.empty();
  parameters.add("every ranks", every_ranks,
                 "true: it is run on all numbers of ranks that are asked for; false: on the first one only, as where times are compared; default of "
                 "sweeps: false");
  if (expected.empty() && !stop.required)
    parameters.error("", "nothing is expected; please add the list \"expected\", or a \"stop\" that is required");
}

void HardFile::describe(Parameters& parameters) {
  parameters.add(
      "time limit", time_limit,
      Says("wall time, for each rank, after which a run is ended and counts as wrong, unless its settings say another").unit("s").above(0.0));
  parameters.named("cases", cases, Says("the cases, by names of your choice").required());
}

}  // namespace mortise
