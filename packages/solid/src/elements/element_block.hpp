#pragma once
// The elements of one body behind one virtual call a block; inside, nothing is virtual and nothing is allocated.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/state_archive.hpp"
#include "mortise/solid/bodies.hpp"
#include "mortise/solid/element_loop.hpp"

namespace mortise {

/// Arguments of the loops of a block.
struct BlockContext {
  const FieldSpace& space;  ///< displacements first
  const Block& block;
  LocalOrdinal index;  ///< of the block in the mesh
};

/// The middle of an element's nodes in the reference configuration, for people: "at (1, 0.5) of the reference configuration".
std::string element_place(const BlockContext& context, LocalOrdinal element);

/// Failure of an element that is turned inside out.
StepFailure inverted(const BlockContext& context, LocalOrdinal element, double determinant);
/// Failure at a point of an element where its law finds no stress.
/// @param why  of it, as "the law finds none"
StepFailure without_stress(const BlockContext& context, LocalOrdinal element, int point, double determinant, const std::string& why);

/// `unknowns`: of all fields on the local dofs. `time_step`: its length, of rates; infinite: there are none. See Bodies for what the members do.
class ElementBlock {
 public:
  virtual ~ElementBlock() = default;
  /// Adds the internal force to target.residual, the stiffness to target.matrix: to what is not null. Blocks that know the temperature add to its
  /// rows and columns too.
  virtual void add(const double* unknowns, double time_step, const AssemblyTarget& target, std::optional<StepFailure>& failure) const = 0;
  /// Whether it adds heat to the rows of the temperature.
  virtual bool heats() const { return false; }
  /// Power of the elements before `count` that becomes heat.
  virtual double heat(const double* /*unknowns*/, double /*time_step*/, LocalOrdinal /*count*/) const { return 0.0; }
  /// Points of the first `count` elements.
  virtual void visit_points(const double* unknowns, LocalOrdinal count, const std::function<void(const MaterialPoint&)>& visit) const = 0;
  /// See Bodies::begin(); by default nothing depends on it.
  virtual void begin(const double* /*unknowns*/) {}
  virtual void commit(const double* unknowns) = 0;
  /// The history of the last committed step, by the ids of the elements.
  virtual void serialize(StateArchive& archive, const std::string& name) = 0;
  virtual std::size_t history_bytes() const = 0;
  virtual long history_evaluations() const = 0;
  /// matrix += factor x consistent mass matrix.
  virtual void add_mass(double density, const NodalSparsity::Values& matrix, double factor) const = 0;
  /// masses[owned node] += lumped mass.
  virtual void add_nodal_masses(double density, std::vector<double>& masses) const = 0;
  /// volumes[owned node] += integral of N_a dV0.
  virtual void add_nodal_volumes(std::vector<double>& volumes) const = 0;
  /// The element with the smallest det dX/dxi and that value; element -1 if the block is empty.
  virtual std::pair<LocalOrdinal, double> smallest_reference_determinant() const = 0;
};

/// The block of elements that `body` asks for; check_combination() has to accept it.
/// @param temperature  the field that the law takes, which lives on all nodes of the block; none: the law knows no temperature
/// @param heat_at_start  s of ThermalLaw
std::unique_ptr<ElementBlock> make_element_block(const BlockContext& context, const BodyProperties& body, Kinematics kinematics, double thickness,
                                                 std::optional<std::size_t> temperature, double heat_at_start);

}  // namespace mortise
