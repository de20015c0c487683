#include "shared/draw_plot.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <cstdlib>

#include "mortise/core/error.hpp"
#include "mortise/io/files.hpp"
#include "shared/plot_scripts.hpp"

namespace mortise {
namespace {

constexpr int missing = 69;  ///< exit code of plot_style without matplotlib

}  // namespace

std::optional<ProcessEnding> run_script(const std::string& script, const std::vector<std::string>& arguments) {
  std::vector<std::string> pythons{"python3", "/usr/bin/python3"};
  if (const char* chosen = std::getenv("MORTISE_PYTHON")) pythons = {chosen};
  for (const auto& python : pythons) {
    // -I: modules come from the python's own directories, and from no other, the working directory for one.
    std::vector<std::string> command{python, "-I", "-c", std::string(plot_style) + script};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProcessEnding ending = run_process(command);
    if (ending.code == missing || ending.code == 126 || ending.code == 127) continue;  // no matplotlib, or no python
    return ending;
  }
  return {};
}

bool draw_plot(const Communicator& comm, const std::string& script, const std::vector<std::string>& arguments, const std::string& image) {
  std::optional<std::string> failure;
  int drawn = 0;
  if (comm.getRank() == 0) {
    const auto ending = run_script(script, arguments);
    drawn = ending ? 1 : 0;
    if (ending && ending->code != 0) failure = fmt::format("python ended with code {}: {}", ending->code, ending->last_line());
  }
  throw_if_any_file_error(comm, "cannot draw", image, failure);
  Teuchos::broadcast(comm, 0, Teuchos::outArg(drawn));
  return drawn == 1;
}

void require_page_python(const Communicator& comm, const std::string& page) {
  if (!draw_plot(comm, page_needs, {}, page))
    throw FileError("cannot draw " + page + ": no python3 with matplotlib and h5py; please install python3-matplotlib and python3-h5py (Debian)");
}

}  // namespace mortise
