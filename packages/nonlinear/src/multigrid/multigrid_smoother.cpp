#include "multigrid/multigrid_smoother.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace mortise::detail {
namespace {

std::string name_of_level(int level) { return fmt::format("level {}", level); }

// Coarse levels are small but hard. With Chebyshev polynomials they are passed twice. Their aggregates follow the order of the graph and are half as
// large as in that of the rows: level k holds the aggregates of level k - 1. Where aggregates are cut at the border of ranks, twice the degree pays.
void set_chebyshev(Teuchos::ParameterList& parameters, int levels, int ranks) {
  const auto set_polynomial = [](Teuchos::ParameterList& of_level, int degree) {
    of_level.set("smoother: type", "CHEBYSHEV");
    of_level.sublist("smoother: params").set("chebyshev: degree", degree);
    of_level.sublist("smoother: params").set("chebyshev: ratio eigenvalue", 8.0);
  };
  set_polynomial(parameters, 2);
  for (int level = 1; level < levels; ++level) set_polynomial(parameters.sublist(name_of_level(level)), ranks == 1 ? 2 : 4);
  for (int level = 2; level < levels; ++level) parameters.sublist(name_of_level(level)).set("aggregation: ordering", "graph");
  parameters.set("cycle type", "W");
}

void set_gauss_seidel(Teuchos::ParameterList& parameters, int levels) {
  const auto set_sweeps = [](Teuchos::ParameterList& of_level, int sweeps) {
    of_level.set("smoother: type", "RELAXATION");
    of_level.sublist("smoother: params").set("relaxation: type", "Symmetric Gauss-Seidel");
    of_level.sublist("smoother: params").set("relaxation: sweeps", sweeps);
  };
  set_sweeps(parameters, 1);
  for (int level = 1; level < levels; ++level) set_sweeps(parameters.sublist(name_of_level(level)), 2);
}

}  // namespace

Smoother first_smoother(const Teuchos::ParameterList& parameters) {
  const bool is_given = std::any_of(parameters.begin(), parameters.end(), [&](const auto& item) {
    return item.first.rfind("smoother:", 0) == 0 || (item.second.isList() && parameters.sublist(item.first).isParameter("smoother: type"));
  });
  return is_given ? Smoother::given : Smoother::chebyshev;
}

std::optional<Smoother> next_smoother(Smoother smoother) {
  if (smoother == Smoother::chebyshev) return Smoother::gauss_seidel;
  return std::nullopt;
}

double most_iterations(Smoother smoother) { return next_smoother(smoother) ? 100.0 : std::numeric_limits<double>::infinity(); }

void set_smoother(Teuchos::ParameterList& parameters, Smoother smoother, int levels, int ranks) {
  switch (smoother) {
    case Smoother::chebyshev:
      return set_chebyshev(parameters, levels, ranks);
    case Smoother::gauss_seidel:
      return set_gauss_seidel(parameters, levels);
    case Smoother::given:
      break;
  }
}

}  // namespace mortise::detail
