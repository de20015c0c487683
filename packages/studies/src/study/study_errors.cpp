#include "study/study_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/studies/convergence.hpp"
#include "mortise/studies/study_profile.hpp"

namespace mortise {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

using Values = std::vector<double>;

/// Nothing can be said about differences below the uncertainty of the reference. Not a number if the value or the reference is not.
double relative_difference(double value, double reference, double uncertainty) {
  const double difference = std::abs(value - reference);
  return (difference < uncertainty ? uncertainty : difference) / std::abs(reference);
}

double quantity_of(const StudyPoint& point, const StudyRecord& record, const std::string& name) {
  const auto found = std::find(point.quantities.begin(), point.quantities.end(), name);
  return found == point.quantities.end() || !record.finished() ? none : record.quantities[found - point.quantities.begin()];
}

std::string note(const Extrapolation& found, bool given) {
  if (found.order) return fmt::format("extrapolated to {:.8g} with the order {:.3g}{}", found.limit, *found.order, given ? " (given)" : " found");
  return fmt::format(
      "no order: the three finest levels agree, oscillate or rest; the reference is the finest value, {:.8g}, uncertain by {:.2g} as the last two "
      "differ; no smaller error is reported",
      found.limit, found.uncertainty);
}

/// A limit for each curve. Returns how uncertain the reference of each point is.
Values extrapolated(const StudyMeasuring& measuring, const StudyQuantity& quantity, StudyErrors& errors) {
  Values uncertainty(errors.value.size(), 0.0);
  for (const StudyCurve& curve : measuring.curves) {
    Values h, values;
    for (const std::size_t i : curve.points)
      if (std::isfinite(errors.value[i]) && std::isfinite(measuring.results.h[i]))
        h.push_back(measuring.results.h[i]), values.push_back(errors.value[i]);
    const auto limit = extrapolate(h, values, quantity.order);
    errors.notes.push_back(curve.name + ": " +
                           (limit ? note(*limit, quantity.order.has_value()) : "no reference: the three finest levels do not approach a limit"));
    if (!limit) continue;
    for (const std::size_t i : curve.points) errors.reference[i] = limit->limit, uncertainty[i] = limit->uncertainty;
  }
  return uncertainty;
}

StudyErrors scalar_errors(const StudyMeasuring& measuring, const std::string& name, const StudyQuantity& quantity) {
  const auto& [plan, results] = std::tie(measuring.plan, measuring.results);
  const std::string wanted = quantity.quantity.value.empty() ? name : quantity.quantity.value;
  const std::size_t count = plan.points.size();
  StudyErrors errors{name, Values(count, none), Values(count, none), Values(count, none), {}};
  for (std::size_t i = 0; i < count; ++i) errors.value[i] = quantity_of(plan.points[i], results.points[i], wanted);
  if (quantity.measure == StudyMeasure::itself) {
    for (std::size_t i = 0; i < count; ++i) errors.error[i] = std::abs(errors.value[i]);
    return errors;
  }
  Values uncertainty(count, 0.0);
  if (quantity.reference == StudyReference::finest) {
    errors.reference.assign(count, quantity_of(*plan.finest, *results.finest, wanted));
    errors.notes.push_back(fmt::format("reference: {:.8g} of the finest run", errors.reference.front()));
  } else if (quantity.reference == StudyReference::exact) {
    for (std::size_t i = 0; i < count; ++i)
      if (results.points[i].finished())
        errors.reference[i] = evaluate(quantity.value, plan.points[i], results.points[i].quantities, results.points[i].dofs);
  } else {
    uncertainty = extrapolated(measuring, quantity, errors);
  }
  for (std::size_t i = 0; i < count; ++i) errors.error[i] = relative_difference(errors.value[i], errors.reference[i], uncertainty[i]);
  return errors;
}

StudyErrors profile_errors(const StudyMeasuring& measuring, const std::string& name, const StudyQuantity& quantity) {
  const auto& [plan, results] = std::tie(measuring.plan, measuring.results);
  const std::size_t count = plan.points.size();
  StudyErrors errors{name, Values(count, none), Values(count, none), Values(count, none), {}};
  if (!results.finest->finished()) return errors;
  const std::string column = quantity.measure == StudyMeasure::pressure_profile ? "pressure" : "shear";
  const auto read = [&](const StudyPoint& point) { return read_profiles(measuring.directory_of(point) + "/profiles.csv", column); };
  const auto reference = read(*plan.finest);
  for (std::size_t i = 0; i < count; ++i)
    if (results.points[i].finished()) errors.error[i] = profile_difference(read(plan.points[i]), reference);
  return errors;
}

}  // namespace

std::vector<double> mesh_sizes(const StudyPlan& plan, const std::vector<StudyRecord>& records) {
  Values h;
  for (std::size_t i = 0; i < records.size(); ++i) h.push_back(evaluate(plan.file.h, plan.points[i], records[i].quantities, records[i].dofs));
  return h;
}

std::vector<StudyErrors> study_errors(const StudyMeasuring& measuring) {
  std::vector<StudyErrors> all;
  std::optional<FieldErrors> fields;
  for (const auto& [name, place, quantity] : measuring.plan.file.quantities) {
    if (quantity.of_scalar()) {
      all.push_back(scalar_errors(measuring, name, quantity));
    } else if (quantity.is_profile()) {
      all.push_back(profile_errors(measuring, name, quantity));
    } else {
      if (!fields) fields = field_errors(measuring);
      const Values nothing(measuring.plan.points.size(), none);
      all.push_back({name, quantity.measure == StudyMeasure::displacement ? fields->displacement : fields->gradient, nothing, nothing, {}});
    }
    if (quantity.needs_finest() && !measuring.results.finest->finished())
      all.back().notes = {"no reference: the finest run ended as \"" + measuring.results.finest->status() + "\""};
  }
  return all;
}

}  // namespace mortise
