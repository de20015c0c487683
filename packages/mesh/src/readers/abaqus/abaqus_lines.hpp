#pragma once
// The lines of an Abaqus input file and of the files that it includes.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readers/byte_stream.hpp"
#include "readers/file_cells.hpp"

namespace mortise {

/// A file and a line of it.
struct AbaqusSpot {
  std::int32_t file = 0, line = 0;
};

/// Gives lines without comments, blank ones and blanks at their ends.
class AbaqusLines {
 public:
  AbaqusLines(const std::string& path, FileErrors& errors);

  /// The next line; valid until the next call. Returns false at the end of the outermost file.
  bool next(std::string_view& line);
  /// Goes on with the lines of this file, which is named relative to the one that names it, and then with those that follow here.
  void include(const std::string& name, AbaqusSpot from);
  AbaqusSpot spot() const { return spot_; }  ///< of the last line
  Place place(AbaqusSpot spot) const { return place_of_line(files_[static_cast<std::size_t>(spot.file)], spot.line); }

 private:
  struct Open {
    std::unique_ptr<ByteStream> stream;
    std::int32_t file;
    std::string canonical;
  };

  FileErrors& errors_;
  std::vector<std::string> files_;  ///< each that was opened
  std::vector<Open> stack_;
  AbaqusSpot spot_;
};

}  // namespace mortise
