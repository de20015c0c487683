// Couplings of slave nodes for further fields: their derivatives against central differences, and the place in the graph of the rows of such fields.
#include "mortise/contact/field_transfer.hpp"

#include <array>
#include <set>

#include "linearised_cases.hpp"

namespace mortise {
namespace {

using namespace test;

class Transfer : public ::testing::TestWithParam<int> {};

/// A host whose scalar field takes part in what crosses the interface, at an iterate.
struct Host {
  explicit Host(const TwoSurfaces& surfaces)
      : dimension(surfaces.dimension), fixture(surfaces, Tpetra::getDefaultComm(), HostNumbering::interleaved, true) {}
  ContactHistory history(const Vector& d, const Vector& z) const {
    const auto before = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(3.1 * static_cast<double>(id) + 0.2); });
    Vector guess(contact.multiplier_map());
    const ContactHistory started = fixture.first_step(*before, guess);
    return updated(contact, contact.evaluate(d, started).laws(z), started);
  }
  /// Values of a vector on the dofs at the nodes of the interface; 0 where a component is no unknown.
  RCP<MultiVector> on_nodes(const FieldTransfer& transfer, const Vector& of_dofs) const {
    MultiVector owned(fixture.nodes, static_cast<std::size_t>(dimension));
    for (const GlobalOrdinal node : local_ids(*fixture.nodes))
      for (int i = 0; i < dimension; ++i)
        if (const GlobalOrdinal id = fixture.number(dimension * node + i); id != NodalField::none)
          owned.replaceGlobalValue(node, static_cast<std::size_t>(i), of_dofs.getData()[fixture.dofs->getLocalElement(id)]);
    return transfer.on_nodes(owned);
  }

  int dimension;
  Fixture fixture;
  const ContactSystem& contact = *fixture.contact;
};

std::vector<double> quantities(const NodeTransfer& node) {
  return {node.weight.value, node.pressure.value, node.gap.value, node.slip.value, node.friction_work.value};
}

TEST_P(Transfer, HasTheDerivativesOfDifferences) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  // Edges that cross at a small angle: derivatives there are those of the exact integral (segment_3d_kernel.hpp), differences those of the sum over
  // points. On curved triangles of 6 nodes single entries differ by the error of the rule of 7 points; with 12 points they pass. Their sums are
  // exact.
  const bool has_error_of_rule = one.name == "quadratic, space, hardly covered, triangles";
  const Host host(one.surfaces);
  const ContactSystem& contact = host.contact;
  const auto d = Fixture::vector(host.fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const auto v = Fixture::vector(host.fixture.dofs, [](GlobalOrdinal id) { return wiggle(3 * id + 1); });
  const auto z = host.fixture.multipliers(pressure);
  const auto w = Fixture::vector(contact.multiplier_map(), [](GlobalOrdinal id) { return wiggle(5 * id + 2); });
  const ContactHistory history = host.history(*d, *z);
  const DifferentiatedContact at = contact.differentiate(*d, history);
  const FieldTransfer transfer(at.linearise(at.laws(*z)), 0);
  const double h = 1e-6;
  const auto moved = [&](double by) {
    Vector d_h(*d, Teuchos::Copy), z_h(*z, Teuchos::Copy);
    d_h.update(by, *v, 1.0);
    z_h.update(by, *w, 1.0);
    return FieldTransfer(contact.evaluate(d_h, history).laws(z_h), 0);
  };
  // Differences of fourth order.
  const std::array<FieldTransfer, 4> around = {moved(h), moved(-h), moved(2.0 * h), moved(-2.0 * h)};
  const auto difference = [&](const std::array<double, 4>& values) { return (8.0 * (values[0] - values[1]) - (values[2] - values[3])) / (12.0 * h); };
  const RCP<MultiVector> motion = host.on_nodes(transfer, *v);
  const auto of_nodes = motion->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < transfer.size(); ++s) {
    if (!transfer.is_covered(s)) continue;
    const NodeTransfer node = transfer[s];
    std::array<NodeTransfer, 4> beside;
    for (std::size_t n = 0; n < beside.size(); ++n) {
      ASSERT_TRUE(around[n].is_covered(s));
      beside[n] = around[n][s];
      ASSERT_EQ(node.nodes, beside[n].nodes);
    }
    Eigen::VectorXd direction(host.dimension * static_cast<Eigen::Index>(node.nodes.size()));
    for (std::size_t c = 0; c < node.nodes.size(); ++c)
      for (int i = 0; i < host.dimension; ++i) direction[host.dimension * static_cast<Eigen::Index>(c) + i] = of_nodes(node.nodes[c], i);
    const auto along = [&](const std::vector<double>& slopes, std::size_t row) {
      return Eigen::Map<const Eigen::VectorXd>(slopes.data() + row * static_cast<std::size_t>(direction.size()), direction.size()).dot(direction);
    };
    double of_slave = 0.0, of_master = 0.0, largest = 0.0;
    for (std::size_t c = 0; c < node.nodes.size(); ++c) {
      (transfer.is_slave(node.nodes[c]) ? of_slave : of_master) += node.coefficients[c];
      largest = std::max(largest, std::abs(node.coefficients[c]));
      if (node.loaded[c] == 0) {
        EXPECT_EQ(node.coefficients[c], 0.0);
      }
      std::array<double, 4> values;
      for (std::size_t n = 0; n < values.size(); ++n) values[n] = beside[n].coefficients[c];
      if (!has_error_of_rule) {
        EXPECT_NEAR(along(node.coefficient_slopes, c), difference(values), 1e-6) << node.node;
      }
    }
    EXPECT_NEAR(of_slave, node.weight.value, 1e-14 * largest * static_cast<double>(node.nodes.size()));
    EXPECT_NEAR(of_master, -node.weight.value, 1e-12 * largest * static_cast<double>(node.nodes.size()));
    std::array<std::vector<double>, 4> quantities_beside;
    for (std::size_t n = 0; n < beside.size(); ++n) quantities_beside[n] = quantities(beside[n]);
    const std::vector<const NodeQuantity*> all = {&node.weight, &node.pressure, &node.gap, &node.slip, &node.friction_work};
    for (std::size_t n = 0; n < all.size(); ++n) {
      double slope = along(all[n]->of_positions, 0), size = 1.0 + std::abs(slope);
      for (int i = 0; i < host.dimension; ++i)
        slope += all[n]->of_multiplier[static_cast<std::size_t>(i)] * w->getData()[w->getMap()->getLocalElement(node.multiplier + i)];
      std::array<double, 4> values;
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = quantities_beside[k][n];
      EXPECT_NEAR(slope, difference(values), 2e-6 * (size + std::abs(slope))) << "quantity " << n << " of node " << node.node;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Transfer, ::testing::ValuesIn(indices(false)), test_name);

// Rows of the further field at nodes that multipliers load have the columns of the displacements' rows there.
TEST(FurtherFields, HaveTheirRowsInTheGraph) {
  for (const TwoSurfaces& surfaces : {arch_on_ground(), dome_on_waves(), quadratic(arch_on_ground(), true, true)}) {
    TwoSurfaces within_reach = surfaces;
    within_reach.options.mortar.search_reach = 1.0;
    const Host host(within_reach);
    const Vector rest(host.fixture.dofs);
    const ContactHistory history = host.contact.initial_history(rest);
    const DifferentiatedContact at = host.contact.differentiate(rest, history);
    const RCP<const Graph> graph = host.contact.graph(at, [&] { return host.fixture.bulk; });
    const auto columns_of = [&](GlobalOrdinal id) {
      Graph::local_inds_host_view_type columns;
      graph->getLocalRowView(host.fixture.dofs->getLocalElement(id), columns);
      std::set<GlobalOrdinal> result;
      for (std::size_t k = 0; k < columns.extent(0); ++k) result.insert(graph->getColMap()->getGlobalElement(columns(k)));
      return result;
    };
    const FieldTransfer transfer(at.linearise(at.laws(Vector(host.contact.multiplier_map()))), 0);
    const std::vector<GlobalOrdinal> scalars = host.fixture.scalar_field().ids_on(transfer.nodes());
    for (std::size_t s = 0; s < transfer.size(); ++s) {
      if (!transfer.is_covered(s)) continue;
      const NodeTransfer node = transfer[s];
      const std::set<GlobalOrdinal> own = columns_of(host.fixture.scalar_field().id(node.owned_node, 0));
      for (const LocalOrdinal m : node.nodes) {
        EXPECT_EQ(own.count(scalars[static_cast<std::size_t>(m)]), 1u);
        for (int i = 0; i < host.dimension; ++i) EXPECT_EQ(own.count(transfer.displacement_id(m, i)), 1u);
      }
    }
  }
}

TEST(FurtherFields, HaveToFitTheSystem) {
  const Fixture fixture(arch_on_ground(), Tpetra::getDefaultComm());
  const auto nodes = fixture.nodes;
  const auto reference = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
  const NodalField beyond("beyond", nodes, 1, std::vector<GlobalOrdinal>(local_id_count(*nodes), 1000));
  EXPECT_THROW(ContactSystem(nodes, fixture.dofs, reference, fixed, {}, {}, Timers(), {beyond}), std::invalid_argument);
}

}  // namespace
}  // namespace mortise
