#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mortise/io/csv_writer.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/output/quantity_evaluators.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/studies/peer.hpp"
#include "peer/calculix_deck.hpp"
#include "peer/calculix_results.hpp"
#include "peer/peer_evaluation.hpp"
#include "shared/run_process.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

/// The lines of its output that say what went wrong.
std::string first_messages(const std::string& output) {
  std::string found, line;
  std::istringstream stream(output);
  for (int lines = 0; lines < 6 && std::getline(stream, line);)
    for (const char* sign : {"*ERROR", "divergence", "singular", "too many"})
      if (line.find(sign) != std::string::npos) {
        found += (found.empty() ? "" : "; ") + line.substr(std::min(line.find_first_not_of(' '), line.size()));
        ++lines;
        break;
      }
  if (!found.empty()) return found;
  // The solver SPOOLES ends without a message where the matrix is singular.
  return "no message; the last line is \"" + boost::algorithm::trim_copy(output.substr(output.find_last_of('\n') + 1)) + '"';
}

Json steps_json(const CalculixResults& results) {
  Json steps = Json::array();
  for (const CalculixIncrement& increment : results.increments) {
    Json newton = Json::array();
    for (int i = 0; i <= increment.iterations; ++i) newton.push_back(Json::object());  // the first is the state before the first iteration
    steps.push_back({{"time", increment.time}, {"dt", increment.dt}, {"cutbacks", increment.cutbacks}, {"newton", newton}});
  }
  return steps;
}

void write_profiles(const RCP<const Communicator>& comm, const std::string& path, const Scene& scene, double time, const PeerEvaluation& evaluation) {
  CsvWriter file(comm, path, {"time", "pair", "part", "arc_length", "x", "y", "pressure", "gap"});
  const auto profiles = evaluation.profiles();
  for (std::size_t pair = 0; pair < profiles.size(); ++pair)
    for (const ProfilePoint& point : profiles[pair])
      file.row({time, scene.contact[pair].name, static_cast<long long>(point.part), point.arc_length, point.x, point.y, point.pressure, point.gap});
}

/// Files that CalculiX may leave where it is run.
const std::vector<std::string> files_of_calculix{"peer.sta",
                                                 "peer.cvg",
                                                 "peer.dat",
                                                 "peer.frd",
                                                 "peer.12d",
                                                 "peer.cel",
                                                 "contact.fbd",
                                                 "slavtan.fbd",
                                                 "intpoints.out",
                                                 "slavintmortar.out",
                                                 "spooles.out",
                                                 "ResultsForLastIterations.frd",
                                                 "peer_WarnNodeMissTiedContact.nam",
                                                 "peer_WarnSlaveNodeUnallowedMpc.nam",
                                                 "peer_WarnNodeNotProjected.nam"};

}  // namespace

ExitCode run_peer(const RCP<const Communicator>& comm, const PeerOptions& options) {
  RunLog log(comm, options.verbosity);
  const Timers timers;
  const Scene scene = read_scene(*comm, options.scene, options.settings);
  const Model model(comm, scene, timers);
  const QuantityEvaluators evaluators = make_evaluators(scene, model);  // says which names do not exist before anything is written
  std::vector<Diagnostic> obstacles = calculix_obstacles(scene, model);
  const Place place{"", 0, "--penalty"};
  if (!options.penalty.empty() && !has_penalty(options.peer))
    obstacles.push_back({place, fmt::format("{} presses without a penalty; please leave it out, or take another peer", peer_title(options.peer))});
  if (!obstacles.empty()) throw InputError(obstacles);
  const std::optional<double> penalty = penalty_multiple(options.penalty, scene.symbols, place);
  if (const std::string missing = missing_program(options.peer); !missing.empty()) throw FileError("not installed: " + missing);
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) : options.directory,
                            {"run", options.scene, options.directory.empty()});
  std::vector<std::string> names = files_of_calculix;
  names.insert(names.end(), {"peer.inp", "peer.log"});
  directory.begin_run(names);
  for (const auto& name : names) directory.claim(name);
  write_file(*comm, directory.claim("peer.inp"), [&] { return calculix_deck(scene, model, options.peer, penalty); });

  setenv("OMP_NUM_THREADS", "1", 1);  // one process on one core, as this program's ranks
  // It leaves files of its own where it is run.
  const ProcessEnding ending = run_process({"env", "-C", directory.path(), "ccx", "-i", "peer"});
  directory.strike_missing();
  write_file(*comm, directory.claim("peer.log"), [&] { return ending.output + "\n"; });
  const CalculixResults results = read_calculix_results(directory.path());
  const double end = scene.stepping.end_time;
  const bool finished = ending.code == 0 && results.end_time() > end * (1.0 - 1e-6) && results.time > end * (1.0 - 1e-6);

  Json summary{{"scene", options.scene}, {"version", options.version}, {"ranks", 1}, {"dofs", model.dofs()}, {"converged", finished}};
  summary["peer"] = {{"name", peer_title(options.peer)}, {"version", results.version},  {"exit", ending.code},
                     {"wall_s", ending.wall_seconds},    {"cpu_s", ending.cpu_seconds}, {"memory_mib", ending.memory_mib}};
  summary["steps"] = steps_json(results);
  summary["quantities"] = Json::object();
  summary["checks"] = Json::array();
  summary["time"] = {{"total", ending.wall_seconds}};
  summary["memory_total_mib"] = ending.memory_mib;
  if (finished) {
    const PeerEvaluation evaluation(scene, model, results);
    const auto values = evaluation.quantities(evaluators);
    for (std::size_t i = 0; i < values.size(); ++i) {
      summary["quantities"][scene.quantities[i].name] = std::isfinite(values[i]) ? Json(values[i]) : Json(nullptr);
      log.info(fmt::format("{} = {:.10g}", scene.quantities[i].name, values[i]));
    }
    if (scene.output.contact_profiles) write_profiles(comm, directory.claim("profiles.csv"), scene, end, evaluation);
  } else {
    log.warning(fmt::format("{} stopped at time {:g} of {:g}, exit code {}: {}", peer_title(options.peer), results.end_time(), end, ending.code,
                            first_messages(ending.output)));
  }
  write_json(*comm, directory.claim("summary.json"), summary);
  int iterations = 0;
  for (const auto& increment : results.increments) iterations += increment.iterations;
  log.info(fmt::format("{}: {} steps, {} iterations, {:.2f} s, {:.0f} MiB; results in {}", peer_title(options.peer), results.increments.size(),
                       iterations, ending.wall_seconds, ending.memory_mib, directory.path()));
  return finished ? ExitCode::done : ExitCode::not_converged;
}

const std::vector<std::pair<std::string, Peer>>& peer_names() {
  static const std::vector<std::pair<std::string, Peer>> names{{"none", Peer::none},
                                                               {"calculix mortar", Peer::calculix_mortar},
                                                               {"calculix surface to surface", Peer::calculix_surface_to_surface},
                                                               {"calculix node to surface", Peer::calculix_node_to_surface}};
  return names;
}

bool has_penalty(Peer peer) { return peer == Peer::calculix_surface_to_surface || peer == Peer::calculix_node_to_surface; }

std::optional<double> penalty_multiple(const std::string& expression, const Symbols& variables, const Place& place) {
  if (expression.empty()) return std::nullopt;
  const double multiple = parse_expression({}, expression, variables, place).at({});
  if (!(multiple > 0.0 && std::isfinite(multiple)))
    throw InputError({{place, fmt::format("the penalty is \"{}\" = {:g} times E/h; it has to be above 0", expression, multiple)}});
  return multiple;
}

std::string peer_name(Peer peer) {
  const auto& names = peer_names();
  return std::find_if(names.begin(), names.end(), [&](const auto& one) { return one.second == peer; })->first;
}

std::string peer_title(Peer peer) {
  const std::string name = peer_name(peer), first = "calculix";
  return name.compare(0, first.size(), first) == 0 ? "CalculiX" + name.substr(first.size()) : name;
}

std::string missing_program(Peer peer) {
  if (peer == Peer::none || run_process({"ccx", "-v"}).code != 127) return "";
  return "ccx (Debian: calculix-ccx)";
}

}  // namespace mortise
