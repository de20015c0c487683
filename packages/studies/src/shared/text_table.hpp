#pragma once
// Tables that a run left.

#include <map>
#include <string>
#include <vector>

namespace mortise {

/// The cells of a line of comma separated values, without the quotes around texts.
std::vector<std::string> cells_of(const std::string& line);

/// Columns of a table of comma separated values by their names, rows in their order; texts as they stand.
using TextTable = std::map<std::string, std::vector<std::string>>;

/// Reads a table. A last line without its end, of a run that was killed, is left out. No file, or an empty one: no columns.
TextTable read_table(const std::string& path);

/// The number that a cell holds; not a number if it holds none.
double number_of(const std::string& cell);

}  // namespace mortise
