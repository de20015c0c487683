#pragma once
// Mortar coupling of a slave and a master surface, distributed over MPI: search, segment integrals, dual basis, nodal normals.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/spatial.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mortar/mortar_options.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace mortise {

class InterfaceImplementation;

/// Surfaces that a coupling is not made for; another one may be.
class UnfitCoupling : public InputError {
 public:
  using InputError::InputError;
};

/// Matrices over the nodes of one slave facet.
using FacetMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_side_nodes, most_side_nodes>;
/// Values at the nodes of one slave facet.
using FacetVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_side_nodes, 1>;

/// Values of one slave facet and, if asked for, their first derivatives with respect to nodal positions, in a model of `dim` dimensions. Nodes are
/// local indices of MortarInterface::local_nodes().
///
/// The phi_j are the functions of the facet's multipliers: dual ones, formed on its covered part only, or N_j. The share of a node without multiplier
/// is given to the facet's other nodes; rows of nodes without multiplier are zero. On quadratic facets the phi_j are dual to, or are, the functions
/// Ñ_j of quadratic_facet.hpp, and so are w_j and the weight A_j.
///
/// Node to segment: one slave node with the facet that it meets. Its phi_j is a point load: D_jj is its share w of the surface, M_jl = w N_l, the gap
/// w times the distance.
///
/// At a kink that takes the master's normal, rows of D, M and gap of the node's owner are weighed with the facet's projected length: see
/// corner_normal.hpp.
struct FacetCoupling {
  Facet<LocalOrdinal> slave;          ///< local nodes of the slave facet
  std::vector<LocalOrdinal> master;   ///< nodes of the master facets that the slave facet overlaps, without repeats
  std::vector<LocalOrdinal> columns;  ///< nodes on whose positions the values depend: slave, ring (neighbours that shape the normals), master, nodes
                                      ///< of a kink's other facet
  /// D(j,k) = int phi_j N_k; dual: off-diagonal only for nodes k without multiplier, and, where j is a mid-side node, for corners k
  FacetMatrix D;
  Eigen::MatrixXd M;  ///< [slave x master] M(j,l) = int phi_j N_l
  FacetVector gap;    ///< [slave] int w_j g, w the gap weighting
  FacetVector cover;  ///< [slave] covered share of each node's weight, int N_j (Ñ_j) over the covered part by that over the whole facet. Empty with
                      ///< node to segment
  /// Derivatives; column dim c + i belongs to component i of columns[c]. Empty if not asked for.
  Eigen::MatrixXd dD;      ///< row slave.size() j + k
  Eigen::MatrixXd dM;      ///< row j master.size() + l
  Eigen::MatrixXd dgap;    ///< row j
  Eigen::MatrixXd dcover;  ///< row j; empty too where the whole facet is covered
  /// Of facets at a kink that takes the master's normal; else empty. Row j is m_j = -int N_j <-n.n_m> n_m, with the normals n of the facet and n_m of
  /// the master. Derivatives: row dim j + i.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_side_nodes, 3> facing;
  Eigen::MatrixXd dfacing;  ///< of `facing`
  /// Of such a facet 1 where it lies along the master, 0 where it stands off by 20 degrees or more, smooth in between; of others 1, no derivatives.
  double alignment = 1.0;
  Eigen::MatrixXd dalignment;  ///< one row
};

/// Contribution of one slave facet to the Hessian of a weighted sum of all weighted gaps.
struct GapCurvature {
  std::vector<LocalOrdinal> columns;  ///< local nodes, as in FacetCoupling
  Eigen::MatrixXd hessian;            ///< [dim x columns squared]
};

/// Unit normal of an owned slave node and its derivative: averaged, but at kinks.
struct NodalNormal {
  SpatialVector normal;                                                                  ///< unit vector, out of the body
  std::vector<LocalOrdinal> columns;                                                     ///< local nodes on whose positions it depends
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3> derivative;  ///< [dim x dim columns.size()]
};

/// An owned slave node. Constant during the life of the interface.
struct SlaveNode {
  GlobalOrdinal id = 0;            ///< of the node in the model
  LocalOrdinal owned_node = 0;     ///< local index in the map of owned nodes
  LocalOrdinal local_node = 0;     ///< local index in local_nodes(), which never changes
  std::array<bool, 3> fixed{};     ///< components with a prescribed displacement
  bool carries_multiplier = true;  ///< false: prescribed in every direction its normal could push it, or marked as a crosspoint
  bool middle = false;             ///< of an edge of quadratic facets: its dual multiplier acts on corners too
  double weight = 0.0;             ///< A_j = int N_j (Ñ_j) over the whole reference slave surface (with t or 2 pi R), times the pair's share

  /// True if any component is prescribed.
  bool partly_fixed() const { return fixed[0] || fixed[1] || fixed[2]; }
};

/// Share of this rank in the integrals of an interface. With node to segment, which integrates nothing, as at first.
struct InterfaceLoad {
  long facets = 0;                  ///< slave facets that overlap a master facet, in the last evaluation
  long segments = 0;                ///< their overlaps
  double imbalance_as_owned = 1.0;  ///< at the last search, over all ranks: largest over mean work, if every facet stayed with an owner of its nodes
  int redistributions = 0;          ///< searches that gave facets to other ranks
};

/// Kinks of the slave surface, on each rank those of the nodes that its facets need normals of.
struct SurfaceKinks {
  std::vector<char> is_kink;                                ///< [nodes] 1 where so; empty: not chosen yet
  std::vector<std::optional<std::size_t>> takes_normal_of;  ///< [nodes] which of its facets a kink has the normal of; none: the average
  /// The same kinks with the same normals.
  bool operator==(const SurfaceKinks& other) const { return is_kink == other.is_kink && takes_normal_of == other.takes_normal_of; }
};

/// [owned slave nodes] ids of nodes.
using RetainedNodes = std::vector<std::vector<GlobalOrdinal>>;

/// Nodes that a rank needs for an interface, and couplings between them. The order of nodes does not depend on earlier patterns.
struct InterfacePattern {
  /// Owned slave nodes first, the others of their facets and those that shape normals next. Then follow master nodes and retained ones by id, then
  /// those of facets that this rank integrates for others.
  RCP<const Map> local_nodes;
  RCP<const Import> import;  ///< from the map of owned nodes to local_nodes
  /// [owned slave nodes] every local node that may appear in `master` or `columns` of the couplings of its facets, and retained ones, ascending.
  std::vector<std::vector<LocalOrdinal>> coupled;
  /// [owned slave nodes] the nodes on which the multiplier may act, the rows of its column of D^T and M^T, a part of `coupled`. They are
  ///   - the node itself;
  ///   - its facets' nodes without multiplier, all of them with standard multipliers;
  ///   - corners where it is a mid-side node;
  ///   - master nodes.
  /// Variational mortar: all whose positions its gap depends on.
  std::vector<std::vector<LocalOrdinal>> loaded;
};

/// The mark of all components of a node that carries no multiplier of an interface, as other interfaces meet there.
inline constexpr double crosspoint_mark = 3.0;

/// One contact pair's coupling, in 2D or 3D, by the number of columns of the positions. Collective in all members but the accessors.
class MortarInterface {
 public:
  /// @param owned_nodes    one-to-one map of all nodes of the model
  /// @param reference      [owned nodes x dim] reference positions
  /// @param fixed          [owned nodes x dim] 1 where the displacement is prescribed, 2 where it follows a rigid body or a reference point, else 0.
  ///                       Only messages tell 1 from 2. crosspoint_mark: the node carries no multiplier here, though nothing holds it
  /// @param slave          every slave facet with a node owned by this rank (so a facet may stand on two ranks)
  /// @param master         the master facets of this rank, each on exactly one rank
  /// @throws InputError (at `place`, on every rank) for
  ///   - facets on other ranks than that or of nodes that nobody owns;
  ///   - a slave facet whose nodes, or mid-side nodes, all lack a multiplier ("make this side the master");
  ///   - a facet of zero length, an empty surface, or a node on both sides;
  ///   - quadratic facets with node to segment; and variational mortar in 3D or without the normals' derivatives.
  MortarInterface(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed, const SurfaceFacets& slave,
                  const SurfaceFacets& master, const InterfaceMeasure& measure, const MortarOptions& options, const Place& place);
  ~MortarInterface();

  /// Finds, for the positions `x` [owned nodes x dim], the master facets each slave facet may touch, and which rank integrates it. That is one of the
  /// owners of its nodes, or any where that would leave the ranks' work further apart than MortarOptions::balance. Cheap when no node moved further
  /// than a tenth of the shortest facet since the last real search. Returns (the same on every rank) whether the pattern was rebuilt. Does nothing if
  /// a position is not finite; evaluate() then reports it.
  bool search(const MultiVector& x);

  /// The kinks of the slave surface at positions `x`, after a choice `before`. They are convex nodes at which it turns by more than 30 degrees, or by
  /// 5 if the node is a kink already. In 3D they are those of the first choice alone. The facets that meet there have their own normals, and the node
  /// what MortarOptions::corner_rule() says. Collective.
  /// @param x        [owned nodes x dim] positions that tell
  /// @param nearest  [slave_nodes()] the facet nearest to the master, by its nodes; empty where none is covered: then the node's normal stays the
  ///                 average. No other rule needs it: empty
  SurfaceKinks find_kinks(const MultiVector& x, const std::vector<Facet<LocalOrdinal>>& nearest, const SurfaceKinks& before) const;

  /// Ids of the nodes of SurfaceKinks, owned slave nodes first. The facets that meet at a node, and their order, do not depend on the rank.
  std::vector<GlobalOrdinal> nodes_of_kinks() const;

  /// From now on the slave surface has these kinks. Returns, the same on every rank, whether they were others before: then the next search() rebuilds
  /// local_nodes() and the pattern. Collective.
  bool set_kinks(const SurfaceKinks& kinks);

  /// Number of owned slave nodes that are kinks at positions `x` [owned nodes x dim], whatever rule acts. Collective.
  long kinks(const MultiVector& x) const;

  /// From now on each owned slave node is coupled to these nodes too: those that a slip is measured against. Null: to none. Returns, the same on
  /// every rank, whether the next search() rebuilds local_nodes() and the pattern for that: not if all stand in coupled_nodes() already. Collective.
  bool retain(const std::shared_ptr<const RetainedNodes>& nodes);

  /// The coupled nodes; another object after each rebuild by search().
  const std::shared_ptr<const InterfacePattern>& pattern() const;
  /// InterfacePattern::local_nodes of the present pattern.
  const RCP<const Map>& local_nodes() const;

  /// Owned slave nodes, ascending by owned_node. slave_nodes()[s].local_node == s.
  const std::vector<SlaveNode>& slave_nodes() const;

  /// InterfacePattern::coupled of the present pattern.
  const std::vector<LocalOrdinal>& coupled_nodes(std::size_t s) const;
  /// InterfacePattern::loaded of the present pattern.
  const std::vector<LocalOrdinal>& loaded_nodes(std::size_t s) const;

  /// At positions `x` [local nodes x dim], couplings of all facets that touch an owned slave node and overlap a master facet. Normals are those of
  /// the owned slave nodes [slave nodes]. Every facet is integrated once; its coupling travels to the other ranks that own nodes of it. Values do not
  /// depend on who integrates. Failures (inverted facet, projection) go to `failure` of the rank that meets them; the couplings of other ranks are
  /// then incomplete.
  void evaluate(const MultiVector& x, bool derivatives, std::vector<FacetCoupling>& couplings, std::vector<NodalNormal>& normals,
                std::optional<StepFailure>& failure) const;

  /// Variational mortar: second derivatives of sum_j pressures_j g_j over the owned slave nodes j, at the positions of the last evaluate(), which met
  /// no failure. Each rank integrates the facets of its own nodes for them: nothing is sent.
  std::vector<GapCurvature> gap_curvatures(const MultiVector& x, const std::vector<double>& pressures) const;

  /// Collective. For some owned slave nodes (indices into slave_nodes()) the distance of the nearest master facet that faces the given unit normal,
  /// along that normal. Positions are `x` [owned nodes x dim, finite]. Negative: the facet stands behind the node, which has gone through it. However
  /// far, other than evaluate(). No value: no such facet.
  std::vector<std::optional<double>> distances_to_master(const MultiVector& x, const std::vector<std::size_t>& nodes,
                                                         const std::vector<SpatialVector>& normals) const;

  /// This rank's share of the work.
  const InterfaceLoad& load() const;
  /// Number of overlaps of which each coupling of the last evaluate() is the sum [couplings]; empty with node to segment.
  const std::vector<std::size_t>& segments() const;

  /// Distance up to which facets can touch.
  double reach() const;

  /// Length of the shortest slave facet between corners, over all ranks, in the reference configuration.
  double shortest_facet() const;
  /// Length of the longest facet of either side between corners, over all ranks, in the reference configuration.
  double longest_facet() const;

 private:
  std::unique_ptr<InterfaceImplementation> implementation_;
};

}  // namespace mortise
