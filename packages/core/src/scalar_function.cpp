#include "mortise/core/scalar_function.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace mortise {

struct ScalarFunction::Content {
  double value;  // of a constant
  Body body;     // of all others
  std::string source;
  Place place;
  std::vector<char> reads;
};

ScalarFunction::ScalarFunction(double value) : ScalarFunction(value, fmt::format("{}", value), {}) {}

ScalarFunction::ScalarFunction(double value, std::string source, Place place)
    : content_(std::make_shared<const Content>(Content{value, {}, std::move(source), std::move(place), {}})) {}

ScalarFunction::ScalarFunction(Body body, std::string source, Place place, std::vector<char> reads)
    : content_(std::make_shared<const Content>(Content{0.0, std::move(body), std::move(source), std::move(place), std::move(reads)})) {
  if (!content_->body) throw std::invalid_argument(fmt::format("the function \"{}\" has no body", content_->source));
}

double ScalarFunction::at(const std::vector<double>& arguments) const { return is_constant() ? content_->value : content_->body(arguments); }

double ScalarFunction::operator()(double t, double x, double y, double z) const {
  if (is_constant()) return content_->value;
  const double value = at({t, x, y, z});
  if (!std::isfinite(value)) {
    const double shown = std::isnan(value) ? std::abs(value) : value;  // some operations give a sign to what is not a number
    throw InputError(content_->place, fmt::format("\"{}\" is {} at t = {:g}, x = {:g}, y = {:g}, z = {:g}", content_->source, shown, t, x, y, z));
  }
  return value;
}

bool ScalarFunction::is_constant() const { return !content_->body; }
bool ScalarFunction::depends_on(std::size_t argument) const {
  return argument < content_->reads.size() && content_->reads[argument] != 0;
}
const std::string& ScalarFunction::source() const { return content_->source; }
const Place& ScalarFunction::place() const { return content_->place; }

}  // namespace mortise
