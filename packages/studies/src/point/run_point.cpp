#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "mortise/input/parameter_tree.hpp"
#include "mortise/io/csv_writer.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/material/point_driver.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/studies/point.hpp"
#include "mortise/studies/point_file.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"

namespace mortise {
namespace {

constexpr std::array<std::array<int, 2>, 6> symmetric{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

std::string digits(const std::array<int, 2>& component) { return fmt::format("{}{}", component[0] + 1, component[1] + 1); }

/// Columns of point.csv, in the order of row_of.
std::vector<std::string> columns() {
  std::vector<std::string> names{"t"};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) names.push_back("F" + digits({i, j}));
  for (const char* tensor : {"strain_", "cauchy_", "kirchhoff_"})
    for (const auto& component : symmetric) names.push_back(tensor + digits(component));
  names.insert(names.end(), {"von_mises", "equivalent_plastic_strain"});
  return names;
}

std::vector<double> row_of(const PointRecord& record) {
  std::vector<double> row{record.time};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) row.push_back(record.F(i, j));
  for (const Matrix3* tensor : {&record.strain, &record.cauchy, &record.kirchhoff})
    for (const auto& [i, j] : symmetric) row.push_back((*tensor)(i, j));
  row.insert(row.end(), {record.von_mises(), record.equivalent_plastic_strain});
  return row;
}

std::string effective_xml(const PointFile& point) {
  return to_scene_xml(collect_parameters(point.name, point, CollectParameters::What::values), symbol_lists(point.symbols));
}

}  // namespace

ExitCode run_point(const RCP<const Communicator>& comm, const RunOptions& options) {
  // A point is nothing: every rank drives it, rank 0 writes.
  RunLog log(comm, options.verbosity);
  const PointFile point = read_point(*comm, options.scene, options.settings);
  const std::vector<PathPoint> path = points_of(*point.path.options);
  const Law law = point.material.options->law();
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) : options.directory,
                            {"run", options.scene, options.directory.empty()}, options.keep);
  directory.begin_run();
  write_file(*comm, directory.claim("effective.xml"), [&] { return effective_xml(point); });
  log.info(fmt::format("{}: {}, {}, {} steps", options.scene, point.material.type, point.path.type, path.size() - 1));

  const std::vector<std::string> names = columns();
  std::vector<double> last;
  int steps = 0;
  std::optional<StepFailure> failure;
  {
    CsvWriter table(comm, directory.claim("point.csv"), names);
    try {
      drive_point(law, path, [&](const PointRecord& record) {
        last = row_of(record);
        steps = record.step;
        table.row({last.begin(), last.end()});
      });
    } catch (const StepFailure& found) {
      failure = found;
    }
  }
  const ExitCode exit = failure ? ExitCode::not_converged : ExitCode::done;
  const std::string component = digits(point.path.options->component());

  nlohmann::ordered_json json;
  json["point"] = options.scene;
  json["version"] = options.version;
  json["material"] = point.material.type;
  json["path"] = point.path.type;
  json["component"] = component;
  json["converged"] = !failure;
  json["exit"] = static_cast<int>(exit);
  json["steps"] = steps;
  json["quantities"] = nlohmann::ordered_json::object();
  for (std::size_t c = 0; c < last.size(); ++c) json["quantities"][names[c]] = last[c];
  write_json(*comm, directory.claim("summary.json"), json);

  for (const char* name : {"point.svg", "point.png"}) directory.claim(name);
  const bool small_strain = std::visit([](const auto& kind) { return kind.small_strain; }, law);
  const bool drawn =
      draw_plot(*comm, point_plot,
                {directory.file("point.csv"), directory.file("point"), component, fmt::format("{} ({})", point.name, point.material.type),
                 small_strain ? "strain" : "logarithmic strain", point.stress_unit},
                directory.file("point.svg"));
  directory.strike_missing();
  if (!drawn) log.warning("nothing is drawn without matplotlib; please install python3-matplotlib (Debian)");
  if (!last.empty())
    log.info(fmt::format("t = {:g}: strain_{} = {:.6g}, cauchy_{} = {:.6g}, von_mises = {:.6g}, equivalent_plastic_strain = {:.6g}", last[0],
                         component, json["quantities"]["strain_" + component].get<double>(), component,
                         json["quantities"]["cauchy_" + component].get<double>(), json["quantities"]["von_mises"].get<double>(),
                         json["quantities"]["equivalent_plastic_strain"].get<double>()));
  if (failure) log.warning(failure->what());
  log.info("results in " + directory.path());
  return exit;
}

}  // namespace mortise
