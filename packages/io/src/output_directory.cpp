#include "mortise/io/output_directory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#include "field_files.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

/// Files of a run, relative to the directory.
std::vector<std::string> run_files(const std::string& directory, std::error_code& error) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  for (const std::string& below : {std::string(), fields_directory + "/"}) {
    const fs::path folder = fs::path(directory) / below;
    if (!fs::is_directory(folder, error)) break;  // there are no fields
    for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
      if (const std::string name = below + entry->path().filename().string(); is_run_file(name)) files.push_back(name);
  }
  if (error == std::errc::no_such_file_or_directory) error.clear();
  return files;
}

/// Why no files could be made in the directory, or why it could not be made. Touches nothing.
std::optional<std::string> obstacle(const std::string& directory, bool keep) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path there = fs::absolute(directory, error);
  while (!error && !fs::exists(there, error) && there != there.root_path()) there = there.parent_path();
  if (error) return error.message();
  if (!fs::is_directory(there, error)) return fmt::format("{} exists and is not a directory", there.string());
  if (access(there.c_str(), W_OK | X_OK) != 0) return fmt::format("{}: {}", there.string(), std::strerror(errno));
  if (!fs::exists(directory, error)) return {};
  const auto earlier = run_files(directory, error);
  if (error) return error.message();
  if (keep && !earlier.empty()) return fmt::format("it holds a run ({}), which is to be kept; please choose another directory", earlier.front());
  for (const auto& file : earlier)
    if (fs::is_directory(fs::path(directory) / file, error)) return fmt::format("{} in it is a directory", file);
  return {};
}

std::optional<std::string> make_directory(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  return error ? std::optional(error.message()) : std::nullopt;
}

std::optional<std::string> remove_run(const std::string& directory) {
  std::error_code error;
  const auto files = run_files(directory, error);
  if (error) return error.message();
  for (const auto& file : files) {
    std::filesystem::remove(std::filesystem::path(directory) / file, error);
    if (error) return fmt::format("{}: {}", file, error.message());
  }
  std::filesystem::remove(std::filesystem::path(directory) / fields_directory, error);  // it stays if something else is in it
  return {};
}

}  // namespace

bool is_run_file(const std::string& name) {
  if (is_field_file(name)) return true;
  // fields.h5 is what earlier versions wrote.
  static const std::array<const char*, 12> names{"steps.jsonl", "summary.json",  "newton.csv", "history.csv", "profiles.csv", "fields.xdmf",
                                                 "fields.h5",   "effective.xml", "log.txt",    "point.csv",   "point.svg",    "point.png"};
  for (const char* known : names)
    if (name == known || name == std::string(known) + ".part") return true;
  const std::string begin = "checkpoint-", end = ".h5";
  return name.size() > begin.size() + end.size() && name.compare(0, begin.size(), begin) == 0 &&
         name.compare(name.size() - end.size(), end.size(), end) == 0;
}

OutputDirectory::OutputDirectory(RCP<const Communicator> comm, std::string path, bool keep) : comm_(std::move(comm)), path_(std::move(path)) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = obstacle(path_, keep);
  throw_if_any_file_error(*comm_, "cannot write to the directory", path_, reason);
}

void OutputDirectory::make() const {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = make_directory(path_);
  throw_if_any_file_error(*comm_, "cannot make the directory", path_, reason);
}

void OutputDirectory::begin_run() const {
  make();
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = remove_run(path_);
  throw_if_any_file_error(*comm_, "cannot replace the run in", path_, reason);
}

}  // namespace mortise
