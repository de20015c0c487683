#include "mortise/io/csv_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>

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
    : comm_(std::move(comm)), path_(std::move(path)), columns_(columns.size()) {
  errno = 0;
  if (comm_->getRank() == 0) stream_.open(path_, std::ios::binary | std::ios::trunc);
  write_line(joined(columns, quoted));
}

void CsvWriter::row(const std::vector<CsvValue>& values) { rows({values}); }

void CsvWriter::rows(const std::vector<std::vector<CsvValue>>& rows) {
  std::string lines;
  std::optional<std::string> reason;
  if (comm_->getRank() == 0)
    for (const auto& row : rows) {
      if (row.size() != columns_) reason = fmt::format("a row of {} values for {} columns", row.size(), columns_);
      lines += joined(row, to_text);
    }
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);
  write_line(lines);
}

void CsvWriter::write_line(const std::string& line) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) {
    stream_ << line << std::flush;
    if (!stream_) reason = errno != 0 ? std::strerror(errno) : "it cannot be written";
  }
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);
}

}  // namespace mortise
