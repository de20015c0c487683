#pragma once
// The host's matrix in compressed rows, as the matrix that contact adds to and condenses.

#include <cstdint>
#include <vector>

#include "agreement.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/plain/plain_contact.hpp"

namespace mortise {

/// Keeps the pattern, so that graphs are made only where it changes. Collective in all members.
class HostSystem {
 public:
  explicit HostSystem(RCP<const Map> rows) : rows_(std::move(rows)) {}

  /// The host's entries on the graph of an evaluation: open for changes.
  /// @throws PlainError on every rank for a column that is no row of any rank
  const RCP<Matrix>& fill(const PlainMatrix& K, const ContactSystem& contact, const ContactEvaluation& at);
  /// Zeros on the graph of contact alone.
  RCP<Matrix> zeros(const ContactSystem& contact, const ContactEvaluation& at) const;

 private:
  void take_pattern(const PlainMatrix& K);
  RCP<const Graph> graph() const;

  RCP<const Map> rows_;
  std::vector<std::int64_t> starts_, columns_;
  long version_ = 0;  ///< of the pattern; 0 is that of zeros()
  RCP<Matrix> matrix_;
  std::vector<LocalOrdinal> local_columns_;  ///< of `columns_` in `matrix_`
};

}  // namespace mortise
