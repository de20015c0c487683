#include "draw_plot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <Teuchos_CommHelpers.hpp>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "mortise/io/files.hpp"
#include "plot_scripts.hpp"

namespace mortise {
namespace {

constexpr int missing = 69;  ///< exit code of plot_style without matplotlib

std::string quoted(const std::string& word) { return "'" + boost::algorithm::replace_all_copy(word, "'", "'\\''") + "'"; }

struct Ending {
  int code = -1;
  std::string last_line;  ///< of what it said
};

Ending run(const std::string& command) {
  Ending ending;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return ending;
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t read = fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), read);
  const int status = pclose(pipe);
  boost::algorithm::trim_right(output);
  ending.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  ending.last_line = output.substr(output.find_last_of('\n') + 1);
  return ending;
}

}  // namespace

bool draw_plot(const Communicator& comm, const std::string& script, const std::vector<std::string>& arguments, const std::string& image) {
  std::optional<std::string> failure;
  int drawn = 0;
  if (comm.getRank() == 0) {
    std::vector<std::string> pythons{"python3", "/usr/bin/python3"};
    if (const char* chosen = std::getenv("MORTISE_PYTHON")) pythons = {chosen};
    for (const auto& python : pythons) {
      std::string command = quoted(python) + " -c " + quoted(std::string(plot_style) + script);
      for (const auto& argument : arguments) command += " " + quoted(argument);
      const Ending ending = run(command + " 2>&1");
      if (ending.code == missing || ending.code == 126 || ending.code == 127) continue;  // no matplotlib, or (from the shell) no python
      drawn = 1;
      if (ending.code != 0) failure = fmt::format("{} ended with code {}: {}", python, ending.code, ending.last_line);
      break;
    }
  }
  throw_if_any_file_error(comm, "cannot draw", image, failure);
  Teuchos::broadcast(comm, 0, Teuchos::outArg(drawn));
  return drawn == 1;
}

}  // namespace mortise
