#pragma once
// A file's bytes in their order, through a buffer of fixed size.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// Bytes and lines of a regular file.
class ByteStream {
 public:
  /// @throws FileError if there is no such file, if it is no regular file or if it cannot be read
  explicit ByteStream(std::string path);

  /// The next byte, or -1 at the end.
  int get() {
    if (at_ == end_ && !fill()) return -1;
    const auto byte = static_cast<unsigned char>(buffer_[at_++]);
    if (byte == '\n') ++lines_ended_;
    return byte;
  }
  /// The next byte, which stays the next one; -1 at the end.
  int peek() { return at_ == end_ && !fill() ? -1 : static_cast<unsigned char>(buffer_[at_]); }
  /// Copies the next bytes, or returns false if there are not so many.
  bool read(void* to, std::size_t bytes);
  /// The rest of a line without its end, which is LF, CR LF or CR; valid until the next call of any member. Returns false at the end of the file.
  /// @throws InputError if a line is longer than any text has
  bool next_line(std::string_view& line);

  /// Passes over the mark by which some editors begin files in UTF-8. To be called before anything is read.
  void skip_byte_order_mark();

  const std::string& path() const { return path_; }
  std::int64_t size() const { return size_; }                                      ///< bytes of the file
  std::int64_t offset() const { return begin_ + static_cast<std::int64_t>(at_); }  ///< of the next byte, from 0
  std::int64_t left() const { return size_ - offset(); }                           ///< bytes that were not read
  std::int64_t line() const { return lines_ended_ + 1; }                           ///< of the next byte, from 1

 private:
  bool fill();

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;  ///< of the buffer: the next byte, and where what was read ends
  std::int64_t begin_ = 0;        ///< of the buffer in the file
  std::int64_t size_ = 0, lines_ended_ = 0;
};

/// A place in a text file, of which a line number is known that may be larger than that of a Place.
Place place_of_line(const std::string& file, std::int64_t line);

}  // namespace mortise
