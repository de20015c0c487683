#include "evaluation/option_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/container_hash/hash.hpp>
#include <cmath>
#include <cstdint>

#include "mortise/contact/friction.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/core/parameter_range.hpp"

namespace mortise::detail {
namespace {

/// Visits options: all of them as one text, and what is wrong with their values.
class CheckedOptions final : public Parameters {
 public:
  void add(const std::string& name, double& value, const Says& says) override { number(name, value, says); }
  void add(const std::string& name, int& value, const Says& says) override { number(name, value, says); }
  void add(const std::string& name, bool& value, const Says&) override { entry(name, value); }
  void add(const std::string& name, std::string& value, const Says&) override { entry(name, value); }
  void add(const std::string& name, ScalarFunction& value, const Says& says) override {
    entry(name, value.source());
    if (value.is_constant()) number(name, value.at({}), says);
  }
  void add(const std::string& name, std::optional<ScalarFunction>& value, const Says& says) override {
    if (value) add(name, *value, says);
  }
  void add(const std::string& name, std::optional<double>& value, const Says& says) override {
    if (value) number(name, *value, says);
  }
  void add(const std::string& name, std::vector<double>& value, const Says& says) override {
    for (const double one : value) number(name, one, says);
  }
  void add(const std::string& name, std::vector<std::string>& value, const Says&) override { entry(name, fmt::format("{}", value)); }
  using Parameters::add;
  void verbatim(const std::string&, Teuchos::ParameterList&, const Says&) override {}
  void assignments(std::vector<Assignment>&) override {}
  void locate(const std::string&, Place&) const override {}
  void error(const std::string&, const std::string&) override {}

  const std::string& text() const { return text_; }
  const std::vector<std::string>& wrong() const { return wrong_; }

 protected:
  void add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says&) override {
    entry(name, names[index]);
  }
  bool begin_list(const std::string& name, const Says&) override {
    lists_ += name + "/";
    return true;
  }
  void end_list() override { lists_.erase(lists_.size() < 2 ? 0 : lists_.rfind('/', lists_.size() - 2) + 1); }
  void named_lists(const std::string&, const NamedAccess& access, const Says&) override {
    for (std::size_t i = 0; i < access.size(); ++i) access.describe(i, *this);
  }
  void choice_of(const std::string& name, const ChoiceAccess& access, const Says&) override {
    entry(name, access.type);
    access.describe(*this);
  }

 private:
  template <class Value>
  void entry(const std::string& name, const Value& value) {
    text_ += fmt::format("{}{} = {}\n", lists_, name, value);
  }
  void number(const std::string& name, double value, const Says& says) {
    entry(name, value);
    if (std::isfinite(value) && is_in_range(value, says)) return;
    wrong_.push_back(
        fmt::format("\"{}{}\" is {}; allowed: finite numbers {}", lists_, name, std::isnan(value) ? std::abs(value) : value, range_text(says)));
  }

  std::string text_, lists_;
  std::vector<std::string> wrong_;
};

void refuse_second_pass(const std::vector<ContactPair>& pairs, std::size_t pair, std::vector<Diagnostic>& diagnostics) {
  const std::optional<std::size_t>& of = pairs[pair].second_pass_of;
  if (!of) return;
  if (*of >= pair)
    diagnostics.push_back(
        {pairs[pair].place, fmt::format("`second_pass_of` of pair {} is {}; give the number of an earlier pair, below {}", pair, *of, pair)});
  else if (!pairs[pair].options.formulation.options->two_pass() || !pairs[*of].options.formulation.options->two_pass())
    diagnostics.push_back({pairs[pair].place, fmt::format("`second_pass_of` is {}, but the formulation has one pass", *of)});
}

}  // namespace

void refuse_wrong_options(const Communicator& comm, std::vector<ContactPair>& pairs) {
  const auto count = static_cast<std::int64_t>(pairs.size());
  if (least_over_ranks(comm, count) != most_over_ranks(comm, count))
    throw InputError(Place{}, fmt::format("{} contact pairs are given on rank {}, another number on others; give every pair on each rank, also where "
                                          "it has no facets",
                                          count, comm.getRank()));
  std::vector<Diagnostic> diagnostics;
  std::vector<std::int64_t> digests;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    ContactPair& pair = pairs[p];
    CheckedOptions options;
    pair.options.describe(options);
    for (const std::string& wrong : options.wrong()) diagnostics.push_back({pair.place, wrong});
    refuse_second_pass(pairs, p, diagnostics);
    std::size_t digest = 0;
    boost::hash_combine(digest, pair.name);
    boost::hash_combine(digest, pair.youngs_modulus);
    boost::hash_combine(digest, pair.has_conditions_on_rate);
    boost::hash_combine(digest, pair.second_pass_of ? *pair.second_pass_of + 1 : 0);
    boost::hash_combine(digest, options.text());
    digests.push_back(static_cast<std::int64_t>(digest));
  }
  const std::vector<std::int64_t> least = least_over_ranks(comm, digests), most = most_over_ranks(comm, digests);
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (least[p] != most[p])
      diagnostics.push_back(
          {pairs[p].place, fmt::format("name, Young's modulus or options of pair {} differ between ranks; give all ranks the same", p)});
  throw_if_any(comm, diagnostics);
}

}  // namespace mortise::detail
