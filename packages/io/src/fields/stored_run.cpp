#include "fields/stored_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "fields/xdmf.hpp"
#include "hdf5/hdf5_rows.hpp"
#include "mortise/core/error.hpp"

namespace mortise {
namespace {

/// The shape of this number in a mixed topology.
std::optional<CellShape> shape_of_number(long long number) {
  std::optional<CellShape> found;
  visit_each_cell([&](auto cell) {
    using Cell = decltype(cell);
    if (Cell::xdmf_number == number) found = shape_of<Cell>;
  });
  return found;
}

/// Numbers one after the other, read in chunks.
class Numbers {
 public:
  Numbers(const std::string& path, const std::string& dataset) : rows_(path, dataset) {}
  bool at_end() const { return first_ + static_cast<long long>(at_) >= rows_.rows(); }
  long long size() const { return rows_.rows(); }
  long long next() {
    if (at_ == chunk_.size()) {
      first_ += static_cast<long long>(chunk_.size());
      chunk_ = rows_.whole_numbers(first_, std::min(chunk_rows, rows_.rows() - first_));
      at_ = 0;
    }
    return chunk_[at_++];
  }

 private:
  Hdf5Rows rows_;
  long long first_ = 0;
  std::vector<long long> chunk_;
  std::size_t at_ = 0;
};

}  // namespace

StoredRun::StoredRun(std::string directory) : directory_(std::move(directory)) {
  std::error_code error;
  if (!std::filesystem::is_directory(directory_, error))
    throw FileError(directory_ + ": there is no such directory; please give the directory of the results of a run");
  if (!std::filesystem::exists(path(mesh_file), error))
    throw FileError(
        fmt::format("{} holds no fields ({} is missing): either it is no directory of results, or the run wrote no fields", directory_, mesh_file));
  read_mesh();
  read_steps();
}

void StoredRun::read_mesh() {
  const std::string file = path(mesh_file);
  nodes_ = Hdf5Rows(file, "coordinates").rows();
  elements_ = Hdf5Rows(file, "body").rows();
  std::vector<std::string> names;
  read_body_names(path("fields.xdmf"), names);  // what cannot be read of them are numbers
  Numbers topology(file, "topology"), body(file, "body");
  const auto damaged = [&](const std::string& why) { throw FileError(fmt::format("{} is damaged: {}; please run the scene again", file, why)); };
  for (long long element = 0; element < elements_; ++element) {
    if (topology.at_end()) damaged(fmt::format("its topology ends before element {} of {}", element, elements_));
    const long long number = topology.next(), of = body.next();
    const auto shape = shape_of_number(number);
    if (!shape) damaged(fmt::format("element {} has the shape {}, which is none that a run writes", element, number));
    if (of < 0 || of >= elements_) damaged(fmt::format("element {} has the body {}", element, of));
    if (blocks_.empty() || blocks_.back().body != static_cast<int>(of) || blocks_.back().shape != *shape) {
      const std::string name = of < static_cast<long long>(names.size()) ? names[static_cast<std::size_t>(of)] : fmt::format("body {}", of);
      blocks_.push_back({name, static_cast<int>(of), *shape, element, 0});
    }
    ++blocks_.back().elements;
    dimension_ = std::max(dimension_, mortise::topology(*shape).dimension);
    if (*shape == CellShape::line2 && (topology.at_end() || topology.next() != 2)) damaged(fmt::format("element {} is no line of 2 nodes", element));
    for (int a = 0; a < mortise::topology(*shape).nodes; ++a) {
      if (topology.at_end()) damaged(fmt::format("its topology ends within element {}", element));
      if (const long long node = topology.next(); node < 0 || node >= nodes_)
        damaged(fmt::format("element {} has the node {}, but there are {}", element, node, nodes_));
    }
  }
  if (!topology.at_end()) damaged(fmt::format("its topology goes on after element {}", elements_ - 1));
  name_blocks();
}

// The first block of a body has the name of the body, the others one with a number that no body and no other block has.
void StoredRun::name_blocks() {
  std::set<std::string> taken;
  for (const StoredBlock& block : blocks_) taken.insert(block.name);
  std::set<int> bodies;
  for (StoredBlock& block : blocks_) {
    if (bodies.insert(block.body).second) continue;
    const std::string body = block.name;
    for (int n = 2; !taken.insert(block.name).second; ++n) block.name = fmt::format("{} ({})", body, n);
  }
}

void StoredRun::visit_elements(const Visitor& visit) const {
  Numbers topology(path(mesh_file), "topology");
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const StoredBlock& block = blocks_[b];
    const int head = block.shape == CellShape::line2 ? 2 : 1, width = mortise::topology(block.shape).nodes;
    std::vector<long long> nodes;
    long long first = block.first;
    for (long long element = block.first; element < block.first + block.elements; ++element) {
      for (int skipped = 0; skipped < head; ++skipped) topology.next();
      for (int a = 0; a < width; ++a) nodes.push_back(topology.next());
      if (static_cast<long long>(nodes.size()) < chunk_rows && element + 1 < block.first + block.elements) continue;
      visit(b, nodes, first);
      nodes.clear();
      first = element + 1;
    }
  }
}

void StoredRun::read_steps() {
  std::vector<int> numbers;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(path(fields_directory), error), end; !error && entry != end; entry.increment(error))
    if (const auto step = step_of_file(fields_directory + "/" + entry->path().filename().string())) numbers.push_back(*step);
  if (error) throw FileError(fmt::format("cannot read {}: {}", path(fields_directory), error.message()));
  if (numbers.empty()) throw FileError(path(fields_directory) + " holds no fields of any step");
  std::sort(numbers.begin(), numbers.end());
  for (const int number : numbers) {
    StoredStep step;
    if (const auto reason = read_step(path(step_file(number)), step))
      throw FileError(fmt::format("cannot read {}: {}; please run the scene again", path(step_file(number)), *reason));
    step.step = number;
    check_rows(step);
    steps_.push_back(step);
  }
}

void StoredRun::check_rows(const StoredStep& step) const {
  const std::string file = path(step_file(step.step));
  for (const StoredField& field : step.fields) {
    const Hdf5Rows values(file, field.name);
    const long long expected = field.center == Field::Center::node ? nodes_ : elements_;
    if (values.rows() != expected || values.columns() != stored_components(field.kind))
      throw FileError(fmt::format("{} is damaged: {} has {} x {} values, but {} x {} are expected; please run the scene again", file, field.name,
                                  values.rows(), values.columns(), expected, stored_components(field.kind)));
  }
}

}  // namespace mortise
