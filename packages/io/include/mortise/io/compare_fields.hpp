#pragma once
// Differences between the fields of two runs.

#include <array>
#include <string>
#include <vector>

namespace mortise {

/// A field at the times that both runs have: where it differs most.
struct FieldDifference {
  std::string name;
  double difference = 0.0;        ///< largest |a - b| of a component [unit of the field]; not finite where one of them is not
  double scale = 0.0;             ///< largest |a| or |b| of all components and times
  double time = 0.0;              ///< of the difference
  bool of_nodes = true;           ///< else of elements
  long long id = 0;               ///< of the node or element, as in the files
  std::array<double, 3> place{};  ///< reference position of the node, or of the element's first node
};

/// Fields that two runs have.
struct FieldComparison {
  std::string not_compared;               ///< why no field is compared, as meshes differ; empty: they are
  int times = 0;                          ///< that both have
  std::vector<FieldDifference> fields;    ///< in the order of the first run
  std::vector<std::string> in_one_alone;  ///< names
};

/// Compares fields that FieldWriters left below two directories, at times that agree to 1e-9. Meshes have to have the same elements, and nodes at the
/// same places to 1e-9 of the size of the mesh. Ids do not depend on the number of ranks. No communication; rows are read in chunks.
/// @throws FileError  what cannot be read or is damaged
FieldComparison compare_fields(const std::string& a, const std::string& b);

}  // namespace mortise
