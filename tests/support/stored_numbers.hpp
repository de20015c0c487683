#pragma once
// An archive in memory.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/state_archive.hpp"

namespace mortise::test {

/// Keeps what is stored by this rank, or restores it.
class StoredNumbers final : public StateArchive {
 public:
  using Numbers = std::map<std::string, std::vector<double>>;
  /// Empty: it stores.
  StoredNumbers() = default;
  /// Restores these.
  explicit StoredNumbers(Numbers all) : numbers(std::move(all)), is_full_(true) {}
  bool restores() const override { return is_full_; }
  void values(const std::string& name, std::vector<double>& values) override {
    (is_full_ ? values : numbers[name]) = is_full_ ? numbers[name] : values;
  }
  void text(const std::string&, std::string&) override {}
  void rows(const std::string& name, const RowIds&, std::size_t, std::vector<double>& rows) override { values(name, rows); }
  void refuse_if(const std::optional<std::string>& wrong) override {
    if (wrong) throw FileError(*wrong);
  }

  Numbers numbers;

 private:
  bool is_full_ = false;
};

}  // namespace mortise::test
