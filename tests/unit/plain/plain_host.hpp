#pragma once
// Two surfaces as a host gives them to mortise.h.

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/plain/mortise.h"
#include "two_surfaces.hpp"

namespace mortise::test {

/// The arrays that mortise_create() and mortise_add_facets() take.
struct PlainArrays {
  std::vector<std::int64_t> node_ids, node_rows, row_ids, slave, master;
  std::vector<double> positions;
  std::vector<std::int32_t> marks;
  int dimension = 2, slave_size = 2, master_size = 2;

  PlainArrays(const TwoSurfaces& surfaces, const Fixture& fixture) : dimension(surfaces.dimension) {
    const auto slaves = static_cast<GlobalOrdinal>(surfaces.slave.size());
    for (const GlobalOrdinal node : local_ids(*fixture.nodes)) {
      const Point& x = node < slaves ? surfaces.slave[static_cast<std::size_t>(node)] : surfaces.master[static_cast<std::size_t>(node - slaves)];
      node_ids.push_back(node);
      for (int i = 0; i < dimension; ++i) {
        positions.push_back(x[static_cast<std::size_t>(i)]);
        node_rows.push_back(fixture.number(dimension * node + i));
        marks.push_back(surfaces.fixed[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)] ? 1 : 0);
      }
    }
    for (const GlobalOrdinal row : local_ids(*fixture.dofs)) row_ids.push_back(row);
    const auto mine = [&](GlobalOrdinal node) { return fixture.nodes->isNodeGlobalElement(node); };
    const auto polyline = [](GlobalOrdinal first, GlobalOrdinal end) {
      SurfaceFacets facets;
      for (GlobalOrdinal node = first; node + 1 < end; ++node) facets.push_back({node, node + 1});
      return facets;
    };
    const auto all = static_cast<GlobalOrdinal>(surfaces.size());
    const SurfaceFacets upper = surfaces.slave_facets.empty() ? polyline(0, slaves) : surfaces.slave_facets;
    const SurfaceFacets lower = surfaces.master_facets.empty() ? polyline(slaves, all) : surfaces.master_facets;
    slave_size = static_cast<int>(upper[0].size()), master_size = static_cast<int>(lower[0].size());
    for (const SurfaceFacet& facet : upper)
      if (std::any_of(facet.begin(), facet.end(), mine)) slave.insert(slave.end(), facet.begin(), facet.end());
    for (const SurfaceFacet& facet : lower)
      if (mine(facet[0])) master.insert(master.end(), facet.begin(), facet.end());
  }
};

/// A mortise_contact with its arrays.
struct PlainHost {
  PlainArrays arrays;
  mortise_contact* contact = nullptr;
  std::int32_t pair = -1;
  std::int64_t rows = 0, multipliers = 0;
  std::string message;

  explicit PlainHost(PlainArrays given) : arrays(std::move(given)), rows(static_cast<std::int64_t>(arrays.row_ids.size())) {}
  ~PlainHost() { mortise_destroy(&contact); }
  PlainHost(const PlainHost&) = delete;
  PlainHost& operator=(const PlainHost&) = delete;

  int create(const char* options = nullptr) {
    std::vector<char> text(1000);
    const int status =
        mortise_create(static_cast<int>(MPI_Comm_c2f(MPI_COMM_WORLD)), arrays.dimension, static_cast<std::int64_t>(arrays.node_ids.size()),
                       arrays.node_ids.data(), arrays.positions.data(), arrays.node_rows.data(), arrays.marks.data(), rows, arrays.row_ids.data(),
                       options, &contact, text.data(), static_cast<std::int64_t>(text.size()));
    message = text.data();
    return status;
  }
  int add_pair(const std::string& options) { return mortise_add_pair(contact, "pair", 100.0, options.c_str(), &pair); }
  int add_facets(int side, const std::vector<std::int64_t>& nodes, int size) {
    return mortise_add_facets(contact, pair, side, static_cast<std::int64_t>(nodes.size()) / size, size, nodes.data());
  }
  int ready() { return mortise_ready(contact, &multipliers); }
  /// All of it.
  void set_up(const std::string& options) {
    ASSERT_EQ(create(), MORTISE_OK) << message;
    ASSERT_EQ(add_pair(options), MORTISE_OK) << error();
    ASSERT_EQ(add_facets(MORTISE_SLAVE, arrays.slave, arrays.slave_size), MORTISE_OK) << error();
    ASSERT_EQ(add_facets(MORTISE_MASTER, arrays.master, arrays.master_size), MORTISE_OK) << error();
    ASSERT_EQ(ready(), MORTISE_OK) << error();
  }
  std::string error() const { return mortise_last_error(contact); }
};

/// The entries of a vector on this rank.
inline std::vector<double> entries(const Vector& vector) {
  const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
  return {view.data(), view.data() + view.extent(0)};
}

/// A matrix in compressed rows of global columns.
struct Compressed {
  std::vector<std::int64_t> starts{0}, columns;
  std::vector<double> values;

  explicit Compressed(const Matrix& matrix) {
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(matrix)); ++row) {
      Matrix::local_inds_host_view_type indices;
      Matrix::values_host_view_type of_row;
      matrix.getLocalRowView(row, indices, of_row);
      for (std::size_t k = 0; k < indices.extent(0); ++k) {
        columns.push_back(matrix.getColMap()->getGlobalElement(indices(k)));
        values.push_back(of_row(k));
      }
      starts.push_back(static_cast<std::int64_t>(columns.size()));
    }
  }
  explicit Compressed(const mortise_matrix& matrix)
      : starts(matrix.starts, matrix.starts + matrix.rows + 1),
        columns(matrix.columns, matrix.columns + matrix.starts[matrix.rows]),
        values(matrix.values, matrix.values + matrix.starts[matrix.rows]) {}
  bool operator==(const Compressed& other) const { return starts == other.starts && columns == other.columns && values == other.values; }
};

}  // namespace mortise::test
