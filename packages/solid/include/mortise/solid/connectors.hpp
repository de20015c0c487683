#pragma once
// Springs and dashpots on nodes, reference points and sets of nodes.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/solid/bodies.hpp"
#include "mortise/solid/connector_law.hpp"

namespace mortise {

/// What a spring or a dashpot acts on.
struct ConnectorOptions {
  enum class Per { set, node };
  Located<std::string> set;                         ///< nodes or sides, or a reference point
  Located<std::string> to;                          ///< another set; empty: the ground
  std::vector<double> anchor;                       ///< fixed point at the other end of an axial one; empty: none
  Per per = Per::set;                               ///< of components against the ground: for the whole set, or for each of its nodes
  std::array<std::optional<double>, 3> components;  ///< x, y, z
  std::optional<double> axial;                      ///< along the line between its ends
  std::optional<double> rotational;                 ///< of a reference point that rotates
  std::optional<double> rest_length;                ///< of an axial spring without force; none: that at the start

 protected:
  /// @param word  "stiffness" or "coefficient", that parameters begin with
  void describe(Parameters& parameters, const std::string& word, const std::string& unit, const std::string& rotational_unit);
};

/// A spring. [force / length]
struct SpringOptions : ConnectorOptions {
  void describe(Parameters& parameters);
};

/// A dashpot, whose force is a coefficient times a velocity. [force time / length]
struct DashpotOptions : ConnectorOptions {
  void describe(Parameters& parameters);
};

/// A node with the factor of its displacement.
struct ShareOfNode {
  LocalOrdinal node;  ///< owned or ghost
  double weight;
};

/// A motion e = sum w_a u_a with its law: the displacement of a point relative to another one, or to the ground. Of a rotation, u_a are the dofs
/// arm * theta of rotation nodes and w = +-1/arm.
struct ConnectorLink {
  std::size_t connector = 0;                          ///< which one of the list it is part of
  ConnectorLaw law;                                   ///< of this part
  double part = 1.0;                                  ///< of the connector's motion that it stands for
  bool is_grounded = true;                            ///< else e is a motion of the second end relative to the first
  bool is_rotation = false;                           ///< e is an angle in its first component, in 3D a rotation vector
  bool is_spread = false;                             ///< its nodes are on several ranks, and `shares` has those of this rank
  bool counts = true;                                 ///< this rank counts its energy and force
  std::vector<ShareOfNode> shares;                    ///< signed
  std::vector<std::pair<GlobalOrdinal, double>> all;  ///< of a spread one, on all ranks
  Eigen::Vector3d start = Eigen::Vector3d::Zero();    ///< X of the law

  /// Of the force on the first end, or on the only one.
  double sign() const { return is_grounded ? -1.0 : 1.0; }
};

/// One spring or dashpot at a time.
struct ConnectorState {
  std::array<double, 3> force{};       ///< on its `set`; 0 of an axial one
  std::array<double, 3> elongation{};  ///< components of the motion of `to` relative to `set`; against the ground the mean motion of `set`
  double along = 0.0;                  ///< force along the line of an axial one, above 0 in tension
  double elongation_along = 0.0;       ///< over the length without force; of a dashpot over that at the start
  double moment = 0.0;                 ///< on the reference point `set`; in 3D its size
  double rotation = 0.0;               ///< [radians] in 3D its size
  double power = 0.0;                  ///< of a dashpot, what it takes
  double energy = 0.0;                 ///< of a spring
};

/// Springs, or dashpots, of a model.
///
/// Against the ground, components act at all places of a set of sides, k/A for each area (so that the force on node a is integral of N_a k/A u
/// dGamma), k/n at each of the n nodes of a set of nodes, or k at each node. Between two sets, and along lines, the ends are the mean places of the
/// sets, by area of sides, else of nodes: e = mean(u of `to`) - mean(u of `set`), and a force on a mean acts on the nodes by their weights in it.
class Connectors {
 public:
  /// Collective. Throws InputError on all ranks for sets that do not exist, a z in 2D, ends that coincide, sets with too many nodes.
  Connectors(std::shared_ptr<const Bodies> bodies, const std::vector<Named<SpringOptions>>& springs);
  /// Likewise.
  Connectors(std::shared_ptr<const Bodies> bodies, const std::vector<Named<DashpotOptions>>& dashpots);

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<ConnectorLink>& links() const { return links_; }
  const std::shared_ptr<const Bodies>& bodies() const { return bodies_; }
  bool are_springs() const { return are_springs_; }

  /// residual += forces on owned dofs. Vectors on owned dofs and ghosts; springs need no velocity. Collective.
  void add_forces(const Vector& displacement, const Vector* velocity, Vector& residual, std::optional<StepFailure>& failure) const;

  /// matrix += by_motion df/du + by_velocity df/dv; its graph has to hold coupled(). Collective.
  /// @param velocity_shares  factors of the columns of df/dv, on owned dofs and ghosts; null: 1
  void add_derivatives(const Vector& displacement, const Vector* velocity, double by_motion, double by_velocity, const Vector* velocity_shares,
                       Matrix& matrix) const;

  /// Of the n-th one. Collective.
  ConnectorState state(std::size_t n, const Vector& displacement, const Vector* velocity) const;

  /// Stored by all springs. Collective.
  double energy(const Vector& displacement) const;

  /// Pairs of nodes that are coupled, of rows of this rank.
  std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> coupled() const;

 private:
  /// Motions of the links. Collective if any is spread.
  std::vector<Eigen::Vector3d> motions(const Vector& vector) const;
  std::vector<ConnectorForce> forces(const Vector& displacement, const Vector* velocity) const;
  /// [nodes of all spread links] factors of velocities; empty without. Collective.
  std::vector<double> shares_of_spread_links(const Vector* velocity_shares) const;

  std::shared_ptr<const Bodies> bodies_;
  bool are_springs_;
  std::vector<std::string> names_;
  std::vector<Place> places_;
  std::vector<ConnectorLink> links_;
};

}  // namespace mortise
