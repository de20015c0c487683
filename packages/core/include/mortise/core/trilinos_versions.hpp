#pragma once
// Spellings that differ between versions of Trilinos. Members of maps, graphs and matrices that count on this rank have other names since 13.4, and the
// old names are gone since 14: code of Mortise and of its users calls these functions.

#include <Trilinos_version.h>

#include <cstddef>

namespace mortise {

/// Number of ids that a map has on this rank.
template <class Map>
std::size_t local_id_count(const Map& map) {
#if TRILINOS_MAJOR_MINOR_VERSION < 130400
  return map.getNodeNumElements();
#else
  return map.getLocalNumElements();
#endif
}

/// Global ids that a map has on this rank, in the order of their local ids. The view is valid as long as the map is.
template <class Map>
auto local_ids(const Map& map) {
#if TRILINOS_MAJOR_MINOR_VERSION < 130400
  return map.getNodeElementList();
#else
  return map.getLocalElementList();
#endif
}

/// Number of rows that a graph or a matrix has on this rank.
template <class Rows>
std::size_t local_row_count(const Rows& rows) {
#if TRILINOS_MAJOR_MINOR_VERSION < 130400
  return rows.getNodeNumRows();
#else
  return rows.getLocalNumRows();
#endif
}

/// Number of entries in the rows that a graph or a matrix has on this rank.
template <class Rows>
std::size_t local_entry_count(const Rows& rows) {
#if TRILINOS_MAJOR_MINOR_VERSION < 130400
  return rows.getNodeNumEntries();
#else
  return rows.getLocalNumEntries();
#endif
}

/// Number of entries of the longest row that a graph or a matrix has on this rank.
template <class Rows>
std::size_t longest_local_row(const Rows& rows) {
#if TRILINOS_MAJOR_MINOR_VERSION < 130400
  return rows.getNodeMaxNumRowEntries();
#else
  return rows.getLocalMaxNumRowEntries();
#endif
}

}  // namespace mortise
