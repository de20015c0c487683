#pragma once
// Content of a mesh file, whatever its format. Readers make it; bodies are made from it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// Cells of one shape.
struct FileCells {
  CellShape shape = CellShape::tetrahedron4;
  std::vector<std::int32_t> nodes;   ///< [cells x nodes of the shape] indices into MeshFile::coordinates, in the order of the shape
  std::vector<std::int64_t> labels;  ///< [cells] their numbers in the file
};

/// Cells `first` to `first + count - 1` of MeshFile::cells[group].
struct FileCellRange {
  std::int32_t group = 0, first = 0, count = 0;
};

/// The face of a shell or of a rigid surface that looks against its normal, which nodes in their order turn round.
inline constexpr int the_other_face = -2;

/// A side of a cell: its number in the topology of the shape, or of a shell or rigid surface the_cell_itself, its face along the normal, or
/// the_other_face.
struct FileSide {
  std::int32_t group = 0, cell = 0;
  std::int32_t side = 0;
};

/// A set of a file that is not read, and why not.
struct LeftOutSet {
  std::string name, reason;
};

/// A named set of a file. Names are unique among the sets of a kind. Members are in the order of the file and may repeat.
template <class Member>
struct FileSet {
  std::string name;
  std::vector<Member> members;
};

/// A mesh as a file gives it, whole. Cells of lower dimension (the surface of a solid in a Gmsh file, shells) are cells like all others: what
/// uses the file finds the sides that they lie on.
struct MeshFile {
  std::string path;                                ///< as it was named
  std::vector<std::array<double, 3>> coordinates;  ///< [nodes] as in the file; 0 where it gives fewer than three
  std::vector<std::int64_t> node_labels;           ///< [nodes] their numbers in the file
  std::vector<FileCells> cells;                    ///< no two with the same shape
  std::vector<FileSet<FileCellRange>> cell_sets;   ///< element blocks, physical groups, ELSETs; ranges ascend
  std::vector<FileSet<FileSide>> side_sets;        ///< given by sides of cells
  std::vector<FileSet<std::int32_t>> node_sets;    ///< given by nodes
  std::vector<LeftOutSet> left_out;                ///< sets of any kind
  std::vector<std::string> notes;                  ///< elements that the reader replaced by others or left out, in words for users
};

/// The formats that can be read.
enum class MeshFormat {
  by_name,  ///< by the end of the file's name
  exodus,   ///< .exo, .e, .ex2, .exoII, .g, .gen
  gmsh,     ///< .msh, versions 2.2 and 4.1, ASCII and binary
  abaqus    ///< .inp of Abaqus and CalculiX
};

/// Reads a file on this rank. `place`, where it is named, is that of errors about the format.
/// @throws InputError with the file's line or byte, the entity, what was seen and what was expected; FileError if it cannot be opened
MeshFile read_mesh_file(const std::string& path, MeshFormat format, const Place& place);

}  // namespace mortise
