#include "readers/gmsh/gmsh_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mortise {
namespace {

bool is_blank(int c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::int64_t GmshNumbers::spot() {
  if (binary_) return stream_.offset();
  while (is_blank(stream_.peek())) stream_.get();
  return stream_.line();
}

std::string GmshNumbers::prefix(std::int64_t spot) const { return binary_ ? fmt::format("byte {}: ", spot) : std::string(); }

std::string GmshNumbers::subject() const { return kind_ == nullptr ? std::string() : fmt::format("{} {}: ", kind_, label_); }

void GmshNumbers::expected(const char* what, std::int64_t spot, std::string_view found) {
  stop_at(spot, found.empty() ? fmt::format("{}expected {}, found the end of the file: it is cut off", subject(), what)
                              : fmt::format("{}expected {}, found \"{}\"", subject(), what, found));
}

std::string_view GmshNumbers::word() {
  while (is_blank(stream_.peek())) stream_.get();
  word_line_ = stream_.line();
  std::size_t length = 0;
  for (int c = stream_.peek(); c >= 0 && !is_blank(c) && length < word_.size(); c = stream_.peek())
    word_[length++] = static_cast<char>(stream_.get());
  return {word_.data(), length};
}

std::int64_t GmshNumbers::whole_word(const char* what) {
  const std::string_view text = word();
  const auto value = whole_number_of(text);
  if (!value) expected(what, word_line_, text);
  return *value;
}

template <class Number>
Number GmshNumbers::bytes_of_number(const char* what) {
  std::array<char, sizeof(Number)> bytes;
  const std::int64_t at = stream_.offset();
  if (!stream_.read(bytes.data(), bytes.size())) expected(what, at, {});
  if (swapped_) std::reverse(bytes.begin(), bytes.end());
  Number value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::int64_t GmshNumbers::whole(const char* what) {
  if (binary_) return bytes_of_number<std::int32_t>(what);
  const std::int64_t value = whole_word(what);
  if (value < -most_indices || value > most_indices) stop_at(word_line_, fmt::format("{}{} is {}, beyond {}", subject(), what, value, most_indices));
  return value;
}

std::int64_t GmshNumbers::size(const char* what) {
  const std::int64_t at = spot(), value = binary_ ? bytes_of_number<std::int64_t>(what) : whole_word(what);
  if (value < 0) stop_at(at, fmt::format("{}{} is {}, outside of 0 to 2^63 - 1", subject(), what, value));
  return value;
}

double GmshNumbers::real(const char* what) {
  if (binary_) {
    const std::int64_t at = stream_.offset();
    const auto value = bytes_of_number<double>(what);
    if (!std::isfinite(value)) stop_at(at, fmt::format("{}{} is {}, no finite number", subject(), what, value));
    return value;
  }
  const std::string_view text = word();
  const auto value = real_number_of(text);
  if (!value) expected(what, word_line_, text);
  return *value;
}

void GmshNumbers::require_room(std::int64_t count, const char* what, std::int64_t spot, std::int64_t bytes_of_text, std::int64_t bytes) {
  if (count < 0) stop_at(spot, fmt::format("{} is {}, below 0", what, count));
  if (count > most_indices) stop_at(spot, fmt::format("{} is {}, above {}, the most that is read", what, count, most_indices));
  // The end of the last number may be missing.
  const std::int64_t room = (stream_.left() + 1) / (binary_ ? bytes : bytes_of_text);
  if (count > room)
    stop_at(spot, fmt::format("{} is {}, but the {} bytes that follow have no room for more than {}: the file is cut off, or the number is wrong",
                              what, count, stream_.left(), room));
}

std::int64_t GmshNumbers::count(const char* what, std::int64_t bytes_of_text, std::int64_t bytes) {
  const std::int64_t at = spot(), value = size(what);
  require_room(value, what, at, bytes_of_text, bytes);
  return value;
}

}  // namespace mortise
