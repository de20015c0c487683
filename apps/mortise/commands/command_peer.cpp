#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "declarations.hpp"
#include "mortise/studies/peer.hpp"
#include "program.hpp"

namespace mortise {

void add_peer_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("peer", "run a scene by another program, for comparison: CalculiX");
  const auto options = std::make_shared<PeerOptions>();
  options->version = version();
  options->peer = Peer::calculix_mortar;
  command->add_option("SCENE", options->scene, "scene file")->required()->type_name(xml_value);
  add_settings(*command, options->settings);
  std::map<std::string, Peer> peers(peer_names().begin(), peer_names().end());
  peers.erase("none");
  std::vector<std::string> names;
  for (const auto& [name, peer] : peers) names.push_back(name);
  command
      ->add_option_function<std::string>(
          "--by", [options, peers](const std::string& name) { options->peer = peers.at(name); },
          "calculix mortar (the default), calculix surface to surface, calculix node to surface")
      ->check(one_of("peer", names))
      ->option_text("PEER");
  command
      ->add_option("--penalty", options->penalty,
                   "of contact, in multiples of E/h: a number or an expression of the scene's variables, e.g. 800/n; not of mortar.\n"
                   "Default: 1 in 2D, 50 in 3D")
      ->type_name("MULTIPLE");
  add_directory(*command, options->directory, "directory for the results; default: results/<name of the file SCENE>");
  command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command->footer(
      "Leaves peer.inp, the deck of the same mesh, what CalculiX writes beside it, and summary.json with the quantities that can be had of its\n"
      "results. Needs the program ccx (Debian: calculix-ccx). Exit codes: 2 if a deck cannot hold the scene, 3 if CalculiX did not come to its end,\n"
      "5 if it is not installed.\n"
      "Example: mortise peer inputs/paper/hertz_elastic.xml --by 'calculix node to surface' -o peer");
  command->callback([&program, options] {
    program.action = [&program, options] {
      if (program.comm->getSize() == 1) return run_peer(program.comm, *options);
      if (program.is_first_rank()) print(program, "mortise peer runs on one rank: please call it without mpirun\n");
      return ExitCode::usage;
    };
  });
}

}  // namespace mortise
