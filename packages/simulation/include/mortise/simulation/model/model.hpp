#pragma once
// A scene made into objects: mesh, bodies, loads, boundary conditions, contact. Only what the scene names is built.

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/timers.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/heat_of_model.hpp"
#include "mortise/simulation/model/inertia_of_model.hpp"
#include "mortise/simulation/model/supports.hpp"
#include "mortise/simulation/model/surfaces_at_start.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

class DashpotForces;
class EdgeContact;
class Stabilisation;

/// Springs, dashpots and stabilisation of a model; null where the scene has none.
struct ConnectorsOfModel {
  std::shared_ptr<const Connectors> springs, dashpots;
  std::shared_ptr<DashpotForces> dashpot_forces;
  std::shared_ptr<Stabilisation> stabilisation;
};

/// Active effects and their subjects: ("finite strain", bodies), ("contact", pairs), ... in the order in which they are shown.
using Effects = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// History of a body between the steps, over all ranks. Ranks keep that of their ghost elements as well.
struct BodyHistory {
  std::string body;
  long bytes = 0;
  long evaluations = 0;  ///< of forces, stiffness and history by code that knows of history
};

/// State of a tie before anything moves, over all ranks.
struct TieAtStart {
  GlobalOrdinal tied = 0;   ///< slave nodes that follow the master
  GlobalOrdinal open = 0;   ///< slave nodes that no master covers within the tolerance, or hardly: they are free
  double tolerance = 0.0;   ///< [length]
  GlobalOrdinal moved = 0;  ///< slave nodes that were adjusted
  double furthest = 0.0;    ///< by so much [length]
};

/// Remarks on mesh files, in words: "body: ...".
struct MeshRemarks {
  std::vector<std::string> notes;     ///< changes and omissions
  std::vector<std::string> warnings;  ///< things that are most likely not meant
};

/// Everything that a run solves for and with.
class Model {
 public:
  /// Collective. Throws InputError, on all ranks, with everything that is wrong with the scene.
  Model(const RCP<const Communicator>& comm, const Scene& scene, const Timers& timers);
  ~Model();

  const RCP<const Mesh>& mesh() const { return mesh_; }
  const FieldSpace& space() const { return *space_; }
  const MeshSize& size() const { return size_; }
  /// mesh_digest() of the mesh as it was before ties adjusted it. Collective.
  std::string mesh_digest() const;
  const std::shared_ptr<const Bodies>& bodies() const { return bodies_; }
  /// Null if the scene has no contact.
  const std::shared_ptr<ContactSystem>& contact() const { return parts_.contact; }
  /// Without mass if the scene has no inertia.
  const InertiaOfModel& inertia() const { return inertia_; }
  /// Without bodies if the scene has no temperature.
  const HeatOfModel& heat() const { return heat_; }
  /// Null if no edges of the scene's pairs may cross.
  EdgeContact* edges() const { return edges_.get(); }
  const ConnectorsOfModel& connectors() const { return connectors_; }
  /// For each owned node whether it belongs to a body that nothing but contact holds.
  const std::vector<char>& held_by_contact_only() const { return held_by_contact_only_; }
  /// mesh.bodies indices of the bodies on either side of each contact pair, second passes behind all pairs of the scene.
  const std::vector<std::vector<int>>& bodies_of_pairs() const { return bodies_of_pairs_; }
  const Effects& effects() const { return effects_; }
  /// Supports of the bodies besides contact.
  const Supports& supports() const { return supports_; }
  /// Gaps and overlaps of the surfaces before anything moves.
  const SurfacesAtStart& surfaces_at_start() const { return surfaces_at_start_; }
  const MeshRemarks& mesh_remarks() const { return mesh_remarks_; }
  /// In the order of the scene.
  const std::vector<TieAtStart>& ties_at_start() const { return ties_at_start_; }

  GlobalOrdinal dofs() const;
  /// Slave nodes that carry a multiplier, over all ranks.
  GlobalOrdinal slave_nodes() const;

  /// Parts of the nonlinear system.
  const SystemParts& parts() const { return parts_; }

  /// Number of evaluations of each contribution on this rank, by its name.
  std::map<std::string, long> calls() const;

  /// Of all bodies, in the order of the scene. Collective.
  std::vector<BodyHistory> histories() const;

 private:
  /// @param loose  [mesh.bodies]
  void stabilise(const Scene& scene, const std::vector<char>& loose, const Timers& timers);

  RCP<const Mesh> mesh_;
  std::shared_ptr<const FieldSpace> space_;
  MeshSize size_;
  std::shared_ptr<const Bodies> bodies_;
  InertiaOfModel inertia_;
  HeatOfModel heat_;
  std::vector<char> held_by_contact_only_;
  std::vector<std::vector<int>> bodies_of_pairs_;
  Effects effects_;
  SurfacesAtStart surfaces_at_start_;
  MeshRemarks mesh_remarks_;
  std::vector<TieAtStart> ties_at_start_;
  Supports supports_;
  std::string mesh_digest_;  ///< empty: that of the mesh as it is
  SystemParts parts_;
  std::shared_ptr<EdgeContact> edges_;
  ConnectorsOfModel connectors_;
};

}  // namespace mortise
