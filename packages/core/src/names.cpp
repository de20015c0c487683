#include "mortise/core/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace mortise {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row[b.size()];
}

/// Bytes of a name for files. File systems take 255; what is put before and behind a name has room too.
constexpr std::size_t longest_file_name = 200;

/// Fowler, Noll and Vo's hash (FNV-1a), the same on every machine.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3;
  return hash;
}

}  // namespace

std::string name_for_files(std::string text) {
  const std::uint64_t hash = hash_of(text);
  const auto is_allowed = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || std::string("=,._-+").find(c) != std::string::npos;
  };
  std::replace_if(
      text.begin(), text.end(), [&](char c) { return !is_allowed(c); }, '_');
  if (!text.empty() && text.front() == '.') text.front() = '_';
  if (text.size() <= longest_file_name) return text;
  const std::string end = fmt::format("-{:016x}", hash);
  return text.substr(0, longest_file_name - end.size()) + end;
}

std::string without_control_characters(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]), next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool is_unicode_control = byte == 0xC2 && 0x80 <= next && next < 0xA0;  // of two bytes in UTF-8
    result += byte < 0x20 || byte == 0x7F || is_unicode_control ? '?' : text[i];
    if (is_unicode_control) ++i;
  }
  return result;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates) {
  std::size_t best = name.size() / 3 + 2;
  std::string closest;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best) {
      best = distance;
      closest = candidate;
    }
  }
  return closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest);
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  const std::string hint = did_you_mean(name, known);
  const std::string all = known.empty() ? "there is none" : "there are: " + quoted_list(known);
  return fmt::format("there is no {} \"{}\"{}", what, name, hint.empty() ? "; " + all : hint + " T" + all.substr(1));
}

}  // namespace mortise
