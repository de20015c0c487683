#pragma once
// Content of an Abaqus input file, part by part, with names and labels as they stand there.

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "readers/abaqus/abaqus_lines.hpp"

namespace mortise {

/// A line's share of a set. Indices are those of a scope.
struct AbaqusSetItem {
  enum class Kind : std::uint8_t {
    label,        ///< a: of a node or element
    labels,       ///< a, a + c, ... up to b
    set,          ///< a: index into the scope's names
    indices,      ///< nodes a to a + b - 1; cells a to a + b - 1 of group c
    left_out,     ///< a elements that are not read
    of_elements,  ///< nodes of the set of elements a: index into the scope's names
  };
  Kind kind = Kind::label;
  std::int32_t a = 0, b = 0, c = 0;
  std::int32_t instance = -1;  ///< index into the scope's names of the instance that it is of; -1: of the scope itself
  AbaqusSpot spot;
};

struct AbaqusSet {
  std::string name;  ///< as it was written first
  bool is_internal = false;
  std::vector<AbaqusSetItem> items;
};

/// Sides of the elements of an item, or its nodes.
struct AbaqusSurfaceItem {
  enum class Face : std::uint8_t {
    exterior,  ///< those that no other element has
    side,      ///< S1, S2, ...
    positive,  ///< SPOS
    negative,  ///< SNEG
  };
  AbaqusSetItem of;
  Face face = Face::exterior;
  int number = 0;  ///< of the side, from 1
};

struct AbaqusSurface {
  std::string name;
  bool is_of_nodes = false;  ///< then its items have no faces
  bool is_internal = false;
  std::vector<AbaqusSurfaceItem> items;
};

/// Entries of a kind in their order, found by their names whatever the letters.
template <class Entry>
class AbaqusNames {
 public:
  /// The entry of this name, which is added if there is none.
  Entry& operator[](const std::string& name);
  /// Its index, or -1.
  std::int32_t find(const std::string& name) const;
  const std::vector<Entry>& all() const { return entries_; }

 private:
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::int32_t> places_;
};

/// A part, or what stands outside of parts: there labels and names are its own.
struct AbaqusScope {
  std::string name;
  std::vector<std::array<double, 3>> coordinates;
  std::vector<std::int64_t> node_labels;
  std::vector<AbaqusSpot> node_spots;
  std::vector<FileCells> cells;                     ///< their nodes are labels, as there may be nodes behind them
  std::vector<std::vector<AbaqusSpot>> cell_spots;  ///< [groups][cells]
  std::vector<std::vector<bool>> cell_is_surface;   ///< [groups][cells] a shell, membrane or rigid surface
  AbaqusNames<AbaqusSet> node_sets, element_sets;
  AbaqusNames<AbaqusSurface> surfaces;
  std::vector<std::int64_t> left_out_elements;  ///< labels of elements that are not read
  std::vector<LeftOutSet> left_out_surfaces;
  std::vector<std::string> names;  ///< that items refer to

  /// The number of cell 0 of each group in the order of the groups, and of all cells.
  std::vector<std::int32_t> first_cells() const;
};

/// A part that is put somewhere.
struct AbaqusInstance {
  std::string name;
  std::size_t part = 0;
  std::vector<double> translation, rotation;  ///< none, or 3 numbers; none, or two points of the axis and the angle in degrees
  AbaqusSpot spot;
};

struct AbaqusModel {
  AbaqusScope outside;  ///< of parts
  std::deque<AbaqusScope> parts;
  std::vector<AbaqusInstance> instances;
  std::map<std::string, int> passed_over;        ///< number of uses of each keyword that says nothing of the mesh
  std::map<std::string, std::int64_t> left_out;  ///< number of elements of each type that is not read: "springs (SPRINGA)"
  std::vector<std::string> notes;
};

/// Reads all lines; behind the first *STEP sets and surfaces alone.
AbaqusModel parse_abaqus(AbaqusLines& lines, FileErrors& errors);

}  // namespace mortise
