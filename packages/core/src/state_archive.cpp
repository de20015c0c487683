#include "mortise/core/state_archive.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

std::string not_whole(const std::string& name, double value) {
  return fmt::format("\"{}\" holds {}, which is no whole number of the kind that stands there", name, value);
}

std::optional<std::string> not_finite(const std::string& name, const std::vector<double>& values) {
  const auto wrong = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (wrong == values.end()) return std::nullopt;
  return fmt::format("\"{}\" holds {} as number {} of {}; only finite numbers can stand there", name, *wrong, wrong - values.begin() + 1,
                     values.size());
}

void serialize(StateArchive& archive, const std::string& name, std::optional<double>& number) {
  std::vector<double> values;
  if (number) values.push_back(*number);
  serialize(archive, name, values);
  number = values.empty() ? std::nullopt : std::optional(values.front());
}

void serialize(StateArchive& archive, const std::string& name, const std::string& rows, Vector& vector) {
  const auto ids = local_ids(*vector.getMap());
  std::vector<double> values(static_cast<std::size_t>(ids.size()));
  if (!archive.restores()) {
    const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t row = 0; row < values.size(); ++row) values[row] = view(row, 0);
  }
  archive.rows(name, {rows, {ids.begin(), ids.end()}, values.size()}, 1, values);
  if (!archive.restores()) return;
  const auto view = vector.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t row = 0; row < values.size(); ++row) view(row, 0) = values[row];
}

// As a table of the longest row, each row with its length before it.
void serialize(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& ids, std::vector<std::vector<double>>& rows) {
  std::size_t mine = 0, longest = 0;
  for (const auto& row : rows) mine = std::max(mine, row.size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(longest));
  serialize(archive, name + ".longest", longest);
  const std::size_t columns = 1 + longest;
  std::vector<double> table;
  if (!archive.restores())
    for (const auto& row : rows) {
      table.push_back(static_cast<double>(row.size()));
      table.insert(table.end(), row.begin(), row.end());
      table.resize(table.size() + longest - row.size());
    }
  archive.rows(name, ids, columns, table);
  if (!archive.restores()) return;
  rows.clear();
  std::optional<std::string> wrong;
  for (auto row = table.begin(); row != table.end(); row += static_cast<std::ptrdiff_t>(columns)) {
    const auto length = whole_number<std::ptrdiff_t>(*row);
    if (!length || *length < 0 || *length > static_cast<std::ptrdiff_t>(longest))
      wrong = fmt::format("a row of \"{}\" is {} long; the longest one has {}", name, *row, longest);
    else
      rows.emplace_back(row + 1, row + 1 + *length);
  }
  archive.refuse_if(wrong);
}

}  // namespace mortise
