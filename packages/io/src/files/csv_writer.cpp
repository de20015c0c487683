#include "mortise/io/csv_writer.hpp"

#include <fmt/format.h>

#include <optional>

#include "mortise/io/files.hpp"

namespace mortise {
namespace {

/// RFC 4180: text with a comma, a quote or a line break is quoted.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string to_text(const CsvValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return quoted(*text);
  if (const auto* whole = std::get_if<long long>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{}", std::get<double>(value));
}

template <class Values, class Text>
std::string joined(const Values& values, const Text& text) {
  std::string line;
  for (const auto& value : values) line += (&value == &values.front() ? "" : ",") + text(value);
  return line + "\n";
}

}  // namespace

CsvWriter::CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns)
    : lines_(std::move(comm), std::move(path), joined(columns, quoted)), columns_(columns.size()) {}

CsvWriter::CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns, std::uintmax_t continue_at)
    : lines_(std::move(comm), std::move(path), joined(columns, quoted), continue_at), columns_(columns.size()) {}

void CsvWriter::row(const std::vector<CsvValue>& values) { rows({values}); }

void CsvWriter::rows(const std::vector<std::vector<CsvValue>>& rows) {
  std::string lines;
  std::optional<std::string> reason;
  if (lines_.comm()->getRank() == 0)
    for (const auto& row : rows) {
      if (row.size() != columns_) reason = fmt::format("a row of {} values for {} columns", row.size(), columns_);
      lines += joined(row, to_text);
    }
  throw_if_any_file_error(*lines_.comm(), "cannot write", path(), reason);
  lines_.append(lines);
}

}  // namespace mortise
