// Displacement and temperature of a point.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/over_ranks.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// Distance outside, in reference coordinates, at which a point still counts as inside: round-off of points on sides and nodes.
constexpr double inside_tolerance = 1e-8;

/// Bulge of sides of quadratic cells beyond the box of their nodes, at most, over its diagonal.
constexpr double curved_margin = 0.25;

/// Shares N_a of an element's nodes at the point, or nothing if it lies outside. Newton's method for X(xi) = point.
template <class Cell>
std::vector<double> shares_at(const Mesh& mesh, const LocalOrdinal* nodes, const std::array<double, 3>& position) {
  constexpr int dimension = Cell::dimension;
  using Position = Eigen::Matrix<double, dimension, 1>;
  const Position point(position.data());
  Eigen::Matrix<double, dimension, Cell::nodes> corners;
  for (int a = 0; a < Cell::nodes; ++a) corners.col(a) = Position(mesh.coordinates[nodes[a]].data());
  const Position low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
  const double margin = (Cell::nodes > Cell::corners ? curved_margin : inside_tolerance) * (high - low).norm();
  if (((low.array() - margin) > point.array()).any() || ((high.array() + margin) < point.array()).any()) return {};
  auto xi = Cell::centroid;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const auto values = Cell::values(xi);
    const auto gradients = Cell::gradients(xi);
    Position residual = -point;
    Eigen::Matrix<double, dimension, dimension> jacobian = Eigen::Matrix<double, dimension, dimension>::Zero();
    for (int a = 0; a < Cell::nodes; ++a) {
      residual += values[a] * corners.col(a);
      for (int i = 0; i < dimension; ++i) jacobian.col(i) += gradients[a][i] * corners.col(a);
    }
    const Position step = jacobian.inverse() * residual;
    for (int i = 0; i < dimension; ++i) xi[i] -= step[i];
    if (!(step.norm() > 1e-14)) break;
  }
  if (!Cell::contains(xi, inside_tolerance)) return {};
  const auto values = Cell::values(xi);
  return std::vector<double>(values.begin(), values.end());
}

std::vector<double> shares_at(CellShape shape, const Mesh& mesh, const LocalOrdinal* nodes, const std::array<double, 3>& position) {
  return visit_cell(shape, [&](auto cell) { return shares_at<decltype(cell)>(mesh, nodes, position); });
}

/// A component of a field at the point that an element holds.
class PointEvaluator final : public QuantityEvaluator {
 public:
  PointEvaluator(const PointOptions& quantity, std::size_t field, int component, const QuantityContext& context)
      : field_(field), component_(component) {
    const Mesh& mesh = context.mesh();
    if (quantity.z.has_value() != (mesh.dimension == 3))
      throw InputError(quantity.x.place,
                       mesh.dimension == 3 ? "a point in 3D needs \"z\"; please add it" : "a point in 2D has no \"z\"; please remove it");
    const auto wanted = find_optional_body(context, quantity.body);
    const std::array<double, 3> point{quantity.x.value, quantity.y.value, quantity.z.value_or(0.0)};
    // The body first, then the element of the lowest id: the same one on any number of ranks.
    int lacks = 0;
    const GlobalOrdinal none = std::numeric_limits<GlobalOrdinal>::max();
    GlobalOrdinal mine = none;
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      const Block& block = mesh.blocks[b];
      if (topology(block.shape).dimension < mesh.dimension || (wanted && block.body != *wanted)) continue;
      for (LocalOrdinal element = 0; element < block.owned; ++element) {
        if (block.element_ids[element] >= mine) continue;
        const LocalOrdinal* nodes = block.nodes(element);
        const auto shares = shares_at(block.shape, mesh, nodes, point);
        if (shares.empty()) continue;
        mine = block.element_ids[element];
        shares_ = shares;
        nodes_.assign(nodes, nodes + block.nodes_per_element);
      }
    }
    GlobalOrdinal first = none;
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(first));
    if (first == none) {
      const std::string where = quantity.body.value.empty() ? "in no body" : fmt::format("not in the body \"{}\"", quantity.body.value);
      throw InputError(quantity.x.place,
                       fmt::format("the point ({:g}) lies {}", fmt::join(point.begin(), point.begin() + mesh.dimension, ", "), where));
    }
    if (mine == first && !context.space().rows(field_).lives(nodes_.front())) lacks = 1;
    if (most_over_ranks(*mesh.comm, lacks) != 0)
      throw InputError(quantity.x.place, "the body at this point has no temperature; please give its material a list \"heat\" with a \"conductivity\"");
    const int candidate = mine == first ? mesh.comm->getRank() : mesh.comm->getSize();
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, candidate, Teuchos::outArg(owner_));
  }

  double evaluate(const QuantityContext& context) override {
    const auto values = context.local_displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
    double value = 0.0;
    if (context.mesh().comm->getRank() == owner_)
      for (std::size_t a = 0; a < nodes_.size(); ++a) value += shares_[a] * values(context.space().row(field_, nodes_[a], component_), 0);
    Teuchos::broadcast(*context.mesh().comm, owner_, Teuchos::outArg(value));
    return value;
  }

 private:
  std::size_t field_;
  int component_;
  int owner_ = 0;                    ///< rank whose element holds the point
  std::vector<LocalOrdinal> nodes_;  ///< of the element, on that rank
  std::vector<double> shares_;       ///< N_a at the point
};

}  // namespace

void PointOptions::describe(Parameters& parameters) {
  parameters.add("x", x, Says("reference position of the point").unit("length").required());
  parameters.add("y", y, Says("reference position of the point").unit("length").required());
  parameters.add("z", z, Says("reference position of the point, in three dimensions").unit("length"));
  parameters.add("body", body, "deformable body that the point belongs to; empty: the first one that holds it");
}

void PointDisplacement::describe(Parameters& parameters) {
  point.describe(parameters);
  parameters.add("component", component, component_names(), "component of the displacement");
}

std::unique_ptr<QuantityEvaluator> PointDisplacement::make_evaluator(const QuantityContext& context) const {
  require_component(context, component);
  return std::make_unique<PointEvaluator>(point, 0, static_cast<int>(component), context);
}

void PointTemperature::describe(Parameters& parameters) { point.describe(parameters); }

std::unique_ptr<QuantityEvaluator> PointTemperature::make_evaluator(const QuantityContext& context) const {
  require_temperature(context);
  return std::make_unique<PointEvaluator>(point, context.heat.bodies->temperature(), 0, context);
}

void add_point_displacement(Registry<Quantity>& kinds) { kinds.add<PointDisplacement>("displacement", "displacement of a point"); }

void add_point_temperature(Registry<Quantity>& kinds) { kinds.add<PointTemperature>("temperature", "temperature of a point"); }

}  // namespace mortise
