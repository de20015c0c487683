// The header of netCDF's classic formats. Entry by entry:
// header   = "CDF" version  records  dimensions  attributes  variables
// list     = 0 0 | tag count entries
// dimension = name length;   attribute = name type count values;   variable = name count dimensions attributes type size begin
// name     = count characters.  Numbers are big-endian, of 4 bytes (counts of 8 bytes in CDF-5, begins of 8 bytes but in CDF-1). Characters and
// values are filled up to whole words of 4 bytes.

#include "readers/exodus/netcdf_header.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace mortise {
namespace {

constexpr std::int64_t longest_netcdf_name = 256, most_netcdf_dimensions = 1024;

class NetcdfHeader {
 public:
  NetcdfHeader(ByteStream& stream, int version) : stream_(stream), count_bytes_(version == 5 ? 8 : 4), offset_bytes_(version == 1 ? 4 : 8) {}

  void check() {
    number(count_bytes_, "the number of records");
    for (std::int64_t n = list(10, "dimensions", 2 * count_bytes_); n > 0; --n) {
      name("a dimension");
      lengths_.push_back(count("the length of a dimension", 0));
    }
    check_attributes();
    for (std::int64_t n = list(11, "variables", 4 * count_bytes_); n > 0; --n) check_variable();
  }

 private:
  [[noreturn]] void refuse(std::int64_t byte, const std::string& message) const {
    throw InputError({stream_.path(), 0, ""}, fmt::format("byte {}: {}", byte, message));
  }

  std::int64_t number(std::int64_t bytes, const char* what) {
    std::array<unsigned char, 8> read{};
    const std::int64_t at = stream_.offset();
    if (!stream_.read(read.data(), static_cast<std::size_t>(bytes)))
      refuse(at, fmt::format("expected {}, found the end of the file: it is cut off", what));
    std::uint64_t value = 0;
    for (std::int64_t b = 0; b < bytes; ++b) value = value << 8 | read[static_cast<std::size_t>(b)];
    return static_cast<std::int64_t>(value);
  }

  /// Of things that take so many bytes of the header each.
  std::int64_t count(const char* what, std::int64_t bytes_each) {
    const std::int64_t at = stream_.offset(), value = number(count_bytes_, what);
    if (value < 0 || (bytes_each > 0 && value > stream_.left() / bytes_each))
      refuse(at, fmt::format("{} is {}, and {} bytes follow: the file is cut off, or damaged", what, value, stream_.left()));
    return value;
  }

  std::int64_t list(std::int64_t tag, const char* what, std::int64_t bytes_each) {
    const std::int64_t at = stream_.offset(), found = number(4, what),
                       entries = count(("the number of entries of the list of " + std::string(what)).c_str(), bytes_each);
    if (found != tag && (found != 0 || entries != 0))
      refuse(at, fmt::format("expected the list of {}, found the number {}: the file is damaged", what, found));
    return entries;
  }

  void skip(std::int64_t bytes) {
    for (std::int64_t b = 0; b < (bytes + 3) / 4 * 4; ++b) stream_.get();
  }

  std::string name(const char* of) {
    const std::int64_t at = stream_.offset(), length = count("the length of a name", 1);
    if (length > longest_netcdf_name) refuse(at, fmt::format("the name of {} has {} characters, above {}", of, length, longest_netcdf_name));
    std::string text(static_cast<std::size_t>(length), '\0');
    stream_.read(text.data(), text.size());
    for (std::int64_t b = length; b % 4 != 0; ++b) stream_.get();
    return text;
  }

  /// Bytes of a value.
  std::int64_t type() {
    constexpr std::array<std::int64_t, 12> bytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const std::int64_t at = stream_.offset(), value = number(4, "a type");
    if (value < 1 || value >= static_cast<std::int64_t>(bytes.size()))
      refuse(at, fmt::format("the number of a type is {}, outside of 1 to 11", value));
    return bytes[static_cast<std::size_t>(value)];
  }

  void check_attributes() {
    for (std::int64_t n = list(12, "attributes", 2 * count_bytes_ + 4); n > 0; --n) {
      name("an attribute");
      const std::int64_t bytes = type();
      skip(bytes * count("the number of values of an attribute", bytes));
    }
  }

  void check_variable() {
    const std::int64_t at = stream_.offset();
    const std::string variable = name("a variable");
    const std::int64_t dimensions = count("the number of dimensions of a variable", count_bytes_);
    if (dimensions > most_netcdf_dimensions)
      refuse(at, fmt::format("variable \"{}\" has {} dimensions, above {}", variable, dimensions, most_netcdf_dimensions));
    // A first dimension of length 0 is that of records, which no mesh has.
    bool of_records = false;
    double values = 1.0;
    for (std::int64_t d = 0; d < dimensions; ++d) {
      const std::int64_t id = number(count_bytes_, "a dimension");
      if (id < 0 || id >= static_cast<std::int64_t>(lengths_.size()))
        refuse(at, fmt::format("variable \"{}\" has dimension {}; the file has {}", variable, id, lengths_.size()));
      const std::int64_t length = lengths_[static_cast<std::size_t>(id)];
      of_records = of_records || (d == 0 && length == 0);
      values *= static_cast<double>(length);
    }
    check_attributes();
    const std::int64_t bytes = type();
    number(count_bytes_, "the size of a variable");
    const std::int64_t begin = number(offset_bytes_, "where a variable begins");
    const double end = static_cast<double>(begin) + values * static_cast<double>(bytes);
    if (begin < 0 || (!of_records && end > static_cast<double>(stream_.size())))
      refuse(at, fmt::format("variable \"{}\" is to stand in bytes {} to {:.0f}, and the file has {}: it is cut off, or damaged", variable, begin,
                             end, stream_.size()));
  }

  ByteStream& stream_;
  std::int64_t count_bytes_, offset_bytes_;
  std::vector<std::int64_t> lengths_;
};

}  // namespace

void check_netcdf_header(ByteStream& stream, int version) { NetcdfHeader(stream, version).check(); }

}  // namespace mortise
