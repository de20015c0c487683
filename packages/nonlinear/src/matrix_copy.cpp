#include "matrix_copy.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <stdexcept>

namespace mortise {

std::vector<std::size_t> places_of_entries(const Matrix& source, const Matrix& target) {
  const auto from = source.getLocalMatrixHost(), to = target.getLocalMatrixHost();
  std::vector<LocalOrdinal> column_in_target(source.getColMap()->getNodeNumElements());
  for (std::size_t c = 0; c < column_in_target.size(); ++c)
    column_in_target[c] = target.getColMap()->getLocalElement(source.getColMap()->getGlobalElement(static_cast<LocalOrdinal>(c)));
  std::vector<std::size_t> places(from.graph.entries.extent(0));
  for (LocalOrdinal row = 0; row < from.numRows(); ++row) {
    const auto begin = to.graph.entries.data() + to.graph.row_map(row), end = to.graph.entries.data() + to.graph.row_map(row + 1);
    for (std::size_t k = from.graph.row_map(row); k < from.graph.row_map(row + 1); ++k) {
      const LocalOrdinal column = column_in_target[from.graph.entries(k)];
      const auto found = std::lower_bound(begin, end, column);
      if (found == end || *found != column) throw std::logic_error("the condensed system's graph does not hold the bulk's");
      places[k] = static_cast<std::size_t>(found - to.graph.entries.data());
    }
  }
  return places;
}

void copy_entries(const Matrix& source, const std::vector<std::size_t>& places, Matrix& target) {
  target.resumeFill();
  target.setAllToScalar(0.0);
  const auto from = source.getLocalMatrixHost();
  const auto to = target.getLocalMatrixHost();
  for (std::size_t k = 0; k < places.size(); ++k) to.values(places[k]) = from.values(k);
}

}  // namespace mortise
