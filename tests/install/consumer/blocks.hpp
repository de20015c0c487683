#pragma once
// Part of a host application: two blocks, one on the other, linear elastic with Poisson's ratio 0. In the plane they are in plane strain.

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/dof_map.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace host {

using namespace mortise;

constexpr double E = 1000.0, height = 2.0, width = 1.0;

/// Squares or cubes of side 1, the lower of 4 cells along each direction, the upper of 3. The last direction is up. Cells have the shape functions
/// that are linear in each direction. Nodes with x < 1/2 belong to rank 0, the others to the last rank.
struct Blocks {
  static constexpr std::array<int, 2> cells = {4, 3};
  using Place = std::array<int, 3>;  ///< of a node or cell in its block; 0 in a direction that there is not

  const int dimension;
  const double overhang;                     ///< by which the upper block reaches beyond the lower one, along x
  const std::array<GlobalOrdinal, 3> first;  ///< node of each block, and behind the last
  RCP<const Communicator> comm = Tpetra::getDefaultComm();
  RCP<const Map> nodes, dofs;
  RCP<MultiVector> reference, fixed;

  explicit Blocks(int dimension, double overhang = 0.0)
      : dimension(dimension), overhang(overhang), first{0, count(cells[0] + 1), count(cells[0] + 1) + count(cells[1] + 1)} {
    std::vector<GlobalOrdinal> ids;
    for (GlobalOrdinal node = 0; node < first[2]; ++node)
      if (mine(node)) ids.push_back(node);
    nodes = rcp(new Map(first[2], ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
    dofs = make_dof_map(*nodes, dimension);
    reference = rcp(new MultiVector(nodes, dimension)), fixed = rcp(new MultiVector(nodes, dimension));
    for (const GlobalOrdinal id : ids)
      for (int i = 0; i < dimension; ++i) {
        reference->replaceGlobalValue(id, i, position(id)[i]);
        fixed->replaceGlobalValue(id, i, held(id) ? 1.0 : 0.0);
      }
    for (int block = 0; block < 2; ++block)
      for (GlobalOrdinal cell = 0; cell < count(cells[block]); ++cell) {
        const std::vector<GlobalOrdinal> element = corners(block, place(cell, cells[block]), dimension);
        if (std::any_of(element.begin(), element.end(), [&](GlobalOrdinal one) { return mine(one); })) elements_.push_back(element);
      }
  }

  int block_of(GlobalOrdinal node) const { return node < first[1] ? 0 : 1; }
  bool held(GlobalOrdinal node) const {
    const double up = position(node)[dimension - 1];
    return up == 0.0 || up == height;
  }

  /// Prescribed displacements: the upper block's upper face goes down.
  Vector pressed(double down) const {
    Vector target(dofs);
    for (const GlobalOrdinal id : local_ids(*dofs))
      if (block_of(id / dimension) == 1 && held(id / dimension) && id % dimension == dimension - 1) target.replaceGlobalValue(id, -down);
    return target;
  }

  /// Facets of the lower block's upper face (block 0), each on one rank, or of the upper block's lower face (1), each on the ranks that own a node of
  /// it. In the plane bodies are on the left of the way along the nodes, in space nodes go round the outward normal.
  SurfaceFacets face(int block) const {
    SurfaceFacets facets;
    for (int k = 0; k < count(cells[block]) / cells[block]; ++k) {
      Place at = place(k, cells[block]);
      at[dimension - 1] = block == 0 ? cells[0] : 0;
      std::vector<GlobalOrdinal> around = corners(block, at, dimension - 1);
      if (dimension == 3) std::swap(around[2], around[3]);  // against the clock, seen from above
      if ((dimension == 3) == (block == 1)) std::reverse(around.begin(), around.end());
      const SurfaceFacet facet(around.begin(), around.end());
      const bool any_mine = std::any_of(facet.begin(), facet.end(), [&](GlobalOrdinal one) { return mine(one); });
      if (block == 1 ? any_mine : mine(facet[0])) facets.push_back(facet);
    }
    return facets;
  }

  /// The upper block's lower face (slave) on the lower block's upper face, with Coulomb friction.
  ContactPair pair(double coefficient) const {
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(coefficient);
    ContactPair pair;
    pair.name = "joint";
    pair.slave = face(1);
    pair.master = face(0);
    pair.youngs_modulus = E;
    pair.options.friction = {"coulomb", coulomb, {}};
    return pair;
  }

  RCP<const Graph> graph() const {
    const auto graph = rcp(new Graph(dofs, dimension * (dimension == 2 ? 9 : 27)));
    for_each_entry([&](GlobalOrdinal row, GlobalOrdinal column, double) { graph->insertGlobalIndices(row, 1, &column); });
    graph->fillComplete(dofs, dofs);
    return graph;
  }
  void assemble(Matrix& matrix) const {
    for_each_entry([&](GlobalOrdinal row, GlobalOrdinal column, double value) { matrix.sumIntoGlobalValues(row, 1, &value, &column); });
  }

 private:
  GlobalOrdinal count(int along) const { return dimension == 2 ? along * along : along * along * along; }
  static Place place(GlobalOrdinal number, int along) {
    const int n = static_cast<int>(number);
    return {n % along, n / along % along, n / along / along};
  }
  GlobalOrdinal node(int block, const Place& at) const {
    const int along = cells[block] + 1;
    return first[block] + at[0] + along * (at[1] + along * at[2]);
  }
  /// Of a cell, or of a side of as many directions: x first.
  std::vector<GlobalOrdinal> corners(int block, const Place& cell, int directions) const {
    std::vector<GlobalOrdinal> result;
    for (int corner = 0; corner < 1 << directions; ++corner)
      result.push_back(node(block, {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1)}));
    return result;
  }
  std::array<double, 3> position(GlobalOrdinal node) const {
    const int block = block_of(node);
    const Place at = place(node - first[block], cells[block] + 1);
    std::array<double, 3> x;
    for (int i = 0; i < 3; ++i) x[i] = 1.0 * at[i] / cells[block];
    x[0] += block * overhang;
    x[dimension - 1] += block;
    return x;
  }
  bool mine(GlobalOrdinal node) const { return (position(node)[0] < 0.5 ? 0 : comm->getSize() - 1) == comm->getRank(); }

  // Products of integrals over the sides h of a cell:  m_ij = int N_a,i N_b,j.  With  sigma = E (sym grad u):
  //   K_(a i)(b j) = E ( delta_ij sum_k m_kk / 2 + m_ji / 2 ).
  template <class Take>
  void for_each_entry(const Take& take) const {
    const auto sign = [](int a, int i) { return (a >> i & 1) != 0 ? 1.0 : -1.0; };
    const auto m = [&](int a, int b, int i, int j, double h) {
      double product = 1.0;
      for (int k = 0; k < dimension; ++k)
        if (k == i && k == j)
          product *= sign(a, k) * sign(b, k) / h;
        else if (k == i)
          product *= 0.5 * sign(a, k);
        else if (k == j)
          product *= 0.5 * sign(b, k);
        else
          product *= h * (sign(a, k) == sign(b, k) ? 1.0 / 3.0 : 1.0 / 6.0);
      return product;
    };
    for (const std::vector<GlobalOrdinal>& element : elements_) {
      const int size = static_cast<int>(element.size());
      const double h = 1.0 / cells[block_of(element[0])];
      for (int a = 0; a < size; ++a)
        for (int b = 0; b < size && mine(element[a]); ++b) {
          double sum = 0.0;
          for (int k = 0; k < dimension; ++k) sum += m(a, b, k, k, h);
          for (int i = 0; i < dimension; ++i)
            for (int j = 0; j < dimension; ++j)
              take(dimension * element[a] + i, dimension * element[b] + j, 0.5 * E * ((i == j ? sum : 0.0) + m(a, b, j, i, h)));
        }
    }
  }

  std::vector<std::vector<GlobalOrdinal>> elements_;  ///< those with a node of this rank
};

}  // namespace host
