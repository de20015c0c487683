#include "mortise/mortar/coupling/variational_mortar.hpp"

#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

CornerRule VariationalMortarCoupling::corner_rule(CornerRule asked, int /*dimension*/) const {
  return asked == CornerRule::master_normal ? CornerRule::nearest_facet : asked;
}

std::optional<std::string> VariationalMortarCoupling::refusal(const MortarOptions& options) const {
  if (options.linearisation == Linearisation::exact) return std::nullopt;
  return "variational mortar takes its forces from the derivatives of the gap, those of the normals too; \"linearisation\" is \"frozen "
         "normals\", take \"exact\"";
}

}  // namespace mortise
