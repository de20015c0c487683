#pragma once
// Draws with matplotlib, in a python3 of its own.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "shared/run_process.hpp"

namespace mortise {

/// Runs plot_style and then `script`, which sees `arguments` in sys.argv[1:]. Returns its ending; none if no python has matplotlib. The first that
/// has it is taken of: the python named by the environment variable MORTISE_PYTHON, alone if it is set; python3 of the path; /usr/bin/python3. It is
/// isolated: it takes no modules of the working directory, of PYTHONPATH or of the user's own packages. No communication.
std::optional<ProcessEnding> run_script(const std::string& script, const std::vector<std::string>& arguments);

/// run_script() on rank 0. Collective. Returns false on all ranks if there is no python for it. Throws FileError on all ranks if the script fails.
/// @param image  what is drawn, for the error
bool draw_plot(const Communicator& comm, const std::string& script, const std::vector<std::string>& arguments, const std::string& image);

/// Throws FileError on all ranks if nothing here can draw `page`, to be called before what it takes is computed: no python with matplotlib and h5py.
void require_page_python(const Communicator& comm, const std::string& page);

}  // namespace mortise
