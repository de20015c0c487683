#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "mortise/input/xml.hpp"
#include "mortise/io/files.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "scale/scale_rates.hpp"
#include "scale/scale_report.hpp"
#include "scale/slurm_jobs.hpp"
#include "shared/draw_plot.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* index_name = "scale-jobs.json";
constexpr const char* planned_machine = "planned-machine.xml";
const Origin jobs_origin{"scale jobs", "", false};

/// Data that decides on the runs of an index, but for their number.
Json identity(const Communicator& comm, const ScaleOptions& options) {
  Json weak = options.weak ? Json{{"name", options.weak->name}, {"multiple", options.weak->multiple}} : Json(nullptr);
  return {{"text", read_text(comm, options.scene)}, {"settings", options.settings}, {"weak", weak}, {"version", options.version}};
}

Json index_json(const ScaleOptions& options, const Json& identity, const std::vector<ScalePoint>& points,
                const std::vector<ScalePrediction>& predictions) {
  Json json{{"identity", identity},       {"scene", options.scene},     {"settings", options.settings},
            {"version", options.version}, {"repeats", options.repeats}, {"launcher", options.launcher.words},
            {"points", Json::array()}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    Json one{
        {"series", points[i].series}, {"ranks", points[i].ranks}, {"settings", points[i].settings}, {"script", "jobs/" + points[i].name() + ".sh"}};
    one["nodes"] = predictions[i].nodes;
    one["memory_per_node_mib"] = predictions[i].memory_per_node;
    one["seconds"] = predictions[i].phases.empty() ? Json(nullptr) : Json(predictions[i].seconds);
    json["points"].push_back(std::move(one));
  }
  return json;
}

Json read_index(const Communicator& comm, const std::string& directory) {
  const std::string path = directory + "/" + index_name;
  if (!std::filesystem::exists(path))
    throw FileError(fmt::format("{} holds no jobs of `mortise scale --batch slurm`: there is no {}", directory, index_name));
  const Json json = Json::parse(read_text(comm, path), nullptr, false);
  if (json.is_discarded() || !json.contains("identity") || !json.contains("points"))
    throw FileError("cannot read " + path + ": it is no index of jobs");
  return json;
}

/// What each point takes on the machine. Points of one size share a plan's mesh.
std::vector<ScalePrediction> predictions_of(const RCP<const Communicator>& comm, const ScaleOptions& options, const MachineFile& machine,
                                            const std::vector<ScalePoint>& points) {
  std::map<std::vector<std::string>, std::unique_ptr<ScalePlanner>> planners;
  std::vector<ScalePrediction> predictions;
  for (const ScalePoint& point : points) {
    auto& planner = planners[point.settings];
    if (!planner) {
      planners.clear();  // one mesh at a time
      planners[point.settings] = std::make_unique<ScalePlanner>(comm, read_scene(*comm, options.scene, point.settings), options.ranks);
    }
    predictions.push_back(predict(machine, planners.at(point.settings)->plan(point.ranks)));
  }
  return predictions;
}

/// Registers what jobs will leave: it is the program's to replace.
void claim_job_files(OutputDirectory& jobs, const ScaleOptions& options, const std::vector<ScalePoint>& points) {
  for (const ScalePoint& point : points) {
    for (const char* ending : {".sh", ".log", ".id"}) jobs.claim(point.name() + ending);
    for (int repeat = 1; repeat <= options.repeats; ++repeat)
      for (const char* what : {"started", "said", "exit"}) jobs.claim(fmt::format("{}.{}.{}", point.name(), repeat, what));
  }
}

void make_executable(const std::string& path) {
  namespace fs = std::filesystem;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add);
}

std::size_t count(const std::vector<ScalePoint>& points, const std::string& state) {
  return std::count_if(points.begin(), points.end(), [&](const ScalePoint& point) { return point.state == state; });
}

}  // namespace

ExitCode write_scale_jobs(const RCP<const Communicator>& comm, const ScaleOptions& given) {
  if (comm->getSize() > 1) throw InputError(Place{}, "jobs are written on one rank; please call it without mpirun");
  RunLog log(comm, given.verbosity);
  ScaleOptions options = given;
  const MachineFile machine = read_machine(*comm, options.machine);
  const Scene scene = read_scene(*comm, options.scene, options.settings);
  options.scene = std::filesystem::absolute(options.scene).lexically_normal().string();
  if (options.ranks == 0) options.ranks = machine.cores_per_node;
  if (options.launcher.words.empty()) options.launcher = read_launcher("srun");
  const std::string path = std::filesystem::absolute(options.directory.empty() ? default_directory(given.scene) + "-scale" : options.directory)
                               .lexically_normal()
                               .string();
  std::vector<ScalePoint> points = planned_points(scene, options);
  const Json wanted = identity(*comm, options);
  if (std::filesystem::exists(path + "/" + index_name) && read_index(*comm, path).at("identity") != wanted)
    throw InputError(Place{},
                     fmt::format("{} holds jobs of another scene, of other settings or of another version of the program; please name another "
                                 "directory, or remove it",
                                 path));
  const std::vector<ScalePrediction> predictions = predictions_of(comm, options, machine, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!predictions[i].fits)
      throw InputError(Place{},
                       fmt::format("{} rank(s) take {:.0f} MiB on a node, and one of {} has {:g} MiB; please take more ranks or a smaller scene",
                                   points[i].ranks, predictions[i].memory_per_node, options.machine, machine.memory_per_node));

  OutputDirectory directory(comm, path, jobs_origin);
  directory.open({index_name, planned_machine, "submit.sh", "jobs", "runs"});
  OutputDirectory jobs = directory.subdirectory("jobs"), runs = directory.subdirectory("runs");
  claim_job_files(jobs, options, points);
  const JobFiles files(path);
  write_file(*comm, jobs.claim("scene"), [&] { return wanted.at("text").get<std::string>(); });
  for (std::size_t i = 0; i < points.size(); ++i) {
    runs.subdirectory(points[i].name());
    write_file(*comm, files.script(points[i]), [&] { return job_script(options, points[i], predictions[i], machine, files); });
    take_jobs(options, points[i], files);
    log.info(fmt::format("{} series, {} rank(s) on {} node(s), {:.0f} MiB each{}: {}", points[i].series, points[i].ranks, predictions[i].nodes,
                         predictions[i].memory_per_node, predictions[i].phases.empty() ? "" : fmt::format(", {:.3g} s", predictions[i].seconds),
                         points[i].state));
  }
  write_file(*comm, directory.claim("submit.sh"), [&] { return submit_script(options, points, files); });
  make_executable(directory.file("submit.sh"));
  write_file(*comm, directory.claim(planned_machine), [&] { return to_machine_xml(machine); });
  write_json(*comm, directory.claim(index_name), index_json(options, wanted, points, predictions));
  if (!machine.has_rates()) log.warning(fmt::format("{} has no rates: the jobs ask for no time, and the cluster's default holds", options.machine));
  log.info(fmt::format("{} of {} runs have finished; {} submits the others", count(points, "finished"), points.size(), directory.file("submit.sh")));
  return ExitCode::done;
}

ExitCode harvest_scale(const RCP<const Communicator>& comm, const std::string& given, Verbosity verbosity) {
  RunLog log(comm, verbosity);
  const std::string path = std::filesystem::absolute(given).lexically_normal().string();
  const Json index = read_index(*comm, path);
  ScaleOptions options;
  options.scene = index.at("scene");
  options.settings = index.at("settings").get<std::vector<std::string>>();
  options.version = index.at("version");
  options.repeats = index.at("repeats");
  options.launcher.words = index.at("launcher").get<std::vector<std::string>>();
  if (const Json weak = index.at("identity").at("weak"); !weak.is_null()) options.weak = WeakVariable{weak.at("name"), weak.at("multiple")};
  const MachineFile machine = read_machine(*comm, path + "/" + planned_machine);
  OutputDirectory directory(comm, path, jobs_origin);
  require_page_python(*comm, directory.file("report.html"));
  const std::vector<std::string> reports{"scale.csv", "scale.json", "scale.svg", "scale_weak.svg", "report.html", "machine.xml", "plans"};
  directory.open(reports);
  for (const auto& old : reports) directory.remove(old);

  const JobFiles files(path);
  std::vector<ScalePoint> points;
  for (const Json& one : index.at("points")) {
    ScalePoint& point = points.emplace_back();
    point.series = one.at("series");
    point.ranks = one.at("ranks");
    point.settings = one.at("settings").get<std::vector<std::string>>();
    point.directory = files.results(point, 1);
    take_jobs(options, point, files);
    log.info(fmt::format("{} series, {} rank(s): {}", point.series, point.ranks,
                         point.finished ? fmt::format("finished, {:.2f} s", point.seconds) : point.state));
    if (!point.finished) log.warning(fmt::format("{}: {}", point.name(), point.said));
  }
  log.info(fmt::format("{} finished, {} failed, {} running, {} waiting, {} missing", count(points, "finished"), count(points, "failed"),
                       count(points, "running"), count(points, "waiting"), count(points, "missing")));
  const ExitCode code = report_scale(comm, options, points, directory, log);
  write_measured_machine(comm, options, points, machine, directory, log);
  directory.strike_missing();
  return code;
}

}  // namespace mortise
