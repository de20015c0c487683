#include "run_process.hpp"

#include <sys/wait.h>

#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cstdio>

namespace mortise {
namespace {

std::string quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=/.,:%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  return "'" + boost::algorithm::replace_all_copy(word, "'", "'\\''") + "'";
}

}  // namespace

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

ProcessEnding run_process(const std::vector<std::string>& words) {
  ProcessEnding ending;
  // The shell becomes the program, so that a signal that kills it is seen here.
  FILE* pipe = popen(("exec " + shell_line(words) + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ending;
  std::array<char, 4096> buffer;
  while (const std::size_t read = fread(buffer.data(), 1, buffer.size(), pipe)) ending.output.append(buffer.data(), read);
  const int status = pclose(pipe);
  boost::algorithm::trim_right(ending.output);
  if (WIFEXITED(status)) ending.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.code = 128 + WTERMSIG(status);
  return ending;
}

}  // namespace mortise
