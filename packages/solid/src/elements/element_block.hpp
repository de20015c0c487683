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

/// `displacement`: on the local dofs. See Bodies for what the members do.
class ElementBlock {
 public:
  virtual ~ElementBlock() = default;
  /// Adds the internal force to target.residual, the stiffness to target.matrix: to what is not null.
  virtual void add(const double* displacement, const AssemblyTarget& target, std::optional<StepFailure>& failure) const = 0;
  /// Points of the first `count` elements.
  virtual void visit_points(const double* displacement, LocalOrdinal count, const std::function<void(const MaterialPoint&)>& visit) const = 0;
  virtual void commit(const double* displacement) = 0;
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
std::unique_ptr<ElementBlock> make_element_block(const BlockContext& context, const BodyProperties& body, Kinematics kinematics, double thickness);

}  // namespace mortise
