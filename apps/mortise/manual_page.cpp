#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "declarations.hpp"
#include "program.hpp"

namespace mortise {
namespace {

/// A text in which man's macros see nothing of theirs.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      case '"':
        result += "\\(dq";
        break;
      default:
        result += c;
    }
  return result.empty() || result.front() != '.' ? result : "\\&" + result;
}

/// Lines as they are.
std::string literal(const std::string& text) {
  std::string result = ".nf\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) result += escaped(line) + "\n";
  return result + ".fi\n";
}

/// Running text; its last lines, from the one that begins with "Example" on, are commands and stay as they are.
std::string paragraphs(const std::string& text) {
  const std::size_t examples = text.find("Example");
  std::string result;
  std::istringstream lines(text.substr(0, examples));
  for (std::string line; std::getline(lines, line);) result += escaped(line) + "\n";
  if (examples != std::string::npos) result += (result.empty() ? "" : ".PP\n") + literal(text.substr(examples));
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string in_synopsis(const DeclaredOption& option) {
  if (option.has_place) return option.required ? italic(option.names.front()) : "[" + italic(option.names.front()) + "]";
  const std::string text = bold(option.names.front()) + (option.value.empty() ? "" : " " + italic(option.value));
  return option.required ? text : "[" + text + "]";
}

std::string entry(const DeclaredOption& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(option.has_place ? italic(name) : bold(name));
  const std::string value = option.has_place || option.value.empty() ? "" : " " + italic(option.value);
  std::string text = fmt::format(".TP\n{}{}\n{}\n", fmt::join(names, ", "), value, escaped(option.meaning));
  if (!option.choices.empty()) text += escaped(fmt::format("(one of: {})", fmt::join(option.choices, ", "))) + "\n";
  return text;
}

std::string section_of(const DeclaredCommand& command) {
  std::string synopsis, entries;
  for (const DeclaredOption& option : command.options) {
    synopsis += " " + in_synopsis(option);
    entries += entry(option);
  }
  std::string text =
      fmt::format(".SS {}\n{}{}\n.PP\n{}.\n{}", command.name, bold("mortise " + command.name), synopsis, escaped(command.meaning), entries);
  if (!command.footer.empty()) text += ".PP\n" + paragraphs(command.footer);
  return text;
}

}  // namespace

std::string manual_page(CLI::App& app) {
  std::string text = fmt::format(".TH MORTISE 1 \"\" \"mortise {}\" \"User commands\"\n", escaped(version_number()));
  text += ".SH NAME\nmortise \\- contact between bodies that deform, slide and yield\n";
  text += ".SH SYNOPSIS\n.B mortise\n.I COMMAND\n.RI [ ARGUMENTS ]\n.PP\n.B mpirun \\-n\n.I RANKS\n.B mortise run\n.I SCENE\n.RI [ ARGUMENTS ]\n";
  text += ".SH DESCRIPTION\n" + escaped(app.get_description()) + ".\n";
  text += ".SH COMMANDS\n";
  for (const DeclaredCommand& command : declared_commands(app)) text += section_of(command);
  return text + ".SH EXAMPLES AND EXIT STATUS\n" + literal(app.get_footer());
}

}  // namespace mortise
