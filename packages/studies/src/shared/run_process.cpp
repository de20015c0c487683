#include "shared/run_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/trim.hpp>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "mortise/simulation/run/output/exit_code.hpp"

namespace mortise {
namespace {

/// From SIGTERM to SIGKILL: mpirun gives its ranks two seconds to go.
constexpr double grace_seconds = 5.0;

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Becomes the program. As in a shell, 127 is that there is none, 126 that it cannot be run.
[[noreturn]] void become(char* const* words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(126);  // it died before it could be watched
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execvp(words[0], words);
  _exit(errno == ENOENT ? 127 : 126);
}

/// Appends what comes through a pipe until nobody writes to it any more, or until an instant of the watch. Returns whether it was the former.
bool read_until(int pipe, double end, const Stopwatch& watch, std::string& output) {
  std::array<char, 4096> buffer;
  for (double left = end - watch.seconds(); left > 0.0; left = end - watch.seconds()) {
    pollfd waiting{pipe, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(std::ceil(1e3 * std::min(left, 60.0)))) == 0) continue;
    const ssize_t size = read(pipe, buffer.data(), buffer.size());
    if (size > 0) output.append(buffer.data(), static_cast<std::size_t>(size));
    if (size == 0 || (size < 0 && errno != EINTR)) return true;
  }
  return false;
}

/// All that a process started, and what that started. A process group would not do: mpirun gives each rank a group of its own. Nor would a session:
/// one rank without mpirun has a daemon with a session of its own.
void add_descendants(pid_t process, std::vector<pid_t>& found) {
  std::error_code gone;
  for (const auto& thread : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", process), gone)) {
    std::ifstream children(thread.path() / "children");
    for (pid_t child = 0; children >> child;) {
      found.push_back(child);
      add_descendants(child, found);
    }
  }
}

void signal_descendants(int signal) {
  std::vector<pid_t> processes;
  add_descendants(getpid(), processes);
  for (const pid_t process : processes) kill(process, signal);
}

/// Waits for a child, -1: any of them, and adds what it took. Returns which one it was, less than 0 if there is none.
pid_t wait_for(pid_t child, int& status, ProcessEnding& ending) {
  rusage usage{};
  pid_t ended = -1;
  do ended = wait4(child, &status, 0, &usage);
  while (ended < 0 && errno == EINTR);
  if (ended < 0) return ended;
  ending.cpu_seconds += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ending.memory_mib = std::max(ending.memory_mib, static_cast<double>(usage.ru_maxrss) / 1024.0);  // Linux counts in KiB
  return ended;
}

/// Ends all descendants of this process. Returns the status of `child`.
int stop(pid_t child, int pipe, const Stopwatch& watch, ProcessEnding& ending) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // whose parent ends becomes a child of this process: without children it has no descendants
  signal_descendants(SIGTERM);
  read_until(pipe, watch.seconds() + grace_seconds, watch, ending.output);
  int child_status = 0, status = 0;
  for (pid_t ended = 0; ended >= 0;) {
    signal_descendants(SIGKILL);
    ended = wait_for(-1, status, ending);
    if (ended == child) child_status = status;
  }
  prctl(PR_SET_CHILD_SUBREAPER, 0);
  return child_status;
}

void add_settings(std::vector<std::string>& command, const std::vector<std::string>& settings, const std::string& directory) {
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  command.insert(command.end(), {"-o", directory, "--quiet"});
}

}  // namespace

ProcessEnding run_process(const std::vector<std::string>& words, double limit) {
  ProcessEnding ending;
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return ending;

  const Stopwatch watch;
  const pid_t self = getpid(), child = fork();
  if (child == 0) become(arguments.data(), pipe_ends[1], self);
  close(pipe_ends[1]);
  int status = 0;
  if (child > 0) {
    ending.stopped = !read_until(pipe_ends[0], limit, watch, ending.output);
    if (ending.stopped)
      status = stop(child, pipe_ends[0], watch, ending);
    else
      wait_for(child, status, ending);
  }
  close(pipe_ends[0]);
  if (child < 0) return ending;
  ending.wall_seconds = watch.seconds();
  boost::algorithm::trim_right(ending.output);
  if (WIFEXITED(status)) ending.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.code = 128 + WTERMSIG(status);
  return ending;
}

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

std::vector<std::string> command_of_peer(const std::string& scene, const std::vector<std::string>& settings, const std::string& peer,
                                         const std::string& penalty, const std::string& directory) {
  std::vector<std::string> command{this_program(), "peer", scene, "--by", peer};
  if (!penalty.empty()) command.insert(command.end(), {"--penalty", penalty});
  add_settings(command, settings, directory);
  return command;
}

std::vector<std::string> command_of_run(const Launcher& launcher, const std::string& scene, const std::vector<std::string>& settings, int ranks,
                                        const std::string& directory) {
  std::vector<std::string> run{this_program(), "run", scene};
  add_settings(run, settings, directory);
  return launcher.command(ranks, run);
}

std::string said_at_end(const std::vector<std::string>& words, const ProcessEnding& ending) {
  const auto of_run = {ExitCode::done,  ExitCode::invalid_input, ExitCode::not_converged, ExitCode::check_missed,
                       ExitCode::files, ExitCode::memory,        ExitCode::internal};
  const bool is_of_run = std::any_of(of_run.begin(), of_run.end(), [&](ExitCode code) { return ending.code == static_cast<int>(code); });
  if (words.front() == this_program() || ending.stopped || is_of_run) return ending.output;
  const std::string how = ending.code == 127 ? "could not be started" : fmt::format("ended with code {}", ending.code);
  return fmt::format("{} {}{}", fmt::join(words, " "), how, ending.output.empty() ? " and printed nothing" : ":\n" + ending.output);
}

}  // namespace mortise
