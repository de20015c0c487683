#include "run_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/algorithm/string/trim.hpp>
#include <cerrno>
#include <chrono>
#include <filesystem>

namespace mortise {
namespace {

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

/// Becomes the program. As in a shell, 127 is that there is none, 126 that it cannot be run.
[[noreturn]] void become(char* const* words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(126);  // it died before it could be watched
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execvp(words[0], words);
  _exit(errno == ENOENT ? 127 : 126);
}

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

void add_settings(std::vector<std::string>& command, const std::vector<std::string>& settings, const std::string& directory) {
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  command.insert(command.end(), {"-o", directory, "--quiet"});
}

}  // namespace

ProcessEnding run_process(const std::vector<std::string>& words) {
  ProcessEnding ending;
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return ending;

  const auto begin = std::chrono::steady_clock::now();
  const pid_t self = getpid(), child = fork();
  if (child == 0) become(arguments.data(), pipe_ends[1], self);
  close(pipe_ends[1]);
  std::array<char, 4096> buffer;
  while (child > 0) {
    const ssize_t size = read(pipe_ends[0], buffer.data(), buffer.size());
    if (size > 0) ending.output.append(buffer.data(), static_cast<std::size_t>(size));
    if (size == 0 || (size < 0 && errno != EINTR)) break;
  }
  close(pipe_ends[0]);
  if (child < 0) return ending;

  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) return ending;
  ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ending.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ending.memory_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
  boost::algorithm::trim_right(ending.output);
  if (WIFEXITED(status)) ending.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.code = 128 + WTERMSIG(status);
  return ending;
}

std::vector<std::string> command_of_peer(const std::string& scene, const std::vector<std::string>& settings, const std::string& peer,
                                         const std::string& penalty, const std::string& directory) {
  std::vector<std::string> command{this_program(), "peer", scene, "--by", peer};
  if (!penalty.empty()) command.insert(command.end(), {"--penalty", penalty});
  add_settings(command, settings, directory);
  return command;
}

std::vector<std::string> command_of_run(const std::string& scene, const std::vector<std::string>& settings, int ranks, const std::string& directory) {
  std::vector<std::string> command{this_program()};
  if (ranks > 1) command = {"mpirun", "-n", std::to_string(ranks), command.front()};
  command.insert(command.end(), {"run", scene});
  add_settings(command, settings, directory);
  return command;
}

}  // namespace mortise
