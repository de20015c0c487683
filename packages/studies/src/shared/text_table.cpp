#include "shared/text_table.hpp"

#include <boost/tokenizer.hpp>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace mortise {

std::vector<std::string> cells_of(const std::string& line) {
  const boost::tokenizer<boost::escaped_list_separator<char>> cells(line, boost::escaped_list_separator<char>("", ",", "\""));
  return {cells.begin(), cells.end()};
}

TextTable read_table(const std::string& path) {
  std::ifstream file(path);
  std::stringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  std::istringstream whole(text.substr(0, text.rfind('\n') + 1));
  std::string line;
  TextTable table;
  if (!std::getline(whole, line)) return table;
  const std::vector<std::string> names = cells_of(line);
  for (const auto& name : names) table[name];
  while (std::getline(whole, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() == names.size())
      for (std::size_t i = 0; i < names.size(); ++i) table[names[i]].push_back(cells[i]);
  }
  return table;
}

double number_of(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return cell.empty() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace mortise
