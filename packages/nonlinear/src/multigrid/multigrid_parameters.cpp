#include "multigrid/multigrid_parameters.hpp"

#include <MueLu_MasterList.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <algorithm>

#include "multigrid/solver_parameters.hpp"

namespace mortise::detail {
namespace {

/// At most.
constexpr int levels = 8;

/// Rows of the coarsest level, at most: KLU2 takes seconds for a few thousand in 3D.
constexpr int rows_of_coarsest = 1000;

/// Rows of any coarse level on each of several ranks, at least.
constexpr int rows_on_one_rank = 5000;

// Smoothed aggregation. Aggregates do not cross where the coordinates say that two bodies are far apart ("cut"), whatever contact couples. The matrix
// that smooths the prolongator is the whole one all the same. It is scaled with the sums of rows. Scaled with the diagonal, its largest eigenvalue,
// by which the smoothing is damped everywhere, would be that of the few rows in contact. The smoother is scaled with sums too, but its eigenvalue is
// that of prescribed rows, so the prolongator's has to be estimated separately.
Teuchos::ParameterList smoothed_aggregation(const MultigridSize& size) {
  Teuchos::ParameterList list("MueLu");
  list.set("verbosity", "none");
  list.set("problem: type", "unknown");
  list.set("number of equations", size.equations);
  list.set("max levels", levels);
  list.set("multigrid algorithm", "sa");
  list.set("sa: use filtered matrix", false);
  list.set("sa: use rowsumabs diagonal scaling", true);
  list.set("sa: calculate eigenvalue estimate", true);
  list.set("rap: fix zero diagonals", true);  // of coarse dofs beyond those of an aggregate of a single node
  list.set("aggregation: drop scheme", "distance laplacian");
  list.set("aggregation: drop tol", 1e-8);
  // The coarse solver is KLU2, which is right on one rank only: what is small enough for it is moved to one rank, and there is always a coarse level.
  list.set("coarse: max size", size.ranks == 1 ? rows_of_coarsest : static_cast<int>(std::clamp<GlobalOrdinal>(size.rows / 5, 1, rows_of_coarsest)));
  if (size.ranks == 1) {
    list.set("transpose: use implicit", true);  // no restriction is stored beside the prolongator; repartitioning needs it
  } else {
    list.set("repartition: enable", true);
    list.set("repartition: partitioner", "zoltan2");
    list.set("repartition: start level", 1);
    list.set("repartition: min rows per proc", rows_on_one_rank);
  }
  return list;
}

}  // namespace

Teuchos::ParameterList multigrid_parameters(const Teuchos::ParameterList& given, Smoother smoother, const MultigridSize& size) {
  Teuchos::ParameterList list = smoothed_aggregation(size);
  set_smoother(list, smoother, levels, size.ranks);
  list.setParameters(given);
  return list;
}

// Names first: on a wrong one MueLu prints all that it has.
std::vector<Diagnostic> multigrid_parameter_errors(const Located<Teuchos::ParameterList>& given, const RCP<const Communicator>& comm) {
  std::vector<Diagnostic> found;
  const bool has_factories = given.value.isSublist("Hierarchy");  // MueLu's other interface, with names of one's own
  if (!has_factories)
    found =
        unknown_parameters(given.value, *MueLu::MasterList::List(), given.place, "MueLu", "the MueLu User's Guide (trilinos.github.io)", "level ");
  try {
    Teuchos::ParameterList list = multigrid_parameters(given.value, first_smoother(given.value), {2, 1000, comm->getSize()});
    if (found.empty()) MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(list, comm);
  } catch (const std::exception& error) {
    found.push_back({given.place, in_one_line(error.what())});
  }
  return found;
}

}  // namespace mortise::detail
