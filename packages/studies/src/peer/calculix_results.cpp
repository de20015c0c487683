#include "peer/calculix_results.hpp"

#include <boost/algorithm/string.hpp>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

/// peer.sta: two lines of heads, then step, increment, attempt ("1", or "1U" for one that did not converge), iterations, total time, step time, dt.
std::vector<CalculixIncrement> read_increments(const std::string& path) {
  std::vector<CalculixIncrement> increments;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    long step = 0, number = 0;
    std::string attempt;
    CalculixIncrement increment;
    double step_time = 0.0;
    if (!(words >> step >> number >> attempt >> increment.iterations >> increment.time >> step_time >> increment.dt)) continue;  // a head
    if (boost::ends_with(attempt, "U")) continue;
    increment.cutbacks = std::stoi(attempt) - 1;
    increments.push_back(increment);
  }
  return increments;
}

/// Numbers of a line of results: " -1", node in 10 columns, values in 12 columns each, without blanks between them.
std::array<double, 6> values_of(const std::string& line) {
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size() && 13 + 12 * i < line.size(); ++i) values[i] = std::stod(line.substr(13 + 12 * i, 12));
  return values;
}

/// peer.frd: " -4  NAME" starts a block of nodal results, " -1" a line of it, " -3" ends it; "  100C" carries the time. Later blocks replace earlier
/// ones.
void read_nodal(const std::string& path, CalculixResults& results) {
  std::ifstream file(path);
  std::map<long, std::array<double, 6>>* block = nullptr;
  for (std::string line; std::getline(file, line);) {
    boost::trim_right(line);
    if (boost::starts_with(line, "    1UVERSION")) results.version = boost::trim_copy(line.substr(13));
    if (boost::starts_with(line, "  100C")) results.time = std::stod(line.substr(12, 12));
    if (boost::starts_with(line, " -4")) {
      block = &results.nodal[boost::trim_copy(line.substr(5, 8))];
      block->clear();
    }
    if (boost::starts_with(line, " -3")) block = nullptr;
    if (block != nullptr && boost::starts_with(line, " -1")) (*block)[std::stol(line.substr(3, 10))] = values_of(line);
  }
}

}  // namespace

CalculixResults read_calculix_results(const std::string& directory) {
  CalculixResults results;
  results.increments = read_increments(directory + "/peer.sta");
  try {
    read_nodal(directory + "/peer.frd", results);
  } catch (const std::logic_error&) {
    throw FileError("cannot read " + directory + "/peer.frd: a line of it is not one of results");
  }
  return results;
}

}  // namespace mortise
