#pragma once
// Files of meshes for tests: small texts, and what a mesh has to be.

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "mortise/mesh/mesh_file.hpp"

namespace mortise {

/// A folder of this process, removed at its end.
class MeshFileFolder {
 public:
  MeshFileFolder() : path_(std::filesystem::temp_directory_path() / ("mortise-mesh-files-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~MeshFileFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  MeshFileFolder(const MeshFileFolder&) = delete;
  MeshFileFolder& operator=(const MeshFileFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

inline const MeshFileFolder& mesh_file_folder() {
  static const MeshFileFolder one;
  return one;
}

inline MeshFile read_mesh_text(const std::string& name, const std::string& bytes) {
  return read_mesh_file(mesh_file_folder().write(name, bytes), MeshFormat::by_name, {});
}

/// Message on a file that is refused, without the folder in which it is.
inline std::string refusal_of(const std::string& name, const std::string& bytes) {
  try {
    read_mesh_text(name, bytes);
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string folder = mesh_file_folder().path("");
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) text.erase(at, folder.size());
    return text;
  }
  return "no error";
}

/// Positions of the nodes of a reference cell, in 3D.
inline std::vector<std::array<double, 3>> reference_nodes(CellShape shape) {
  return visit_cell(shape, [](auto kind) {
    std::vector<std::array<double, 3>> all;
    for (const auto& node : decltype(kind)::node_positions) {
      std::array<double, 3> position{};
      for (std::size_t i = 0; i < node.size(); ++i) position[i] = node[i];
      all.push_back(position);
    }
    return all;
  });
}

template <class Member>
const FileSet<Member>& set_named(const std::vector<FileSet<Member>>& sets, const std::string& name) {
  for (const auto& set : sets)
    if (set.name == name) return set;
  throw std::out_of_range("there is no set " + name);
}

template <class Member>
std::vector<std::string> names_of_sets(const std::vector<FileSet<Member>>& sets) {
  std::vector<std::string> names;
  for (const auto& set : sets) names.push_back(set.name);
  return names;
}

/// The integral of 1 over a cell. Solids, and plane cells with z = 0, have det J > 0 at every point of the rule.
inline double measure_of(const MeshFile& file, const FileCells& cells, std::size_t cell) {
  return visit_cell(cells.shape, [&](auto kind) {
    using Cell = decltype(kind);
    constexpr int dimension = Cell::dimension;
    // Degree 3 or more: det J of quadratic cells with straight edges is constant or bilinear.
    int points = 0;
    if constexpr (dimension == 1)
      points = 3;
    else
      points = Cell::stiffness_points;
    double measure = 0.0;
    for (const CellPoint& point : Cell::rule(points)) {
      const auto gradients = Cell::gradients(point.template position<dimension>());
      Eigen::Matrix<double, 3, dimension> J = Eigen::Matrix<double, 3, dimension>::Zero();
      for (int a = 0; a < Cell::nodes; ++a)
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < dimension; ++k)
            J(i, k) += file.coordinates[static_cast<std::size_t>(cells.nodes[cell * Cell::nodes + static_cast<std::size_t>(a)])]
                                       [static_cast<std::size_t>(i)] *
                       gradients[static_cast<std::size_t>(a)][static_cast<std::size_t>(k)];
      const Eigen::Matrix<double, dimension, dimension> metric = J.transpose() * J;
      double det = std::sqrt(metric.determinant());
      if constexpr (dimension == 3) det = J.determinant();
      EXPECT_GT(det, 0.0) << "cell " << cells.labels[cell];
      measure += point.weight * det;
    }
    return measure;
  });
}

/// Of all cells of a set.
inline double measure_of(const MeshFile& file, const FileSet<FileCellRange>& set) {
  double sum = 0.0;
  for (const FileCellRange& range : set.members)
    for (std::int32_t c = 0; c < range.count; ++c)
      sum += measure_of(file, file.cells[static_cast<std::size_t>(range.group)], static_cast<std::size_t>(range.first + c));
  return sum;
}

/// In meshes with straight edges each mid-side node lies in the middle of its own edge, up to the rounding of coordinates in text.
inline void expect_middles(const MeshFile& file) {
  for (const FileCells& cells : file.cells) {
    const CellTopology& shape = topology(cells.shape);
    for (std::size_t c = 0; c < cells.labels.size(); ++c)
      for (int m = 0; m < shape.mid_side_nodes(); ++m)
        for (std::size_t i = 0; i < 3; ++i) {
          const auto x = [&](int node) {
            return file
                .coordinates[static_cast<std::size_t>(cells.nodes[c * static_cast<std::size_t>(shape.nodes) + static_cast<std::size_t>(node)])][i];
          };
          const auto& edge = shape.edges[static_cast<std::size_t>(m)];
          EXPECT_NEAR(x(shape.corners + m), 0.5 * (x(edge[0]) + x(edge[1])), 1e-9) << "cell " << cells.labels[c] << ", mid-side node " << m;
        }
  }
}

/// Positions of the corners of a side.
inline std::vector<std::array<double, 3>> corners_of(const MeshFile& file, const FileSide& side) {
  const FileCells& cells = file.cells[static_cast<std::size_t>(side.group)];
  const CellTopology& shape = topology(cells.shape);
  const std::int32_t* const nodes = cells.nodes.data() + std::ptrdiff_t{side.cell} * shape.nodes;
  std::vector<std::array<double, 3>> corners;
  const CellSide& own = shape.sides[static_cast<std::size_t>(side.side)];
  for (int n = 0; n < own.corners; ++n) corners.push_back(file.coordinates[static_cast<std::size_t>(nodes[own.nodes[static_cast<std::size_t>(n)]])]);
  return corners;
}

}  // namespace mortise
