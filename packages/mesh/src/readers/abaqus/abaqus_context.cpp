#include "readers/abaqus/abaqus_context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace mortise {

std::string AbaqusContext::required(const AbaqusKeyword& keyword, const char* parameter) {
  const auto value = keyword.value(parameter);
  if (!value || value->empty()) stop(keyword.spot, fmt::format("*{} has no {}=", keyword.name, parameter));
  return *value;
}

void AbaqusContext::require_parameters(const AbaqusKeyword& keyword, const std::vector<std::string>& known) {
  for (const auto& [name, value] : keyword.parameters)
    if (std::find(known.begin(), known.end(), name) == known.end())
      error(keyword.spot, fmt::format("*{}: the parameter {} is not read; read are {}", keyword.name, name, fmt::join(known, ", ")));
}

std::optional<std::int32_t> AbaqusContext::label_of(std::string_view field, const char* of) {
  const auto label = whole_number_of(field);
  if (label && *label > 0 && *label <= most_indices) return static_cast<std::int32_t>(*label);
  error(fmt::format("expected the label of {} {}, a number from 1 to {}, found \"{}\"", of[0] == 'e' ? "an" : "a", of, most_indices, field));
  return std::nullopt;
}

}  // namespace mortise
