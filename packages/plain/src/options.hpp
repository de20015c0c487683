#pragma once
// Options as text, "name = value" separated by ";" or line breaks. Names of lists come before those within them: "friction/coefficient = 0.3".

#include <map>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// Visitor that fills the options it visits. A function has to be a number.
class ReadOptions : public Parameters {
 public:
  /// @param where  whose options they are, for messages
  ReadOptions(const std::string& text, const std::string& where);

  void add(const std::string& name, double& value, const Says& says) override;
  void add(const std::string& name, int& value, const Says& says) override;
  void add(const std::string& name, bool& value, const Says& says) override;
  void add(const std::string& name, std::string& value, const Says& says) override;
  void add(const std::string& name, ScalarFunction& value, const Says& says) override;
  void add(const std::string& name, std::optional<ScalarFunction>& value, const Says& says) override;
  void add(const std::string& name, std::optional<double>& value, const Says& says) override;
  void add(const std::string& name, std::vector<double>& value, const Says& says) override;
  void add(const std::string& name, std::vector<std::string>& value, const Says& says) override;
  using Parameters::add;
  void verbatim(const std::string&, Teuchos::ParameterList&, const Says&) override {}
  void assignments(std::vector<Assignment>&) override {}
  void locate(const std::string&, Place& place) const override { place.path = where_; }
  void error(const std::string& name, const std::string& message) override;

  /// To call after the visit.
  /// @throws InputError with all that is wrong, names that were not asked for among it
  void finish();

 protected:
  void add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) override;
  bool begin_list(const std::string& name, const Says& says) override;
  void end_list() override { lists_.pop_back(); }
  void named_lists(const std::string&, const NamedAccess&, const Says&) override {}
  void choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) override;

 private:
  std::string path(const std::string& name) const;
  const std::string* find(const std::string& name, const Says& says);
  std::optional<double> number(const std::string& name, const std::string& text, const Says& says);
  void say(const std::string& message);

  std::string where_;
  std::map<std::string, std::string> given_;  ///< value by path
  std::vector<std::string> lists_, known_, refused_;
  std::vector<Diagnostic> diagnostics_;
};

/// Fills anything with a `describe`.
/// @throws InputError with all that is wrong
template <class Options>
void read_options(Options& options, const std::string& text, const std::string& where) {
  ReadOptions reader(text, where);
  options.describe(reader);
  reader.finish();
}

}  // namespace mortise
