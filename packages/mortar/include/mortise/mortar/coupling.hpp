#pragma once
// Couplings: what the multipliers of slave nodes act through. A new one: a struct in coupling/, and its line in coupling_registry().

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace Eigen {
template <class Scalar, int rows, int columns, int options, int most_rows, int most_columns>
class Matrix;
}  // namespace Eigen

namespace mortise {

/// Eigen::Vector2d, which needs Eigen only where a coupling is written.
using PlaneVector = Eigen::Matrix<double, 2, 1, 0, 2, 1>;

struct FacetCoupling;
struct InterfaceMeasure;
struct MortarOptions;
struct SlaveNodeData;

/// Functions that weight the gap.
enum class GapWeighting { dual, standard };

/// Normals at kinks of a slave surface: convex nodes at which it turns, in 3D those on its edges and at their ends.
enum class CornerRule {
  master_normal,  ///< facets have their own normals, the node has the master's, averaged over what the node's facets cover
  nearest_facet,  ///< facets have their own normals, the node has that of the facet nearest to the master; 2D only
  averaged        ///< the average of the facets' normals, as everywhere else
};

/// Functions through which a slave node's multiplier acts, and those that weight its gap: immutable, without options of its own. By default integrals
/// over the overlaps of facets, in 2D and in 3D.
class Coupling {
 public:
  virtual ~Coupling() = default;
  /// As messages say it.
  virtual std::string name() const = 0;

  /// True if the functions phi_j of the multipliers are dual to N_j, so that D is diagonal; else phi_j = N_j.
  virtual bool has_dual_multipliers() const = 0;
  /// True if the gap is weighted by the dual functions and not by N_j, where the pair asks for `asked`.
  virtual bool has_dual_gap(GapWeighting asked) const = 0;
  /// True if normal forces are the derivatives of the weighted gaps, so that second derivatives of these are needed; else they act as the phi_j do.
  virtual bool has_forces_of_gaps() const { return false; }

  /// False: each slave node is coupled by couple_node() in the place of integrals over facets.
  virtual bool integrates_facets() const { return true; }
  /// Couples a slave node with the master facets near it; 2D.
  /// @param masters     facets that may be met, in an order that does not depend on the partition
  /// @param reach       distance up to which they can be
  /// @param x           positions of the local nodes
  /// @param share       of the surface that the slave side stands for
  /// @param derivatives whether `coupling` gets them
  /// @return false if none is met; then `coupling` has no meaning
  virtual bool couple_node(const SlaveNodeData& slave, const std::vector<Facet<LocalOrdinal>>& masters, double reach,
                           const std::vector<PlaneVector>& x, const InterfaceMeasure& measure, double share, bool derivatives,
                           FacetCoupling& coupling) const;

  /// Rule at kinks, where the pair asks for `asked`: in 3D the average in the place of the nearest facet.
  virtual CornerRule corner_rule(CornerRule asked, int dimension) const;
  /// True if it exists in models of 2 or 3 dimensions.
  virtual bool exists_in(int /*dimension*/) const { return true; }
  /// True if facets may be quadratic.
  virtual bool takes_quadratic_facets() const { return true; }
  /// Why it does not go with these options; nothing where it does.
  virtual std::optional<std::string> refusal(const MortarOptions& /*options*/) const { return std::nullopt; }
};

/// A coupling as options hold it.
using SharedCoupling = std::shared_ptr<const Coupling>;

/// The object of a kind of coupling, the same in each call.
template <class Kind>
const SharedCoupling& coupling_of() {
  static const SharedCoupling coupling = std::make_shared<const Kind>();
  return coupling;
}

/// All couplings.
const std::vector<SharedCoupling>& coupling_registry();

}  // namespace mortise
