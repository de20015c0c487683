#pragma once
// Part of a host application: two blocks of bilinear elements, one on the other, linear elastic with Poisson's ratio 0, in plane strain.

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

namespace host {

using namespace mortise;

constexpr double E = 1000.0, height = 2.0, width = 1.0;

/// Squares of side 1, the lower of 4 x 4 cells, the upper of 3 x 3. Nodes with x < 1/2 belong to rank 0, the others to the last rank.
struct Blocks {
  static constexpr std::array<int, 2> cells = {4, 3};
  static constexpr std::array<GlobalOrdinal, 3> first = {0, 25, 41};  ///< node of each block, and behind the last

  RCP<const Communicator> comm = Tpetra::getDefaultComm();
  RCP<const Map> nodes, dofs;
  RCP<MultiVector> reference, fixed;
  std::vector<std::array<GlobalOrdinal, 4>> elements;  ///< those with a node of this rank, x first

  static GlobalOrdinal node(int block, int i, int j) { return first[block] + i + (cells[block] + 1) * j; }
  static int block_of(GlobalOrdinal node) { return node < first[1] ? 0 : 1; }
  static std::array<double, 2> position(GlobalOrdinal node) {
    const int block = block_of(node), points = cells[block] + 1;
    const auto place = static_cast<int>(node - first[block]);
    return {1.0 * (place % points) / cells[block], block + 1.0 * (place / points) / cells[block]};
  }
  static bool held(GlobalOrdinal node) { return position(node)[1] == 0.0 || position(node)[1] == height; }
  bool mine(GlobalOrdinal node) const { return (position(node)[0] < 0.5 ? 0 : comm->getSize() - 1) == comm->getRank(); }

  Blocks() {
    std::vector<GlobalOrdinal> ids;
    for (GlobalOrdinal node = 0; node < first[2]; ++node)
      if (mine(node)) ids.push_back(node);
    nodes = rcp(new Map(first[2], ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
    dofs = make_dof_map(*nodes, 2);
    reference = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
    for (const GlobalOrdinal id : ids)
      for (int i = 0; i < 2; ++i) {
        reference->replaceGlobalValue(id, i, position(id)[i]);
        fixed->replaceGlobalValue(id, i, held(id) ? 1.0 : 0.0);
      }
    for (int block = 0; block < 2; ++block)
      for (int j = 0; j < cells[block]; ++j)
        for (int i = 0; i < cells[block]; ++i) {
          const std::array<GlobalOrdinal, 4> element = {node(block, i, j), node(block, i + 1, j), node(block, i, j + 1), node(block, i + 1, j + 1)};
          if (std::none_of(element.begin(), element.end(), [&](GlobalOrdinal one) { return mine(one); })) continue;
          elements.push_back(element);
        }
  }

  /// The upper block's lower edge (slave) on the lower block's upper edge, bodies on the left of the way along the nodes.
  ContactPair pair(double coefficient) const {
    ContactPair pair;
    pair.name = "joint";
    pair.youngs_modulus = E;
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(coefficient);
    pair.options.friction = {"coulomb", coulomb, {}};
    for (int i = 0; i < cells[1]; ++i) {
      const SurfaceFacet facet = {node(1, i, 0), node(1, i + 1, 0)};
      if (mine(facet[0]) || mine(facet[1])) pair.slave.push_back(facet);
    }
    for (int i = 0; i < cells[0]; ++i) {
      const SurfaceFacet facet = {node(0, i + 1, cells[0]), node(0, i, cells[0])};
      if (mine(facet[0])) pair.master.push_back(facet);
    }
    return pair;
  }

  RCP<const Graph> graph() const {
    const auto graph = rcp(new Graph(dofs, 18));
    for_each_entry([&](GlobalOrdinal row, GlobalOrdinal column, double) { graph->insertGlobalIndices(row, 1, &column); });
    graph->fillComplete(dofs, dofs);
    return graph;
  }
  void assemble(Matrix& matrix) const {
    for_each_entry([&](GlobalOrdinal row, GlobalOrdinal column, double value) { matrix.sumIntoGlobalValues(row, 1, &value, &column); });
  }

 private:
  // Of squares, whose side leaves the integrals:  int N_a,i N_b,j = m_ij,  sigma = E (sym grad u):
  //   K_(a i)(b j) = E ( delta_ij (m_11 + m_22) / 2 + m_ji / 2 ).
  template <class Take>
  void for_each_entry(const Take& take) const {
    const auto sign = [](int a, int i) { return (a >> i & 1) != 0 ? 1.0 : -1.0; };
    const auto m = [&](int a, int b, int i, int j) {
      const int other = 1 - i;
      return i == j ? sign(a, i) * sign(b, i) * ((a >> other & 1) == (b >> other & 1) ? 1.0 / 3.0 : 1.0 / 6.0) : 0.25 * sign(a, i) * sign(b, j);
    };
    for (const auto& element : elements)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4 && mine(element[a]); ++b)
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              take(2 * element[a] + i, 2 * element[b] + j, E * ((i == j ? 0.5 * (m(a, b, 0, 0) + m(a, b, 1, 1)) : 0.0) + 0.5 * m(a, b, j, i)));
  }
};

}  // namespace host
