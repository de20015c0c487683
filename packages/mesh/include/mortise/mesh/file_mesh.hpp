#pragma once
// Options of a body's mesh that comes from a file.

#include <string>
#include <vector>

#include "mortise/mesh/file_body.hpp"
#include "mortise/mesh/mesh_options.hpp"

namespace mortise {

/// Treatment of nodes that two bodies of a file have in common.
enum class SharedNodes {
  refused,
  doubled  ///< each body gets its own
};

/// A mesh of a file. Its dimension is the model's. See make_file_bodies(), which makes the body.
struct FileMesh : MeshOptions {
  FileMesh() : MeshOptions(3) {}

  Located<std::string> file;  ///< path as given
  MeshFormat format = MeshFormat::by_name;
  std::vector<std::string> blocks;  ///< empty: all
  std::vector<double> piece;        ///< x, y(, z) in the file; empty: all
  double scale = 1.0;
  SharedNodes shared_nodes = SharedNodes::refused;
  std::vector<double> rotation_axis{0.0, 0.0, 1.0};  ///< through the origin

  void describe_shape(Parameters& parameters) override;
  /// Throws std::logic_error: the body stands in a file.
  BodyComplex complex(CellShape cell, const Place& place) const override;
  /// The request to the file, for a body of this name. Relative paths begin at the folder of the file that names them.
  FileBodyRequest request(const std::string& body, const Place& place, int dimension, bool is_surface) const;

 protected:
  void describe_rotation(Parameters& parameters) override;
};

}  // namespace mortise
