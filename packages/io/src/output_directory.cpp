#include "mortise/io/output_directory.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "mortise/io/files.hpp"

namespace mortise {
namespace {

std::vector<std::filesystem::path> run_files(const std::string& directory, std::error_code& error) {
  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry(directory, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (is_run_file(entry->path().filename().string())) files.push_back(entry->path());
  return files;
}

/// Why no files can be made in the directory.
std::optional<std::string> prepare(const std::string& directory, bool keep) {
  std::error_code error;
  if (std::filesystem::exists(directory, error) && !std::filesystem::is_directory(directory, error)) return "it exists and is not a directory";
  std::filesystem::create_directories(directory, error);
  if (error) return error.message();
  const auto earlier = run_files(directory, error);
  if (error) return error.message();
  if (keep && !earlier.empty())
    return fmt::format("it holds a run ({}), which is to be kept; please choose another directory", earlier.front().filename().string());
  const std::string probe = directory + "/.mortise-probe";
  errno = 0;
  std::ofstream stream(probe);
  stream.close();
  if (!stream) return errno != 0 ? std::strerror(errno) : "no files can be made in it";
  std::filesystem::remove(probe, error);
  for (const auto& file : earlier)
    if (std::filesystem::is_directory(file, error)) return fmt::format("{} in it is a directory", file.filename().string());
  return {};
}

std::optional<std::string> remove_run(const std::string& directory) {
  std::error_code error;
  const auto files = run_files(directory, error);
  if (error) return error.message();
  for (const auto& file : files) {
    std::filesystem::remove(file, error);
    if (error) return fmt::format("{}: {}", file.filename().string(), error.message());
  }
  return {};
}

}  // namespace

bool is_run_file(const std::string& name) {
  static const std::array<const char*, 11> names{"summary.json",  "newton.csv", "history.csv", "profiles.csv", "fields.xdmf", "fields.h5",
                                                 "effective.xml", "log.txt",    "point.csv",   "point.svg",    "point.png"};
  for (const char* known : names)
    if (name == known || name == std::string(known) + ".part") return true;
  const std::string begin = "checkpoint-", end = ".h5";
  return name.size() > begin.size() + end.size() && name.compare(0, begin.size(), begin) == 0 &&
         name.compare(name.size() - end.size(), end.size(), end) == 0;
}

OutputDirectory::OutputDirectory(RCP<const Communicator> comm, std::string path, bool keep) : comm_(std::move(comm)), path_(std::move(path)) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = prepare(path_, keep);
  throw_if_any_file_error(*comm_, "cannot write to the directory", path_, reason);
}

void OutputDirectory::remove_earlier_run() {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = remove_run(path_);
  throw_if_any_file_error(*comm_, "cannot replace the run in", path_, reason);
}

}  // namespace mortise
