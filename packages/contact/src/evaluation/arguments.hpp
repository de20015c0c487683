#pragma once
// Checks of the arguments of one call of a host, refused on every rank alike.

#include <optional>
#include <string>

#include "evaluation/evaluated_contact.hpp"

namespace mortise::detail {

/// Arguments of one call. What does not fit is kept until agree(), so that no rank goes on alone.
class Arguments {
 public:
  /// @param call  as messages name it
  Arguments(const ContactModel& model, const char* call) : model_(model), call_(call) {}

  /// A vector on the dofs of the system.
  Arguments& on_dofs(const Vector& vector, const char* name);
  /// A vector on the map of multipliers.
  Arguments& on_multipliers(const Vector& vector, const char* name);
  /// A displacement: on the dofs, and on the owned nodes if it has such a part.
  Arguments& displacement(const NodalDisplacement& d);
  /// A history of this system, or of one with the same slave nodes on the same ranks and the same multipliers.
  Arguments& history(const ContactHistory& history);
  /// States of the nodes of this system.
  Arguments& states(const ContactStates& states);
  /// A finite number that is `allowed`, within a range that messages name.
  Arguments& number(double value, const char* name, bool allowed, const char* range);

  /// Collective. Throws std::invalid_argument on every rank if anything did not fit on any rank.
  void agree() const;

 private:
  void refuse(const std::string& what);
  void on_map(const Map& map, const Map& wanted, const char* name, const char* of_what);

  const ContactModel& model_;
  const char* call_;
  std::optional<std::string> wrong_;  ///< the first one on this rank
};

/// Digest of the slave nodes of all pairs on this rank, of those whose data histories hold.
std::size_t layout_of(const ContactModel& model);

/// Throws std::out_of_range for a pair that a system does not have. Not collective.
void require_pair(const ContactModel& model, std::size_t pair);
/// Throws std::logic_error, on every rank, for a value of another system.
void require_own(const ContactModel& model, const ContactModel& of_value, const char* call);

}  // namespace mortise::detail
