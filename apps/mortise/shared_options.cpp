// Options that several commands have.

#include "declarations.hpp"
#include "mortise/core/xml.hpp"
#include "program.hpp"

namespace mortise {
namespace {

std::string wrong_directory(const std::string& directory) {
  return directory.empty() ? "the name of the directory is empty; please give one, or leave the option out" : "";
}

}  // namespace

void add_directory(CLI::App& command, std::string& directory, const std::string& meaning) {
  command.add_option("-o,--output", directory, meaning)->check(CLI::Validator(wrong_directory, ""))->type_name(directory_value);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& meaning) {
  command.add_option("--set", settings, meaning)->check(CLI::Validator(wrong_assignment, ""))->type_name("PATH=VALUE")->allow_extra_args(false);
}

}  // namespace mortise
