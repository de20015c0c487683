#include "mortise/mortar/facet_partition.hpp"

#include <zoltan_cpp.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

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

namespace {

const std::vector<PartitionedFacet>& facets_of(void* data) { return *static_cast<const std::vector<PartitionedFacet>*>(data); }

int count(void* data, int*) { return static_cast<int>(facets_of(data).size()); }

int three_coordinates(void*, int*) { return 3; }

// The place of a facet in the list of its rank identifies it. Global ids only have to differ there.
void list(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float* weights, int*) {
  const auto& facets = facets_of(data);
  std::iota(global, global + facets.size(), ZOLTAN_ID_TYPE{0});
  std::iota(local, local + facets.size(), ZOLTAN_ID_TYPE{0});
  for (const auto& facet : facets) *weights++ = static_cast<float>(facet.work);
}

void centres(void* data, int, int, int objects, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* coordinates, int*) {
  for (int k = 0; k < objects; ++k) {
    const auto& centre = facets_of(data)[local[k]].centre;
    coordinates = std::copy(centre.begin(), centre.end(), coordinates);
  }
}

bool is_fine(int code) { return code == ZOLTAN_OK || code == ZOLTAN_WARN; }

void check(int code) {
  if (!is_fine(code)) throw std::runtime_error("Zoltan cannot be set up for the partition of the facets");
}

/// Equal numbers of facets in the order of ranks, whatever their work.
std::vector<int> in_order(std::int64_t before, std::int64_t all, std::size_t here, int parts) {
  std::vector<int> result(here);
  for (std::size_t f = 0; f < here; ++f) result[f] = static_cast<int>((before + static_cast<std::int64_t>(f)) * parts / all);
  return result;
}

}  // namespace

std::vector<int> partition_facets(const RCP<const Communicator>& comm, const std::vector<PartitionedFacet>& facets, int parts) {
  const auto mine = static_cast<std::int64_t>(facets.size());
  std::int64_t until = 0, all = 0;
  Teuchos::scan(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(until));
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  if (all <= parts) return in_order(until - mine, all, facets.size(), parts);  // nothing to weigh, and bisection fails at so few

  float version = 0.0f;
  check(Zoltan_Initialize(0, nullptr, &version));
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(comm.get());
  Zoltan zoltan(mpi != nullptr ? (*mpi->getRawMpiComm())() : MPI_COMM_SELF);
  const std::pair<const char*, std::string> parameters[] = {
      {"DEBUG_LEVEL", "0"},      {"LB_METHOD", "RCB"},    {"NUM_GLOBAL_PARTS", std::to_string(parts)},
      {"IMBALANCE_TOL", "1.01"}, {"OBJ_WEIGHT_DIM", "1"}, {"RETURN_LISTS", "PARTS"}};
  for (const auto& [name, value] : parameters) check(zoltan.Set_Param(name, value));
  auto* data = const_cast<std::vector<PartitionedFacet>*>(&facets);  // Zoltan only passes it on
  zoltan.Set_Num_Obj_Fn(count, data);
  zoltan.Set_Obj_List_Fn(list, data);
  zoltan.Set_Num_Geom_Fn(three_coordinates, data);
  zoltan.Set_Geom_Multi_Fn(centres, data);

  // With RETURN_LISTS = PARTS the lists of exports have all facets of this rank.
  int changes = 0, global_entries = 0, local_entries = 0, imports = 0, exports = 0;
  ZOLTAN_ID_PTR import_global = nullptr, import_local = nullptr, export_global = nullptr, export_local = nullptr;
  int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
  const int code = zoltan.LB_Partition(changes, global_entries, local_entries, imports, import_global, import_local, import_ranks, import_parts,
                                       exports, export_global, export_local, export_ranks, export_parts);
  int fails = is_fine(code) ? 0 : 1, fails_anywhere = 0;
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, fails, Teuchos::outArg(fails_anywhere));
  std::vector<int> result = in_order(until - mine, all, facets.size(), parts);  // the partition is only for speed: without one all goes on
  if (fails_anywhere > 0) exports = 0;
  for (int k = 0; k < exports; ++k) result[export_local[k]] = export_parts[k];
  Zoltan::LB_Free_Part(&import_global, &import_local, &import_ranks, &import_parts);
  Zoltan::LB_Free_Part(&export_global, &export_local, &export_ranks, &export_parts);
  return result;
}

}  // namespace mortise
