#pragma once
// The loop over the elements of a block: gathers what an integrand reads and scatters what it gives.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "mortise/mesh/field_space.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/solid/element_history.hpp"
#include "mortise/solid/element_points.hpp"

namespace mortise {

/// A tangent of an element: the derivative of the component i at node a with respect to the component k at node b.
template <int nodes, int field_components>
struct NodalBlocks {
  static constexpr int components = field_components;
  std::array<std::array<double, components * nodes>, components * nodes> entries{};
  double& operator()(int a, int i, int b, int k) { return entries[components * a + i][components * b + k]; }
  double operator()(int a, int i, int b, int k) const { return entries[components * a + i][components * b + k]; }
};

/// A tangent with one number for a pair of nodes, which holds for each component; components do not mix.
template <int nodes>
struct NodalPairs {
  std::array<std::array<double, nodes>, nodes> entries{};
  double& operator()(int a, int b) { return entries[a][b]; }
  double operator()(int a, int b) const { return entries[a][b]; }
};

/// A coupling of an element: the derivative of the component i at node a with respect to the component k of another field at node b.
template <int nodes, int row_components, int column_components>
struct FieldCoupling {
  static constexpr int rows = row_components, columns = column_components;
  std::array<std::array<double, columns * nodes>, rows * nodes> entries{};
  double& operator()(int a, int i, int b, int k) { return entries[rows * a + i][columns * b + k]; }
  double operator()(int a, int i, int b, int k) const { return entries[rows * a + i][columns * b + k]; }
};

/// True of integrands with a Coupling.
template <class Integrand, class = void>
inline constexpr bool has_coupling = false;
template <class Integrand>
inline constexpr bool has_coupling<Integrand, std::void_t<typename Integrand::Coupling>> = true;

/// What is absent is no member.
template <class Integrand, bool wanted>
struct ResidualSum {};
template <class Integrand>
struct ResidualSum<Integrand, true> {
  typename Integrand::Residual residual{};
};
template <class Integrand, bool wanted>
struct TangentSum {};
template <class Integrand>
struct TangentSum<Integrand, true> {
  typename Integrand::Tangent tangent{};
};
template <class Integrand, bool wanted>
struct CouplingSum {};
template <class Integrand>
struct CouplingSum<Integrand, true> {
  typename Integrand::Coupling coupling{};
};

/// What an integrand's points are summed into: `residual`, `tangent` or both; with the tangent also `coupling`, of integrands that have one.
template <class Integrand, bool residual_wanted, bool tangent_wanted>
struct ElementSums : ResidualSum<Integrand, residual_wanted>,
                     TangentSum<Integrand, tangent_wanted>,
                     CouplingSum<Integrand, tangent_wanted && has_coupling<Integrand>> {
  static constexpr bool with_residual = residual_wanted, with_tangent = tangent_wanted;
};

/// An integrand says what is integrated over one element and knows no mesh, no vector and no matrix. It has
///   - Geometry, an ElementGeometry; point_count, the number of points of the cell's rule;
///   - Reads, a tuple of what it takes of fields at the points: FieldValue, FieldGradient, or a type of its own made like them;
///   - Residual, an array [components * node + i] of the field in whose rows it stands, and `components`; or no such type;
///   - Tangent, NodalBlocks or a type that is called like it, or NodalPairs; or no such type;
///   - Coupling, FieldCoupling with the columns of another field; or no such type;
///   - State, what a point remembers; or no such type;
///   - add(points, sums), with a State add(points, states, sums): adds to sums.residual if Sums::with_residual, to sums.tangent and sums.coupling
///   if Sums::with_tangent.
///     It returns nothing, or what converts to true where the element has no such sums.
/// `points` are ElementPoints.
///
/// An integrand over the elements of a block, with its rule and what its points remember.
template <class Integrand>
class BlockIntegral {
  template <class Type, class = void>
  struct StateIn {
    using State = NoState;
    static constexpr bool exists = false;
  };
  template <class Type>
  struct StateIn<Type, std::void_t<typename Type::State>> {
    using State = typename Type::State;
    static constexpr bool exists = true;
  };

 public:
  using Geometry = typename Integrand::Geometry;
  using Points = ElementPoints<Geometry, Integrand::point_count, typename Integrand::Reads>;
  using History = ElementHistory<typename StateIn<Integrand>::State, Integrand::point_count>;

  Integrand integrand;
  typename Points::Rule rule;
  History history;

  /// `thickness` counts for plane cells.
  BlockIntegral(Integrand of_element, const Block& block, double thickness) : integrand(std::move(of_element)), rule(thickness), history(block) {}

  template <class Sums>
  auto add(LocalOrdinal element, const Points& points, Sums& sums) const {
    if constexpr (StateIn<Integrand>::exists)
      return integrand.add(points, history[element], sums);
    else
      return integrand.add(points, sums);
  }
};

/// Where sums of elements go.
struct AssemblyTarget {
  FieldView<double> residual{};                   ///< null: not wanted
  const NodalSparsity::Values* matrix = nullptr;  ///< of the space's sparsity; null: not wanted
  double factor = 1.0;                            ///< of what is added to the matrix
};

/// The elements of a block that touch an owned node. Rows of other nodes are left to their ranks.
template <class Cell>
class ElementLoop {
 public:
  static constexpr int nodes = Cell::nodes, dimension = Cell::dimension;
  using Positions = std::array<std::array<double, dimension>, nodes>;
  /// The values of fields on the local nodes, in the order of Reads.
  template <std::size_t fields>
  using Fields = std::array<FieldView<const double>, fields>;

  /// Tangents stand in the rows and the columns of one field, couplings in its rows and the columns of the coupled one. Space and block have to
  /// outlive the loop; the fields live on the nodes of the block.
  ElementLoop(const FieldSpace& space, const Block& block, std::size_t field = 0, std::optional<std::size_t> coupled = std::nullopt)
      : mesh_(*space.mesh()), block_(block), rows_(space.rows(field)), owned_nodes_(mesh_.owned_count()), positions_(positions(space, block, field)) {
    if (coupled) coupled_positions_ = positions(space, block, *coupled);
  }

  const Mesh& mesh() const { return mesh_; }
  const Block& block() const { return block_; }
  /// Of the field in whose rows the sums stand.
  const FieldRows& rows() const { return rows_; }

  /// target += the integral over each element, of its residual, its tangent (with its coupling) or both. A wanted residual without a place in the
  /// target is left out there. report(element, what add() returned) where an integrand has no sums; the target's are then meaningless.
  template <bool residual_wanted, bool tangent_wanted, class Integrand, std::size_t fields, class Report>
  void add(const BlockIntegral<Integrand>& integral, const Fields<fields>& values, const AssemblyTarget& target, const Report& report) const {
    for (LocalOrdinal element = 0; element < block_.size(); ++element) {
      if (!touches_owned(element)) continue;
      ElementSums<Integrand, residual_wanted, tangent_wanted> sums;
      const auto points = points_of<Integrand>(element, integral.rule, values);
      if constexpr (std::is_void_v<decltype(integral.add(element, points, sums))>)
        integral.add(element, points, sums);
      else if (const auto trouble = integral.add(element, points, sums))
        report(element, trouble);
      add_sums(element, sums, target);
    }
  }

  /// The same of integrands that always have sums.
  template <bool residual_wanted, bool tangent_wanted, class Integrand, std::size_t fields>
  void add(const BlockIntegral<Integrand>& integral, const Fields<fields>& values, const AssemblyTarget& target) const {
    add<residual_wanted, tangent_wanted>(integral, values, target, [](LocalOrdinal, auto) {});
  }

  /// The points of an element, whether it touches an owned node or not.
  template <class Integrand, std::size_t fields>
  auto points_of(LocalOrdinal element, const typename BlockIntegral<Integrand>::Points::Rule& rule, const Fields<fields>& values) const {
    using Points = typename BlockIntegral<Integrand>::Points;
    static_assert(fields == std::tuple_size_v<typename Integrand::Reads>);
    const LocalOrdinal* node = block_.nodes(element);
    return Points(rule, reference(node), gather<typename Points::NodalValues>(node, values, std::make_index_sequence<fields>{}));
  }

  /// Whether rows of the element are this rank's.
  bool touches_owned(LocalOrdinal element) const {
    const LocalOrdinal* node = block_.nodes(element);
    for (int a = 0; a < nodes; ++a)
      if (node[a] < owned_nodes_) return true;
    return false;
  }

  /// target += the sums of one element, for who has a loop of his own: see add().
  template <class Integrand, bool residual_wanted, bool tangent_wanted>
  void add_sums(LocalOrdinal element, const ElementSums<Integrand, residual_wanted, tangent_wanted>& sums, const AssemblyTarget& target) const {
    if constexpr (residual_wanted)
      if (target.residual.values != nullptr) scatter<Integrand::components>(block_.nodes(element), sums.residual, target.residual);
    if constexpr (tangent_wanted) scatter(element, sums.tangent, target);
    if constexpr (tangent_wanted && has_coupling<Integrand>) scatter(element, sums.coupling, target);
  }

  /// Reference positions of nodes.
  Positions reference(const LocalOrdinal* node) const {
    Positions X;
    for (int a = 0; a < nodes; ++a) std::copy_n(mesh_.coordinates[node[a]].begin(), dimension, X[a].begin());
    return X;
  }

 private:
  /// Of the columns of a field, [elements x nodes x nodes].
  static std::vector<LocalOrdinal> positions(const FieldSpace& space, const Block& block, std::size_t field) {
    std::vector<LocalOrdinal> result;
    result.reserve(static_cast<std::size_t>(block.size()) * nodes * nodes);
    for (LocalOrdinal element = 0; element < block.size(); ++element)
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b) result.push_back(space.sparsity().position(block.nodes(element)[a], block.nodes(element)[b], field));
    return result;
  }

  template <class NodalValues, std::size_t fields, std::size_t... n>
  static NodalValues gather([[maybe_unused]] const LocalOrdinal* node, [[maybe_unused]] const Fields<fields>& values, std::index_sequence<n...>) {
    NodalValues result;
    (gather(node, values[n], std::get<n>(result)), ...);
    return result;
  }

  template <std::size_t components>
  static void gather(const LocalOrdinal* node, const FieldView<const double>& field, std::array<std::array<double, components>, nodes>& result) {
    for (int a = 0; a < nodes; ++a) std::copy_n(&field(node[a], 0), components, result[a].begin());
  }

  template <int components>
  void scatter(const LocalOrdinal* node, const std::array<double, components * nodes>& sum, const FieldView<double>& residual) const {
    for (int a = 0; a < nodes; ++a)
      if (node[a] < owned_nodes_)
        for (int i = 0; i < components; ++i) residual(node[a], i) += sum[components * a + i];
  }

  template <class Tangent>
  void scatter(LocalOrdinal element, const Tangent& tangent, const AssemblyTarget& target) const {
    constexpr int components = Tangent::components;
    const LocalOrdinal* node = block_.nodes(element);
    const LocalOrdinal* position = positions_.data() + static_cast<std::size_t>(element) * nodes * nodes;
    for (int a = 0; a < nodes; ++a) {
      if (node[a] >= owned_nodes_) continue;
      for (int i = 0; i < components; ++i) {
        double* row = target.matrix->row(rows_(node[a], i));
        for (int b = 0; b < nodes; ++b)
          for (int k = 0; k < components; ++k) row[position[a * nodes + b] + k] += target.factor * tangent(a, i, b, k);
      }
    }
  }

  void scatter(LocalOrdinal element, const NodalPairs<nodes>& tangent, const AssemblyTarget& target) const {
    const int components = rows_.components;
    const LocalOrdinal* node = block_.nodes(element);
    const LocalOrdinal* position = positions_.data() + static_cast<std::size_t>(element) * nodes * nodes;
    for (int a = 0; a < nodes; ++a) {
      if (node[a] >= owned_nodes_) continue;
      for (int i = 0; i < components; ++i) {
        double* row = target.matrix->row(rows_(node[a], i));
        for (int b = 0; b < nodes; ++b) row[position[a * nodes + b] + i] += target.factor * tangent(a, b);
      }
    }
  }

  template <int row_components, int column_components>
  void scatter(LocalOrdinal element, const FieldCoupling<nodes, row_components, column_components>& coupling, const AssemblyTarget& target) const {
    const LocalOrdinal* node = block_.nodes(element);
    const LocalOrdinal* position = coupled_positions_.data() + static_cast<std::size_t>(element) * nodes * nodes;
    for (int a = 0; a < nodes; ++a) {
      if (node[a] >= owned_nodes_) continue;
      for (int i = 0; i < row_components; ++i) {
        double* row = target.matrix->row(rows_(node[a], i));
        for (int b = 0; b < nodes; ++b)
          for (int k = 0; k < column_components; ++k) row[position[a * nodes + b] + k] += target.factor * coupling(a, i, b, k);
      }
    }
  }

  const Mesh& mesh_;
  const Block& block_;
  FieldRows rows_;
  LocalOrdinal owned_nodes_;
  std::vector<LocalOrdinal> positions_;          ///< [elements x nodes x nodes] NodalSparsity::position
  std::vector<LocalOrdinal> coupled_positions_;  ///< the same of the coupled field; empty: there is none
};

}  // namespace mortise
