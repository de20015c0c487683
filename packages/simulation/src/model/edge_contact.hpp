#pragma once
// Contact of edges that cross in 3D.

#include <array>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/contributions.hpp"
#include "model/edges/edge_search.hpp"

namespace mortise {

/// A crossing of edges that may touch.
struct CrossingEdges {
  std::size_t contact = 0;        ///< pair of the scene
  Eigen::Vector3d place;          ///< half way between the two edges
  Eigen::Vector3d normal;         ///< out of the slave
  double gap = 0.0, force = 0.0;  ///< below 0: depth of the overlap; force of the edges then
  double stiffness = 0.0;         ///< K of F = K g^2
  double area = 0.0;              ///< of the section of the overlap, over the depth squared
  double length = 0.0;            ///< of the longer one of the pieces of the edges that cross
};

/// Weighted gaps are taken at the nodes of a slave facet. Where an edge of it crosses an edge of the master between nodes they see nothing, and where
/// a node is there they see it as wide as a facet. This adds the force of the crossing itself, F = K g^2: see wedge_contact(). The edges that may
/// touch, and K, are those of the accepted state, so that within a step F is a function of g. As facets come to resolve the crossing they lie on one
/// another there, g and K vanish, and weighted gaps have all of the force.
class EdgeContact final : public CountedContribution {
 public:
  /// @param displaced  places of all bodies at a displacement [owned dofs]; collective
  EdgeContact(std::shared_ptr<const Bodies> bodies, EdgeSearch search, std::vector<std::string> names,
              std::function<PlacedBodies(const Vector& displacement)> displaced, const Timers& timers);

  Kind kind() const override { return Kind::interaction; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

  /// A step starts from an accepted state with this displacement [owned dofs]. Collective.
  void start_step(const Vector& displacement);
  /// Looks at the displacement of a solution, before it is accepted. Collective.
  /// @throws StepFailure on every rank (lost_contact) for edges that overlap without a force, or deeper than the reach
  void examine(const Vector& displacement);
  /// Force on the slave side of a pair of the scene at a displacement [owned dofs, then ghosts]. Collective.
  std::array<double, 3> resultant(std::size_t pair, const Vector& local_displacement) const;
  /// True if edges of a pair bore a force in the solution that was examined last.
  bool acts(std::size_t pair) const { return acting_.count(pair) > 0; }
  /// Crossings in the solution that was examined last, the same on every rank.
  const std::vector<CrossingEdges>& crossings() const { return crossings_; }

  /// A graph, widened by what edges couple.
  RCP<const Graph> graph(const RCP<const Graph>& bulk) const;
  /// Grows whenever graph() changes.
  long graph_version() const { return version_; }

 private:
  std::vector<Eigen::Vector3d> places(const Vector& local_displacement) const;
  RCP<Vector> local(const Vector& displacement) const;
  /// Calls `visit` for each force that acts.
  void visit_forces(const Vector& local_displacement,
                    const std::function<void(const EdgeSpot&, const EdgeCrossing&, const CrossingForce&)>& visit) const;
  void take(EdgeSpots spots);

  std::shared_ptr<const Bodies> bodies_;
  EdgeSearch search_;
  std::vector<std::string> names_;
  std::function<PlacedBodies(const Vector&)> displaced_;
  EdgeSpots active_, next_;
  std::set<std::size_t> acting_;
  std::vector<CrossingEdges> crossings_;
  RCP<Vector> searched_at_;                                    ///< the displacement of next_; null: none
  std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> coupled_;  ///< nodes of the graph
  long version_ = 0;
};

}  // namespace mortise
