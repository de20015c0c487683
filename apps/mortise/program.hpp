#pragma once
// Declarations that the commands of the program share.

#include <functional>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"

namespace CLI {
class App;
}

namespace mortise {

struct Launcher;
struct RunOptions;

/// One run of the program: the command line selects the action, main runs it.
struct Program {
  RCP<const Communicator> comm;
  RCP<const Communicator> exit_comm;  ///< a duplicate that carries nothing but the agreement on the exit code
  std::function<void()> read;         ///< reads the input with `comm`, before the action; empty where there is none
  std::function<ExitCode()> action;
  bool uses_mpi = true;   ///< false: alone, the action runs without MPI, whose start takes longer than most answers
  bool launches = false;  ///< the action starts runs of this program: it gets no MPI, as programs that use MPI cannot start others that do

  bool is_first_rank() const { return comm->getRank() == 0; }
};

/// "0.2.0", and with the git revision that was built "0.2.0 (1a2b3c4)".
std::string version_number();
std::string version();

/// Prints on the first rank only.
/// @throws FileError  if standard output does not take it
void print(const Program& program, const std::string& text);

/// Each adds its command to the command line and sets program.action when it is chosen.
void add_run_command(CLI::App& app, Program& program);
void add_check_command(CLI::App& app, Program& program);
void add_point_command(CLI::App& app, Program& program);
void add_picture_command(CLI::App& app, Program& program);
void add_compare_command(CLI::App& app, Program& program);
void add_export_command(CLI::App& app, Program& program);
void add_describe_command(CLI::App& app, Program& program);
void add_list_command(CLI::App& app, Program& program);
void add_doctor_command(CLI::App& app, Program& program);
void add_paper_command(CLI::App& app, Program& program);
void add_study_command(CLI::App& app, Program& program);
void add_hard_command(CLI::App& app, Program& program);
void add_scale_command(CLI::App& app, Program& program);
void add_peer_command(CLI::App& app, Program& program);
void add_completion_command(CLI::App& app, Program& program);
void add_man_command(CLI::App& app, Program& program);

/// Cores that this process may use.
int cores();

/// -o, --output: a directory, which cannot be "". `directory` has to live as long as the command.
void add_directory(CLI::App& command, std::string& directory, const std::string& meaning);

/// --set, whose form is checked. `settings` has to live as long as the command.
void add_settings(CLI::App& command, std::vector<std::string>& settings,
                  const std::string& meaning = "replace a value of the file: path=value, e.g. variables/n=16; may be repeated");

/// --launcher, whose default is MORTISE_LAUNCHER in the environment. `launcher` has to live as long as the command.
void add_launcher(CLI::App& command, Launcher& launcher);

/// Arguments of the commands that run an input file: the file itself, called `file`, and --set; -o, --keep, --quiet, --verbose. The options have to
/// live as long as the command.
void add_input_arguments(CLI::App& command, const std::string& file, const std::string& meaning, RunOptions& options);
void add_output_arguments(CLI::App& command, const std::string& file, RunOptions& options);

/// End of a rank's action; the message is empty unless it failed.
struct Outcome {
  ExitCode code = ExitCode::done;
  std::string message;
};

/// Runs what is to be done; an exception becomes its exit code and message, which the first rank prints.
Outcome run_action(const Program& program, const std::function<ExitCode()>& action);

/// Collective: agrees on the largest of all ranks' codes. A rank may find itself alone here, while another one is stuck in a collective call that
/// this rank will never join. It then says why and ends the whole program with code 70 instead of waiting without end.
int agree_on_exit(const Program& program, const Outcome& outcome);

}  // namespace mortise
