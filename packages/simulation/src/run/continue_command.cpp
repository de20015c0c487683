#include "run/continue_command.hpp"

#include <fmt/format.h>

namespace mortise {
namespace {

std::string quoted_for_shell(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

std::string command_to_continue(const RunOptions& options, const std::string& directory, int ranks) {
  std::string command = ranks > 1 ? fmt::format("{} -n {} ", options.launcher, ranks) : "";
  command += "mortise run " + quoted_for_shell(options.scene);
  for (const std::string& setting : options.settings) command += " --set " + quoted_for_shell(setting);
  return command + " -o " + quoted_for_shell(directory) + " --restart";
}

}  // namespace mortise
