#pragma once
// The commands and options that are declared to CLI11, as data: the source of completions and of the manual page.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace mortise {

/// An option, or an argument that has a place instead of a name.
struct DeclaredOption {
  std::vector<std::string> names;    ///< "-o", "--output"; of an argument its name, as SCENE
  std::string value;                 ///< placeholder of its value, as DIR; empty: it has none
  std::vector<std::string> choices;  ///< the values that it may have; empty: any
  std::string meaning;
  bool has_place = false;  ///< an argument
  bool required = false;
};

/// A command of the program.
struct DeclaredCommand {
  std::string name, meaning, footer;
  std::vector<DeclaredOption> options;
};

/// All commands, in the order of their declaration.
std::vector<DeclaredCommand> declared_commands(CLI::App& app);

/// Placeholders of values of arguments and options: a scene or another file of XML, a directory, a list of a
/// scene.
inline constexpr const char *xml_value = "FILE", *directory_value = "DIR", *list_value = "LIST";

/// Checks that a value is one of `names`; `kind` is what they name, for the message. The choices are declared in the order given.
CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names);

/// Checks that a value is a whole number above 0.
CLI::Validator above_zero();

/// A script for bash that completes commands, options, what may be chosen, files *.xml and directories.
std::string bash_completion(CLI::App& app);

/// The page mortise(1) in the macros of man(7).
std::string manual_page(CLI::App& app);

}  // namespace mortise
