#include "fuzz_targets.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>
#include <zlib.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "mortise/input/expression.hpp"
#include "mortise/io/checkpoint_file.hpp"
#include "mortise/mesh/mesh_file.hpp"
#include "mortise/simulation/scene/file_kind.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/studies/point_file.hpp"
#include "mortise/studies/study_points.hpp"
#include "run/restart/scene_changes.hpp"

namespace mortise::fuzz {
namespace {

RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }

/// A folder of this process, removed at its end.
class Scratch {
 public:
  Scratch() : path_(std::filesystem::temp_directory_path() / fmt::format("mortise-fuzz-{}", getpid())) { std::filesystem::create_directories(path_); }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path path_;
};

const Scratch& scratch() {
  static const Scratch one;
  return one;
}

// ---- scenes, points, studies

const char* const scene_of_studies = R"(<ParameterList name="one block">
  <ParameterList name="variables"><Parameter name="n" type="int" value="2"/></ParameterList>
  <ParameterList name="materials"><ParameterList name="steel">
    <Parameter name="type" type="string" value="hencky"/>
    <Parameter name="young's modulus" type="double" value="210000"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/>
  </ParameterList></ParameterList>
  <ParameterList name="bodies"><ParameterList name="block">
    <Parameter name="material" type="string" value="steel"/>
    <ParameterList name="mesh">
      <Parameter name="type" type="string" value="block"/>
      <Parameter name="width" type="double" value="1"/>
      <Parameter name="height" type="double" value="1"/>
      <Parameter name="cells x" type="int" value="n"/>
      <Parameter name="cells y" type="int" value="n"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="quantities"><ParameterList name="stress_spread">
    <Parameter name="type" type="string" value="spread"/>
  </ParameterList></ParameterList>
</ParameterList>
)";

void read_scene_text(const std::string& text) {
  const XmlList root = parse_xml(text, "scene.xml");
  refuse_other_kinds(root, FileKind::scene);
  const Scene scene = make_scene(root);
  const std::string fingerprint = scene_fingerprint(scene);
  if (!refused_changes(fingerprint, fingerprint).empty()) throw std::logic_error("a scene differs from itself");
}

void read_point_text(const std::string& text) { read_point(*world(), scratch().write("point.xml", text), {}); }

void read_study_text(const std::string& text) {
  static const std::string scene = scratch().write("scene.xml", scene_of_studies);
  read_study(*world(), scratch().write("study.xml", text));
}

template <class Options>
ListRecord declarations_of() {
  return collect_parameters("file", Options(), CollectParameters::What::declarations);
}

// ---- expressions

void read_expression(const std::string& source) {
  Symbols symbols;
  symbols.variables = {{"n", 4.0}, {"tiny", 1e-300}, {"huge", 1e300}};
  symbols.tables["ramp"] = Table{{0.0, 1.0, 2.0}, {0.0, 5.0, -1.0}};
  symbols.refused = {"wrong"};
  std::vector<Diagnostic> diagnostics;
  const auto attempt = [&](const auto& evaluate) {
    try {
      evaluate();
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  };
  attempt([&] {
    const ScalarFunction of_time_and_place = parse_expression(source, symbols);
    for (const double number : {0.0, 1.0, -1.0, 1e300, -0.0, 1e-320}) of_time_and_place(number, 2.0 * number, -number, 0.5);
  });
  attempt([&] { parse_expression({}, source, symbols)(); });
  attempt([&] { parse_expression({"dofs", "peak pressure", "h"}, source, symbols).at({1.0, 2.0, 3.0}); });
  throw InputError(diagnostics);
}

// ---- checkpoints

/// Values of every kind that a run stores.
struct State {
  std::string scene = "stepping/step = 0.5\nbodies/block/material = steel\nmaterials/steel/young's modulus = 210000\n", mesh = "0123456789abcdef";
  double time = 0.25;
  std::optional<double> next_step = 0.5;
  int steps = 3;
  std::uintmax_t file_size = 4096;
  Vector unknowns{rcp(new Map(8, 0, world()))};
  std::vector<double> history = std::vector<double>(12, 0.125);
  std::vector<char> covered{0, 1, 1, 0};
  std::vector<int> states{2, 0, 1, 2};
  std::vector<std::vector<double>> slip{{1.0}, {}, {3.0, 4.0, 5.0}, {6.0}};
};

std::vector<std::string> exchange(StateArchive& archive, State& state) {
  const RowIds elements{"body.0.elements", {0, 1, 2, 3}, 4}, slaves{"contact.0.slaves", {3, 5, 6, 11}, 4};
  std::vector<std::string> refused;
  const auto attempt = [&](const auto& one) {
    try {
      one();
    } catch (const FileError& error) {
      refused.emplace_back(error.what());
    }
  };
  attempt([&] { archive.text("scene", state.scene); });
  attempt([&] { archive.text("mesh", state.mesh); });
  attempt([&] { serialize(archive, "time", state.time); });
  attempt([&] { serialize(archive, "next_step", state.next_step); });
  attempt([&] { serialize(archive, "steps", state.steps); });
  attempt([&] { serialize(archive, "files.newton", state.file_size); });
  attempt([&] { serialize(archive, "x", "unknowns", state.unknowns); });
  attempt([&] { archive.rows("body.0.history", elements, 3, state.history); });
  attempt([&] { serialize(archive, "contact.0.covered", slaves, state.covered); });
  attempt([&] { serialize(archive, "contact.0.states", slaves, state.states); });
  attempt([&] { serialize(archive, *world(), "contact.0.slip", slaves, state.slip); });
  return refused;
}

/// The datasets of a checkpoint of such a state.
const std::vector<std::string>& dataset_names() {
  static const std::vector<std::string> names{"/values/text.scene",     "/values/text.mesh",
                                              "/values/time",           "/values/next_step",
                                              "/values/steps",          "/values/files.newton",
                                              "/ids/unknowns",          "/rows/x",
                                              "/ids/body.0.elements",   "/rows/body.0.history",
                                              "/ids/contact.0.slaves",  "/rows/contact.0.covered",
                                              "/rows/contact.0.states", "/values/contact.0.slip.longest",
                                              "/rows/contact.0.slip"};
  return names;
}

/// Header by which bytes describe a dataset: this, then `count` words of 8 bytes. HDF5's own structures are made from it, as the library trusts them.
struct DatasetHeader {
  std::uint8_t name, type, dimensions, layout, rows, columns, count, none;
};

enum TypeCode : std::uint8_t { numbers, whole_numbers, short_numbers, bytes_of_text, type_codes };
enum LayoutCode : std::uint8_t { contiguous, without_values, chunked, compact, layout_codes };

/// Sizes up to 2^55 in one byte.
hsize_t size_of(std::uint8_t code) { return code < 200 ? code : hsize_t{1} << (code - 200); }

constexpr hsize_t most_values = 4096;  ///< that are written: more would make files large and slow

void make_dataset(hid_t file, const DatasetHeader& header, const std::vector<std::uint64_t>& words) {
  const std::array<hsize_t, 3> size{size_of(header.rows), size_of(header.columns), 1};
  const int dimensions = header.dimensions % 4;
  const hid_t space = dimensions == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(dimensions, size.data(), nullptr);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE), creation = H5Pcreate(H5P_DATASET_CREATE), text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, sizeof(std::uint64_t));
  H5Pset_create_intermediate_group(links, 1);
  const int layout = header.layout % layout_codes;
  if (layout == chunked) {
    const std::array<hsize_t, 3> chunk{2, 2, 1};
    H5Pset_chunk(creation, std::max(dimensions, 1), chunk.data());
  }
  if (layout == compact) H5Pset_layout(creation, H5D_COMPACT);
  const std::array<hid_t, type_codes> types{H5T_NATIVE_DOUBLE, H5T_NATIVE_LLONG, H5T_NATIVE_SHORT, text};
  const std::string& name = dataset_names()[header.name % dataset_names().size()];
  const hid_t dataset = H5Dcreate2(file, name.c_str(), types[header.type % type_codes], space, links, creation, H5P_DEFAULT);
  hsize_t values = 1;
  for (int d = 0; d < dimensions; ++d) values = std::min(values, most_values + 1) * std::min(size[static_cast<std::size_t>(d)], most_values + 1);
  if (dataset >= 0 && layout != without_values && values <= most_values && !words.empty()) {
    std::vector<std::uint64_t> all(values);
    for (std::size_t n = 0; n < all.size(); ++n) all[n] = words[n % words.size()];
    const bool whole = header.type % type_codes == whole_numbers;
    const hid_t memory = header.type % type_codes == bytes_of_text ? text : whole ? H5T_NATIVE_LLONG : H5T_NATIVE_DOUBLE;
    H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  }
  if (dataset >= 0) H5Dclose(dataset);
  if (space >= 0) H5Sclose(space);
  for (const hid_t list : {links, creation}) H5Pclose(list);
  H5Tclose(text);
}

/// Stores as the bytes from which checkpoint_file() makes a file.
class Recorder final : public StateArchive {
 public:
  bool restores() const override { return false; }
  void values(const std::string& name, std::vector<double>& values) override { record("/values/" + name, numbers, 1, values.size(), 1, values); }
  void text(const std::string& name, std::string& text) override {
    std::vector<double> bytes;
    for (const char c : text) bytes.push_back(static_cast<unsigned char>(c));
    values("text." + name, bytes);
  }
  void rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) override {
    if (known_.insert(ids.name).second) record("/ids/" + ids.name, whole_numbers, 1, ids.owned, 1, ids.ids);
    record("/rows/" + name, numbers, columns == 1 ? 1 : 2, ids.owned, columns, rows);
  }
  void refuse_if(const std::optional<std::string>&) override {}
  const std::string& bytes() const { return bytes_; }

 private:
  template <class Number>
  void record(const std::string& name, TypeCode type, int dimensions, std::size_t rows, std::size_t columns, const std::vector<Number>& numbers) {
    static_assert(sizeof(Number) == sizeof(std::uint64_t));
    const auto number_of_name = std::find(dataset_names().begin(), dataset_names().end(), name) - dataset_names().begin();
    const auto byte = [](auto number) { return static_cast<std::uint8_t>(number); };
    const DatasetHeader header{byte(number_of_name), type, byte(dimensions), contiguous, byte(rows), byte(columns), byte(numbers.size()), 0};
    bytes_.append(reinterpret_cast<const char*>(&header), sizeof header);
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  }

  std::set<std::string> known_;
  std::string bytes_;
};

void read_checkpoint(const std::string& bytes) {
  if (const std::vector<std::string> refused = restore_checkpoint(checkpoint_file(bytes)); !refused.empty()) throw FileError(refused.front());
}

// ---- mesh files

void read_gmsh_bytes(const std::string& bytes) { read_mesh_file(scratch().write("mesh.msh", bytes), MeshFormat::gmsh, {}); }

void read_abaqus_bytes(const std::string& bytes) { read_mesh_file(scratch().write("mesh.inp", bytes), MeshFormat::abaqus, {}); }

/// Of netCDF's own formats alone: HDF5 trusts its bytes.
void read_exodus_bytes(const std::string& bytes) {
  if (bytes.compare(0, 4, "\x89HDF") != 0) read_mesh_file(scratch().write("mesh.exo", bytes), MeshFormat::exodus, {});
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all{{"scene", read_scene_text, declarations_of<Scene>},
                                       {"point", read_point_text, declarations_of<PointFile>},
                                       {"study", read_study_text, declarations_of<StudyFile>},
                                       {"expression", read_expression, nullptr},
                                       {"checkpoint", read_checkpoint, nullptr},
                                       {"gmsh", read_gmsh_bytes, nullptr},
                                       {"abaqus", read_abaqus_bytes, nullptr},
                                       {"exodus", read_exodus_bytes, nullptr}};
  return all;
}

const Target& target(const std::string& name) {
  const auto found = std::find_if(targets().begin(), targets().end(), [&](const Target& one) { return one.name == name; });
  if (found == targets().end()) throw std::out_of_range("there is no target " + name);
  return *found;
}

void read_or_refuse(const Target& target, const std::string& bytes) {
  try {
    target.read(bytes);
  } catch (const InputError&) {
  } catch (const FileError&) {
  }
}

std::string whole_checkpoint() {
  Recorder recorder;
  State state;
  exchange(recorder, state);
  return recorder.bytes();
}

std::string checkpoint_file(const std::string& bytes) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::string path = scratch().file("checkpoint.h5");
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  DatasetHeader header{};
  for (std::size_t at = 0; at + sizeof header <= bytes.size();) {
    std::memcpy(&header, bytes.data() + at, sizeof header);
    at += sizeof header;
    std::vector<std::uint64_t> words(std::min<std::size_t>(header.count, (bytes.size() - at) / sizeof(std::uint64_t)));
    if (!words.empty()) std::memcpy(words.data(), bytes.data() + at, words.size() * sizeof(std::uint64_t));
    at += words.size() * sizeof(std::uint64_t);
    make_dataset(file, header, words);
  }
  H5Fclose(file);
  const std::string content = scratch().read("checkpoint.h5");
  const unsigned long crc = crc32_z(crc32(0, nullptr, 0), reinterpret_cast<const unsigned char*>(content.data()), content.size());
  std::string line = fmt::format("\nmortise checkpoint 1 bytes {} crc32 {:08x}", content.size(), crc);
  line.resize(63, ' ');
  return scratch().write("checkpoint.h5", content + line + '\n');
}

std::string written_checkpoint() {
  const std::string path = scratch().file("written.h5");
  CheckpointWriter writer(world(), path);
  State state;
  exchange(writer, state);
  writer.finish();
  return path;
}

std::vector<std::string> restore_checkpoint(const std::string& path) {
  State state;
  const std::string now = state.scene;
  CheckpointReader reader(world(), path);
  std::vector<std::string> refused = exchange(reader, state);
  for (std::string& change : refused_changes(state.scene, now)) refused.push_back(std::move(change));
  return refused;
}

}  // namespace mortise::fuzz
