#include "mortise/mesh/file_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <stdexcept>

namespace mortise {

void FileMesh::describe_shape(Parameters& parameters) {
  parameters.add("file", file, Says("path of the mesh file; a relative one begins at the folder of the file that names it").required());
  // Read once, the path is whole: an input that repeats it may stand in another folder.
  namespace fs = std::filesystem;
  if (const fs::path path(file.value); !file.value.empty() && !path.is_absolute() && !file.place.file.empty())
    file.value = fs::absolute(fs::path(file.place.file).parent_path() / path).lexically_normal().string();
  parameters.add("format", format,
                 {{"by name", MeshFormat::by_name}, {"exodus", MeshFormat::exodus}, {"gmsh", MeshFormat::gmsh}, {"abaqus", MeshFormat::abaqus}},
                 "format of the file; by name: .exo, .e, .g and the like are Exodus II, .msh is Gmsh, .inp is Abaqus or CalculiX");
  parameters.add("blocks", blocks, "element blocks, physical groups or element sets of the file that make the body; empty: all of its cells");
  parameters.add("piece", piece,
                 "a point, \"x, y\" or \"x, y, z\" in the coordinates of the file. It selects one of several parts that have no node in common: the "
                 "one with the node nearest to it. Empty: all cells, which have to be one piece");
  if (!piece.empty() && piece.size() != 2 && piece.size() != 3) {
    parameters.error("piece", fmt::format("is \"{}\"; it needs two or three numbers", fmt::join(piece, ", ")));
    piece.clear();
  }
  parameters.add("scale", scale,
                 Says("factor on the coordinates of the file, for its unit of length: 0.001 takes mm to m").at_least(1e-30).at_most(1e30));
  parameters.add("shared nodes", shared_nodes, {{"refused", SharedNodes::refused}, {"doubled", SharedNodes::doubled}},
                 "nodes that another body of the same file has too: refused, an error; doubled, each body gets its own, so that they can move apart");
}

void FileMesh::describe_rotation(Parameters& parameters) { describe_spatial_rotation(parameters, rotation_axis); }

BodyComplex FileMesh::complex(CellShape, const Place&) const { throw std::logic_error("the mesh of a file is made by make_file_bodies()"); }

FileBodyRequest FileMesh::request(const std::string& body, const Place& place, int dimension, bool is_surface) const {
  FileBodyRequest request;
  request.name = body;
  request.place = place;
  request.file = file.value;
  request.format = format;
  request.dimension = dimension;
  request.is_surface = is_surface;
  request.shares_nodes = shared_nodes == SharedNodes::doubled;
  request.blocks = blocks;
  request.piece = piece;
  request.scale = scale;
  request.placement = {
      {rotation_axis.at(0), rotation_axis.at(1), rotation_axis.at(2)}, rotation, {translation.at(0), translation.at(1), translation.at(2)}};
  return request;
}

}  // namespace mortise
