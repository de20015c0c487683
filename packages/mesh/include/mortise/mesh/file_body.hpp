#pragma once
// Bodies from mesh files: what is asked of a file, and what comes of it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/mesh/listed_complex.hpp"
#include "mortise/mesh/mesh_file.hpp"

namespace mortise {

/// A body to be made of a mesh file.
struct FileBodyRequest {
  std::string name;                        ///< of the body
  Place place;                             ///< where it is described
  std::string file;                        ///< path
  std::shared_ptr<const MeshFile> made{};  ///< on rank 0: a mesh in the place of a file
  MeshFormat format = MeshFormat::by_name;
  int dimension = 3;                ///< of the model: 2 or 3
  bool is_surface = false;          ///< a rigid body
  bool shares_nodes = false;        ///< nodes that another body of the file has too are doubled; else they are an error
  std::vector<std::string> blocks;  ///< names of element blocks, physical groups or element sets; empty: all
  std::vector<double> piece;        ///< of cells that hang together by nodes only those with the node nearest to this point of the file; empty: all
  std::vector<Located<std::string>> parts;  ///< names of those with a material of their own
  double scale = 1.0;                       ///< factor on the file's coordinates
  SpatialPlacement placement;               ///< after the scaling
};

/// The body of a file that was read. On one rank; not collective.
/// @throws InputError: names that are none in the file, no cells, several pieces, sides that do not conform, a mesh in 2D that is not flat
/// `file_nodes`: gets the indices of its nodes in the file.
ListedBody make_file_body(const MeshFile& file, const FileBodyRequest& request, std::vector<std::int32_t>* file_nodes = nullptr);

/// The bodies of all requests, in their order. Rank 0 reads each file once. Collective.
/// @throws InputError on all ranks: what read_mesh_file() and make_file_body() refuse; bodies of a file that share nodes
std::vector<std::shared_ptr<ListedBody>> make_file_bodies(const Communicator& comm, const std::vector<FileBodyRequest>& requests);

}  // namespace mortise
