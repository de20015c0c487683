#include "mortise/mortar/facet_partition.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <algorithm>
#include <numeric>

namespace mortise {

int home_of(const SurfaceFacet& facet, const std::vector<int>& owners) {
  const GlobalOrdinal sum = std::accumulate(facet.begin(), facet.end(), GlobalOrdinal{0});
  return owners[static_cast<std::size_t>(sum) % owners.size()];
}

double largest_over_mean(const std::vector<double>& work_of_rank) {
  const double sum = std::accumulate(work_of_rank.begin(), work_of_rank.end(), 0.0);
  return sum > 0.0 ? *std::max_element(work_of_rank.begin(), work_of_rank.end()) * static_cast<double>(work_of_rank.size()) / sum : 1.0;
}

bool worth_moving(double now, double then, double bound) { return now > bound && (then <= bound || then <= 0.9 * now); }

std::vector<int> partition_facets(const RCP<const Communicator>& comm, const std::vector<PartitionedFacet>& facets, int parts) {
  using Adapter = Zoltan2::BasicVectorAdapter<Zoltan2::BasicUserTypes<double, LocalOrdinal, GlobalOrdinal>>;
  const auto count = static_cast<GlobalOrdinal>(facets.size());
  GlobalOrdinal end = 0;
  Teuchos::scan(*comm, Teuchos::REDUCE_SUM, count, Teuchos::outArg(end));
  std::vector<GlobalOrdinal> ids(facets.size());
  std::vector<double> x, y, z, work;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    ids[f] = end - count + static_cast<GlobalOrdinal>(f);
    x.push_back(facets[f].centre[0]);
    y.push_back(facets[f].centre[1]);
    z.push_back(facets[f].centre[2]);
    work.push_back(facets[f].work);
  }
  std::vector<const double*> coordinates{x.data(), y.data(), z.data()}, weights{work.data()};
  std::vector<int> strides{1, 1, 1}, weight_strides{1};
  Adapter adapter(static_cast<LocalOrdinal>(count), ids.data(), coordinates, strides, weights, weight_strides);
  Teuchos::ParameterList parameters;
  parameters.set("algorithm", "multijagged");
  parameters.set("num_global_parts", parts);
  parameters.set("imbalance_tolerance", 1.01);
  Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &parameters, comm);
  problem.solve();
  const int* part = problem.getSolution().getPartListView();
  return {part, part + facets.size()};
}

}  // namespace mortise
