#pragma once
// The numbers of a Gmsh file, whether they are written as text or as bytes.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "readers/byte_stream.hpp"
#include "readers/file_cells.hpp"

namespace mortise {

/// Reads one number after the other. Anything else ends the reading with an error that says where, of what and what was expected.
class GmshNumbers {
 public:
  GmshNumbers(ByteStream& stream, FileErrors& errors) : stream_(stream), errors_(errors) {}

  /// Sets the format of numbers from here on.
  void set_encoding(bool binary, bool swapped, bool wide_labels) { binary_ = binary, swapped_ = swapped, wide_ = wide_labels; }
  bool binary() const { return binary_; }
  ByteStream& stream() { return stream_; }

  /// Sets the subject of errors from here on: "node", 7. The text lives longer than this.
  void about(const char* kind, std::int64_t label) { kind_ = kind, label_ = label; }
  /// Where the next number stands: a line of text, or a byte.
  std::int64_t spot();
  Place place_at(std::int64_t spot) const { return place_of_line(stream_.path(), binary_ ? 0 : spot); }
  /// "byte 17: ", or nothing for text.
  std::string prefix(std::int64_t spot) const;
  /// Reports an error at a spot; reading goes on, or ends.
  void error_at(std::int64_t spot, const std::string& message) { errors_.add(place_at(spot), prefix(spot) + message); }
  [[noreturn]] void stop_at(std::int64_t spot, const std::string& message) { errors_.stop(place_at(spot), prefix(spot) + message); }

  /// An `int` of Gmsh. `what` is what it means.
  std::int64_t whole(const char* what);
  /// A `size_t` of Gmsh; none above 2^63 - 1 is taken.
  std::int64_t size(const char* what);
  /// The label of a node in the connectivity: an `int` in version 2.2, a `size_t` in 4.1.
  std::int64_t label(const char* what) { return wide_ ? size(what) : whole(what); }
  /// A finite number.
  double real(const char* what);
  /// A count (a `size_t`) of things that take so many bytes each at least, as text and as bytes: the rest of the file has room for them.
  std::int64_t count(const char* what, std::int64_t bytes_of_text, std::int64_t bytes);
  /// Refuses a count for which the rest of the file has no room, or more than indices can tell apart.
  void require_room(std::int64_t count, const char* what, std::int64_t spot, std::int64_t bytes_of_text, std::int64_t bytes);
  /// The next word of text, behind blanks and ends of lines; empty at the end of the file.
  std::string_view word();

 private:
  template <class Number>
  Number bytes_of_number(const char* what);
  std::int64_t whole_word(const char* what);
  std::string subject() const;
  [[noreturn]] void expected(const char* what, std::int64_t spot, std::string_view found);

  ByteStream& stream_;
  FileErrors& errors_;
  bool binary_ = false, swapped_ = false, wide_ = false;
  const char* kind_ = nullptr;
  std::int64_t label_ = 0, word_line_ = 0;
  std::array<char, 64> word_{};
};

}  // namespace mortise
