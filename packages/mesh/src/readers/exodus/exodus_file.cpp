#include "readers/exodus/exodus_file.hpp"

#include <exodusII.h>
#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <utility>

#include "readers/exodus/exodus_check.hpp"
#include "readers/file_cells.hpp"

namespace mortise {
namespace {

/// Exodus' library looks its blocks and sets up one by one: with more of them a file would take days.
constexpr std::int64_t most_blocks_or_sets = 100000;

}  // namespace

ExodusFile::ExodusFile(std::string path) : path_(std::move(path)) {
  check_exodus_file(path_);
  ex_opts(0);  // it prints nothing
  int word_bytes = sizeof(double), file_word_bytes = 0;
  float version = 0.0F;
  id_ = ex_open(path_.c_str(), EX_READ | EX_ALL_INT64_API, &word_bytes, &file_word_bytes, &version);
  if (id_ < 0) refuse(fmt::format("it cannot be read as Exodus II ({}); is it cut off, or of another kind?", nc_strerror(exerrval)));
  try {
    std::array<char, MAX_LINE_LENGTH + 1> title{};
    require(ex_get_init(id_, title.data(), &dimension_, &nodes_, &elements_, &blocks_, &node_sets_, &side_sets_),
            "the numbers of nodes and elements");
    if (dimension_ < 1 || dimension_ > 3) refuse(fmt::format("the number of coordinates (num_dim) is {}, outside of 1 to 3", dimension_));
    const auto require_count = [&](std::int64_t count, const char* what, std::int64_t most) {
      if (count < 0 || count > most) refuse(fmt::format("the number of {} is {}, outside of 0 to {}", what, count, most));
    };
    require_count(nodes_, "nodes", most_indices);
    require_count(elements_, "elements", most_indices);
    require_count(blocks_, "element blocks", most_blocks_or_sets);
    require_count(node_sets_, "node sets", most_blocks_or_sets);
    require_count(side_sets_, "side sets", most_blocks_or_sets);
  } catch (...) {
    ex_close(id_);
    throw;
  }
}

ExodusFile::~ExodusFile() { ex_close(id_); }

void ExodusFile::refuse(const std::string& message) const { throw InputError({path_, 0, ""}, message); }

void ExodusFile::require(int status, const std::string& what) const {
  if (status < 0) refuse(fmt::format("{} cannot be read ({}): the file is damaged or cut off", what, nc_strerror(exerrval)));
}

// The library takes a variable with netCDF's number 0 for one that is missing, and leaves out what is missing: so the variables are asked for by
// name.
void ExodusFile::read_coordinates(std::int64_t first, std::int64_t count, int component, double* values) const {
  const char letter = "xyz"[component];
  const auto what = [&] { return fmt::format("the coordinates {} of nodes {} to {}", letter, first + 1, first + count); };
  const auto check = [&](int status) {
    if (status != NC_NOERR) refuse(fmt::format("{} cannot be read ({}): the file is damaged or cut off", what(), nc_strerror(status)));
  };
  const auto begin = static_cast<std::size_t>(first), length = static_cast<std::size_t>(count);
  int variable = 0;
  if (nc_inq_varid(id_, (std::string("coord") + letter).c_str(), &variable) == NC_NOERR) {
    check(nc_get_vara_double(id_, variable, &begin, &length, values));
    return;
  }
  if (const int status = nc_inq_varid(id_, "coord", &variable); status != NC_NOERR)  // as files had it before version 2.03
    refuse(fmt::format("{} are missing: there is neither a variable \"coord{}\" nor \"coord\"", what(), letter));
  const std::array<std::size_t, 2> start{static_cast<std::size_t>(component), begin}, shape{1, length};
  check(nc_get_vara_double(id_, variable, start.data(), shape.data(), values));
}

std::vector<std::int64_t> ExodusFile::ids(int kind, std::int64_t count, const std::string& what) const {
  std::vector<std::int64_t> ids(static_cast<std::size_t>(count));
  if (count > 0) require(ex_get_ids(id_, static_cast<ex_entity_type>(kind), ids.data()), "the numbers of " + what);
  std::vector<std::int64_t> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  const auto same = std::adjacent_find(sorted.begin(), sorted.end());
  if (same != sorted.end()) refuse(fmt::format("the number {} stands twice among those of {}", *same, what));
  return ids;
}

std::string ExodusFile::name(int kind, std::int64_t id) const {
  const std::int64_t longest = std::max<std::int64_t>(ex_inquire_int(id_, EX_INQ_DB_MAX_ALLOWED_NAME_LENGTH), MAX_STR_LENGTH);
  ex_set_max_name_length(id_, static_cast<int>(std::min<std::int64_t>(longest, NC_MAX_NAME)));
  std::array<char, NC_MAX_NAME + 1> text{};
  if (ex_get_name(id_, static_cast<ex_entity_type>(kind), id, text.data()) < 0) return {};
  std::string name(text.data());
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
}

}  // namespace mortise
