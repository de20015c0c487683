#include "distribution/coupling_message.hpp"

#include "mortise/mortar/facet_partition.hpp"

namespace mortise {

// Each list begins with its length, each matrix with its rows and columns.
std::size_t coupling_bytes(std::size_t slaves, std::size_t masters, std::size_t columns, int dimension) {
  const std::size_t values = slaves * slaves + slaves * masters + 2 * slaves;
  const std::size_t header = 2 + slaves, lists = 2 + masters + columns, sizes = 10 * 2;
  return sizeof(Words::value_type) * (header + lists + sizes + values * (1 + static_cast<std::size_t>(dimension) * columns));
}

void put_coupling(WordWriter& to, const CouplingHeader& header, const FacetCoupling& coupling, const std::function<GlobalOrdinal(LocalOrdinal)>& id) {
  to.put_list(header.slave);
  to.put(header.segments);
  if (header.segments == 0) return;
  for (const auto* nodes : {&coupling.master, &coupling.columns}) {
    to.put(nodes->size());
    for (const LocalOrdinal node : *nodes) to.put(id(node));
  }
  to.put_matrix(coupling.D);
  to.put_matrix(coupling.M);
  to.put_matrix(coupling.gap);
  to.put_matrix(coupling.cover);
  to.put_matrix(coupling.facing);
  to.put(coupling.alignment);
  for (const Eigen::MatrixXd* slope : {&coupling.dD, &coupling.dM, &coupling.dgap, &coupling.dcover, &coupling.dfacing, &coupling.dalignment})
    to.put_matrix(*slope);
}

CouplingHeader get_header(WordReader& from) {
  CouplingHeader header;
  from.get_list<GlobalOrdinal>([&](GlobalOrdinal node) { header.slave.push_back(node); });
  header.segments = from.get<std::size_t>();
  return header;
}

void get_coupling(WordReader& from, const CouplingHeader& header, const std::function<LocalOrdinal(GlobalOrdinal)>& local, FacetCoupling& coupling) {
  coupling.slave.clear();
  for (const GlobalOrdinal node : header.slave) coupling.slave.push_back(local(node));
  for (auto* nodes : {&coupling.master, &coupling.columns}) {
    nodes->clear();
    from.get_list<GlobalOrdinal>([&](GlobalOrdinal node) { nodes->push_back(local(node)); });
  }
  from.get_matrix(coupling.D);
  from.get_matrix(coupling.M);
  from.get_matrix(coupling.gap);
  from.get_matrix(coupling.cover);
  from.get_matrix(coupling.facing);
  coupling.alignment = from.get<double>();
  for (Eigen::MatrixXd* slope : {&coupling.dD, &coupling.dM, &coupling.dgap, &coupling.dcover, &coupling.dfacing, &coupling.dalignment})
    from.get_matrix(*slope);
}

}  // namespace mortise
