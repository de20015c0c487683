#pragma once
// Other programs that run a scene, for comparison.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/types.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"

namespace mortise {

/// Contact of CalculiX (http://www.calculix.de), which is started as the program `ccx`.
enum class Peer { none, calculix_mortar, calculix_surface_to_surface, calculix_node_to_surface };

/// "none", "calculix mortar", "calculix surface to surface", "calculix node to surface".
const std::vector<std::pair<std::string, Peer>>& peer_names();

/// True if its contact presses by a penalty: all but mortar.
bool has_penalty(Peer peer);

/// The penalty of a peer's contact in multiples of E/h, from an expression of the scene's variables; none if that is empty: the deck's own choice.
/// @throws InputError if it is not a number above 0
std::optional<double> penalty_multiple(const std::string& expression, const Symbols& variables, const Place& place);

/// "calculix mortar", as `mortise peer --by` takes it.
std::string peer_name(Peer peer);

/// For tables: "CalculiX mortar".
std::string peer_title(Peer peer);

/// Settings of a peer's run of a scene.
struct PeerOptions {
  std::string scene;                  ///< file
  std::vector<std::string> settings;  ///< "path=value" each
  std::string directory;              ///< where results go; empty: default_directory(scene)
  Peer peer = Peer::none;
  std::string penalty;  ///< as penalty_multiple() takes it
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
