#pragma once
// Couplings of slave nodes as fields beside the displacement need them: rows of D and M, pressure, gap, slip and work of friction, with derivatives.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/contact/contact_linearisation.hpp"
#include "mortise/contact/contact_state.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// A number at a slave node j, with its derivatives.
struct NodeQuantity {
  double value = 0.0;                     ///< the number
  std::array<double, 3> of_multiplier{};  ///< by the components of z_j
  std::vector<double> of_positions;       ///< entry dim c + i: by component i of NodeTransfer::nodes[c]; empty without derivatives
};

/// A slave node j that is covered, with the nodes m that it is coupled to. With c_jk = D_jk at slave nodes and c_jl = -M_jl at master nodes,
///   sum_m c_jm u_m
/// is the weighted jump of a field u from the master to the slave. A flux q_j that leaves the slave enters the rows of the nodes as  c_jm q_j.
struct NodeTransfer {
  GlobalOrdinal node = 0;                   ///< j, its id
  LocalOrdinal owned_node = 0;              ///< its local index in the map of owned nodes
  GlobalOrdinal multiplier = 0;             ///< id of the first component of z_j in ContactSystem::multiplier_map()
  ContactState state = ContactState::open;  ///< of its law
  std::vector<LocalOrdinal> nodes;          ///< m, local indices in FieldTransfer::nodes(), ascending
  std::vector<double> coefficients;         ///< [nodes] c_jm
  std::vector<char> loaded;                 ///< [nodes] whether c_jm may be other than 0: others shape the normal, or are kept for slips
  NodeQuantity weight;                      ///< w_j = sum_k D_jk = sum_l M_jl > 0
  NodeQuantity pressure;                    ///< z_j . n_j
  NodeQuantity gap;                         ///< mean gap g_j / w_j [length]
  NodeQuantity slip;                        ///< |s_j| / w_j since the start of the step [length]; 0 unless it slips with friction
  NodeQuantity friction_work;               ///< (T_j z_j) . s_j: what friction takes in the step; 0 unless it slips with friction
  std::vector<double> coefficient_slopes;   ///< row m, column dim c + i: derivative of c_jm, as of_positions; empty without derivatives
};

/// The couplings of the slave nodes of a pair at an iterate. A node slips by the weighted slip s_j of the step; one that was not covered when the
/// step began by the part of it after first contact. Ties of hardly covered nodes are no part of it. A value. Collective where it says so.
class FieldTransfer {
 public:
  /// Without derivatives. Collective.
  /// @throws std::out_of_range for a pair that does not exist
  FieldTransfer(const ContactLaws& laws, std::size_t pair);
  /// With derivatives. Collective.
  /// @throws std::out_of_range for a pair that does not exist
  FieldTransfer(const ContactLinearisation& at, std::size_t pair);

  /// Ids of the nodes of the interface on this rank, those of other ranks too. The same object as long as the candidates of contact stay.
  const RCP<const Map>& nodes() const;
  /// Values of a nodal field on nodes(), from those on the map of owned nodes. Collective.
  RCP<MultiVector> on_nodes(const MultiVector& of_owned_nodes) const;
  /// True for a node of nodes() that is one of the slave's.
  bool is_slave(LocalOrdinal node) const;
  /// Dofs of the displacement of a node of nodes(); NodalField::none where a component is no unknown.
  GlobalOrdinal displacement_id(LocalOrdinal node, int component) const;

  std::size_t size() const;  ///< number of owned slave nodes, in the order of ContactSystem::slave_ids()
  /// True if a slave node has a multiplier and is covered. One that has none is coupled through the rows of the nodes around it.
  bool is_covered(std::size_t slave) const;
  /// The couplings of a slave node that is covered.
  NodeTransfer operator[](std::size_t slave) const;

 private:
  struct Content;
  std::shared_ptr<const Content> content_;
};

}  // namespace mortise
