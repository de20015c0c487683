#pragma once
// Options as data: the source of `describe`, of the reference pages, of the schema and of effective.xml.

#include <string>
#include <utility>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/input/expression.hpp"

namespace mortise {

/// A parameter and its value.
struct ParameterRecord {
  /// Type of its values.
  enum class Kind { number, integer, boolean, text, expression, optional_expression, optional_number, numbers, texts, enumeration };
  std::string name;                  ///< in its list
  Kind kind = Kind::text;            ///< of its value
  std::string value;                 ///< as one would write it; empty for an optional one without a value
  Says says{""};                     ///< sentence, unit and bounds
  std::vector<std::string> choices;  ///< of an enumeration

  /// Type attribute of the XML dialect.
  std::string type() const;
  /// "number", "expression of t, x, y", "one of ..." for people.
  std::string kind_text() const;
  /// "> 0, <= 1"; empty if any value is allowed.
  std::string range_text() const;
  /// True if it may be left without a value.
  bool optional() const { return kind == Kind::optional_number || kind == Kind::optional_expression; }
};

/// A list of parameters and lists.
struct ListRecord {
  /// list: of parameters. named: of lists whose names the user chooses. verbatim: of what another package knows.
  enum class Kind { list, named, verbatim };
  std::string name;                         ///< in the list around it
  Says says{""};                            ///< its description
  Kind kind = Kind::list;                   ///< named: `lists` are the entries, or one prototype "<name>"
  std::vector<ParameterRecord> parameters;  ///< in the order of their declaration
  std::vector<ListRecord> lists;            ///< in the order of their declaration
  /// Kinds behind a parameter "type": name, sentence and the parameters of each kind. With values: only the one chosen, already merged.
  std::vector<std::pair<std::string, ListRecord>> kinds;
  Teuchos::ParameterList verbatim;  ///< of that kind
};

/// Visitor that writes down what it visits and leaves it as it is.
class CollectParameters : public Parameters {
 public:
  /// Choice of the recorded data.
  enum class What {
    declarations,  ///< all kinds of every choice, one prototype of every named list
    values         ///< the present values of the options
  };
  /// `name` is that of the outermost list.
  CollectParameters(std::string name, What what);

  void add(const std::string& name, double& value, const Says& says) override;
  void add(const std::string& name, int& value, const Says& says) override;
  void add(const std::string& name, bool& value, const Says& says) override;
  void add(const std::string& name, std::string& value, const Says& says) override;
  void add(const std::string& name, ScalarFunction& value, const Says& says) override;
  void add(const std::string& name, std::optional<double>& value, const Says& says) override;
  void add(const std::string& name, std::optional<ScalarFunction>& value, const Says& says) override;
  void add(const std::string& name, std::vector<double>& value, const Says& says) override;
  void add(const std::string& name, std::vector<std::string>& value, const Says& says) override;
  using Parameters::add;
  void verbatim(const std::string& name, Teuchos::ParameterList& list, const Says& says) override;
  void assignments(std::vector<Assignment>& assignments) override;
  void locate(const std::string&, Place&) const override {}
  void error(const std::string&, const std::string&) override {}

  /// The outermost list, after the visit.
  const ListRecord& tree() const { return stack_.front(); }

 protected:
  void add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) override;
  bool begin_list(const std::string& name, const Says& says) override;
  void end_list() override;
  void named_lists(const std::string& name, const NamedAccess& access, const Says& says) override;
  void choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) override;

 private:
  void record(const std::string& name, ParameterRecord::Kind kind, std::string value, const Says& says, std::vector<std::string> choices = {});
  ListRecord& here() { return stack_.back(); }

  What what_;
  std::vector<ListRecord> stack_;
};

/// The part of a tree below a path of list names ("contact/<name>" or "contact"); null if there is none.
const ListRecord* find_list(const ListRecord& tree, const std::string& path);

std::string to_text(const ListRecord& tree);      ///< for a terminal
std::string to_markdown(const ListRecord& tree);  ///< tables, one for each list
/// For programs: {"name", "sentence", "parameters": [{"name", "kind", "default", "unit", "range", "choices", "required", "sentence"}], "kinds":
/// {type: list}, "lists": [list]}; a key without a value is left out. From declarations.
std::string to_json(const ListRecord& tree);
/// Schema in RELAX NG's XML syntax; from declarations.
/// @param symbols  whether the file may hold the lists "variables" and "tables"
std::string to_relax_ng(const ListRecord& tree, bool symbols = true);
/// A scene with everything spelled out; from values. `extra` are lists put first ("variables", "tables").
std::string to_scene_xml(const ListRecord& tree, const std::vector<ListRecord>& extra);
/// The lists "variables" and "tables" of symbols.
std::vector<ListRecord> symbol_lists(const Symbols& symbols);

/// The tree of options that have a `describe`.
template <class Options>
ListRecord collect_parameters(const std::string& name, const Options& options, CollectParameters::What what) {
  CollectParameters collector(name, what);
  const_cast<Options&>(options).describe(collector);  // not const for the visitors that fill options; this one does not write
  return collector.tree();
}

}  // namespace mortise
