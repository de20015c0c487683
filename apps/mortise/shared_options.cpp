// Options that several commands have.

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "declarations.hpp"
#include "mortise/input/xml.hpp"
#include "mortise/studies/launcher.hpp"
#include "program.hpp"

namespace mortise {
namespace {

std::string wrong_directory(const std::string& directory) {
  return directory.empty() ? "the name of the directory is empty; please give one, or leave the option out" : "";
}

}  // namespace

CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names) {
  const auto wrong = [kind, names](const std::string& value) -> std::string {
    if (std::find(names.begin(), names.end(), value) != names.end()) return {};
    return fmt::format("there is no {} \"{}\"; known: {}", kind, value, fmt::join(names, ", "));
  };
  return {wrong, fmt::format("{{{}}}", fmt::join(names, ","))};
}

CLI::Validator above_zero() {
  const auto wrong = [](const std::string& value) -> std::string {
    int number = 0;
    const auto [last, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc() && last == value.data() + value.size() && number > 0) return {};
    return "has to be a whole number above 0, not " + value;
  };
  return {wrong, ""};
}

void add_directory(CLI::App& command, std::string& directory, const std::string& meaning) {
  command.add_option("-o,--output", directory, meaning)->check(CLI::Validator(wrong_directory, ""))->type_name(directory_value);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& meaning) {
  command.add_option("--set", settings, meaning)->check(CLI::Validator(wrong_assignment, ""))->type_name("PATH=VALUE")->allow_extra_args(false);
}

void add_launcher(CLI::App& command, Launcher& launcher) {
  const auto wrong = [](const std::string& text) -> std::string {
    try {
      read_launcher(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  command
      .add_option_function<std::string>(
          "--launcher", [&launcher](const std::string& text) { launcher = read_launcher(text); },
          "command that starts each run, e.g. \"srun --mpi=pmix\"; {ranks} in it is the number of ranks, by default -n {ranks}.\n"
          "Default: MORTISE_LAUNCHER in the environment, or mpirun for more than one rank")
      ->envname("MORTISE_LAUNCHER")
      ->check(CLI::Validator(wrong, ""))
      ->type_name("COMMAND");
}

}  // namespace mortise
