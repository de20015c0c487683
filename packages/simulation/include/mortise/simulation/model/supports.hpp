#pragma once
// Supports of bodies besides contact.

#include <memory>
#include <vector>

#include "mortise/mortar/tied_surfaces.hpp"
#include "mortise/solid/connectors.hpp"
#include "mortise/solid/prescribed_motion.hpp"

namespace mortise {

struct Supports {
  std::vector<LocalOrdinal> prescribed;     ///< owned dofs, ascending
  RCP<const MultiVector> fixed;             ///< [owned nodes x dim] 1 where the displacement is prescribed, else 0
  std::vector<InclinedComponent> inclined;  ///< of owned nodes
  std::shared_ptr<const TieRows> ties;      ///< of surfaces; null: nothing is tied
  std::vector<LocalOrdinal> dofs;  ///< owned dofs on which supports act: those that are prescribed, and those of inclined supports, ascending
  std::vector<std::shared_ptr<const Connectors>> connectors = {};  ///< springs, and in statics dashpots
};

}  // namespace mortise
