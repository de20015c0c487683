#include "readers/byte_stream.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

namespace mortise {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18;  ///< also the longest line

[[noreturn]] void refuse_to_read(const std::string& path, const std::string& reason) {
  throw FileError(fmt::format("{}: cannot be read: {}", path, reason));
}

}  // namespace

Place place_of_line(const std::string& file, std::int64_t line) {
  return {file, static_cast<int>(std::min<std::int64_t>(line, std::numeric_limits<int>::max())), ""};
}

ByteStream::ByteStream(std::string path) : path_(std::move(path)), file_(nullptr, std::fclose), buffer_(buffer_bytes) {
  // Before it is opened: to open a pipe may block without end.
  struct stat status {};
  if (stat(path_.c_str(), &status) != 0) refuse_to_read(path_, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) refuse_to_read(path_, S_ISDIR(status.st_mode) ? "it is a directory" : "it is no regular file");
  size_ = status.st_size;
  file_.reset(std::fopen(path_.c_str(), "rb"));
  if (!file_) refuse_to_read(path_, std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
}

bool ByteStream::fill() {
  if (at_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
    begin_ += static_cast<std::int64_t>(at_);
    end_ -= at_;
    at_ = 0;
  }
  errno = 0;
  const std::size_t count = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (count == 0 && std::ferror(file_.get())) refuse_to_read(path_, errno != 0 ? std::strerror(errno) : "its reading ended with an error");
  end_ += count;
  return count > 0;
}

bool ByteStream::read(void* to, std::size_t bytes) {
  char* out = static_cast<char*>(to);
  while (bytes > 0) {
    if (at_ == end_ && !fill()) return false;
    const std::size_t part = std::min(bytes, end_ - at_);
    std::memcpy(out, buffer_.data() + at_, part);
    at_ += part;
    out += part;
    bytes -= part;
  }
  return true;
}

void ByteStream::skip_byte_order_mark() {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  while (end_ - at_ < mark.size() && fill()) continue;
  if (std::string_view(buffer_.data() + at_, std::min(end_ - at_, mark.size())) == mark) at_ += mark.size();
}

bool ByteStream::next_line(std::string_view& line) {
  std::size_t searched = 0;
  for (;;) {
    const std::string_view there(buffer_.data() + at_, end_ - at_);
    const auto is_end = [](char c) { return c == '\n' || c == '\r'; };
    const auto end =
        static_cast<std::size_t>(std::find_if(there.begin() + static_cast<std::ptrdiff_t>(searched), there.end(), is_end) - there.begin());
    const bool may_be_half = end + 1 == there.size() && there[end] == '\r' && there.size() < buffer_.size() && left() > std::int64_t(there.size());
    if (end < there.size() && !may_be_half) {
      line = there.substr(0, end);
      at_ += end + (there.substr(end, 2) == "\r\n" ? 2 : 1);
      ++lines_ended_;
      return true;
    }
    searched = end;
    if (there.size() == buffer_.size())
      throw InputError(place_of_line(path_, this->line()), fmt::format("a line of more than {} bytes: the file is no text", there.size()));
    if (fill()) continue;
    if (there.empty()) return false;
    line = there.substr(0, end);
    at_ = end_;
    return true;
  }
}

}  // namespace mortise
