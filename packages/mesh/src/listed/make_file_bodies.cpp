// Bodies of mesh files on many ranks: rank 0 reads, all know names and sizes.

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <map>

#include "mortise/core/error.hpp"
#include "mortise/mesh/file_body.hpp"

namespace mortise {
namespace {

/// Numbers and texts in the order in which they were put in.
class Letter {
 public:
  void put(long long number) { numbers_.push_back(number); }
  void put(const std::string& text) {
    put(static_cast<long long>(text.size()));
    text_ += text;
  }
  void put(const std::vector<std::string>& texts) {
    put(static_cast<long long>(texts.size()));
    for (const std::string& text : texts) put(text);
  }
  long long number() { return numbers_.at(next_number_++); }
  std::string text() {
    const auto size = static_cast<std::size_t>(number());
    next_character_ += size;
    return text_.substr(next_character_ - size, size);
  }
  std::vector<std::string> texts() {
    std::vector<std::string> result(static_cast<std::size_t>(number()));
    for (std::string& one : result) one = text();
    return result;
  }
  /// From rank 0 to all. Collective.
  void broadcast(const Communicator& comm) {
    int sizes[2] = {static_cast<int>(numbers_.size()), static_cast<int>(text_.size())};
    Teuchos::broadcast(comm, 0, 2, sizes);
    numbers_.resize(static_cast<std::size_t>(sizes[0]));
    text_.resize(static_cast<std::size_t>(sizes[1]));
    if (sizes[0] > 0) Teuchos::broadcast(comm, 0, sizes[0], numbers_.data());
    if (sizes[1] > 0) Teuchos::broadcast(comm, 0, sizes[1], text_.data());
  }

 private:
  std::vector<long long> numbers_;
  std::string text_;
  std::size_t next_number_ = 0, next_character_ = 0;
};

void put_header(Letter& letter, const ListedBody& body) {
  letter.put(body.dimension);
  letter.put(body.nodes);
  letter.put(static_cast<long long>(body.parts.size()));
  for (const BodyPart& part : body.parts) {
    letter.put(part.name);
    letter.put(static_cast<long long>(part.shape));
    letter.put(part.elements);
  }
  for (const auto* texts : {&body.side_names, &body.node_set_names, &body.notes, &body.warnings}) letter.put(*texts);
  letter.put(static_cast<long long>(body.left_out.size()));
  for (const LeftOutSet& set : body.left_out) {
    letter.put(set.name);
    letter.put(set.reason);
  }
}

ListedBody header(Letter& letter) {
  ListedBody body;
  body.dimension = static_cast<int>(letter.number());
  body.nodes = letter.number();
  body.parts.resize(static_cast<std::size_t>(letter.number()));
  for (BodyPart& part : body.parts) {
    part.name = letter.text();
    part.shape = static_cast<CellShape>(letter.number());
    part.elements = letter.number();
  }
  for (auto* texts : {&body.side_names, &body.node_set_names, &body.notes, &body.warnings}) *texts = letter.texts();
  body.left_out.resize(static_cast<std::size_t>(letter.number()));
  for (LeftOutSet& set : body.left_out) {
    set.name = letter.text();
    set.reason = letter.text();
  }
  return body;
}

/// The body of each node of a file.
class NodesOfBodies {
 public:
  explicit NodesOfBodies(const MeshFile& file) : file_(file), first_(file.coordinates.size(), -1) {}

  /// @throws InputError if another body has one of them and neither says that it may
  void take(const FileBodyRequest& request, const std::vector<std::int32_t>& file_nodes) {
    std::int64_t shared = 0;
    std::int32_t example = -1;
    for (const std::int32_t node : file_nodes) {
      std::int32_t& body = first_[static_cast<std::size_t>(node)];
      if (body < 0) {
        body = static_cast<std::int32_t>(requests_.size());
        continue;
      }
      if (request.shares_nodes || requests_[static_cast<std::size_t>(body)]->shares_nodes) continue;
      if (shared++ == 0) example = node;
    }
    requests_.push_back(&request);
    if (shared == 0) return;
    const auto& x = file_.coordinates[static_cast<std::size_t>(example)];
    throw InputError(request.place, fmt::format("bodies \"{}\" and \"{}\" have {} nodes of {} in common, for instance node {} at ({:.6g}, {:.6g}, "
                                                "{:.6g}); please make them one body with "
                                                "\"materials\" of its blocks, or write \"shared nodes\" (string, double), so that each body gets "
                                                "nodes of its own and they can move apart",
                                                requests_[static_cast<std::size_t>(first_[static_cast<std::size_t>(example)])]->name, request.name,
                                                shared, file_.path, file_.node_labels[static_cast<std::size_t>(example)], x[0], x[1], x[2]));
  }

 private:
  const MeshFile& file_;
  std::vector<std::int32_t> first_;  ///< [nodes of the file]
  std::vector<const FileBodyRequest*> requests_;
};

/// On rank 0: each file is read once, for all bodies that are made of it.
std::vector<std::shared_ptr<ListedBody>> read_bodies(const std::vector<FileBodyRequest>& requests, std::vector<Diagnostic>& diagnostics) {
  std::vector<std::shared_ptr<ListedBody>> bodies(requests.size());
  std::vector<char> is_done(requests.size(), 0);
  for (std::size_t first = 0; first < requests.size(); ++first) {
    if (is_done[first]) continue;
    try {
      const auto& made = requests[first].made;
      const MeshFile file = made ? *made : read_mesh_file(requests[first].file, requests[first].format, requests[first].place);
      NodesOfBodies nodes(file);
      for (std::size_t r = first; r < requests.size(); ++r) {
        if (requests[r].file != requests[first].file || requests[r].format != requests[first].format || requests[r].made != made) continue;
        is_done[r] = 1;
        try {
          std::vector<std::int32_t> file_nodes;
          bodies[r] = std::make_shared<ListedBody>(make_file_body(file, requests[r], &file_nodes));
          nodes.take(requests[r], file_nodes);
          if (r == first) bodies[r]->notes.insert(bodies[r]->notes.begin(), file.notes.begin(), file.notes.end());
        } catch (const InputError& error) {
          diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
        }
      }
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    } catch (const FileError& error) {
      diagnostics.push_back({requests[first].place, error.what()});
    }
  }
  return bodies;
}

}  // namespace

std::vector<std::shared_ptr<ListedBody>> make_file_bodies(const Communicator& comm, const std::vector<FileBodyRequest>& requests) {
  if (requests.empty()) return {};
  std::vector<Diagnostic> diagnostics;
  std::vector<std::shared_ptr<ListedBody>> bodies(requests.size());
  if (comm.getRank() == 0) bodies = read_bodies(requests, diagnostics);
  throw_if_any(comm, diagnostics);
  if (comm.getSize() == 1) return bodies;
  Letter letter;
  if (comm.getRank() == 0)
    for (const auto& body : bodies) put_header(letter, *body);
  letter.broadcast(comm);
  if (comm.getRank() != 0)
    for (auto& body : bodies) body = std::make_shared<ListedBody>(header(letter));
  return bodies;
}

}  // namespace mortise
