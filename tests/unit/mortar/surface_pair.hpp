#pragma once
// A slave and a master surface, spread over ranks in any way, and what the mortar interface makes of them as dense matrices.

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "facets_with_middles.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise::test {

using Points = std::vector<Eigen::Vector2d>;

/// Nodes: slave first, then master.
struct Surfaces {
  int dim = 2;
  std::size_t slaves = 0;
  std::vector<SpatialVector> points;
  SurfaceFacets slave, master;
  std::vector<std::pair<std::size_t, int>> fixed;  ///< node, component
  InterfaceMeasure measure;
  MortarOptions options;

  std::size_t masters() const { return points.size() - slaves; }
};

/// The slave lies above and travels to +x (outward normal down), the master below and to -x.
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

  operator Surfaces() const {
    Surfaces surfaces;
    surfaces.slaves = slave.size();
    for (const auto& x : points()) surfaces.points.emplace_back(x);
    for (std::size_t n = 0; n + 1 < surfaces.points.size(); ++n)
      if (n + 1 != slave.size())
        (n < slave.size() ? surfaces.slave : surfaces.master).push_back({static_cast<GlobalOrdinal>(n), static_cast<GlobalOrdinal>(n + 1)});
    for (const std::size_t n : fixed_x) surfaces.fixed.push_back({n, 0});
    for (const std::size_t n : fixed_y) surfaces.fixed.push_back({n, 1});
    surfaces.measure = measure;
    surfaces.options = options;
    return surfaces;
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

  /// Node n and the master facets that start there belong to rank owner(n).
  SurfacePair(
      Surfaces surfaces, RCP<const Communicator> comm, const Owner& owner = [](std::size_t) { return 0; })
      : surfaces_(std::move(surfaces)) {
    const int rank = comm->getRank();
    const std::size_t count = surfaces_.points.size();
    std::vector<GlobalOrdinal> ids;
    for (std::size_t n = 0; n < count; ++n)
      if (owner(n) == rank) ids.push_back(static_cast<GlobalOrdinal>(n));
    nodes = rcp(new Map(count, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
    const auto fixed = rcp(new MultiVector(nodes, surfaces_.dim));
    for (const auto& [n, component] : surfaces_.fixed)
      if (owner(n) == rank) fixed->replaceGlobalValue(static_cast<GlobalOrdinal>(n), component, 1.0);
    SurfaceFacets slave, master;
    for (const SurfaceFacet& facet : surfaces_.slave)
      if (std::any_of(facet.begin(), facet.end(), [&](GlobalOrdinal n) { return owner(static_cast<std::size_t>(n)) == rank; }))
        slave.push_back(facet);
    for (const SurfaceFacet& facet : surfaces_.master)
      if (owner(static_cast<std::size_t>(facet.front())) == rank) master.push_back(facet);
    interface = std::make_unique<MortarInterface>(nodes, owned(surfaces_.points), fixed, slave, master, surfaces_.measure, surfaces_.options,
                                                  Place{"scene.xml", 7, "contact/pair"});
  }

  template <class Points>
  bool search(const Points& points) {
    return interface->search(*owned(points));
  }

  /// Evaluates at `points`; `failure` as the interface sets it on this rank.
  template <class Points>
  void evaluate(const Points& points, bool derivatives) {
    MultiVector x(interface->local_nodes(), surfaces_.dim);
    for (std::size_t n = 0; n < x.getLocalLength(); ++n)
      for (int i = 0; i < surfaces_.dim; ++i) x.replaceLocalValue(static_cast<LocalOrdinal>(n), i, points[id(static_cast<LocalOrdinal>(n))][i]);
    failure.reset();
    interface->evaluate(x, derivatives, couplings, normals, failure);
  }

  DenseCoupling dense() const {
    const auto slaves = static_cast<Eigen::Index>(surfaces_.slaves), masters = static_cast<Eigen::Index>(surfaces_.masters()),
               dim = Eigen::Index{surfaces_.dim};
    DenseCoupling result;
    result.D.setZero(slaves, slaves);
    result.M.setZero(slaves, masters);
    result.gap.setZero(slaves);
    result.normal.setZero(dim * slaves);
    for_each_row([&](const FacetCoupling& coupling, int j, Eigen::Index row) {
      for (std::size_t k = 0; k < coupling.slave.size(); ++k) result.D(row, index(coupling.slave[k])) += coupling.D(j, static_cast<Eigen::Index>(k));
      for (std::size_t l = 0; l < coupling.master.size(); ++l)
        result.M(row, index(coupling.master[l]) - slaves) += coupling.M(j, static_cast<Eigen::Index>(l));
      result.gap[row] += coupling.gap[j];
    });
    for (std::size_t s = 0; s < normals.size(); ++s) result.normal.segment(dim * index(static_cast<LocalOrdinal>(s)), dim) = normals[s].normal;
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
    const auto slaves = static_cast<Eigen::Index>(surfaces_.slaves), masters = static_cast<Eigen::Index>(surfaces_.masters()),
               dim = Eigen::Index{surfaces_.dim};
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(slaves * (slaves + masters + 1 + dim), dim * (slaves + masters));
    for_each_row([&](const FacetCoupling& coupling, int j, Eigen::Index row) {
      const auto count = static_cast<Eigen::Index>(coupling.master.size()), facet = static_cast<Eigen::Index>(coupling.slave.size());
      for (std::size_t c = 0; c < coupling.columns.size(); ++c) {
        const Eigen::Index to = dim * index(coupling.columns[c]), from = dim * static_cast<Eigen::Index>(c);
        const auto add = [&](Eigen::Index to_row, const Eigen::MatrixXd& slope, Eigen::Index from_row) {
          result.block(to_row, to, 1, dim) += slope.block(from_row, from, 1, dim);
        };
        for (Eigen::Index k = 0; k < facet; ++k) add(row + slaves * index(coupling.slave[k]), coupling.dD, facet * j + k);
        for (Eigen::Index l = 0; l < count; ++l)
          add(slaves * slaves + row + slaves * (index(coupling.master[l]) - slaves), coupling.dM, j * count + l);
        add(slaves * (slaves + masters) + row, coupling.dgap, j);
      }
    });
    for (std::size_t s = 0; s < normals.size(); ++s)
      for (std::size_t c = 0; c < normals[s].columns.size(); ++c)
        result.block(slaves * (slaves + masters + 1) + dim * index(static_cast<LocalOrdinal>(s)), dim * index(normals[s].columns[c]), dim, dim) +=
            normals[s].derivative.middleCols(dim * static_cast<Eigen::Index>(c), dim);
    return result;
  }

  /// Reference weights A_j of this rank's slave nodes, 0 elsewhere.
  Eigen::VectorXd weights() const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(surfaces_.slaves));
    for (const SlaveNode& node : interface->slave_nodes()) result[node.id] = node.weight;
    return result;
  }

  template <class Points>
  RCP<MultiVector> owned(const Points& points) const {
    const auto x = rcp(new MultiVector(nodes, surfaces_.dim));
    for (std::size_t n = 0; n < x->getLocalLength(); ++n)
      for (int i = 0; i < surfaces_.dim; ++i)
        x->replaceLocalValue(static_cast<LocalOrdinal>(n), i, points[nodes->getGlobalElement(static_cast<LocalOrdinal>(n))][i]);
    return x;
  }

  RCP<const Map> nodes;
  std::unique_ptr<MortarInterface> interface;
  SurfaceKinks kinks;  ///< those that were set last
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
      for (int j = 0; j < static_cast<int>(coupling.slave.size()); ++j)
        if (static_cast<std::size_t>(coupling.slave[j]) < interface->slave_nodes().size()) act(coupling, j, index(coupling.slave[j]));
  }

  Surfaces surfaces_;
};

/// The same surfaces with mid-side nodes on either side, moved off the straight edges by up to `bend` of their lengths.
inline Surfaces quadratic(const Surfaces& linear, bool slave, bool master, double bend) {
  Surfaces result = linear;
  const auto slaves = static_cast<GlobalOrdinal>(linear.slaves);
  const auto side = [&](const SurfaceFacets& facets, bool raise, GlobalOrdinal first, GlobalOrdinal shift, std::vector<SpatialVector>& middles) {
    FacetsWithMiddles raised = raise ? with_middles(facets, first) : FacetsWithMiddles{facets, {}};
    for (const auto& [a, b] : raised.edges) {
      const SpatialVector &x = linear.points[static_cast<std::size_t>(a)], &y = linear.points[static_cast<std::size_t>(b)];
      SpatialVector off(linear.dim);
      for (int i = 0; i < linear.dim; ++i) off[i] = bend * (y - x).norm() * disorder(static_cast<std::size_t>(3 * a + 7 * b + 11 * i));
      middles.push_back(0.5 * (x + y) + off);
    }
    for (SurfaceFacet& facet : raised.facets)
      for (GlobalOrdinal& node : facet)
        if (node < first) node += shift;
    return raised.facets;
  };
  std::vector<SpatialVector> of_slave, of_master;
  result.slave = side(linear.slave, slave, slaves, 0, of_slave);
  const auto more = static_cast<GlobalOrdinal>(of_slave.size());
  result.master = side(linear.master, master, static_cast<GlobalOrdinal>(linear.points.size()) + more, more, of_master);
  result.points.insert(result.points.begin() + slaves, of_slave.begin(), of_slave.end());
  result.points.insert(result.points.end(), of_master.begin(), of_master.end());
  result.slaves += of_slave.size();
  return result;
}

inline RCP<const Communicator> alone() { return rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)); }

/// Searched and evaluated on one rank.
inline std::unique_ptr<SurfacePair> evaluated(const Surfaces& surfaces, bool derivatives = false) {
  auto pair = std::make_unique<SurfacePair>(surfaces, alone());
  pair->search(surfaces.points);
  pair->evaluate(surfaces.points, derivatives);
  return pair;
}

}  // namespace mortise::test
