// Heat across contact in a host whose equations are a Thyra::ModelEvaluator: against Newton's method of docs/thermal_contact.md, and differences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Thyra_DefaultProductVector.hpp>
#include <cmath>

#include "heated_model.hpp"
#include "mortise/contact/contact_report.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/core/over_ranks.hpp"
#include "nox_solve.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double E = 1000.0, time_step = 0.002, warm = 0.1;
constexpr double inside = 0.1, overhanging = 0.43;  // where the slave begins: it is 0.8 long, and a seventh of its last facets is covered then

std::shared_ptr<TwoBodies> blocks(int dimension, double from, const Choice<Formulation>& formulation) {
  GridBody lower, upper;
  lower.cells = {4, dimension == 3 ? 2 : 3, 2};
  upper.cells = {3, 2, 2};
  lower.place = [dimension](const Point& u) {
    Point x = u;
    x[dimension - 1] -= 1.0;
    return x;
  };
  upper.place = [dimension, from](const Point& u) {
    Point x = u;
    x[0] = from + 0.8 * u[0];
    if (dimension == 3) x[1] = 0.1 + 0.8 * u[1];
    return x;
  };
  lower.modulus = upper.modulus = E;
  lower.conductivity = 2.0;
  upper.conductivity = 0.5;
  lower.capacity = 0.02;
  upper.capacity = 0.05;
  lower.expansion = 2e-4;
  upper.expansion = 1e-3;
  const auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  ContactOptions options;
  options.formulation = formulation;
  options.friction = {"coulomb", coulomb, {}};
  const int up = dimension - 1;
  return std::make_shared<TwoBodies>(dimension, std::array<GridBody, 2>{lower, upper}, 1, options, E,
                                     [up](int body, const Point& unit) { return unit[up] == (body == 0 ? 0.0 : 1.0); });
}

ThermalPair with_friction() {
  const auto conductance = std::make_shared<PowerConductance>();
  conductance->factor = 40.0;
  conductance->hardness = 10.0;
  conductance->without_pressure = 0.2;
  const auto medium = std::make_shared<MediumConductance>();
  medium->conductivity = 2e-3;
  medium->distance = 1e-2;
  return {0, conductance, medium, share_of_slave(std::sqrt(0.5 * 0.05), std::sqrt(2.0 * 0.02))};
}

struct Case {
  int dimension = 2;
  double from = overhanging;
  ContactUnknowns unknowns = ContactUnknowns::displacements;
  Choice<Formulation> formulation = {"dual mortar", std::make_shared<DualMortar>(), {}};
  std::optional<std::vector<ThermalPair>> pairs = std::vector<ThermalPair>{with_friction()};  ///< none: without HostHeat
};

/// A host with temperatures. Far faces keep theirs, and a node of the slave too.
struct Host {
  explicit Host(const Case& of) : bodies(blocks(of.dimension, of.from, of.formulation)), dofs(bodies->table->dofs) {
    plain = rcp(new HeatedModel(bodies, E, time_step, [this](GlobalOrdinal id) { return is_held(id); }));
    const auto reference = rcp(new MultiVector(bodies->nodes, of.dimension)), fixed = rcp(new MultiVector(bodies->nodes, of.dimension));
    const auto cold = rcp(new MultiVector(bodies->nodes, 1));
    for (const GlobalOrdinal node : local_ids(*bodies->nodes)) {
      for (int i = 0; i < of.dimension; ++i) {
        reference->replaceGlobalValue(node, i, bodies->points[node][i]);
        fixed->replaceGlobalValue(node, i, bodies->is_far(node) ? 1.0 : 0.0);
      }
      cold->replaceGlobalValue(node, 0, is_held(bodies->temperature(node)) ? 1.0 : 0.0);
    }
    WithContactOptions options;
    options.unknowns = of.unknowns;
    if (of.pairs) options.heat = HostHeat{bodies->table->fields[1], *of.pairs, [](const ThyraInArgs&) { return time_step; }, cold};
    displacements.emplace(HostDisplacements{bodies->table->fields[0], reference, fixed, {}, {}});
    model = with_contact(plain, *displacements, {bodies->pair}, options);
  }
  bool is_held(GlobalOrdinal id) const {
    const GlobalOrdinal first = bodies->temperature(0), node = id < first ? id / bodies->dimension : id - first;
    const bool corner = bodies->body_of[node] == 1 && bodies->is_on_face(node) && bodies->units[node][0] == 0.0;
    return bodies->is_far(node) || (id >= first && corner);
  }
  /// The step begins at x: pressed in the first two steps, then drawn along.
  void begin_step(int step, const Vector& x) {
    Tpetra::deep_copy(plain->before, x);
    for (const GlobalOrdinal node : local_ids(*bodies->nodes)) {
      if (bodies->body_of[node] == 0) continue;
      plain->target.replaceGlobalValue(bodies->temperature(node), warm);
      plain->target.replaceGlobalValue(bodies->displacement(node, 0), 0.01 * std::max(0, step - 2));
      plain->target.replaceGlobalValue(bodies->displacement(node, bodies->dimension - 1), -0.005 * std::min(step, 2));
    }
  }
  RCP<ThyraVector> start() const { return model->getNominalValues().get_x()->clone_v(); }
  static RCP<Vector> part(const ThyraVector& x, int number) {
    const auto* product = dynamic_cast<const ::Thyra::ProductVectorBase<Scalar>*>(&x);
    const auto vector = TpetraOf::getConstTpetraVector(product == nullptr ? Teuchos::rcpFromRef(x) : product->getVectorBlock(number));
    return Teuchos::rcp_const_cast<Vector>(vector);
  }
  static RCP<Vector> unknowns(const ThyraVector& x) { return part(x, 0); }
  static bool is_product(const ThyraVector& x) { return dynamic_cast<const ::Thyra::ProductVectorBase<Scalar>*>(&x) != nullptr; }

  std::shared_ptr<TwoBodies> bodies;
  RCP<const Map> dofs;
  RCP<HeatedModel> plain;
  std::optional<HostDisplacements> displacements;
  RCP<ModelWithContact> model;
};

/// Newton's method as docs/thermal_contact.md has it, with the matrix of the same host.
struct Embedded {
  explicit Embedded(const Host& of)
      : host(of),
        contact(*of.bodies->contact),
        thermal(contact, of.bodies->table->fields[1], of.dofs, {with_friction()}),
        x(of.dofs),
        z(contact.multiplier_map()),
        accepted(contact.initial_history(x)),
        ids(of.bodies->all_ids()) {}

  /// @return the number of matrices; none if it does not converge
  std::optional<int> solve_step() {
    const ContactHistory history = contact.start_step(accepted, x, z);
    ContactStates last = history->states;
    Vector dx(host.dofs), dz(contact.multiplier_map());
    for (int iteration = 0; iteration < 20; ++iteration) {
      const DifferentiatedContact at = contact.differentiate(x, history, &last);
      const ContactLaws laws = at.laws(z);
      const ContactLinearisation linearised = at.linearise(laws);
      const DifferentiatedHeat heat = thermal.differentiate(linearised, x, time_step);
      const RCP<const Vector> r = host.plain->unheld(x);
      Vector total(*r, Teuchos::Copy), rhs(host.dofs);
      laws.add_force(total);
      heat.add_to(total);
      rhs.update(-1.0, *r, 0.0);
      for_held([&](LocalOrdinal row) { total.replaceLocalValue(row, E * off(row)); });
      const ContactNorms norms = laws.norms(last);
      if (norms.changed == 0 && total.norm2() / E + norms.gap + norms.complementarity < 1e-13 && iteration > 0) {
        accepted = contact.commit(laws);
        return iteration;
      }
      last = laws.states();
      Matrix A(contact.graph(at, [&] { return host.bodies->graph(); }));
      host.bodies->assemble(time_step, A);
      linearised.add_stiffness(A);
      const NodeElimination condensed = linearised.condense(A, rhs);
      heat.condense(condensed, A, rhs);
      A.fillComplete(host.dofs, host.dofs);
      Eigen::MatrixXd system = Fixture::dense(A, ids, ids);
      for (std::size_t n = 0; n < ids.size(); ++n)
        if (host.is_held(ids[n])) {
          const auto row = static_cast<Eigen::Index>(n);
          system.row(row).setZero();
          system(row, row) = E;
        }
      const Eigen::PartialPivLU<Eigen::MatrixXd> factors(system);
      for_held([&](LocalOrdinal row) { rhs.replaceLocalValue(row, -E * off(row)); });
      bool corrects = false;
      const auto solve = [&](const Vector& given, Vector& solution) {
        Vector right(given, Teuchos::Copy);
        if (corrects) for_held([&](LocalOrdinal row) { right.replaceLocalValue(row, 0.0); });
        corrects = true;
        const Eigen::VectorXd all = factors.solve(Fixture::dense(right, ids));
        Tpetra::deep_copy(solution, *Fixture::vector(host.dofs, [&](GlobalOrdinal id) { return all[id]; }));
      };
      condensed.solve(rhs, solve, dx, dz, heat.of_multipliers().get());
      x.update(1.0, dx, 1.0);
      z.update(1.0, dz, 1.0);
    }
    return std::nullopt;
  }
  double off(LocalOrdinal row) const { return x.getData()[row] - host.plain->target.getData()[row]; }
  template <class Take>
  void for_held(const Take& take) const {
    for (const GlobalOrdinal id : local_ids(*host.dofs))
      if (host.is_held(id)) take(host.dofs->getLocalElement(id));
  }

  const Host& host;
  const ContactSystem& contact;
  ThermalContact thermal;
  Vector x, z;
  ContactHistory accepted;
  std::vector<GlobalOrdinal> ids;
};

double apart(const Vector& one, const Vector& other) {
  Vector difference(one, Teuchos::Copy);
  difference.update(-1.0, other, 1.0);
  return difference.normInf() / other.normInf();
}

/// Sums over rows of heat: of all rows, and of those that are not held.
std::array<double, 2> heat_in_rows(const Host& host, const Vector& rows) {
  double all = 0.0, free = 0.0;
  for (const GlobalOrdinal id : local_ids(*host.dofs))
    if (id >= host.bodies->temperature(0)) {
      const double value = rows.getData()[host.dofs->getLocalElement(id)];
      all += value;
      if (!host.is_held(id)) free += value;
    }
  const std::vector<double> sums = sum_over_ranks(*host.bodies->comm, std::vector<double>{all, free});
  return {sums[0], sums[1]};
}

void expect_heat_in_balance(const Host& host, const ThyraVector& x) {
  const ContactHeat& heat = *host.model->accepted_heat();
  Vector of_contact(host.dofs);
  heat.add_to(of_contact);
  Vector rows(*host.plain->unheld(*Host::unknowns(x)), Teuchos::Copy);
  rows.update(1.0, of_contact, 1.0);
  const HeatFlow flow = heat.flow(0);
  const double size = std::max(std::abs(flow.conducted), flow.friction);
  EXPECT_GT(size, 0.0);
  EXPECT_NEAR(heat_in_rows(host, of_contact)[0], -flow.friction, 1e-12 * size);
  EXPECT_NEAR(heat_in_rows(host, rows)[1], 0.0, 1e-10 * size);  // of free nodes what NOX leaves
}

void expect_host_follows_embedded_loop(const Case& of) {
  Host host(of);
  Embedded embedded(host);
  RCP<ThyraVector> x = host.start();
  double friction = 0.0;
  int slipping = 0;
  for (int step = 1; step <= 4; ++step) {
    SCOPED_TRACE(::testing::Message() << of.dimension << "D, step " << step << (Host::is_product(*x) ? ", product" : ""));
    host.begin_step(step, *Host::unknowns(*x));
    const auto matrices = embedded.solve_step();
    ASSERT_TRUE(matrices);
    if (Host::is_product(*x)) {  // multipliers that the start of the step gives
      const auto guess = host.start();
      Tpetra::deep_copy(*Host::part(*guess, 0), *Host::unknowns(*x));
      x = guess;
    }
    const auto iterations = solve_by_nox(host.model, *x);
    ASSERT_TRUE(iterations) << (host.model->failure() ? host.model->failure()->what() : "");
    const HeatFlow under_way = host.model->heat(*x).flow(0);
    host.model->accept_step(*x);
    const HeatFlow flow = host.model->accepted_heat()->flow(0);
    EXPECT_EQ(under_way.conducted, flow.conducted);
    EXPECT_EQ(under_way.friction, flow.friction);
    friction += flow.friction;
    EXPECT_LE(apart(*Host::unknowns(*x), embedded.x), 1e-10);
    EXPECT_LE(apart(host.model->accepted_multipliers(), embedded.z), 1e-10);
    EXPECT_LE(std::abs(*iterations - *matrices), 2);  // W has no geometric stiffness while many states change
    expect_heat_in_balance(host, *x);
    for (const ContactNodeState& node : node_states(*host.model->accepted_laws(), 0)) slipping += node.state == ContactState::slip;
  }
  EXPECT_GT(friction, 0.0);
  EXPECT_GT(sum_over_ranks(*host.bodies->comm, slipping), 0);
}

constexpr std::array<ContactUnknowns, 2> both_unknowns = {ContactUnknowns::displacements, ContactUnknowns::displacements_and_multipliers};

TEST(HeatWithContact, NoxFollowsTheEmbeddedLoopInThePlane) {
  for (const ContactUnknowns unknowns : both_unknowns)
    for (const double from : {inside, overhanging}) expect_host_follows_embedded_loop({2, from, unknowns});
}
TEST(HeatWithContact, NoxFollowsTheEmbeddedLoopInSpace) {
  for (const ContactUnknowns unknowns : both_unknowns) expect_host_follows_embedded_loop({3, overhanging, unknowns});
}

/// f, W and its solves by hand.
struct Evaluations {
  explicit Evaluations(const RCP<ModelWithContact>& of) : model(of), in(of->getNominalValues()), W(of->create_W_op()), inverse(of->create_W()) {}
  RCP<ThyraVector> f(const ThyraVector& x) {
    in.set_x(Teuchos::rcpFromRef(x));
    ThyraOutArgs out = model->createOutArgs();
    const RCP<ThyraVector> result = ::Thyra::createMember(*model->get_f_space());
    out.set_f(result);
    model->evalModel(in, out);
    return result;
  }
  void linearise(const ThyraVector& x) {
    in.set_x(Teuchos::rcpFromRef(x));
    ThyraOutArgs out = model->createOutArgs();
    out.set_W_op(W);
    model->evalModel(in, out);
  }
  RCP<ThyraVector> times(const ThyraVector& v) const {
    const RCP<ThyraVector> result = ::Thyra::createMember(*model->get_f_space());
    ::Thyra::apply<Scalar>(*W, ::Thyra::NOTRANS, v, result.ptr());
    return result;
  }
  RCP<ThyraVector> solve(const ThyraVector& right) {
    ::Thyra::initializeOp<Scalar>(*model->get_W_factory(), W, inverse.ptr());
    const RCP<ThyraVector> x = ::Thyra::createMember(*model->get_x_space());
    ::Thyra::assign(x.ptr(), 0.0);
    ::Thyra::solve<Scalar>(*inverse, ::Thyra::NOTRANS, right, x.ptr());
    return x;
  }
  RCP<ModelWithContact> model;
  ThyraInArgs in;
  RCP<::Thyra::LinearOpBase<Scalar>> W;
  RCP<::Thyra::LinearOpWithSolveBase<Scalar>> inverse;
};

/// Numbers of any sign for each unknown, the same on all numbers of ranks: displacements `size`, temperatures and multipliers larger.
RCP<ThyraVector> direction(const Host& host, const ThyraVector& like, double size) {
  const auto v = like.clone_v();
  for (int block = 0; block < (Host::is_product(like) ? 2 : 1); ++block) {
    const RCP<Vector> values = Host::part(*v, block);
    for (const GlobalOrdinal id : local_ids(*values->getMap()))
      values->replaceGlobalValue(id, size *
                                         (block == 1                         ? 100.0
                                          : id < host.bodies->temperature(0) ? 1.0
                                                                             : 10.0) *
                                         std::sin(1.0 + 2.7 * static_cast<double>(id)));
  }
  return v;
}

/// Largest difference of momentum, of heat and of conditions, each over the largest value of its kind.
double apart_by_kinds(const Host& host, const ThyraVector& one, const ThyraVector& other) {
  double result = 0.0;
  for (int kind = 0; kind < (Host::is_product(one) ? 3 : 2); ++kind) {
    const RCP<const Vector> a = Host::part(one, kind / 2), b = Host::part(other, kind / 2);
    double difference = 0.0, largest = 0.0;
    for (const GlobalOrdinal id : local_ids(*a->getMap())) {
      if (kind < 2 && (id >= host.bodies->temperature(0)) != (kind == 1)) continue;
      const LocalOrdinal row = a->getMap()->getLocalElement(id);
      difference = std::max(difference, std::abs(a->getData()[row] - b->getData()[row]));
      largest = std::max(largest, std::abs(b->getData()[row]));
    }
    result = std::max(result, most_over_ranks(*host.bodies->comm, difference) / most_over_ranks(*host.bodies->comm, largest));
  }
  return result;
}

/// A host after three steps and at the solution of the fourth, in which it slips.
struct Slipping : Host {
  explicit Slipping(const Case& of) : Host(of), x(start()) {
    for (int step = 1; step <= 4; ++step) {
      begin_step(step, *unknowns(*x));
      if (is_product(*x)) {
        const auto guess = start();
        Tpetra::deep_copy(*part(*guess, 0), *unknowns(*x));
        x = guess;
      }
      EXPECT_TRUE(solve_by_nox(model, *x));
      if (step < 4) model->accept_step(*x);
    }
    EXPECT_GT(model->heat(*x).flow(0).friction, 0.0);
  }
  RCP<ThyraVector> x;
};

Choice<Formulation> standard_mortar() { return {"standard mortar", std::make_shared<StandardMortar>(), {}}; }

// With condensed multipliers W is the derivative of f at a solution, and without nodes that are hardly covered; in the product everywhere.
TEST(HeatWithContact, WIsTheDerivativeOfF) {
  const auto product = ContactUnknowns::displacements_and_multipliers;
  for (const Case& of : {Case{2, inside}, Case{3, inside}, Case{2, overhanging, product}, Case{3, overhanging, product},
                         Case{2, overhanging, product, standard_mortar()}}) {
    const Slipping host(of);
    SCOPED_TRACE(::testing::Message() << of.dimension << "D " << of.formulation.type << (Host::is_product(*host.x) ? ", product" : ""));
    Evaluations at(host.model);
    const auto x = host.x->clone_v();
    if (Host::is_product(*x)) ::Thyra::Vp_V(x.ptr(), *direction(host, *x, 1e-5));
    at.linearise(*x);
    const auto v = direction(host, *x, 1e-6);
    const auto plus = x->clone_v(), minus = x->clone_v();
    ::Thyra::Vp_V(plus.ptr(), *v);
    ::Thyra::Vp_StV(minus.ptr(), -1.0, *v);
    const auto difference = at.f(*plus);
    ::Thyra::Vp_StV(difference.ptr(), -1.0, *at.f(*minus));
    ::Thyra::Vt_S(difference.ptr(), 0.5);
    EXPECT_LE(apart_by_kinds(host, *difference, *at.times(*v)), 1e-6);
    const auto right = at.times(*v);  // also for right-hand sides that are no f
    EXPECT_LE(apart_by_kinds(host, *at.times(*at.solve(*right)), *right), 1e-9);
  }
}

TEST(HeatWithContact, ResidualsFallQuadratically) {
  for (const ContactUnknowns unknowns : both_unknowns) {
    Host host({2, overhanging, unknowns});
    auto x = host.start();
    for (int step = 1; step <= 4; ++step) {
      host.begin_step(step, *Host::unknowns(*x));
      if (Host::is_product(*x)) Tpetra::deep_copy(*Host::part(*x, 1), *Host::part(*host.start(), 1));
      Evaluations at(host.model);
      std::vector<double> norms;
      for (int iteration = 0; iteration < 15; ++iteration) {
        const auto f = at.f(*x);
        norms.push_back(::Thyra::norm(*f) / E);
        if (norms.back() < 1e-14) break;
        at.linearise(*x);
        ::Thyra::Vp_StV(x.ptr(), -1.0, *at.solve(*f));
      }
      host.model->accept_step(*x);
      EXPECT_LE(norms.back(), 1e-13);
      ASSERT_GE(norms.size(), 3u);
      const std::size_t last = norms.size() - 1;
      EXPECT_LE(norms[last], 10.0 * norms[last - 1] * norms[last - 1] + 1e-13) << ::testing::PrintToString(norms);
    }
  }
}

TEST(HeatWithContact, SensitivitiesAreCondensed) {
  const Slipping host({2, inside});
  Evaluations at(host.model);
  at.in.set_x(host.x);
  ThyraOutArgs out = host.model->createOutArgs();
  const auto columns = ::Thyra::createMembers(*host.model->get_f_space(), 2);
  out.set_DfDp(0, ::Thyra::ModelEvaluatorBase::Derivative<Scalar>(columns));
  host.model->evalModel(at.in, out);
  for (int j = 0; j < 2; ++j) {
    const auto f_at = [&](double value) {
      const auto p = ::Thyra::createMember(*host.model->get_p_space(0));
      ::Thyra::assign(p.ptr(), 0.0);
      ::Thyra::set_ele(j, value, p.ptr());
      at.in.set_p(0, p);
      return at.f(*host.x);
    };
    constexpr double change = 1e-3;  // f is linear in p as long as the iterate stays
    const auto difference = f_at(change);
    ::Thyra::Vp_StV(difference.ptr(), -1.0, *f_at(-change));
    ::Thyra::Vt_S(difference.ptr(), 0.5 / change);
    EXPECT_LE(apart_by_kinds(host, *columns->col(j), *difference), 1e-8) << j;
  }
}

// The rows of heat are df/dx: they have its weight.
TEST(HeatWithContact, WeightsOfTimeDerivativesAreTheHosts) {
  for (const ContactUnknowns unknowns : both_unknowns) {
    const Slipping host({2, overhanging, unknowns});
    Evaluations plain(host.model), weighted(host.model);
    plain.linearise(*host.x);
    constexpr double beta = 0.3;
    const auto rate = host.x->clone_v();
    ::Thyra::assign(rate.ptr(), 0.0);
    Host::part(*rate, 0)->update(1.0 / time_step, *Host::unknowns(*host.x), -1.0 / time_step, host.plain->before, 0.0);
    weighted.in.set_x_dot(rate);
    weighted.in.set_alpha(beta / time_step);
    weighted.in.set_beta(beta);
    weighted.linearise(*host.x);
    const auto v = direction(host, *host.x, 1e-6), result = plain.times(*v);
    ::Thyra::Vt_S(result.ptr(), beta);
    EXPECT_LE(apart_by_kinds(host, *weighted.times(*v), *result), 1e-12);
    const auto step = weighted.solve(*result);
    EXPECT_LE(apart_by_kinds(host, *step, *plain.solve(*plain.times(*v))), 1e-9);
    // f too, near its scale at a start that is no solution
    const auto away = host.x->clone_v();
    ::Thyra::Vp_V(away.ptr(), *v);
    Host::part(*rate, 0)->update(1.0 / time_step, *Host::unknowns(*away), -1.0 / time_step, host.plain->before, 0.0);
    EXPECT_LE(apart_by_kinds(host, *weighted.f(*away), *plain.f(*away)), 1e-6);
  }
}

std::vector<double> numbers(const ThyraVector& x) {
  const auto data = Host::unknowns(x)->getData();
  return {data.begin(), data.end()};
}

TEST(HeatWithContact, PairsWithoutHeatChangeNoBitOfF) {
  for (const ContactUnknowns unknowns : both_unknowns) {
    Case without{2, overhanging, unknowns};
    without.pairs = std::nullopt;
    Case nothing = without;
    nothing.pairs = std::vector<ThermalPair>{};
    Case insulated = without;
    insulated.pairs = std::vector<ThermalPair>{{0, nullptr, nullptr, std::nullopt}};
    std::vector<std::vector<double>> results;
    for (const Case& of : {without, nothing, insulated}) {
      Host host(of);
      host.begin_step(2, *Host::unknowns(*host.start()));
      Evaluations at(host.model);
      const auto x = direction(host, *host.start(), 1e-4);
      const auto f = at.f(*x);
      at.linearise(*x);
      results.push_back(numbers(*f));
      results.push_back(numbers(*at.solve(*f)));
    }
    EXPECT_EQ(results[0], results[2]);
    EXPECT_EQ(results[0], results[4]);
    EXPECT_EQ(results[1], results[3]);
    EXPECT_EQ(results[1], results[5]);
  }
}

std::string refusal(const std::function<void()>& wrong) {
  try {
    wrong();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(HeatWithContact, MisuseIsTold) {
  const Host host({2});
  const auto with = [&](const HostHeat& heat) {
    WithContactOptions options;
    options.heat = heat;
    return refusal([&] { with_contact(host.plain, *host.displacements, {host.bodies->pair}, options); });
  };
  const FieldTable& table = *host.bodies->table;
  EXPECT_THAT(with({table.fields[1], {with_friction()}}), HasSubstr("no time_step"));
  const auto step = [](const ThyraInArgs&) { return time_step; };
  EXPECT_THAT(with({table.fields[1], {with_friction()}, step, rcp(new MultiVector(host.dofs, 1))}), HasSubstr("fixed is not one column"));
  // On several ranks such ids are also some that a rank does not own, which is refused by another message.
  const std::string twice = with({numbered_by_nodes("temperature", host.bodies->nodes, 1), {with_friction()}, step});
  if (host.dofs->getComm()->getSize() == 1)
    EXPECT_THAT(twice, HasSubstr("that is a displacement"));
  else
    EXPECT_NE(twice, "");
  Case without{2};
  without.pairs = std::nullopt;
  const Host cold(without);
  EXPECT_THAT(refusal([&] { cold.model->heat(*cold.start()); }), HasSubstr("without WithContactOptions::heat"));
  cold.model->accept_step(*cold.start());
  EXPECT_FALSE(cold.model->accepted_heat());
}

}  // namespace
}  // namespace mortise
