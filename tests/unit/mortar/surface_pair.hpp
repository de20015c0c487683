#pragma once
// A slave and a master polyline, spread over ranks in any way, and what the mortar interface makes of them as dense matrices.

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"

namespace mortise::test {

using Points = std::vector<Eigen::Vector2d>;

/// Nodes: slave first, then master. The slave lies above and travels to +x (outward normal down), the master below and to -x.
struct TwoLines {
  std::string name;
  Points slave, master;
  std::vector<std::size_t> fixed_x, fixed_y;  ///< nodes with a prescribed component
  InterfaceMeasure measure;
  MortarOptions options;

  Points points() const {
    Points all = slave;
    all.insert(all.end(), master.begin(), master.end());
    return all;
  }
};

/// `count` facets over [low, high] on y(x); descending x if `reverse`.
inline Points line(int count, double low, double high, const std::function<double(double)>& y, bool reverse = false) {
  Points points;
  for (int i = 0; i <= count; ++i) {
    const double s = static_cast<double>(reverse ? count - i : i) / count, x = low + s * (high - low);
    points.push_back({x, y(x)});
  }
  return points;
}

/// Deterministic disorder in [-1, 1].
inline double disorder(std::size_t n) { return std::sin(12.9898 * static_cast<double>(n) + 78.233); }

/// Row sums over all ranks by slave node; the normals of the slave nodes.
struct DenseCoupling {
  Eigen::MatrixXd D, M;
  Eigen::VectorXd gap, normal;

  /// All entries one after the other.
  Eigen::VectorXd stacked() const {
    Eigen::VectorXd all(D.size() + M.size() + gap.size() + normal.size());
    all << D.reshaped(), M.reshaped(), gap, normal;
    return all;
  }
};

class SurfacePair {
 public:
  using Owner = std::function<int(std::size_t)>;

  /// Node n and the master facet that starts there belong to rank owner(n).
  SurfacePair(
      const TwoLines& lines, RCP<const Communicator> comm, const Owner& owner = [](std::size_t) { return 0; })
      : lines_(lines) {
    const Points points = lines.points();
    std::vector<GlobalOrdinal> ids;
    for (std::size_t n = 0; n < points.size(); ++n)
      if (owner(n) == comm->getRank()) ids.push_back(static_cast<GlobalOrdinal>(n));
    nodes = rcp(new Map(points.size(), ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
    const auto fixed = rcp(new MultiVector(nodes, 2));
    for (const std::size_t n : lines.fixed_x)
      if (owner(n) == comm->getRank()) fixed->replaceGlobalValue(static_cast<GlobalOrdinal>(n), 0, 1.0);
    for (const std::size_t n : lines.fixed_y)
      if (owner(n) == comm->getRank()) fixed->replaceGlobalValue(static_cast<GlobalOrdinal>(n), 1, 1.0);
    SurfaceFacets slave, master;
    for (std::size_t n = 0; n + 1 < lines.slave.size(); ++n)
      if (owner(n) == comm->getRank() || owner(n + 1) == comm->getRank())
        slave.push_back({static_cast<GlobalOrdinal>(n), static_cast<GlobalOrdinal>(n + 1)});
    for (std::size_t n = lines.slave.size(); n + 1 < points.size(); ++n)
      if (owner(n) == comm->getRank()) master.push_back({static_cast<GlobalOrdinal>(n), static_cast<GlobalOrdinal>(n + 1)});
    interface = std::make_unique<MortarInterface>(nodes, owned(points), fixed, slave, master, lines.measure, lines.options,
                                                  Place{"scene.xml", 7, "contact/pair"});
  }

  bool search(const Points& points) { return interface->search(*owned(points)); }

  /// Evaluates at `points`; `failure` as the interface sets it on this rank.
  void evaluate(const Points& points, bool derivatives) {
    MultiVector x(interface->local_nodes(), 2);
    for (std::size_t n = 0; n < x.getLocalLength(); ++n)
      for (int i = 0; i < 2; ++i) x.replaceLocalValue(static_cast<LocalOrdinal>(n), i, points[id(static_cast<LocalOrdinal>(n))][i]);
    failure.reset();
    interface->evaluate(x, derivatives, couplings, normals, failure);
  }

  DenseCoupling dense() const {
    const auto slaves = static_cast<Eigen::Index>(lines_.slave.size()), masters = static_cast<Eigen::Index>(lines_.master.size());
    DenseCoupling result;
    result.D.setZero(slaves, slaves);
    result.M.setZero(slaves, masters);
    result.gap.setZero(slaves);
    result.normal.setZero(2 * slaves);
    for_each_row([&](const FacetCoupling& coupling, int j, Eigen::Index row) {
      for (int k = 0; k < 2; ++k) result.D(row, index(coupling.slave[k])) += coupling.D(j, k);
      for (std::size_t l = 0; l < coupling.master.size(); ++l)
        result.M(row, index(coupling.master[l]) - slaves) += coupling.M(j, static_cast<Eigen::Index>(l));
      result.gap[row] += coupling.gap[j];
    });
    for (std::size_t s = 0; s < normals.size(); ++s) result.normal.segment<2>(2 * index(static_cast<LocalOrdinal>(s))) = normals[s].normal;
    for (const auto& [data, size] : {std::pair(result.D.data(), result.D.size()),
                                     {result.M.data(), result.M.size()},
                                     {result.gap.data(), result.gap.size()},
                                     {result.normal.data(), result.normal.size()}}) {
      const std::vector<double> mine(data, data + size);
      Teuchos::reduceAll(*nodes->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(size), mine.data(), data);
    }
    return result;
  }

  /// Derivative of dense().stacked() with respect to all nodal positions. One rank.
  Eigen::MatrixXd dense_derivative() const {
    const auto slaves = static_cast<Eigen::Index>(lines_.slave.size()), masters = static_cast<Eigen::Index>(lines_.master.size());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(slaves * (slaves + masters + 3), 2 * (slaves + masters));
    for_each_row([&](const FacetCoupling& coupling, int j, Eigen::Index row) {
      const auto count = static_cast<Eigen::Index>(coupling.master.size());
      for (std::size_t c = 0; c < coupling.columns.size(); ++c) {
        const Eigen::Index to = 2 * index(coupling.columns[c]), from = 2 * static_cast<Eigen::Index>(c);
        for (int k = 0; k < 2; ++k) result.block<1, 2>(row + slaves * index(coupling.slave[k]), to) += coupling.dD.block<1, 2>(2 * j + k, from);
        for (Eigen::Index l = 0; l < count; ++l)
          result.block<1, 2>(slaves * slaves + row + slaves * (index(coupling.master[l]) - slaves), to) +=
              coupling.dM.block<1, 2>(j * count + l, from);
        result.block<1, 2>(slaves * (slaves + masters) + row, to) += coupling.dgap.block<1, 2>(j, from);
      }
    });
    for (std::size_t s = 0; s < normals.size(); ++s)
      for (std::size_t c = 0; c < normals[s].columns.size(); ++c)
        result.block<2, 2>(slaves * (slaves + masters + 1) + 2 * index(static_cast<LocalOrdinal>(s)), 2 * index(normals[s].columns[c])) +=
            normals[s].derivative.middleCols<2>(2 * static_cast<Eigen::Index>(c));
    return result;
  }

  /// Reference weights A_j of this rank's slave nodes, 0 elsewhere.
  Eigen::VectorXd weights() const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lines_.slave.size()));
    for (const SlaveNode& node : interface->slave_nodes()) result[node.id] = node.weight;
    return result;
  }

  RCP<MultiVector> owned(const Points& points) const {
    const auto x = rcp(new MultiVector(nodes, 2));
    for (std::size_t n = 0; n < x->getLocalLength(); ++n)
      for (int i = 0; i < 2; ++i)
        x->replaceLocalValue(static_cast<LocalOrdinal>(n), i, points[nodes->getGlobalElement(static_cast<LocalOrdinal>(n))][i]);
    return x;
  }

  RCP<const Map> nodes;
  std::unique_ptr<MortarInterface> interface;
  std::vector<FacetCoupling> couplings;
  std::vector<NodalNormal> normals;
  std::optional<StepFailure> failure;

 private:
  std::size_t id(LocalOrdinal local) const { return static_cast<std::size_t>(interface->local_nodes()->getGlobalElement(local)); }
  Eigen::Index index(LocalOrdinal local) const { return static_cast<Eigen::Index>(id(local)); }
  /// Rows of owned slave nodes: those of others stand on their owners too.
  template <class Do>
  void for_each_row(const Do& act) const {
    for (const FacetCoupling& coupling : couplings)
      for (int j = 0; j < 2; ++j)
        if (static_cast<std::size_t>(coupling.slave[j]) < interface->slave_nodes().size()) act(coupling, j, index(coupling.slave[j]));
  }

  TwoLines lines_;
};

inline RCP<const Communicator> alone() { return rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)); }

/// Searched and evaluated on one rank.
inline std::unique_ptr<SurfacePair> evaluated(const TwoLines& lines, bool derivatives = false) {
  auto pair = std::make_unique<SurfacePair>(lines, alone());
  pair->search(lines.points());
  pair->evaluate(lines.points(), derivatives);
  return pair;
}

}  // namespace mortise::test
