#include "launch.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

Ending launch(const std::vector<std::string>& command, int seconds) {
  std::string line = "timeout -k 10 " + std::to_string(seconds);
  const bool is_one_rank = command.size() > 3 && command[1] == "-n" && command[2] == "1";
  for (auto word = command.begin() + (is_one_rank ? 3 : 0); word != command.end(); ++word) line += " " + quoted(*word);
  FILE* pipe = popen((line + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + line);
  Ending ending;
  std::array<char, 4096> buffer;
  while (const std::size_t read = fread(buffer.data(), 1, buffer.size(), pipe)) ending.output.append(buffer.data(), read);
  const int status = pclose(pipe);
  ending.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ending;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}
