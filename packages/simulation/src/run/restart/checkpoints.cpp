#include "run/restart/checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "mortise/io/checkpoint_file.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

std::string checkpoint_name(int step) { return fmt::format("step-{:06}.h5", step); }

/// The steps of the checkpoints in a directory, ascending, on every rank.
std::vector<int> checkpoint_steps(const Communicator& comm, const std::string& directory) {
  std::vector<int> steps;
  if (comm.getRank() == 0) {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      int step = 0;
      if (std::sscanf(name.c_str(), "step-%d.h5", &step) == 1 && step > 0 && name == checkpoint_name(step)) steps.push_back(step);
    }
    std::sort(steps.begin(), steps.end());
  }
  int count = static_cast<int>(steps.size());
  Teuchos::broadcast(comm, 0, Teuchos::outArg(count));
  steps.resize(static_cast<std::size_t>(count));
  if (count > 0) Teuchos::broadcast(comm, 0, count, steps.data());
  return steps;
}

void remove_files(const Communicator& comm, const std::string& directory, const std::vector<std::string>& names) {
  std::optional<std::string> reason;
  if (comm.getRank() == 0)
    for (const std::string& name : names) {
      std::error_code error;
      std::filesystem::remove(directory + "/" + name, error);
      if (error) reason = fmt::format("{}: {}", name, error.message());
    }
  throw_if_any_file_error(comm, "cannot remove old checkpoints in", directory, reason);
}

}  // namespace

std::string checkpoint_directory(const std::string& run_directory) { return run_directory + "/checkpoints"; }

Checkpoints::Checkpoints(RCP<const Communicator> comm, const CheckpointOptions& options, OutputDirectory run)
    : comm_(std::move(comm)), options_(options), run_(std::move(run)) {}

bool Checkpoints::is_due(int step) const {
  const double minutes = std::chrono::duration<double, std::ratio<60>>(Clock::now() - since_).count();
  const int mine = options_.every_minutes > 0.0 && minutes >= options_.every_minutes ? 1 : 0;
  int due = mine;
  Teuchos::broadcast(*comm_, 0, Teuchos::outArg(due));  // the first rank has the clock
  return due != 0 || is_due_by_step(step);
}

std::uintmax_t Checkpoints::write(int step, const std::function<void(StateArchive&)>& store) {
  const auto begin = Clock::now();
  OutputDirectory files = run_.subdirectory("checkpoints");
  files.claim("step-*.h5");
  CheckpointWriter file(comm_, files.file(checkpoint_name(step)));
  store(file);
  const std::uintmax_t bytes = file.finish();
  files.sync();
  last_ = step;

  std::vector<int> steps = checkpoint_steps(*comm_, files.path());
  std::vector<std::string> old;
  for (std::size_t n = 0; n + static_cast<std::size_t>(options_.keep) < steps.size(); ++n)
    if (steps[n] != step) old.push_back(checkpoint_name(steps[n]));
  remove_files(*comm_, files.path(), old);
  since_ = Clock::now();
  seconds_ = std::chrono::duration<double>(since_ - begin).count();
  return bytes;
}

FoundCheckpoint find_checkpoint(const Communicator& comm, const std::string& run_directory, std::optional<int> step) {
  const std::string directory = checkpoint_directory(run_directory);
  const std::vector<int> steps = checkpoint_steps(comm, directory);
  const std::string there = fmt::format("{}", fmt::join(steps, ", "));
  if (steps.empty())
    throw FileError(
        fmt::format("{} holds no checkpoint: there is nothing to restart from. Please leave out --restart, or name the directory of the "
                    "run with -o",
                    directory));
  if (step) {
    if (std::find(steps.begin(), steps.end(), *step) == steps.end())
      throw FileError(fmt::format("{} holds no checkpoint of step {}; there are those of the steps {}", directory, *step, there));
    const std::string path = directory + "/" + checkpoint_name(*step);
    if (const auto damage = checkpoint_damage(comm, path))
      throw FileError(fmt::format("cannot restart from {}: {}; there are checkpoints of the steps {}", path, *damage, there));
    return {*step, path, {}};
  }
  FoundCheckpoint found;
  for (auto one = steps.rbegin(); one != steps.rend(); ++one) {
    found.path = directory + "/" + checkpoint_name(*one);
    found.step = *one;
    const auto damage = checkpoint_damage(comm, found.path);
    if (!damage) return found;
    found.damaged.push_back(fmt::format("{}: {}", found.path, *damage));
  }
  throw FileError(fmt::format("no checkpoint in {} is whole: {}", directory, fmt::join(found.damaged, "; ")));
}

void remove_checkpoints_after(const Communicator& comm, const std::string& run_directory, int step) {
  const std::string directory = checkpoint_directory(run_directory);
  std::vector<std::string> names;
  for (const int one : checkpoint_steps(comm, directory))
    if (one > step) names.push_back(checkpoint_name(one));
  std::error_code error;
  if (comm.getRank() == 0)
    for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
      if (entry->path().extension() == ".part") names.push_back(entry->path().filename().string());
  remove_files(comm, directory, names);
}

}  // namespace mortise
