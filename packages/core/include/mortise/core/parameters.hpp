#pragma once
// Parameters declared once: every options struct has one `describe(Parameters&)` that names each of its parameters. Whatever reads, checks, prints
// or documents them is a visitor.

#include <Teuchos_ParameterList.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/scalar_function.hpp"

namespace mortise {

class Parameters;

/// Options that are reached through a base class (see Choice).
struct Described {
  virtual ~Described() = default;
  /// Names each parameter to the visitor.
  virtual void describe(Parameters& parameters) = 0;
};

/// Description of a parameter: one sentence, its unit and the values it may take. Built by chaining:
/// Says("relative bound on the momentum residual").unit("-").above(0.0)
class Says {
 public:
  /// The sentence describes the parameter, without its name, beginning with a small letter.
  Says(std::string sentence) : sentence_(std::move(sentence)) {}
  /// The sentence as a literal.
  Says(const char* sentence) : sentence_(sentence) {}
  /// In dimensions, as "length / time^2"; "-" has none.
  Says& unit(std::string unit) { return unit_ = std::move(unit), *this; }
  /// Values have to be > `bound`.
  Says& above(double bound) { return lower_ = bound, lower_open_ = true, *this; }
  /// Values have to be >= `bound`.
  Says& at_least(double bound) { return lower_ = bound, lower_open_ = false, *this; }
  /// Values have to be < `bound`.
  Says& below(double bound) { return upper_ = bound, upper_open_ = true, *this; }
  /// Values have to be <= `bound`.
  Says& at_most(double bound) { return upper_ = bound, upper_open_ = false, *this; }
  /// It has to be given; there is no default.
  Says& required() { return required_ = true, *this; }
  /// Arguments of a function, instead of t, x, y, z.
  Says& arguments(std::vector<std::string> names) { return arguments_ = std::move(names), *this; }
  /// The parameter's name in earlier versions; "": none. Input that still uses it is refused with the new name.
  Says& formerly(std::string name) { return former_ = std::move(name), *this; }

  const std::string& sentence() const { return sentence_; }                 ///< description of the parameter
  const std::string& unit() const { return unit_; }                         ///< empty: none was said
  const std::optional<double>& lower() const { return lower_; }             ///< none: no bound
  const std::optional<double>& upper() const { return upper_; }             ///< none: no bound
  bool lower_open() const { return lower_open_; }                           ///< true if the bound itself is refused
  bool upper_open() const { return upper_open_; }                           ///< true if the bound itself is refused
  bool is_required() const { return required_; }                            ///< true if there is no default
  const std::vector<std::string>& arguments() const { return arguments_; }  ///< empty: t, x, y, z
  const std::string& former() const { return former_; }                     ///< former name; empty: none

 private:
  std::string sentence_, unit_, former_;
  std::optional<double> lower_, upper_;
  bool lower_open_ = false, upper_open_ = false, required_ = false;
  std::vector<std::string> arguments_;
};

/// A value that remembers where it was given, for errors that are found later.
template <class T>
struct Located {
  T value{};    ///< the value read, or the default
  Place place;  ///< where; of the list around it if it was not given
};

/// A value for a parameter that somebody else reads, by the names of its lists and its own, separated by "/".
struct Assignment {
  std::string path;   ///< "list/list/name"
  std::string value;  ///< as written
  Place place;        ///< where the value is given
};

/// An entry of a list whose members have names of their own (materials, bodies, contact pairs, ...). `value` has a `describe`.
template <class T>
struct Named {
  std::string name;  ///< as it was given
  Place place;       ///< of its list
  T value{};         ///< its options
};

/// Named factories of everything that can stand behind a parameter "type". Adding a kind is one line where the registry is made.
template <class Base>
class Registry {
 public:
  /// One of the kinds.
  struct Entry {
    std::string name;                             ///< value of "type"
    std::string sentence;                         ///< description
    std::function<std::shared_ptr<Base>()> make;  ///< new options with their defaults
  };
  /// Adds a kind, whose options have a default constructor.
  template <class Kind>
  Registry& add(std::string name, std::string sentence) {
    entries_.push_back({std::move(name), std::move(sentence), [] { return std::make_shared<Kind>(); }});
    return *this;
  }
  /// In the order in which they were added.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

/// One of several kinds of options, distinguished by a parameter "type" in the list of the kind's own parameters.
template <class Base>
struct Choice {
  std::string type;               ///< name in the registry; empty: not given. Set beforehand, with the options, it is the default
  std::shared_ptr<Base> options;  ///< null only if no valid type was given
  Place place;                    ///< of the parameter "type"
};

/// The visitor that `describe` functions call. Names are lower case with spaces. A default is the value the member has when visited.
class Parameters {
 public:
  virtual ~Parameters() = default;

  /// A number.
  virtual void add(const std::string& name, double& value, const Says& says) = 0;
  /// A whole number.
  virtual void add(const std::string& name, int& value, const Says& says) = 0;
  /// "true" or "false".
  virtual void add(const std::string& name, bool& value, const Says& says) = 0;
  /// A text.
  virtual void add(const std::string& name, std::string& value, const Says& says) = 0;
  virtual void add(const std::string& name, ScalarFunction& value, const Says& says) = 0;  ///< of t, x, y, z unless it says others
  virtual void add(const std::string& name, std::optional<ScalarFunction>& value,
                   const Says& says) = 0;  ///< no value: not given, as the sentence says
  virtual void add(const std::string& name, std::optional<double>& value,
                   const Says& says) = 0;                                                            ///< no value: chosen as the sentence says
  virtual void add(const std::string& name, std::vector<double>& value, const Says& says) = 0;       ///< any number of them
  virtual void add(const std::string& name, std::vector<std::string>& value, const Says& says) = 0;  ///< any number of them

  /// One of named values of an enumeration.
  template <class Enum>
  void add(const std::string& name, Enum& value, const std::vector<std::pair<std::string, Enum>>& choices, const Says& says) {
    std::vector<std::string> names;
    std::size_t index = 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      names.push_back(choices[i].first);
      if (choices[i].second == value) index = i;
    }
    add_enumeration(name, index, names, says);
    if (value != choices[index].second) value = choices[index].second;
  }

  /// Any of these, with its place.
  template <class T>
  void add(const std::string& name, Located<T>& value, const Says& says) {
    add(name, value.value, says);
    locate(name, value.place);
  }

  /// One of named values of an enumeration, with its place.
  template <class Enum>
  void add(const std::string& name, Located<Enum>& value, const std::vector<std::pair<std::string, Enum>>& choices, const Says& says) {
    add(name, value.value, choices, says);
    locate(name, value.place);
  }

  /// A list of parameters: `options` has a `describe`.
  template <class Options>
  void list(const std::string& name, Options& options, const Says& says) {
    if (!begin_list(name, says)) return;
    options.describe(*this);
    end_list();
  }

  /// A list of lists that have names of their own.
  template <class T>
  void named(const std::string& name, std::vector<Named<T>>& entries, const Says& says) {
    NamedAccess access;
    access.size = [&] { return entries.size(); };
    access.name = [&](std::size_t i) { return entries[i].name; };
    access.append = [&](std::string entry, Place place) { entries.push_back({std::move(entry), std::move(place), T{}}); };
    access.describe = [&](std::size_t i, Parameters& visitor) { entries[i].value.describe(visitor); };
    access.describe_prototype = [](Parameters& visitor) { T{}.describe(visitor); };
    named_lists(name, access, says);
  }

  /// The parameter "type" and the parameters of the kind it selects, in the current list.
  template <class Base>
  void choose(Choice<Base>& choice, const Registry<Base>& registry, const Says& says) {
    ChoiceAccess access;
    for (const auto& entry : registry.entries()) access.kinds.push_back({entry.name, entry.sentence});
    access.type = choice.type;
    access.select = [&](std::size_t i, Place place) {
      choice.type = registry.entries()[i].name;
      choice.options = registry.entries()[i].make();
      choice.place = std::move(place);
    };
    access.describe = [&](Parameters& visitor) { choice.options->describe(visitor); };
    access.describe_prototype = [&](std::size_t i, Parameters& visitor) { registry.entries()[i].make()->describe(visitor); };
    choice_of("type", access, says);
  }

  /// A list handed on as it is to the package that owns its meaning (MueLu, Belos, NOX), which checks it.
  virtual void verbatim(const std::string& name, Teuchos::ParameterList& list, const Says& says) = 0;
  /// Reads the list with its place.
  void verbatim(const std::string& name, Located<Teuchos::ParameterList>& list, const Says& says) {
    verbatim(name, list.value, says);
    locate(name, list.place);
  }

  /// All entries of the current list: values that somebody else reads and checks. Names and those of lists within make paths.
  virtual void assignments(std::vector<Assignment>& assignments) = 0;

  /// Puts into `place` where the parameter or list `name` of the current list is given, or the list's own place if it is not. Leaves it
  /// alone when not reading.
  virtual void locate(const std::string& name, Place& place) const = 0;

  /// Says that what was just read does not go together. Does nothing when not reading, or if a parameter that the message quotes was refused.
  virtual void error(const std::string& name, const std::string& message) = 0;

 protected:
  /// Access of a visitor to the entries of named(), whatever their type.
  struct NamedAccess {
    std::function<std::size_t()> size;                       ///< number of entries
    std::function<std::string(std::size_t)> name;            ///< of an entry
    std::function<void(std::string, Place)> append;          ///< an entry with that name and defaults
    std::function<void(std::size_t, Parameters&)> describe;  ///< visits an entry
    std::function<void(Parameters&)> describe_prototype;     ///< visits an entry as it is before it is read
  };
  /// Access of a visitor to a choose(), whatever its base.
  struct ChoiceAccess {
    std::vector<std::pair<std::string, std::string>> kinds;            ///< name and sentence
    std::string type;                                                  ///< the current one, or empty
    std::function<void(std::size_t, Place)> select;                    ///< takes one of the kinds
    std::function<void(Parameters&)> describe;                         ///< visits the options of the current kind
    std::function<void(std::size_t, Parameters&)> describe_prototype;  ///< visits those of any kind, with their defaults
  };
  /// One of `names`, by its index.
  virtual void add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) = 0;
  virtual bool begin_list(const std::string& name, const Says& says) = 0;  ///< false: skip it
  /// After the parameters of a list for which begin_list() was true.
  virtual void end_list() = 0;
  /// Implements named().
  virtual void named_lists(const std::string& name, const NamedAccess& access, const Says& says) = 0;
  /// Implements choose(), of the parameter `name`.
  virtual void choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) = 0;
};

/// A list of values that somebody else reads.
struct AssignmentList {
  std::vector<Assignment> all;                                            ///< in the order given
  void describe(Parameters& parameters) { parameters.assignments(all); }  ///< takes all entries of the list
};

}  // namespace mortise
