#include "mortise/io/line_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>

#include "files/file_descriptor.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

std::string without_line_end(const std::string& line) { return line.substr(0, line.find_last_not_of('\n') + 1); }

}  // namespace

LineFile::LineFile(RCP<const Communicator> comm, std::string path, const std::string& header)
    : comm_(std::move(comm)), path_(std::move(path)), file_(std::make_unique<FileDescriptor>()) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = file_->open(path_, O_WRONLY | O_CREAT | O_TRUNC);
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);
  append(header);
}

LineFile::LineFile(RCP<const Communicator> comm, std::string path, const std::string& header, std::uintmax_t continue_at)
    : comm_(std::move(comm)), path_(std::move(path)), file_(std::make_unique<FileDescriptor>()), size_(continue_at), is_cut_(false) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = check(header);
  throw_if_any_file_error(*comm_, "cannot continue", path_, reason);
}

LineFile::~LineFile() = default;

std::optional<std::string> LineFile::check(const std::string& header) {
  std::uintmax_t size = 0;
  std::string begin, before;
  if (auto reason = file_->open(path_, O_RDWR | O_NOFOLLOW)) return reason;
  if (auto reason = file_->size(size)) return reason;
  if (size < size_)
    return fmt::format("it has {} bytes, but the run that is continued had written {}; an earlier checkpoint may fit (--restart STEP)", size, size_);
  if (size_ < header.size()) return fmt::format("its first {} bytes are less than its header line, which takes {}", size_, header.size());
  if (auto reason = file_->read(begin, header.size(), 0)) return reason;
  if (begin != header) return fmt::format("its columns are \"{}\", but this run writes \"{}\"", without_line_end(begin), without_line_end(header));
  if (size_ > 0)
    if (auto reason = file_->read(before, 1, size_ - 1)) return reason;
  if (size_ > 0 && before != "\n") return fmt::format("a line goes on at byte {}, where rows are to be added", size_);
  return {};
}

void LineFile::cut() {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0 && !is_cut_) reason = file_->resize(size_);
  is_cut_ = true;
  throw_if_any_file_error(*comm_, "cannot continue", path_, reason);
}

void LineFile::append(const std::string& lines) {
  if (!is_cut_) cut();
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

std::uintmax_t LineFile::size() const {
  auto bytes = static_cast<long long>(size_);
  Teuchos::broadcast(*comm_, 0, Teuchos::outArg(bytes));
  return static_cast<std::uintmax_t>(bytes);
}

void LineFile::sync() const {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = file_->sync();
  throw_if_any_file_error(*comm_, "cannot write to the disk", path_, reason);
}

}  // namespace mortise
