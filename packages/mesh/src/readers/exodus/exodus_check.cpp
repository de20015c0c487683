#include "readers/exodus/exodus_check.hpp"

#include <exodusII.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "readers/exodus/netcdf_header.hpp"

namespace mortise {
namespace {

[[noreturn]] void refuse_exodus(const std::string& path, const std::string& message) { throw InputError({path, 0, ""}, message); }

/// netCDF's classic formats begin with CDF and a number, those in HDF5 with HDF5's signature.
void check_begin(const std::string& path) {
  ByteStream stream(path);
  std::array<char, 4> begin{};
  const bool is_whole = stream.read(begin.data(), begin.size());
  const bool is_classic = begin[0] == 'C' && begin[1] == 'D' && begin[2] == 'F' && (begin[3] == 1 || begin[3] == 2 || begin[3] == 5);
  if (!is_whole || (!is_classic && begin != std::array<char, 4>{'\x89', 'H', 'D', 'F'}))
    refuse_exodus(path, "byte 0: expected \"CDF\" or the signature of HDF5, found neither: this is no Exodus II file");
  if (is_classic) check_netcdf_header(stream, begin[3]);
}

/// A variable, or variables with numbers behind their names, and the dimensions that the library reads it by. A # stands for the number.
struct ExpectedVariable {
  const char* name;
  bool numbered;
  std::vector<const char*> dimensions;
};

const std::vector<ExpectedVariable>& expected_variables() {
  static const std::vector<ExpectedVariable> all{{"coordx", false, {"num_nodes"}},
                                                 {"coordy", false, {"num_nodes"}},
                                                 {"coordz", false, {"num_nodes"}},
                                                 {"coord", false, {"num_dim", "num_nodes"}},
                                                 {"connect", true, {"num_el_in_blk#", "num_nod_per_el#"}},
                                                 {"node_num_map", false, {"num_nodes"}},
                                                 {"elem_num_map", false, {"num_elem"}},
                                                 {"eb_status", false, {"num_el_blk"}},
                                                 {"ss_status", false, {"num_side_sets"}},
                                                 {"ns_status", false, {"num_node_sets"}},
                                                 {"eb_prop1", false, {"num_el_blk"}},
                                                 {"ss_prop1", false, {"num_side_sets"}},
                                                 {"ns_prop1", false, {"num_node_sets"}},
                                                 {"elem_ss", true, {"num_side_ss#"}},
                                                 {"side_ss", true, {"num_side_ss#"}},
                                                 {"node_ns", true, {"num_nod_ns#"}},
                                                 {"eb_names", false, {"num_el_blk", nullptr}},
                                                 {"ss_names", false, {"num_side_sets", nullptr}},
                                                 {"ns_names", false, {"num_node_sets", nullptr}}};
  return all;
}

bool all_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// An open file, read for checks alone.
class ExodusCheck {
 public:
  explicit ExodusCheck(const std::string& path) : path_(path) {
    if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id_); status != NC_NOERR)
      refuse_exodus(path_, fmt::format("netCDF cannot read the file ({}); is it cut off, or of another kind?", nc_strerror(status)));
  }
  ~ExodusCheck() { nc_close(id_); }
  ExodusCheck(const ExodusCheck&) = delete;
  ExodusCheck& operator=(const ExodusCheck&) = delete;

  void check() {
    for (const char* name :
         {"version", "api_version", "floating_point_word_size", "file_size", "int64_status", "maximum_name_length", "last_written_time"})
      check_attribute(NC_GLOBAL, "the file", name, 1, false);
    check_attribute(NC_GLOBAL, "the file", "title", MAX_LINE_LENGTH + 1, true);  // some write the 0 at its end too
    int variables = 0;
    require(nc_inq_nvars(id_, &variables), "the number of variables");
    for (int v = 0; v < variables; ++v) check_variable(v);
  }

 private:
  void require(int status, const std::string& what) const {
    if (status != NC_NOERR) refuse_exodus(path_, fmt::format("{} cannot be read ({}): the file is damaged or cut off", what, nc_strerror(status)));
  }

  /// One that is missing is the library's concern.
  void check_attribute(int variable, const std::string& of, const char* name, std::size_t most, bool text) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(id_, variable, name, &type, &length) != NC_NOERR) return;
    if (length > most) refuse_exodus(path_, fmt::format("attribute \"{}\" of {} has length {}, above {}", name, of, length, most));
    if ((type == NC_CHAR) != text || type == NC_STRING || type > NC_STRING)
      refuse_exodus(path_, fmt::format("attribute \"{}\" of {} is not of {}", name, of, text ? "text" : "numbers"));
  }

  void check_variable(int variable) const {
    std::array<char, NC_MAX_NAME + 1> text{};
    require(nc_inq_varname(id_, variable, text.data()), fmt::format("the name of variable {}", variable));
    const std::string name(text.data());
    for (const ExpectedVariable& expected : expected_variables()) {
      const std::string stem(expected.name);
      const std::string number = expected.numbered && name.size() > stem.size() ? name.substr(stem.size()) : std::string();
      if (name.compare(0, stem.size(), stem) == 0 && (expected.numbered ? all_digits(number) : name.size() == stem.size()))
        check_dimensions(variable, name, number, expected);
    }
    check_attribute(variable, name, "elem_type", MAX_STR_LENGTH, true);
    check_attribute(variable, name, "name", MAX_STR_LENGTH, true);
  }

  void check_dimensions(int variable, const std::string& name, const std::string& number, const ExpectedVariable& expected) const {
    nc_type type = NC_NAT;
    int count = 0;
    require(nc_inq_vartype(id_, variable, &type), "the type of " + name);
    require(nc_inq_varndims(id_, variable, &count), "the dimensions of " + name);
    std::vector<int> ids(static_cast<std::size_t>(count));
    require(nc_inq_vardimid(id_, variable, ids.data()), "the dimensions of " + name);
    std::vector<std::string> found;
    for (const int one : ids) {
      std::array<char, NC_MAX_NAME + 1> text{};
      require(nc_inq_dimname(id_, one, text.data()), "the dimensions of " + name);
      found.emplace_back(text.data());
    }
    std::vector<std::string> wanted;
    bool as_wanted = expected.dimensions.size() == found.size();
    for (std::size_t d = 0; d < expected.dimensions.size(); ++d) {
      std::string dimension = expected.dimensions[d] == nullptr ? "(any)" : expected.dimensions[d];
      if (dimension.back() == '#') dimension.replace(dimension.size() - 1, 1, number);
      as_wanted = as_wanted && (expected.dimensions[d] == nullptr || found[d] == dimension);
      wanted.push_back(std::move(dimension));
    }
    if (!as_wanted)
      refuse_exodus(path_,
                    fmt::format("variable \"{}\" has the dimensions ({}); expected are ({})", name, fmt::join(found, ", "), fmt::join(wanted, ", ")));
    const bool is_text = expected.dimensions.back() == nullptr;
    const bool is_number = type != NC_CHAR && type <= NC_UINT64;
    if (is_text ? type != NC_CHAR : !is_number)
      refuse_exodus(path_, fmt::format("variable \"{}\" is not of {} (type {} of netCDF)", name, is_text ? "text" : "numbers", type));
  }

  const std::string& path_;
  int id_ = -1;
};

}  // namespace

void check_exodus_file(const std::string& path) {
  check_begin(path);
  ExodusCheck(path).check();
}

}  // namespace mortise
