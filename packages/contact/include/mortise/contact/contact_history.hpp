#pragma once
// Memory of contact of the last accepted state: plain data of the owned slave nodes, in the order of MortarInterface::slave_nodes().

#include <memory>
#include <vector>

#include "mortise/contact/contact_state.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Memory of one pair, which the library reads and writes.
struct PairHistory;

/// An accepted state, as the next step needs it.
struct AcceptedContact {
  std::vector<PairHistory> pairs;    ///< [pairs]
  ContactStates states;              ///< of their nodes
  RCP<const MultiVector> positions;  ///< [owned nodes x dim]
  RCP<const Vector> multipliers;     ///< z
  std::size_t layout = 0;            ///< digest of the slave nodes on this rank, by which another system's is known; 0: not known
};

/// The history of contact: an immutable value, cheap to copy. ContactSystem makes new ones: at the start, by commit(), and within a step by
/// start_step(), augment() and allow_overlap(). Whoever keeps an old one can go back to it.
class ContactHistory {
 public:
  /// The library makes them.
  explicit ContactHistory(AcceptedContact accepted);
  const AcceptedContact& operator*() const { return *accepted_; }    ///< its data
  const AcceptedContact* operator->() const { return &*accepted_; }  ///< its data

 private:
  std::shared_ptr<const AcceptedContact> accepted_;
};

}  // namespace mortise
