// Seconds and memory that the reader of each format of mesh files takes for a cube of n x n x n hexahedra. Files are written to the folder of
// temporary files and removed. Each is read by a process of its own, whose largest memory and processor time are printed. Beside them stands the size
// of the value itself, which no reader can go below.
//
//     read_mesh_benchmark [n = 100]        100: 1 000 000 hexahedra, 1 030 301 nodes

#include <exodusII.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "mortise/mesh/mesh_file.hpp"

namespace mortise {
namespace {

/// Nodes and cells of the cube by their numbers, from 1.
struct Cube {
  std::int64_t n;

  std::int64_t nodes() const { return (n + 1) * (n + 1) * (n + 1); }
  std::int64_t cells() const { return n * n * n; }
  std::array<double, 3> position(std::int64_t node) const {
    const std::int64_t i = node - 1, m = n + 1;
    const double h = 1.0 / static_cast<double>(n);
    return {h * static_cast<double>(i % m), h * static_cast<double>(i / m % m), h * static_cast<double>(i / (m * m))};
  }
  std::array<std::int64_t, 8> corners(std::int64_t cell) const {
    const std::int64_t c = cell - 1, m = n + 1, first = c % n + m * (c / n % n) + m * m * (c / (n * n)) + 1;
    return {first, first + 1, first + m + 1, first + m, first + m * m, first + m * m + 1, first + m * m + m + 1, first + m * m + m};
  }
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open_for_writing(const std::string& path) {
  File file(std::fopen(path.c_str(), "wb"), std::fclose);
  if (!file) throw std::runtime_error(path + " cannot be written");
  return file;
}

void write_abaqus(const Cube& cube, const std::string& path) {
  const File file = open_for_writing(path);
  fmt::print(file.get(), "*NODE\n");
  for (std::int64_t node = 1; node <= cube.nodes(); ++node) fmt::print(file.get(), "{}, {}\n", node, fmt::join(cube.position(node), ", "));
  fmt::print(file.get(), "*ELEMENT, TYPE=C3D8, ELSET=cube\n");
  for (std::int64_t cell = 1; cell <= cube.cells(); ++cell) fmt::print(file.get(), "{}, {}\n", cell, fmt::join(cube.corners(cell), ", "));
}

template <class Number>
void put(std::FILE* file, std::initializer_list<Number> numbers) {
  std::fwrite(numbers.begin(), sizeof(Number), numbers.size(), file);
}

void write_gmsh_2(const Cube& cube, const std::string& path, bool binary) {
  const File file = open_for_writing(path);
  const auto whole = [](std::int64_t number) { return static_cast<std::int32_t>(number); };
  fmt::print(file.get(), "$MeshFormat\n2.2 {} 8\n", binary ? 1 : 0);
  if (binary) put(file.get(), {1}), fmt::print(file.get(), "\n");
  fmt::print(file.get(), "$EndMeshFormat\n$Nodes\n{}\n", cube.nodes());
  for (std::int64_t node = 1; node <= cube.nodes(); ++node) {
    const auto x = cube.position(node);
    if (binary)
      put(file.get(), {whole(node)}), put(file.get(), {x[0], x[1], x[2]});
    else
      fmt::print(file.get(), "{} {}\n", node, fmt::join(x, " "));
  }
  fmt::print(file.get(), "$EndNodes\n$Elements\n{}\n", cube.cells());
  if (binary) put(file.get(), {5, whole(cube.cells()), 2});
  for (std::int64_t cell = 1; cell <= cube.cells(); ++cell) {
    if (binary) {
      put(file.get(), {whole(cell), 1, 1});
      for (const std::int64_t node : cube.corners(cell)) put(file.get(), {whole(node)});
    } else {
      fmt::print(file.get(), "{} 5 2 1 1 {}\n", cell, fmt::join(cube.corners(cell), " "));
    }
  }
  fmt::print(file.get(), "$EndElements\n");
}

void write_gmsh_4(const Cube& cube, const std::string& path, bool binary) {
  const File file = open_for_writing(path);
  fmt::print(file.get(), "$MeshFormat\n4.1 {} 8\n", binary ? 1 : 0);
  if (binary) put(file.get(), {1}), fmt::print(file.get(), "\n");
  fmt::print(file.get(), "$EndMeshFormat\n$Nodes\n");
  if (binary)
    put<std::int64_t>(file.get(), {1, cube.nodes(), 1, cube.nodes()}), put(file.get(), {3, 1, 0}), put(file.get(), {cube.nodes()});
  else
    fmt::print(file.get(), "1 {0} 1 {0}\n3 1 0 {0}\n", cube.nodes());
  for (std::int64_t node = 1; node <= cube.nodes(); ++node) binary ? put(file.get(), {node}) : fmt::print(file.get(), "{}\n", node);
  for (std::int64_t node = 1; node <= cube.nodes(); ++node) {
    const auto x = cube.position(node);
    binary ? put(file.get(), {x[0], x[1], x[2]}) : fmt::print(file.get(), "{}\n", fmt::join(x, " "));
  }
  fmt::print(file.get(), "\n$EndNodes\n$Elements\n");
  if (binary)
    put<std::int64_t>(file.get(), {1, cube.cells(), 1, cube.cells()}), put(file.get(), {3, 1, 5}), put(file.get(), {cube.cells()});
  else
    fmt::print(file.get(), "1 {0} 1 {0}\n3 1 5 {0}\n", cube.cells());
  for (std::int64_t cell = 1; cell <= cube.cells(); ++cell) {
    if (binary) {
      put(file.get(), {cell});
      for (const std::int64_t node : cube.corners(cell)) put(file.get(), {node});
    } else {
      fmt::print(file.get(), "{} {}\n", cell, fmt::join(cube.corners(cell), " "));
    }
  }
  fmt::print(file.get(), "\n$EndElements\n");
}

void write_exodus(const Cube& cube, const std::string& path, int mode) {
  int real = sizeof(double), in_file = sizeof(double);
  const int id = ex_create(path.c_str(), EX_CLOBBER | mode, &real, &in_file);
  ex_put_init(id, "cube", 3, cube.nodes(), cube.cells(), 1, 0, 0);
  std::vector<double> x, y, z;
  for (std::int64_t node = 1; node <= cube.nodes(); ++node) {
    const auto position = cube.position(node);
    x.push_back(position[0]), y.push_back(position[1]), z.push_back(position[2]);
  }
  ex_put_coord(id, x.data(), y.data(), z.data());
  std::vector<int> connectivity;
  for (std::int64_t cell = 1; cell <= cube.cells(); ++cell)
    for (const std::int64_t node : cube.corners(cell)) connectivity.push_back(static_cast<int>(node));
  ex_put_block(id, EX_ELEM_BLOCK, 1, "HEX8", cube.cells(), 8, 0, 0, 0);
  ex_put_conn(id, EX_ELEM_BLOCK, 1, connectivity.data(), nullptr, nullptr);
  ex_close(id);
}

double mib_of(const MeshFile& file) {
  double bytes = static_cast<double>(file.coordinates.size() * sizeof file.coordinates[0] + file.node_labels.size() * sizeof file.node_labels[0]);
  for (const FileCells& cells : file.cells)
    bytes += static_cast<double>(cells.nodes.size() * sizeof cells.nodes[0] + cells.labels.size() * sizeof cells.labels[0]);
  return bytes / (1024.0 * 1024.0);
}

/// Reads the file in a child, which tells its time and the size of the value; its parent learns how much memory it had.
void measure(const std::string& what, const std::string& path) {
  const auto megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const auto start = std::chrono::steady_clock::now();
    const MeshFile file = read_mesh_file(path, MeshFormat::by_name, {});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{:<24} {:8.1f} MB {:8.2f} s   value {:7.1f} MiB", what, megabytes, seconds, mib_of(file));
    std::fflush(stdout);
    _exit(file.cells.at(0).labels.empty() ? 1 : 0);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) throw std::runtime_error(what + " was not read");
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  fmt::print("   peak {:7.1f} MiB   processor {:6.2f} s\n", static_cast<double>(usage.ru_maxrss) / 1024.0,
             seconds(usage.ru_utime) + seconds(usage.ru_stime));
}

int run(int argc, char** argv) {
  const Cube cube{argc > 1 ? std::atoll(argv[1]) : 100};
  const std::string folder = std::filesystem::temp_directory_path().string() + fmt::format("/read-mesh-benchmark-{}", getpid());
  std::filesystem::create_directories(folder);
  const auto one = [&](const std::string& what, const std::string& name, const std::function<void(const std::string&)>& write) {
    const std::string path = folder + "/" + name;
    // A child of its own writes: what it takes is not inherited by the one that reads.
    const pid_t child = fork();
    if (child == 0) {
      write(path);
      _exit(0);
    }
    waitpid(child, nullptr, 0);
    measure(what, path);
    std::filesystem::remove(path);
  };
  fmt::print("{} hexahedra, {} nodes\n", cube.cells(), cube.nodes());
  one("Abaqus", "a.inp", [&](const std::string& path) { write_abaqus(cube, path); });
  one("Gmsh 2.2, text", "a.msh", [&](const std::string& path) { write_gmsh_2(cube, path, false); });
  one("Gmsh 2.2, binary", "a.msh", [&](const std::string& path) { write_gmsh_2(cube, path, true); });
  one("Gmsh 4.1, text", "a.msh", [&](const std::string& path) { write_gmsh_4(cube, path, false); });
  one("Gmsh 4.1, binary", "a.msh", [&](const std::string& path) { write_gmsh_4(cube, path, true); });
  one("Exodus II, classic", "a.exo", [&](const std::string& path) { write_exodus(cube, path, EX_LARGE_MODEL); });
  one("Exodus II, HDF5", "a.exo", [&](const std::string& path) { write_exodus(cube, path, EX_NETCDF4); });
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) { return mortise::run(argc, argv); }
