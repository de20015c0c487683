#pragma once
// Other programs that run a scene, for comparison.

#include <string>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Contact of CalculiX (http://www.calculix.de), which is started as the program `ccx`.
enum class Peer { none, calculix_mortar, calculix_surface_to_surface, calculix_node_to_surface };

/// "none", "calculix mortar", "calculix surface to surface", "calculix node to surface".
const std::vector<std::pair<std::string, Peer>>& peer_names();

/// For tables: "CalculiX mortar".
std::string peer_title(Peer peer);

/// How a peer runs a scene.
struct PeerOptions {
  std::string scene;                  ///< file
  std::vector<std::string> settings;  ///< "path=value" each
  std::string directory;              ///< where results go; empty: default_directory(scene)
  Peer peer = Peer::none;
  Verbosity verbosity = Verbosity::normal;
  std::string version;  ///< of this program
};

/// Writes a scene, on its mesh, as the deck peer.inp, lets the peer run it and reads what it found. Leaves peer.* in the directory, summary.json with
/// those names of a run's that a peer has, and profiles.csv with the contact pressures if the scene wants it. `comm` has one rank.
/// Returns done, or not_converged if the peer did not come to its end, having said why. Throws InputError with everything that a deck cannot hold;
/// FileError, also if the peer is not installed.
ExitCode run_peer(const RCP<const Communicator>& comm, const PeerOptions& options);

/// The peer's program, if it cannot be started: "ccx (Debian: calculix-ccx)"; else empty.
std::string missing_program(Peer peer);

}  // namespace mortise
