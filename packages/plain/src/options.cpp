#include "options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mortise/core/names.hpp"
#include "mortise/core/parameter_range.hpp"

namespace mortise {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& text, const char* separators) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    if (std::string part = trimmed(text.substr(begin, end - begin)); !part.empty()) parts.push_back(std::move(part));
    begin = end + 1;
  }
  return parts;
}

/// The number that all of the text is.
template <class Number>
std::optional<Number> read(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end ? std::optional(value) : std::nullopt;
}

}  // namespace

ReadOptions::ReadOptions(const std::string& text, const std::string& where) : where_(where) {
  for (const std::string& one : split(text, ";\n")) {
    const std::size_t equals = one.find('=');
    const std::string name = trimmed(one.substr(0, equals));
    if (equals == std::string::npos || name.empty())
      say(fmt::format("\"{}\" is no option; please write \"name = value\"", one));
    else if (!given_.emplace(name, trimmed(one.substr(equals + 1))).second)
      say(fmt::format("\"{}\" is given twice", name));
  }
}

void ReadOptions::say(const std::string& message) { diagnostics_.push_back({{"", 0, where_}, message}); }

void ReadOptions::error(const std::string& name, const std::string& message) {
  say(name.empty() ? message : fmt::format("\"{}\": {}", path(name), message));
}

std::string ReadOptions::path(const std::string& name) const {
  std::string result;
  for (const std::string& list : lists_) result += list + "/";
  return result + name;
}

const std::string* ReadOptions::find(const std::string& name, const Says& says) {
  known_.push_back(path(name));
  const auto found = given_.find(known_.back());
  if (found != given_.end()) return &found->second;
  if (says.is_required()) say(fmt::format("\"{}\" is missing; please add it: {}", known_.back(), says.sentence()));
  return nullptr;
}

std::optional<double> ReadOptions::number(const std::string& name, const std::string& text, const Says& says) {
  const auto value = read<double>(text);
  if (!value)
    say(fmt::format("\"{}\" is \"{}\", which is no number", path(name), text));
  else if (!std::isfinite(*value) || !is_in_range(*value, says))
    say(fmt::format("\"{}\" is {}; allowed: finite numbers {}", path(name), *value, range_text(says)));
  else
    return value;
  return std::nullopt;
}

void ReadOptions::add(const std::string& name, double& value, const Says& says) {
  if (const std::string* text = find(name, says)) value = number(name, *text, says).value_or(value);
}

void ReadOptions::add(const std::string& name, std::optional<double>& value, const Says& says) {
  if (const std::string* text = find(name, says))
    if (const auto read = number(name, *text, says)) value = read;
}

void ReadOptions::add(const std::string& name, ScalarFunction& value, const Says& says) {
  if (const std::string* text = find(name, says))
    if (const auto read = number(name, *text, says)) value = ScalarFunction(*read);
}

void ReadOptions::add(const std::string& name, std::optional<ScalarFunction>& value, const Says& says) {
  if (const std::string* text = find(name, says))
    if (const auto read = number(name, *text, says)) value = ScalarFunction(*read);
}

void ReadOptions::add(const std::string& name, int& value, const Says& says) {
  const std::string* text = find(name, says);
  if (!text) return;
  const auto whole = read<int>(*text);
  if (!whole)
    say(fmt::format("\"{}\" is \"{}\", which is no whole number", path(name), *text));
  else if (number(name, *text, says))
    value = *whole;
}

void ReadOptions::add(const std::string& name, bool& value, const Says& says) {
  const std::string* text = find(name, says);
  if (!text) return;
  if (*text == "true" || *text == "false")
    value = *text == "true";
  else
    say(fmt::format("\"{}\" is \"{}\"; please write true or false", path(name), *text));
}

void ReadOptions::add(const std::string& name, std::string& value, const Says& says) {
  if (const std::string* text = find(name, says)) value = *text;
}

void ReadOptions::add(const std::string& name, std::vector<double>& value, const Says& says) {
  const std::string* text = find(name, says);
  if (!text) return;
  std::vector<double> all;
  for (const std::string& part : split(*text, ", ")) {
    const auto one = number(name, part, says);
    if (!one) return;
    all.push_back(*one);
  }
  value = std::move(all);
}

void ReadOptions::add(const std::string& name, std::vector<std::string>& value, const Says& says) {
  if (const std::string* text = find(name, says)) value = split(*text, ",");
}

void ReadOptions::add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) {
  const std::string* text = find(name, says);
  if (!text) return;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found == names.end())
    say(fmt::format("\"{}\" is \"{}\"; allowed: {}{}", path(name), *text, quoted_list(names), did_you_mean(*text, names)));
  else
    index = static_cast<std::size_t>(found - names.begin());
}

bool ReadOptions::begin_list(const std::string& name, const Says&) {
  lists_.push_back(name);
  return true;
}

void ReadOptions::choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) {
  const std::string* text = find(name, says);
  std::vector<std::string> kinds;
  for (const auto& kind : access.kinds) kinds.push_back(kind.first);
  if (text) {
    const auto found = std::find(kinds.begin(), kinds.end(), *text);
    if (found == kinds.end()) {
      say(fmt::format("\"{}\" is \"{}\"; allowed: {}{}", path(name), *text, quoted_list(kinds), did_you_mean(*text, kinds)));
      refused_.push_back(path(""));
      return;
    }
    access.select(static_cast<std::size_t>(found - kinds.begin()), {"", 0, where_});
  }
  access.describe(*this);
}

void ReadOptions::finish() {
  for (const auto& [path, value] : given_) {
    const bool below_refused =
        std::any_of(refused_.begin(), refused_.end(), [&, name = path](const std::string& list) { return name.compare(0, list.size(), list) == 0; });
    if (below_refused || std::find(known_.begin(), known_.end(), path) != known_.end()) continue;
    const std::string hint = did_you_mean(path, known_);
    say(fmt::format("unknown option \"{}\"{}", path, hint.empty() ? "; known: " + quoted_list(known_) : hint));
  }
  if (!diagnostics_.empty()) throw InputError(diagnostics_);
}

}  // namespace mortise
