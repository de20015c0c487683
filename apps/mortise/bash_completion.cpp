#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "declarations.hpp"
#include "mortise/studies/describe_scene.hpp"

namespace mortise {
namespace {

constexpr const char* begin = R"(# Completions of mortise for bash; made by `mortise completion`.
_mortise() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} options='' choices='' files='' many='' head='' form='%q\n' IFS=$'\n'
  COMPREPLY=()
  # bash splits --option=value at the "="
  if [ "$word" = = ]; then word=''; elif [ "$previous" = = ]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
  if [ "$COMP_CWORD" -eq 1 ]; then
)";

constexpr const char* end = R"(  case $files in
    xml) mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X '!*.xml' -- "$word") ;;
    directory) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    *)
      # behind an open quote nothing has to be escaped
      if [[ $word == [\"\']* ]]; then word=${word:1} form='%s\n'; else word=${word//\\/}; fi
      if [[ -n $many && $word == *,* ]]; then head=${word%,*},; word=${word##*,}; fi
      mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word" | while read -r one; do printf "%s$form" "$head" "$one"; done)
      ;;
  esac
  if [ -n "$files" ]; then compopt -o filenames 2>/dev/null; fi
}
complete -F _mortise mortise
)";

/// The completion of an option's value: an assignment for the script.
std::string completing(const DeclaredOption& option) {
  if (option.value == xml_value) return "files=xml";
  if (option.value == directory_value) return "files=directory";
  const std::vector<std::string> choices = option.value == list_value ? described_lists() : option.choices;
  const bool many = option.value.find(",...") != std::string::npos;
  return fmt::format("choices=$'{}'{}", fmt::join(choices, "\\n"), many ? " many=yes" : "");
}

std::string branch_of(const DeclaredCommand& command) {
  std::vector<std::string> names;
  std::string argument, values;
  for (const DeclaredOption& option : command.options) {
    if (option.has_place) {
      argument = completing(option);
      continue;
    }
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (!option.value.empty()) values += fmt::format("        {}) {} ;;\n", fmt::join(option.names, " | "), completing(option));
  }
  return fmt::format("    {})\n      options=$'{}'\n      case $previous in\n{}        *) {} ;;\n      esac\n      ;;\n", command.name,
                     fmt::join(names, "\\n"), values, argument.empty() ? ":" : argument);
}

}  // namespace

std::string bash_completion(CLI::App& app) {
  std::vector<std::string> first;
  std::string branches;
  for (const DeclaredCommand& command : declared_commands(app)) {
    first.push_back(command.name);
    branches += branch_of(command);
  }
  for (const CLI::Option* option : app.get_options([](CLI::Option*) { return true; }))
    for (const std::string& name : option->get_lnames()) first.push_back("--" + name);
  return fmt::format(
      "{}    mapfile -t COMPREPLY < <(compgen -W $'{}' -- \"$word\")\n    return\n  fi\n  case $command in\n{}  esac\n"
      "  if [[ $word == -* ]]; then choices=$options files=''; fi\n{}",
      begin, fmt::join(first, "\\n"), branches, end);
}

}  // namespace mortise
