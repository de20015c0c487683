// Share of contact in the steps of Hertz' problem: search, integrals, residual and graph of the condensed system (contact), condensation and
// recovery (condensation).
//
//     contact_share_benchmark [n ...]        elements per half width of the contact; by default 16 48 110: about 12k, 51k, 191k dofs

#include <fmt/format.h>

#include <Tpetra_Core.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"

int main(int argc, char** argv) {
  using namespace mortise;
  Tpetra::ScopeGuard scope(&argc, &argv);
  const auto comm = Tpetra::getDefaultComm();
  std::vector<std::string> sizes(argv + 1, argv + argc);
  if (sizes.empty()) sizes = {"16", "48", "110"};
  if (comm->getRank() == 0)
    fmt::print(
        "| n | dofs | slave nodes | Newton iterations | steps, s | bulk, s | linear solver, s | search, s | contact, s | contact / steps | contact / "
        "(steps - "
        "linear solver) |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& n : sizes) {
    RunOptions options;
    options.scene = SCENE;
    options.directory = std::string(RESULTS) + "/n_" + n;
    options.settings = {"variables/n=" + n,  "variables/F=800", "variables/mu=0",
                        "variables/steps=4", "output/fields=",  "output/contact profiles=false"};
    options.verbosity = Verbosity::quiet;
    if (const auto exit = run_scene(comm, read_scene(*comm, options.scene, options.settings), options); exit != ExitCode::done)
      return static_cast<int>(exit);
    if (comm->getRank() != 0) continue;
    const auto summary = nlohmann::json::parse(std::ifstream(options.directory + "/summary.json"));
    std::size_t iterations = 0;
    for (const auto& step : summary["steps"]) iterations += step["newton"].size() - 1;
    const auto& time = summary["time"];
    const auto sum = [&](const std::vector<const char*>& names) {
      double seconds = 0.0;
      for (const char* name : names) seconds += time.at(name).get<double>();
      return seconds;
    };
    const double contact = sum({"contact", "condensation"}), solver = sum({"linear_setup", "linear_solve"}), steps = time.at("steps").get<double>();
    fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.2f} % | {:.2f} % |\n", n, summary["dofs"].get<long>(),
               summary["slave_nodes"].get<long>(), iterations, steps, sum({"bulk"}), solver, sum({"search"}), contact, 100.0 * contact / steps,
               100.0 * contact / (steps - solver));
  }
  return 0;
}
