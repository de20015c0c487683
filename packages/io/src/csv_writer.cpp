#include "mortise/io/csv_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>

#include "file_descriptor.hpp"
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

std::string without_end(const std::string& line) { return line.substr(0, line.find('\n')); }

}  // namespace

CsvWriter::CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns)
    : comm_(std::move(comm)), path_(std::move(path)), columns_(columns.size()), file_(std::make_unique<FileDescriptor>()) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = file_->open(path_, O_WRONLY | O_CREAT | O_TRUNC);
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);
  append(joined(columns, quoted));
}

CsvWriter::CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns, std::uintmax_t continue_at)
    : comm_(std::move(comm)), path_(std::move(path)), columns_(columns.size()), file_(std::make_unique<FileDescriptor>()), size_(continue_at) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = cut(joined(columns, quoted));
  throw_if_any_file_error(*comm_, "cannot continue", path_, reason);
}

CsvWriter::~CsvWriter() = default;

std::optional<std::string> CsvWriter::cut(const std::string& header) {
  std::uintmax_t size = 0;
  std::string begin, before;
  if (auto reason = file_->open(path_, O_RDWR)) return reason;
  if (auto reason = file_->size(size)) return reason;
  if (size < size_) return fmt::format("it has {} bytes, but the run that is continued had written {}", size, size_);
  if (size_ < header.size()) return fmt::format("its first {} bytes are less than its header line, which takes {}", size_, header.size());
  if (auto reason = file_->read(begin, header.size(), 0)) return reason;
  if (begin != header) return fmt::format("its columns are \"{}\", but this run writes \"{}\"", without_end(begin), without_end(header));
  if (auto reason = file_->read(before, 1, size_ - 1)) return reason;
  if (before != "\n") return fmt::format("a line goes on at byte {}, where rows are to be added", size_);
  return file_->resize(size_);
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
  append(lines);
}

void CsvWriter::append(const std::string& lines) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) {
    reason = file_->write(lines.data(), lines.size(), size_);
    if (reason)
      file_->resize(size_);  // no half line stays; if this fails as well, the first reason is the one to tell
    else
      size_ += lines.size();
  }
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);
}

std::uintmax_t CsvWriter::size() const {
  auto bytes = static_cast<long long>(size_);
  Teuchos::broadcast(*comm_, 0, Teuchos::outArg(bytes));
  return static_cast<std::uintmax_t>(bytes);
}

void CsvWriter::sync() const {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = file_->sync();
  throw_if_any_file_error(*comm_, "cannot write to the disk", path_, reason);
}

}  // namespace mortise
