#include "mortise/io/output_directory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "files/directory_lock.hpp"
#include "files/directory_marker.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

constexpr const char* another_place = "please choose another directory (-o)";

std::string not_ours(const std::string& name) {
  return fmt::format("{} in it was not made by this program, or by a version of it that kept no list of what it made; {}, or move it away", name,
                     another_place);
}

/// The first of `names` in the directory that is another's.
std::optional<std::string> foreign_among(const std::string& directory, const DirectoryMarker& marker, const std::vector<std::string>& names) {
  for (const auto& name : names)
    for (const auto& one : {name, name + ".part"})
      if (is_foreign(directory, marker, one)) return not_ours(one);
  return {};
}

/// Files that a run of the program, or an earlier version of it, may have made in the directory.
std::vector<std::string> run_files(const std::string& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    if (is_run_file(entry->path().filename().string())) names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The source as the list of a directory has it: relative, in one line.
std::string source_below(const std::string& directory, const std::string& source) {
  if (source.empty()) return {};
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(source, error),
                              base = std::filesystem::weakly_canonical(std::filesystem::absolute(directory), error);
  std::string text = path.lexically_relative(base).string();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

/// The first of the names that has become a symbolic link: what it leads to is another's.
std::optional<std::string> link_among(const std::string& directory, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    std::error_code error;
    if (std::filesystem::is_symlink(std::filesystem::symlink_status(directory + "/" + name, error)))
      return fmt::format("{} in it is a symbolic link, which this program did not make; please put the file in its place", name);
  }
  return {};
}

/// Adds to `made` what it had to make: the directory, and those above it.
std::optional<std::string> make_directory(const std::string& directory, std::vector<std::string>& made) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (fs::path there = fs::absolute(directory).lexically_normal(); !fs::exists(there, error) && there != there.root_path();
       there = there.parent_path())
    made.push_back(there.string());
  fs::create_directories(directory, error);
  return error ? std::optional(error.message()) : std::nullopt;
}

/// Where results would mix with all that a user or the system has.
std::optional<std::string> not_for_results(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path path = fs::weakly_canonical(fs::absolute(directory), error);
  if (!path.has_filename()) path = path.parent_path();  // of "below/.." where there is no "below"
  const char* home = std::getenv("HOME");
  if (path == path.root_path()) return fmt::format("it is the root of the file system; {}", another_place);
  if (home != nullptr && *home != '\0' && path == fs::weakly_canonical(home, error))
    return fmt::format("it is your home directory; {}", another_place);
  return {};
}

/// Why no files could be made in the directory, or why it could not be made. Touches nothing.
std::optional<std::string> not_writable(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path there = fs::absolute(directory, error);
  while (!error && !fs::exists(there, error) && there != there.root_path()) {
    // No directory can be made in the place of a link.
    if (std::error_code none; fs::is_symlink(fs::symlink_status(there, none)))
      return fmt::format(
          "{} is a symbolic link to {}, which does not exist; please make that directory, mend the link, or choose another directory (-o)",
          there.string(), fs::read_symlink(there, none).string());
    there = there.parent_path();
  }
  if (error) return error.message();
  if (!fs::is_directory(there, error)) return fmt::format("{} exists and is not a directory", there.string());
  if (access(there.c_str(), W_OK | X_OK) != 0) return fmt::format("{}: {}", there.string(), std::strerror(errno));
  return {};
}

/// Why results of `origin` are not to go where the results are that the marker tells of.
std::optional<std::string> other_origin(const std::string& directory, const DirectoryMarker& marker, const Origin& origin) {
  const std::string source = source_below(directory, origin.source);
  const auto from_here = [&](const std::string& file) { return (std::filesystem::path(directory) / file).lexically_normal().string(); };
  const auto is_of = [&](const std::string& file) { return file.empty() ? "" : " of " + from_here(file); };
  if (!origin.kind.empty() && !marker.holds.empty() && origin.kind != marker.holds)
    return fmt::format("it holds results of kind \"{}\"{}, and these are of kind \"{}\"; {}, or move it away", marker.holds, is_of(marker.source),
                       origin.kind, another_place);
  if (origin.is_default && !marker.source.empty() && marker.source != source)
    return fmt::format("it holds results of {}, and these are of {}; {}", from_here(marker.source), origin.source, another_place);
  return {};
}

}  // namespace

bool is_run_file(const std::string& name) {
  static const std::array<const char*, 14> names{"steps.jsonl", "summary.json", "newton.csv", "history.csv",   "profiles.csv",
                                                 "fields.xdmf", "fields.h5",    "fields",     "effective.xml", "log.txt",
                                                 "checkpoints", "point.csv",    "point.svg",  "point.png"};
  return std::any_of(names.begin(), names.end(), [&](const char* known) { return name == known || name == std::string(known) + ".part"; });
}

/// Shared state of copies. Only rank 0 reads and writes the marker and holds the lock.
struct OutputDirectory::State {
  RCP<const Communicator> comm;
  std::string path;
  Origin origin;
  bool is_open = false;
  Survives survives = Survives::end_of_program;  ///< of the list, where this is no subdirectory
  std::vector<std::string> made;                 ///< directories that were made for this one, itself included
  DirectoryMarker marker;
  DirectoryLock lock;
  std::shared_ptr<State> above;  ///< of a subdirectory, whose lock it is

  /// Collective: every rank throws FileError if `action` gives rank 0 a reason.
  template <class Action>
  void on_first_rank(const char* what, const Action& action) const {
    std::optional<std::string> reason;
    if (comm->getRank() == 0) reason = action();
    throw_if_any_file_error(*comm, what, path, reason);
  }

  /// Reads the marker. Returns why the directory cannot be had for names to come.
  std::optional<std::string> examine(const std::vector<std::string>& names, bool keep) {
    if (auto reason = not_for_results(path)) return reason;
    if (auto reason = not_writable(path)) return reason;
    std::optional<std::string> reason;
    const auto found = read_marker(path, reason);
    if (reason) return reason;
    marker = found.value_or(DirectoryMarker{});
    const bool is_run = origin.kind == "run";
    const std::vector<std::string> of_a_run = is_run || keep ? run_files(path) : std::vector<std::string>{};
    if (keep)
      for (const auto& held : {marker.names, of_a_run})
        if (!held.empty()) return fmt::format("it holds results ({}), which are to be kept; {}", held.front(), another_place);
    if ((reason = other_origin(path, marker, origin))) return reason;
    if (is_run && (reason = foreign_among(path, marker, of_a_run))) return reason;
    return foreign_among(path, marker, names);
  }

  std::optional<std::string> add(const std::string& name) {
    if (marker.lists(name)) return {};
    if (auto reason = foreign_among(path, marker, {name})) return reason;
    marker.names.push_back(name);
    return write_marker(path, marker, survival());
  }

  /// Of the list, from now on.
  Survives survival() const { return above ? above->survival() : survives; }

  void require(const std::string& name) const {
    if (!is_open) throw std::logic_error("nothing may be made in " + path + " before it is taken");
    if (!is_plain_name(name)) throw std::logic_error("\"" + name + "\" is no name of a file in " + path);
  }
};

OutputDirectory::OutputDirectory(RCP<const Communicator> comm, std::string path, Origin origin, bool keep) : state_(std::make_shared<State>()) {
  State& self = *state_;
  self.comm = std::move(comm), self.path = std::move(path), self.origin = std::move(origin);
  self.on_first_rank("cannot write to the directory", [&]() -> std::optional<std::string> {
    auto reason = self.examine({}, keep);
    return reason ? reason : lock_holder(self.path);
  });
}

void OutputDirectory::start(const std::vector<std::string>& names, bool has_to_exist, bool clears) {
  State& self = *state_;
  self.on_first_rank("cannot write to the directory", [&]() -> std::optional<std::string> {
    if (has_to_exist && !std::filesystem::exists(file(marker_name)))
      return fmt::format("it holds no results to go on with ({} is missing)", marker_name);
    if (auto reason = self.examine(names, false)) return reason;
    if (auto reason = make_directory(self.path, self.made)) return reason;
    if (auto reason = self.lock.take(self.path)) return reason;
    // Another process may have come and gone since.
    if (auto reason = self.examine(names, false)) return reason;
    if (has_to_exist)
      if (auto reason = link_among(self.path, self.marker.names)) return reason;
    if (clears) {
      if (auto reason = busy_below(self.path, self.marker.names)) return reason;
      if (auto reason = remove_listed(self.path, self.marker.names)) return reason;
    }
    if (has_to_exist) self.survives = Survives::loss_of_power;
    if (!self.origin.kind.empty()) self.marker.holds = self.origin.kind;
    if (!self.origin.source.empty()) self.marker.source = source_below(self.path, self.origin.source);
    return write_marker(self.path, self.marker, self.survival());
  });
  self.is_open = true;
}

void OutputDirectory::begin_run(const std::vector<std::string>& names) { start(names, false, true); }

void OutputDirectory::continue_run() { start({}, true, false); }

void OutputDirectory::open(const std::vector<std::string>& names) { start(names, false, false); }

std::string OutputDirectory::claim(const std::string& name) {
  State& self = *state_;
  self.require(name);
  self.on_first_rank("cannot write to the directory", [&] { return self.add(name); });
  return file(name);
}

OutputDirectory OutputDirectory::subdirectory(const std::string& name) {
  claim(name);
  const auto below = std::make_shared<State>();
  below->comm = state_->comm, below->path = file(name), below->is_open = true, below->above = state_;
  below->on_first_rank("cannot make the directory", [&]() -> std::optional<std::string> {
    if (auto reason = make_directory(below->path, below->made)) return reason;
    std::optional<std::string> reason;
    const auto found = read_marker(below->path, reason);
    if (reason) return reason;
    below->marker = found.value_or(DirectoryMarker{});
    return found ? std::nullopt : write_marker(below->path, below->marker, below->survival());
  });
  return OutputDirectory(below);
}

void OutputDirectory::remove(const std::string& name) {
  State& self = *state_;
  self.require(name);
  self.on_first_rank("cannot write to the directory", [&]() -> std::optional<std::string> {
    if (auto reason = foreign_among(self.path, self.marker, {name})) return reason;
    std::vector<std::string>& all = self.marker.names;
    const auto listed = std::find(all.begin(), all.end(), name);
    if (listed == all.end()) return {};
    std::vector<std::string> one{name};
    if (auto reason = busy_below(self.path, one)) return reason;
    if (auto reason = remove_listed(self.path, one)) return reason;
    if (one.empty()) all.erase(listed);
    return write_marker(self.path, self.marker, self.survival());
  });
}

void OutputDirectory::strike_missing() {
  State& self = *state_;
  self.on_first_rank("cannot write to the directory", [&] {
    std::vector<std::string>& all = self.marker.names;
    const auto is_missing = [&](const std::string& name) { return !is_made(self.path, name); };
    all.erase(std::remove_if(all.begin(), all.end(), is_missing), all.end());
    return write_marker(self.path, self.marker, self.survival());
  });
}

void OutputDirectory::sync() {
  state_->on_first_rank("cannot write to the disk", [&]() -> std::optional<std::string> {
    State* top = state_.get();
    while (top->above) top = top->above.get();
    top->survives = Survives::loss_of_power;
    if (auto reason = sync_listed(top->path, top->marker)) return reason;
    for (const std::string& made : top->made)
      if (auto reason = sync_directory(std::filesystem::path(made).parent_path().string())) return reason;
    top->made.clear();
    return {};
  });
}

bool OutputDirectory::is_open() const { return state_->is_open; }

const std::string& OutputDirectory::path() const { return state_->path; }

}  // namespace mortise
