#pragma once
// Fills options from a scene's XML and says everything that is wrong with it.

#include <map>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/input/xml.hpp"

namespace mortise {

/// Visitor that fills the options it visits. Every value may be an expression of the symbols' variables.
class ReadParameters : public Parameters {
 public:
  /// @param ignored  names of lists of the outermost level that somebody else reads ("variables", "tables")
  ReadParameters(const XmlList& root, const Symbols& symbols, const std::vector<std::string>& ignored);

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
  void locate(const std::string& name, Place& place) const override { place = this->place(name); }
  void error(const std::string& name, const std::string& message) override;

  /// To call after the visit: reports entries of the outermost list that were not asked for, and returns all diagnostics in the order of lines.
  std::vector<Diagnostic> finish();

 protected:
  void add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) override;
  bool begin_list(const std::string& name, const Says& says) override;
  void end_list() override;
  void named_lists(const std::string& name, const NamedAccess& access, const Says& says) override;
  void choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) override;

 private:
  struct Frame {
    std::string name;
    const XmlList* list;  ///< null: the scene does not have it
    Place place;
    std::vector<std::string> known{};
    std::map<std::string, std::string> renamed{};  ///< former name, present name
    bool check_unknown = true;
    std::vector<std::vector<std::string>> refused{};  ///< parameters that keep their defaults, below the names of the lists within that hold them
  };
  Place place(const std::string& name) const;
  void know(const std::string& name, const Says& says);
  const XmlParameter* find(const std::string& name, const Says& says, const std::vector<std::string>& types);
  void say(const Place& place, const std::string& message) { diagnostics_.push_back({place, message}); }
  void refuse(const std::string& name, const Place& where, const std::string& message);
  void refuse(const std::string& name, const InputError& error);
  std::optional<double> number(const XmlParameter& parameter, const std::string& text, const Says& says);
  void report_unknown(const Frame& frame);
  Frame& frame() { return frames_.back(); }
  const Frame& frame() const { return frames_.back(); }

  const Symbols& symbols_;
  std::vector<Frame> frames_;
  std::vector<Diagnostic> diagnostics_;
};

/// Reads `options` (anything with a `describe`) from the outermost list of a scene; `diagnostics` gets what is wrong.
template <class Options>
void read_parameters(Options& options, const XmlList& root, const Symbols& symbols, const std::vector<std::string>& ignored,
                     std::vector<Diagnostic>& diagnostics) {
  ReadParameters reader(root, symbols, ignored);
  options.describe(reader);
  const std::vector<Diagnostic> found = reader.finish();
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
}

}  // namespace mortise
