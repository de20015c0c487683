#include "declarations.hpp"

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>

namespace mortise {
namespace {

/// The description by the checks of an option of its allowed values; it follows the name of the value.
std::string said_by_checks(CLI::Option& option) {
  std::string said;
  try {
    for (int i = 0;; ++i)
      if (const std::string one = option.get_validator(i)->get_description(); !one.empty()) said += ":" + one;
  } catch (const CLI::OptionNotFound&) {  // there is no other way to count them
  }
  return said;
}

/// "{a,b}" or "{a->0,b->1}" -> {"a", "b"}
std::vector<std::string> choices_in(const std::string& said) {
  const std::size_t begin = said.find('{'), end = said.find('}');
  if (begin == std::string::npos) return {};
  std::vector<std::string> choices;
  const std::string list = said.substr(begin + 1, end - begin - 1);
  boost::algorithm::split(choices, list, boost::algorithm::is_any_of(","));
  for (std::string& choice : choices) choice = choice.substr(0, choice.find("->"));
  return choices;
}

DeclaredOption declared(CLI::Option& option) {
  DeclaredOption result;
  result.has_place = option.get_positional();
  result.required = option.get_required();
  result.meaning = option.get_description();
  if (result.has_place) result.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  if (option.get_items_expected_max() == 0) return result;
  const std::string checks = said_by_checks(option), type = option.get_type_name();
  result.value = option.get_option_text().empty() ? type.substr(0, type.size() - checks.size()) : option.get_option_text();
  result.choices = choices_in(checks);
  return result;
}

}  // namespace

std::vector<DeclaredCommand> declared_commands(CLI::App& app) {
  std::vector<DeclaredCommand> commands;
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    // Without a footer of its own a command has that of the program.
    const std::string footer = command->get_footer() == app.get_footer() ? "" : command->get_footer();
    commands.push_back({command->get_name(), command->get_description(), footer, {}});
    for (CLI::Option* option : command->get_options([](CLI::Option*) { return true; })) commands.back().options.push_back(declared(*option));
  }
  return commands;
}

}  // namespace mortise
