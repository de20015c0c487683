#pragma once
// Launchers: programs that start a run on several ranks.

#include <string>
#include <vector>

namespace mortise {

/// Words before a program that start it on some ranks: mpirun, srun, flux, or any other command.
struct Launcher {
  /// With "{ranks}" where their number stands. Empty: mpirun, and nothing before a program on one rank.
  std::vector<std::string> words;

  /// The words that start `program` on so many ranks.
  std::vector<std::string> command(int ranks, const std::vector<std::string>& program) const;
};

/// Reads a launcher as a shell would: words between blanks, quotes around those with blanks. Without "{ranks}" the usual option for it is added to
/// launchers known by name. Throws InputError for quotes without an end, and for other launchers without "{ranks}".
Launcher read_launcher(const std::string& text);

/// Names of the launchers that read_launcher() knows.
std::vector<std::string> known_launchers();

/// Throws FileError if the program of a launcher cannot be found, before anything is run.
void require_launcher(const Launcher& launcher);

}  // namespace mortise
