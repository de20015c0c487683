#pragma once
// Scene files as trees of lists and parameters with the lines they stand on. The dialect is Teuchos':
// <ParameterList name="..."> and <Parameter name="..." type="..." value="..."/>.

#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/input/expression.hpp"

namespace mortise {

/// A parameter of a list: what the attributes of its element say.
struct XmlParameter {
  std::string name;   ///< unique in its list
  std::string type;   ///< "double", "int", "bool", "string"; empty if the command line gives it
  std::string value;  ///< as written
  Place place;        ///< path: of the list it stands in
};

/// A list of parameters and lists.
struct XmlList {
  std::string name;                      ///< unique in the list around it
  Place place;                           ///< path: of the list itself, below the outermost one
  std::vector<XmlParameter> parameters;  ///< in the order of the file
  std::vector<XmlList> lists;            ///< in the order of the file

  /// The parameter of that name in this list; null if there is none.
  const XmlParameter* parameter(const std::string& name) const;
  /// The list of that name in this list; null if there is none.
  const XmlList* list(const std::string& name) const;
};

/// Collective: the text of a file, read by rank 0. Throws FileError on every rank.
std::string read_text(const Communicator& comm, const std::string& path);

/// Parses a scene's text. No external entities are loaded and nothing is fetched. Throws InputError with everything that is wrong: malformed
/// XML, unknown elements and attributes, missing or repeated names.
XmlList parse_xml(const std::string& text, const std::string& file);

/// Error message for the form of "path=value": no "=", or a path with an empty name. "" if the form is right.
std::string wrong_assignment(const std::string& assignment);

/// Applies `--set path=value`, path being list names and a parameter's name separated by "/". Lists and parameters that the file lacks
/// are made; the reader then says whether they mean anything. Throws InputError if the form is wrong, or if the path goes on below a parameter.
void apply_override(XmlList& root, const std::string& assignment);

/// Applies a value that another file gives, at `place`, which errors then name.
void apply_override(XmlList& root, const std::string& path, const std::string& value, const Place& place);

/// Takes the lists "variables" (numbers, each may use the ones before it) and "tables" ({times, values}) of a scene, and appends what is wrong
/// with them to `diagnostics`.
Symbols read_symbols(const XmlList& root, std::vector<Diagnostic>& diagnostics);

}  // namespace mortise
