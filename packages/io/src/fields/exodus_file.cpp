#include "mortise/io/exodus_file.hpp"

#include <exodusII.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "fields/exodus_shapes.hpp"
#include "fields/stored_run.hpp"
#include "fields/xdmf.hpp"
#include "hdf5/hdf5_rows.hpp"
#include "mortise/core/error.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

constexpr int longest_name = 255;  ///< of the format beneath

/// A component of a field as a variable.
struct ExodusVariable {
  std::string name, field;
  int column;
};

/// Components of a field that a model of this dimension has, with the ends of their names.
std::vector<std::pair<int, std::string>> components_of(FieldKind kind, int dimension) {
  if (kind == FieldKind::vector)
    return dimension == 3 ? std::vector<std::pair<int, std::string>>{{0, "_x"}, {1, "_y"}, {2, "_z"}}
                          : std::vector<std::pair<int, std::string>>{{0, "_x"}, {1, "_y"}};
  if (kind == FieldKind::symmetric_tensor)
    return dimension == 3 ? std::vector<std::pair<int, std::string>>{{0, "_xx"}, {3, "_yy"}, {5, "_zz"}, {1, "_xy"}, {4, "_yz"}, {2, "_zx"}}
                          : std::vector<std::pair<int, std::string>>{{0, "_xx"}, {3, "_yy"}, {5, "_zz"}, {1, "_xy"}};
  return {{0, ""}};
}

/// Variables of all fields with this center, in the order in which steps name them first.
std::vector<ExodusVariable> variables_of(const StoredRun& run, Field::Center center) {
  std::vector<ExodusVariable> variables;
  for (const StoredStep& step : run.steps())
    for (const StoredField& field : step.fields) {
      const bool is_known = std::any_of(variables.begin(), variables.end(), [&](const ExodusVariable& one) { return one.field == field.name; });
      if (field.center != center || is_known) continue;
      for (const auto& [column, ending] : components_of(field.kind, run.dimension())) variables.push_back({field.name + ending, field.name, column});
    }
  return variables;
}

std::string cut_to(const std::string& text, std::size_t size) { return text.substr(0, size); }

/// An Exodus file in the making, which goes with this object unless it is completed.
class ExodusWriter {
 public:
  ExodusWriter(const StoredRun& run, std::string file)
      : run_(run),
        file_(std::move(file)),
        part_(file_ + ".part"),
        nodal_(variables_of(run, Field::Center::node)),
        elemental_(variables_of(run, Field::Center::cell)) {
    ex_opts(0);  // the reason goes into an exception
    int in_memory = sizeof(double), in_file = sizeof(double);
    id_ = ex_create(part_.c_str(), EX_CLOBBER | EX_LARGE_MODEL, &in_memory, &in_file);
    check(id_);
  }
  ~ExodusWriter() {
    if (id_ >= 0) ex_close(id_);
    std::error_code ignored;
    if (!complete_) std::filesystem::remove(part_, ignored);
  }
  ExodusWriter(const ExodusWriter&) = delete;
  ExodusWriter& operator=(const ExodusWriter&) = delete;

  ExodusContent write() {
    write_head();
    write_nodes();
    write_elements();
    name_variables(EX_NODAL, nodal_);
    name_variables(EX_ELEM_BLOCK, elemental_);
    int number = 0;
    for (const StoredStep& step : run_.steps()) {
      ++number;
      check(ex_put_time(id_, number, &step.time));
      for (std::size_t v = 0; v < nodal_.size(); ++v) write_nodal(step, number, static_cast<int>(v) + 1, nodal_[v]);
      for (std::size_t v = 0; v < elemental_.size(); ++v) write_elemental(step, number, static_cast<int>(v) + 1, elemental_[v]);
    }
    complete();
    return {run_.nodes(),
            run_.elements(),
            static_cast<int>(run_.blocks().size()),
            number,
            static_cast<int>(nodal_.size()),
            static_cast<int>(elemental_.size())};
  }

 private:
  void check(int result) const {
    if (result >= 0) return;
    const char *message = nullptr, *function = nullptr;
    int code = 0;
    ex_get_err(&message, &function, &code);
    const std::string reason = code > 0 && code < EX_MSG ? std::strerror(code) : message != nullptr ? message : "";
    throw FileError(fmt::format("cannot write {}: {}", file_, reason.empty() ? "the Exodus library gives no reason" : reason));
  }

  void write_head() {
    std::size_t longest = 32;
    for (const StoredBlock& block : run_.blocks()) longest = std::max(longest, block.name.size());
    for (const auto* variables : {&nodal_, &elemental_})
      for (const ExodusVariable& one : *variables) longest = std::max(longest, one.name.size());
    check(ex_set_max_name_length(id_, static_cast<int>(std::min<std::size_t>(longest, longest_name))));
    const std::string title = cut_to("mortise: " + std::filesystem::path(run_.path("")).parent_path().filename().string(), MAX_LINE_LENGTH);
    check(ex_put_init(id_, title.c_str(), run_.dimension(), run_.nodes(), run_.elements(), static_cast<int>(run_.blocks().size()), 0, 0));
  }

  void write_nodes() {
    const Hdf5Rows coordinates(run_.path(mesh_file), "coordinates");
    if (coordinates.columns() != 3) throw FileError(run_.path(mesh_file) + " is damaged: its nodes do not have 3 coordinates");
    for (long long first = 0; first < run_.nodes(); first += chunk_rows) {
      const long long count = std::min(chunk_rows, run_.nodes() - first);
      const auto x = coordinates.numbers(first, count, 0), y = coordinates.numbers(first, count, 1), z = coordinates.numbers(first, count, 2);
      check(ex_put_partial_coord(id_, first + 1, count, x.data(), y.data(), run_.dimension() == 3 ? z.data() : nullptr));
    }
    char x[] = "x", y[] = "y", z[] = "z";
    char* names[] = {x, y, z};
    check(ex_put_coord_names(id_, names));
  }

  void write_elements() {
    for (std::size_t b = 0; b < run_.blocks().size(); ++b) {
      const StoredBlock& block = run_.blocks()[b];
      check(ex_put_block(id_, EX_ELEM_BLOCK, block_id(b), exodus_name(block.shape, run_.dimension()).c_str(), block.elements,
                         topology(block.shape).nodes, 0, 0, 0));
      check(ex_put_name(id_, EX_ELEM_BLOCK, block_id(b), cut_to(block.name, longest_name).c_str()));
    }
    run_.visit_elements([&](std::size_t b, const std::vector<long long>& nodes, long long first_id) {
      const std::vector<int> order = exodus_order(run_.blocks()[b].shape);
      const auto width = order.size();
      std::vector<int> connectivity(nodes.size()), ids(nodes.size() / width);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        connectivity[i] = static_cast<int>(nodes[i / width * width + static_cast<std::size_t>(order[i % width])]) + 1;
      for (std::size_t e = 0; e < ids.size(); ++e) ids[e] = static_cast<int>(first_id) + static_cast<int>(e) + 1;
      const auto count = static_cast<long long>(ids.size());
      check(ex_put_partial_elem_conn(id_, block_id(b), first_id - run_.blocks()[b].first + 1, count, connectivity.data()));
      check(ex_put_partial_id_map(id_, EX_ELEM_MAP, first_id + 1, count, ids.data()));
    });
  }

  static int block_id(std::size_t block) { return static_cast<int>(block) + 1; }

  void name_variables(ex_entity_type type, const std::vector<ExodusVariable>& variables) {
    if (variables.empty()) return;
    check(ex_put_variable_param(id_, type, static_cast<int>(variables.size())));
    for (std::size_t v = 0; v < variables.size(); ++v) check(ex_put_variable_name(id_, type, static_cast<int>(v) + 1, variables[v].name.c_str()));
    if (type != EX_ELEM_BLOCK) return;
    std::vector<int> all(run_.blocks().size() * variables.size(), 1);
    check(ex_put_truth_table(id_, type, static_cast<int>(run_.blocks().size()), static_cast<int>(variables.size()), all.data()));
  }

  /// The variable's values in a step; none if the step does not have its field.
  std::unique_ptr<const Hdf5Rows> values_of(const StoredStep& step, const ExodusVariable& variable) const {
    const bool is_there = std::any_of(step.fields.begin(), step.fields.end(), [&](const StoredField& field) { return field.name == variable.field; });
    return is_there ? std::make_unique<const Hdf5Rows>(run_.path(step_file(step.step)), variable.field) : nullptr;
  }

  static std::vector<double> chunk_of(const std::unique_ptr<const Hdf5Rows>& values, long long first, long long count, int column) {
    return values ? values->numbers(first, count, column)
                  : std::vector<double>(static_cast<std::size_t>(count), std::numeric_limits<double>::quiet_NaN());
  }

  void write_nodal(const StoredStep& step, int number, int variable, const ExodusVariable& of) {
    const auto values = values_of(step, of);
    for (long long first = 0; first < run_.nodes(); first += chunk_rows) {
      const long long count = std::min(chunk_rows, run_.nodes() - first);
      check(ex_put_partial_var(id_, number, EX_NODAL, variable, 1, first + 1, count, chunk_of(values, first, count, of.column).data()));
    }
  }

  void write_elemental(const StoredStep& step, int number, int variable, const ExodusVariable& of) {
    const auto values = values_of(step, of);
    for (std::size_t b = 0; b < run_.blocks().size(); ++b) {
      const StoredBlock& block = run_.blocks()[b];
      for (long long first = 0; first < block.elements; first += chunk_rows) {
        const long long count = std::min(chunk_rows, block.elements - first);
        check(ex_put_partial_var(id_, number, EX_ELEM_BLOCK, variable, block_id(b), first + 1, count,
                                 chunk_of(values, block.first + first, count, of.column).data()));
      }
    }
  }

  void complete() {
    const int id = std::exchange(id_, -1);
    check(ex_close(id));
    std::error_code error;
    std::filesystem::rename(part_, file_, error);
    if (error) throw FileError(fmt::format("cannot write {}: {}", file_, error.message()));
    complete_ = true;
  }

  const StoredRun& run_;
  std::string file_, part_;
  std::vector<ExodusVariable> nodal_, elemental_;
  int id_ = -1;
  bool complete_ = false;
};

}  // namespace

ExodusContent write_exodus(const std::string& run, const std::function<std::string()>& file) {
  const StoredRun stored(run);
  if (std::max(stored.nodes(), stored.elements()) >= std::numeric_limits<int>::max())
    throw FileError(fmt::format("{}: {} nodes and {} elements are more than an Exodus file with numbers of 32 bits holds", run, stored.nodes(),
                                stored.elements()));
  return ExodusWriter(stored, file()).write();
}

}  // namespace mortise
