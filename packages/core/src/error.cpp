#include "mortise/core/error.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>

#include "mortise/core/names.hpp"

namespace mortise {
namespace {

/// Characters up to which a text is shown whole, and those that are shown of a longer one.
constexpr std::size_t shown_whole = 120, shown_of_long = 60;

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }  // of UTF-8

/// Whatever a message quotes may be a given text, as long as its author pleases.
std::string with_short_quotes(const std::string& message) {
  std::string text;
  for (std::size_t begin = 0; begin <= message.size();) {
    const std::size_t open = message.find('"', begin), close = open == std::string::npos ? open : message.find('"', open + 1);
    if (close == std::string::npos) return text + message.substr(begin);
    text += message.substr(begin, open - begin) + '"' + shortened(message.substr(open + 1, close - open - 1)) + '"';
    begin = close + 1;
  }
  return text;
}

/// Line breaks are ours, other control characters of a given text.
std::string for_terminals(const std::string& message) {
  std::string text;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = message.find('\n', begin);
    text += without_control_characters(message.substr(begin, end - begin)) + (end == std::string::npos ? "" : "\n");
  }
  return text;
}

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += (text.empty() ? "" : "\n") + to_string(diagnostic);
  return text;
}

std::string broadcast(const Communicator& comm, int root, std::string text) {
  int size = static_cast<int>(text.size());
  Teuchos::broadcast(comm, root, Teuchos::outArg(size));
  text.resize(size);
  Teuchos::broadcast(comm, root, size, text.data());
  return text;
}

int broadcast(const Communicator& comm, int root, int value) {
  Teuchos::broadcast(comm, root, Teuchos::outArg(value));
  return value;
}

}  // namespace

std::string shortened(const std::string& text) {
  const auto characters = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
  if (characters <= shown_whole) return text;
  std::size_t end = 0;
  for (std::size_t shown = 0; shown < shown_of_long || !begins_character(text[end]); ++end) shown += begins_character(text[end]);
  return fmt::format("{}... ({} characters)", text.substr(0, end), characters);
}

std::string to_string(const Diagnostic& diagnostic) {
  const Place& place = diagnostic.place;
  std::string text;
  if (!place.file.empty()) text = place.line > 0 ? fmt::format("{}:{}: ", place.file, place.line) : place.file + ": ";
  text += "error: ";
  if (!place.path.empty()) text += shortened(place.path) + ": ";
  return for_terminals(text + with_short_quotes(diagnostic.message));
}

InputError::InputError(std::vector<Diagnostic> diagnostics) : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

InputError::InputError(Place place, std::string message) : InputError(std::vector<Diagnostic>{{std::move(place), std::move(message)}}) {}

std::string to_string(FailureKind kind) {
  switch (kind) {
    case FailureKind::inverted_element:
      return "inverted element";
    case FailureKind::material:
      return "material";
    case FailureKind::inverted_facet:
      return "inverted facet";
    case FailureKind::projection:
      return "projection";
    case FailureKind::augmentation:
      return "augmentation";
    case FailureKind::unstable:
      return "unstable";
    case FailureKind::step_error:
      return "step error";
    case FailureKind::lost_contact:
      return "lost contact";
    case FailureKind::linear_solver:
      return "linear solver";
    case FailureKind::not_finite:
      return "not finite";
    case FailureKind::out_of_memory:
      return "out of memory";
    case FailureKind::input:
      return "input";
    case FailureKind::line_search:
      return "line search";
    case FailureKind::diverged:
      return "diverged";
    case FailureKind::too_many_iterations:
      return "too many iterations";
    case FailureKind::cycling_active_set:
      return "cycling active set";
  }
  return "unknown";
}

void throw_if_any(const Communicator& comm, const std::optional<StepFailure>& failure) {
  const int mine = failure ? comm.getRank() : comm.getSize();
  int lowest = mine;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(lowest));
  if (lowest == comm.getSize()) return;
  const bool here = lowest == comm.getRank();
  const int kind = broadcast(comm, lowest, here ? static_cast<int>(failure->kind()) : 0);
  throw StepFailure(static_cast<FailureKind>(kind), broadcast(comm, lowest, here ? std::string(failure->what()) : std::string()));
}

void throw_if_any(const Communicator& comm, const std::vector<Diagnostic>& diagnostics) {
  const int mine = static_cast<int>(diagnostics.size());
  int most = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(most));
  if (most == 0) return;
  std::vector<Diagnostic> all;
  std::vector<std::string> seen;
  for (int rank = 0; rank < comm.getSize(); ++rank) {
    const bool here = rank == comm.getRank();
    const int count = broadcast(comm, rank, mine);
    for (int i = 0; i < count; ++i) {
      Diagnostic one = here ? diagnostics[i] : Diagnostic{};
      one.place.file = broadcast(comm, rank, one.place.file);
      one.place.line = broadcast(comm, rank, one.place.line);
      one.place.path = broadcast(comm, rank, one.place.path);
      one.message = broadcast(comm, rank, one.message);
      const std::string text = to_string(one);
      if (std::find(seen.begin(), seen.end(), text) != seen.end()) continue;
      seen.push_back(text);
      all.push_back(std::move(one));
    }
  }
  throw InputError(std::move(all));
}

}  // namespace mortise
