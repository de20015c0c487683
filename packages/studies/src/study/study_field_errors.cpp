#include <limits>
#include <nlohmann/json.hpp>

#include "mortise/input/xml.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"
#include "study/study_errors.hpp"

namespace mortise {

FieldErrors field_errors(const StudyMeasuring& measuring) {
  const auto& points = measuring.plan.points;
  const double none = std::numeric_limits<double>::quiet_NaN();
  FieldErrors errors{std::vector<double>(points.size(), none), std::vector<double>(points.size(), none)};
  if (!measuring.results.finest->finished()) return errors;
  const std::string result = measuring.directory + "/field-errors.json";
  std::vector<std::string> arguments{result, measuring.plan.finest->axisymmetric ? "axisymmetric" : "plane",
                                     measuring.directory_of(*measuring.plan.finest)};
  std::vector<std::size_t> measured;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (measuring.results.points[i].finished()) {
      measured.push_back(i);
      arguments.push_back(measuring.directory_of(points[i]));
    }
  draw_plot(measuring.comm, std::string(page_needs) + study_fields, arguments, result);
  const auto rows = nlohmann::json::parse(read_text(measuring.comm, result));
  for (std::size_t row = 0; row < measured.size(); ++row) {
    if (rows[row]["displacement"].is_number()) errors.displacement[measured[row]] = rows[row]["displacement"];
    if (rows[row]["gradient"].is_number()) errors.gradient[measured[row]] = rows[row]["gradient"];
  }
  return errors;
}

}  // namespace mortise
