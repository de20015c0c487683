// Misuse of mortise.h has a name, on every rank, and leaves the contact as it was.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "plain_host.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char friction[] = "friction/type = coulomb; friction/coefficient = 0.3";

/// The status that every rank has; -1 where they differ.
int on_every_rank(int status) {
  int least = 0, most = 0;
  MPI_Allreduce(&status, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&status, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return least == most ? status : -1;
}

bool is_last_rank() {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return rank == size - 1;
}

int ranks() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

PlainArrays arch() {
  const TwoSurfaces surfaces = arch_on_ground();
  return {surfaces, Fixture(surfaces, Tpetra::getDefaultComm())};
}

TEST(PlainMisuse, OfAModel) {
  const auto status_of = [](const std::function<void(PlainArrays&)>& spoil, std::string* message = nullptr) {
    PlainArrays arrays = arch();
    if (is_last_rank()) spoil(arrays);  // on one rank alone
    PlainHost host(std::move(arrays));
    const int status = on_every_rank(host.create());
    EXPECT_EQ(host.contact == nullptr, status != MORTISE_OK);
    if (message) *message = host.message;
    return status;
  };
  std::string message;
  EXPECT_EQ(status_of([](PlainArrays&) {}), MORTISE_OK);
  EXPECT_EQ(status_of([](PlainArrays& one) { one.positions[3] = std::nan(""); }, &message), MORTISE_NOT_FINITE);
  EXPECT_EQ(message, "mortise_create: \"positions\" holds nan at place 3");
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_ids[1] = one.node_ids[0]; }, &message), MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("twice"));
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_ids[1] = -5; }, &message), MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("\"node_ids\" holds -5; ids are from 0"));
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_ids[1] = std::numeric_limits<std::int64_t>::max(); }), MORTISE_REFUSED);
  EXPECT_EQ(status_of([](PlainArrays& one) { one.row_ids[0] = one.row_ids[1]; }), MORTISE_REFUSED);
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_rows[0] = 999; }, &message), MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("\"node_rows\" holds 999, which is not among the \"row_ids\" of this rank"));
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_rows[0] = -2; }), MORTISE_REFUSED);
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_rows[0] = one.node_rows[1]; }, &message), MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("each component has a row of its own"));
  EXPECT_EQ(status_of([](PlainArrays& one) { one.marks[0] = 3; }), MORTISE_REFUSED);
  EXPECT_EQ(status_of([](PlainArrays& one) { one.dimension = 4; }, &message), MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("\"dimension\" is 4; it has to be 2 or 3"));
  if (ranks() == 1) return;
  EXPECT_EQ(status_of([](PlainArrays& one) { one.node_ids[0] = 0; }, &message), MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("another rank has too"));
}

TEST(PlainMisuse, OfCreate) {
  const PlainArrays one = arch();
  const auto n = static_cast<std::int64_t>(one.node_ids.size()), rows = static_cast<std::int64_t>(one.row_ids.size());
  const int world = static_cast<int>(MPI_Comm_c2f(MPI_COMM_WORLD));
  mortise_contact* contact = nullptr;
  char message[40] = "";
  const auto create = [&](int comm, std::int64_t nodes, const std::int64_t* ids, const double* x, const char* options, std::int64_t owned) {
    const int status =
        mortise_create(comm, 2, nodes, ids, x, one.node_rows.data(), nullptr, owned, one.row_ids.data(), options, &contact, message, sizeof(message));
    mortise_destroy(&contact);
    return on_every_rank(status);
  };
  EXPECT_EQ(create(world, n, one.node_ids.data(), one.positions.data(), nullptr, rows), MORTISE_OK);
  EXPECT_STREQ(message, "");
  EXPECT_EQ(create(world, n, nullptr, one.positions.data(), nullptr, rows), MORTISE_NULL_POINTER);
  EXPECT_STREQ(message, "mortise_create: \"node_ids\" is null");
  EXPECT_EQ(create(world, n, one.node_ids.data(), nullptr, nullptr, rows), MORTISE_NULL_POINTER);
  EXPECT_EQ(create(world, -1, one.node_ids.data(), one.positions.data(), nullptr, rows), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(create(world, std::numeric_limits<std::int64_t>::max(), one.node_ids.data(), one.positions.data(), nullptr, rows), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(create(world, n, one.node_ids.data(), one.positions.data(), nullptr, -7), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(create(world, n, one.node_ids.data(), one.positions.data(), "thickness = 0", rows), MORTISE_REFUSED);
  EXPECT_EQ(std::string(message), std::string("error: options: \"thickness\" is 0; allow").substr(0, 39)) << "cut to the size of the buffer";
  EXPECT_EQ(create(99999, n, one.node_ids.data(), one.positions.data(), nullptr, rows), MORTISE_REFUSED);
  if (ranks() > 1)
    EXPECT_EQ(create(world, n, one.node_ids.data(), one.positions.data(), is_last_rank() ? "thickness = 2" : "", rows), MORTISE_REFUSED);
  EXPECT_EQ(mortise_create(MORTISE_THIS_PROCESS, 2, 0, nullptr, nullptr, nullptr, nullptr, 0, nullptr, nullptr, nullptr, message, sizeof(message)),
            MORTISE_NULL_POINTER);
}

TEST(PlainMisuse, OfPairs) {
  PlainHost host(arch());
  ASSERT_EQ(host.create(), MORTISE_OK);
  std::int32_t pair = -1;
  const auto add = [&](const char* name, double modulus, const char* options) {
    return on_every_rank(mortise_add_pair(host.contact, name, modulus, options, &pair));
  };
  std::int64_t multipliers = 0;
  EXPECT_EQ(on_every_rank(host.ready()), MORTISE_WRONG_ORDER) << "no pair";
  EXPECT_EQ(add(nullptr, 1.0, nullptr), MORTISE_REFUSED);
  EXPECT_EQ(add("joint", 0.0, nullptr), MORTISE_REFUSED);
  EXPECT_EQ(add("joint", std::nan(""), nullptr), MORTISE_REFUSED);
  EXPECT_THAT(host.error(), HasSubstr("Young's modulus of \"joint\" is nan"));
  EXPECT_EQ(add("joint", 1.0, "friction/coefficient = 0.3"), MORTISE_REFUSED);
  EXPECT_THAT(host.error(), HasSubstr("joint: unknown option \"friction/coefficient\""));
  EXPECT_EQ(add("joint", 1.0, "friction/type = coulom; friction/coefficient = 0.3"), MORTISE_REFUSED);
  EXPECT_THAT(host.error(), HasSubstr("did you mean \"coulomb\"?"));
  EXPECT_EQ(add("joint", is_last_rank() ? 1.0 : 2.0, nullptr), ranks() == 1 ? MORTISE_OK : MORTISE_REFUSED);
  EXPECT_EQ(mortise_add_pair(host.contact, "without result", 1.0, nullptr, nullptr), MORTISE_NULL_POINTER);
  if (ranks() > 1) {
    EXPECT_EQ(on_every_rank(mortise_add_pair(host.contact, "alone", 1.0, nullptr, is_last_rank() ? nullptr : &pair)), MORTISE_NULL_POINTER);
    ASSERT_EQ(add("joint", 1.0, nullptr), MORTISE_OK);
  }
  EXPECT_EQ(add("joint", 1.0, nullptr), MORTISE_REFUSED);
  EXPECT_EQ(pair, 0);
  EXPECT_EQ(on_every_rank(mortise_add_second_pass(host.contact, 0, &pair)), MORTISE_REFUSED) << "there is only one";
  EXPECT_EQ(on_every_rank(mortise_add_second_pass(host.contact, 5, &pair)), MORTISE_REFUSED);
  ASSERT_EQ(add("twice", 1.0, "formulation/type = node to segment; formulation/passes = two"), MORTISE_OK) << host.error();
  EXPECT_EQ(on_every_rank(mortise_ready(host.contact, &multipliers)), MORTISE_REFUSED);
  EXPECT_THAT(host.error(), HasSubstr("mortise_add_second_pass()"));
  EXPECT_EQ(on_every_rank(mortise_add_second_pass(host.contact, 1, &pair)), MORTISE_OK) << host.error();
  EXPECT_EQ(pair, 2);
}

TEST(PlainMisuse, OfFacets) {
  const auto ready_with = [](const std::function<int(PlainHost&)>& add, int expected, std::string* message) {
    PlainHost host(arch());
    ASSERT_EQ(host.create(), MORTISE_OK);
    ASSERT_EQ(host.add_pair(friction), MORTISE_OK) << host.error();
    ASSERT_EQ(host.add_facets(MORTISE_SLAVE, host.arrays.slave, 2), MORTISE_OK);
    ASSERT_EQ(host.add_facets(MORTISE_MASTER, host.arrays.master, 2), MORTISE_OK);
    if (is_last_rank()) add(host);
    EXPECT_EQ(on_every_rank(host.ready()), expected) << host.error();
    *message = host.error();
  };
  std::string message;
  ready_with([](PlainHost&) { return 0; }, MORTISE_OK, &message);
  const auto refuse = [&](const std::vector<std::int64_t>& nodes, int size, int side, int expected) {
    ready_with(
        [&](PlainHost& host) {
          const int status = host.add_facets(side, nodes, size);
          EXPECT_EQ(status, expected) << host.error();
          return status;
        },
        expected, &message);
  };
  refuse({0, 0}, 2, MORTISE_SLAVE, MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("mortise_ready: facet 0: \"nodes\" holds 0 twice"));
  refuse({0, -1}, 2, MORTISE_SLAVE, MORTISE_REFUSED);
  refuse({0, 1, 2, 3}, 4, MORTISE_SLAVE, MORTISE_REFUSED);
  EXPECT_THAT(message, HasSubstr("in 2D it is 2 or 3"));
  refuse({0, 1}, 2, 7, MORTISE_REFUSED);
  ready_with([](PlainHost& host) { return mortise_add_facets(host.contact, 9, MORTISE_SLAVE, 0, 2, nullptr); }, MORTISE_REFUSED, &message);
  ready_with([](PlainHost& host) { return mortise_add_facets(host.contact, 0, MORTISE_SLAVE, 3, 2, nullptr); }, MORTISE_NULL_POINTER, &message);
  ready_with([](PlainHost& host) { return mortise_add_facets(host.contact, 0, MORTISE_SLAVE, -3, 2, nullptr); }, MORTISE_WRONG_LENGTH, &message);
  ready_with([](PlainHost& host) { return host.add_facets(MORTISE_MASTER, {7, 99}, 2); }, MORTISE_REFUSED, &message);
  EXPECT_THAT(message, HasSubstr("names node 99, which the model does not have"));
  ready_with([](PlainHost& host) { return host.add_facets(MORTISE_MASTER, {6, 7}, 2); }, MORTISE_REFUSED, &message);
  EXPECT_THAT(message, HasSubstr("is given on rank"));
}

/// In a step, with a matrix and vectors.
struct Begun : PlainHost {
  std::vector<double> d, z, f, C, rhs;
  Compressed K;
  mortise_matrix matrix{};

  Begun() : PlainHost(arch()), K(springs()) {
    set_up(friction);
    d.assign(arrays.row_ids.size(), 0.0), rhs = f = d;
    z.assign(static_cast<std::size_t>(multipliers), 0.0), C = z;
  }
  static Compressed springs() {
    const Fixture fixture(arch_on_ground(), Tpetra::getDefaultComm());
    const RCP<Matrix> bulk = fixture.springs(fixture.bulk);
    bulk->fillComplete(fixture.dofs, fixture.dofs);
    return Compressed(*bulk);
  }
  int start() { return on_every_rank(mortise_start_step(contact, rows, multipliers, d.data(), nullptr, z.data())); }
  int differentiate() {
    return on_every_rank(mortise_differentiate(contact, rows, multipliers, d.data(), nullptr, z.data(), f.data(), C.data(), nullptr));
  }
  int condense() { return on_every_rank(mortise_condense(contact, rows, K.starts.data(), K.columns.data(), K.values.data(), rhs.data(), &matrix)); }
  static int half(void*, std::int64_t size, const double* b, double* x) {
    for (std::int64_t i = 0; i < size; ++i) x[i] = 0.5 * b[i];
    return 0;
  }
  int solve(mortise_linear_solver solver = &half) {
    return on_every_rank(mortise_solve(contact, rows, multipliers, rhs.data(), solver, nullptr, d.data(), z.data()));
  }
};

TEST(PlainMisuse, CallsInTheWrongOrder) {
  PlainHost host(arch());
  ASSERT_EQ(host.create(), MORTISE_OK);
  std::vector<double> d(host.arrays.row_ids.size());
  mortise_matrix matrix{};
  mortise_augmentation augmentation{};
  std::int64_t size = 0;
  const auto wrong = [](int status) { EXPECT_EQ(on_every_rank(status), MORTISE_WRONG_ORDER); };
  wrong(mortise_start_step(host.contact, host.rows, 0, d.data(), nullptr, nullptr));
  EXPECT_EQ(host.error(), "mortise_start_step: call mortise_ready() before");
  wrong(mortise_evaluate(host.contact, host.rows, 0, d.data(), nullptr, nullptr, nullptr, nullptr, nullptr));
  wrong(mortise_jacobian(host.contact, MORTISE_F_D, &matrix));
  wrong(mortise_store(host.contact, 0, nullptr, &size));
  wrong(mortise_count_nodes(host.contact, 0, &size));

  Begun begun;
  wrong(begun.differentiate());
  EXPECT_EQ(begun.error(), "mortise_differentiate: call mortise_start_step() before");
  wrong(begun.ready());
  wrong(begun.add_pair(friction));
  wrong(begun.add_facets(MORTISE_SLAVE, begun.arrays.slave, 2));
  wrong(mortise_store(begun.contact, 0, nullptr, &size));
  ASSERT_EQ(begun.start(), MORTISE_OK);
  wrong(mortise_accept(begun.contact));
  wrong(mortise_augment(begun.contact, &augmentation));
  wrong(begun.condense());
  EXPECT_THAT(begun.error(), HasSubstr("call mortise_differentiate() before"));
  wrong(begun.solve());
  wrong(mortise_jacobian(begun.contact, MORTISE_C_D, &matrix));
  EXPECT_EQ(on_every_rank(
                mortise_evaluate(begun.contact, begun.rows, begun.multipliers, begun.d.data(), nullptr, begun.z.data(), nullptr, nullptr, nullptr)),
            MORTISE_OK);
  wrong(begun.condense());
  ASSERT_EQ(begun.differentiate(), MORTISE_OK);
  wrong(mortise_recover(begun.contact, begun.rows, begun.multipliers, begun.d.data(), begun.z.data()));
  ASSERT_EQ(begun.condense(), MORTISE_OK) << begun.error();
  EXPECT_EQ(begun.error(), "");
  ASSERT_EQ(begun.solve(), MORTISE_OK) << begun.error();
  ASSERT_EQ(mortise_accept(begun.contact), MORTISE_OK);
  wrong(mortise_accept(begun.contact));
  wrong(begun.differentiate());
  wrong(begun.condense());
  EXPECT_EQ(on_every_rank(mortise_store(begun.contact, 0, nullptr, &size)), MORTISE_OK);
}

TEST(PlainMisuse, RanksInDifferentCalls) {
  if (ranks() == 1) return;
  Begun begun;
  ASSERT_EQ(begun.start(), MORTISE_OK);
  const int status = is_last_rank() ? mortise_accept(begun.contact)
                                    : mortise_evaluate(begun.contact, begun.rows, begun.multipliers, begun.d.data(), nullptr, begun.z.data(), nullptr,
                                                       nullptr, nullptr);
  EXPECT_EQ(on_every_rank(status), MORTISE_WRONG_ORDER);
  EXPECT_THAT(begun.error(), HasSubstr("ranks are in different calls"));
  EXPECT_EQ(begun.differentiate(), MORTISE_OK) << begun.error();
}

TEST(PlainMisuse, OfArrays) {
  Begun begun;
  const double not_a_number = std::nan("");
  const std::int64_t rows = begun.rows, multipliers = begun.multipliers, more = is_last_rank() ? 1 : 0;
  const auto evaluate = [&](std::int64_t n, std::int64_t m, const double* d, const double* prescribed, const double* z) {
    return on_every_rank(mortise_evaluate(begun.contact, n, m, d, prescribed, z, nullptr, nullptr, nullptr));
  };
  ASSERT_EQ(begun.start(), MORTISE_OK);
  EXPECT_EQ(evaluate(rows + more, multipliers, begun.d.data(), nullptr, begun.z.data()), MORTISE_WRONG_LENGTH);
  EXPECT_THAT(begun.error(), StartsWith("mortise_evaluate: \"d\" has the length "));
  EXPECT_EQ(evaluate(rows, multipliers - more, begun.d.data(), nullptr, begun.z.data()), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(evaluate(-rows, multipliers, begun.d.data(), nullptr, begun.z.data()), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(evaluate(rows, multipliers, is_last_rank() ? nullptr : begun.d.data(), nullptr, begun.z.data()), MORTISE_NULL_POINTER);
  EXPECT_EQ(evaluate(rows, multipliers, begun.d.data(), nullptr, nullptr), MORTISE_NULL_POINTER);
  const auto with = [&](std::vector<double>& array, std::size_t place, double value, const std::function<int()>& call) {
    const double before = array[place];
    if (is_last_rank()) array[place] = value;
    const int status = call();
    array[place] = before;
    return status;
  };
  const auto here = [&] { return evaluate(rows, multipliers, begun.d.data(), nullptr, begun.z.data()); };
  EXPECT_EQ(with(begun.d, 1, not_a_number, here), MORTISE_NOT_FINITE);
  EXPECT_EQ(begun.error(), "mortise_evaluate: \"d\" holds nan at place 1");
  EXPECT_EQ(with(begun.z, 0, std::numeric_limits<double>::infinity(), here), MORTISE_NOT_FINITE);
  EXPECT_EQ(with(begun.d, 1, not_a_number, [&] { return begun.start(); }), MORTISE_NOT_FINITE);
  std::vector<double> prescribed(begun.arrays.node_rows.size(), not_a_number);
  EXPECT_EQ(evaluate(rows, multipliers, begun.d.data(), is_last_rank() ? prescribed.data() : nullptr, begun.z.data()), MORTISE_NOT_FINITE);
  EXPECT_EQ(here(), MORTISE_OK) << "nothing of it has changed the step: " << begun.error();

  ASSERT_EQ(begun.differentiate(), MORTISE_OK);
  const auto condense = [&] { return begun.condense(); };
  EXPECT_EQ(with(begun.rhs, 0, not_a_number, condense), MORTISE_NOT_FINITE);
  EXPECT_EQ(with(begun.K.values, 5, not_a_number, condense), MORTISE_NOT_FINITE);
  const auto spoiled = [&](std::vector<std::int64_t>& array, std::size_t place, std::int64_t value) {
    const std::int64_t before = array[place];
    if (is_last_rank()) array[place] = value;
    const int status = begun.condense();
    array[place] = before;
    return status;
  };
  EXPECT_EQ(spoiled(begun.K.starts, 0, 1), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(spoiled(begun.K.starts, 2, 0), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(spoiled(begun.K.columns, 3, -1), MORTISE_REFUSED);
  EXPECT_EQ(spoiled(begun.K.columns, 3, 4711), MORTISE_REFUSED);
  EXPECT_THAT(begun.error(), HasSubstr("\"columns\" holds 4711, which is no row of any rank"));
  EXPECT_EQ(begun.condense(), MORTISE_OK) << begun.error();
  EXPECT_EQ(on_every_rank(mortise_condense(begun.contact, rows, begun.matrix.starts, begun.matrix.columns, begun.matrix.values, begun.rhs.data(),
                                           &begun.matrix)),
            MORTISE_WRONG_ORDER)
      << "the condensed matrix itself";
  EXPECT_EQ(on_every_rank(mortise_condense(begun.contact, rows, nullptr, nullptr, nullptr, begun.rhs.data(), &begun.matrix)), MORTISE_NULL_POINTER);
  EXPECT_EQ(on_every_rank(mortise_condense(begun.contact, rows + more, begun.K.starts.data(), begun.K.columns.data(), begun.K.values.data(),
                                           begun.rhs.data(), &begun.matrix)),
            MORTISE_WRONG_LENGTH);
  EXPECT_EQ(on_every_rank(mortise_condense(begun.contact, rows, begun.K.starts.data(), begun.K.columns.data(), begun.K.values.data(),
                                           begun.rhs.data(), is_last_rank() ? nullptr : &begun.matrix)),
            MORTISE_NULL_POINTER);
  EXPECT_EQ(on_every_rank(mortise_jacobian(begun.contact, 4, &begun.matrix)), MORTISE_REFUSED);
  EXPECT_EQ(on_every_rank(mortise_report(begun.contact, 0, 1000, nullptr)), MORTISE_WRONG_LENGTH);
  EXPECT_EQ(on_every_rank(mortise_multipliers(begun.contact, multipliers + 1, nullptr, nullptr, nullptr)), MORTISE_WRONG_LENGTH);
}

TEST(PlainMisuse, SolversThatFail) {
  Begun begun;
  ASSERT_EQ(begun.start(), MORTISE_OK);
  ASSERT_EQ(begun.differentiate(), MORTISE_OK);
  ASSERT_EQ(begun.condense(), MORTISE_OK);
  EXPECT_EQ(begun.solve(nullptr), MORTISE_NULL_POINTER);
  EXPECT_EQ(begun.solve([](void*, std::int64_t, const double*, double*) { return is_last_rank() ? 3 : 0; }), MORTISE_SOLVE_FAILED);
  EXPECT_THAT(begun.error(), HasSubstr("the linear solver has failed: it returns 3"));
  EXPECT_EQ(begun.solve([](void*, std::int64_t, const double*, double* x) {
    x[0] = std::nan("");
    return 0;
  }),
            MORTISE_SOLVE_FAILED);
  EXPECT_EQ(begun.solve(), MORTISE_OK) << begun.error();
}

TEST(PlainMisuse, CallsWithinTheSolver) {
  static mortise_contact* under_way = nullptr;
  Begun begun;
  ASSERT_EQ(begun.start(), MORTISE_OK);
  ASSERT_EQ(begun.differentiate(), MORTISE_OK);
  ASSERT_EQ(begun.condense(), MORTISE_OK);
  under_way = begun.contact;
  const int status = begun.solve([](void*, std::int64_t, const double*, double*) {
    mortise_contact* same = under_way;
    mortise_destroy(&same);
    return same == under_way && mortise_accept(under_way) == MORTISE_WRONG_ORDER ? 5 : 0;
  });
  EXPECT_EQ(status, MORTISE_SOLVE_FAILED);
  EXPECT_THAT(begun.error(), HasSubstr("it returns 5"));
  EXPECT_EQ(begun.solve(), MORTISE_OK) << begun.error();
}

TEST(PlainMisuse, StatesThatCannotBeEvaluated) {
  Begun begun;
  ASSERT_EQ(begun.start(), MORTISE_OK);
  const std::vector<double> before = begun.d;
  for (std::size_t k = 0; k < begun.d.size(); ++k) begun.d[k] = -(begun.arrays.positions[k]);  // all of it in one point
  EXPECT_EQ(begun.differentiate(), MORTISE_STEP_FAILED);
  EXPECT_NE(begun.error(), "");
  EXPECT_EQ(begun.condense(), MORTISE_WRONG_ORDER) << "there are no derivatives";
  begun.d = before;
  EXPECT_EQ(begun.start(), MORTISE_OK) << "the step is undone";
  EXPECT_EQ(begun.differentiate(), MORTISE_OK);
}

TEST(PlainMisuse, OfStoredBytes) {
  Begun begun;
  ASSERT_EQ(begun.start(), MORTISE_OK);
  ASSERT_EQ(begun.differentiate(), MORTISE_OK);
  ASSERT_EQ(mortise_accept(begun.contact), MORTISE_OK);
  std::int64_t size = 0;
  ASSERT_EQ(mortise_store(begun.contact, 0, nullptr, &size), MORTISE_OK);
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  EXPECT_EQ(on_every_rank(mortise_store(begun.contact, size - (is_last_rank() ? 1 : 0), bytes.data(), &size)),
            ranks() == 1 ? MORTISE_WRONG_LENGTH : -1)
      << "room is a matter of each rank";
  ASSERT_EQ(mortise_store(begun.contact, size, bytes.data(), &size), MORTISE_OK);
  const auto restore = [&](const unsigned char* from, std::int64_t length) {
    return on_every_rank(mortise_restore(begun.contact, length, from, begun.rows, begun.multipliers, begun.d.data(), nullptr, begun.z.data()));
  };
  EXPECT_EQ(restore(nullptr, size), MORTISE_NULL_POINTER);
  EXPECT_EQ(restore(bytes.data(), -1), MORTISE_BAD_BYTES);
  for (const std::int64_t length : {std::int64_t{0}, std::int64_t{5}, size / 2, size - 1})
    EXPECT_EQ(restore(bytes.data(), length), MORTISE_BAD_BYTES);
  for (std::size_t place = 0; place < bytes.size(); place += 97) {
    std::vector<unsigned char> spoiled = bytes;
    if (is_last_rank()) spoiled[place] ^= 4;
    EXPECT_EQ(restore(spoiled.data(), size), MORTISE_BAD_BYTES) << "byte " << place;
  }
  PlainHost other(arch());
  other.set_up("");
  EXPECT_EQ(on_every_rank(mortise_restore(other.contact, size, bytes.data(), other.rows, other.multipliers, begun.d.data(), nullptr, begun.z.data())),
            MORTISE_OK)
      << "it needs less: " << other.error();
  EXPECT_EQ(restore(bytes.data(), size), MORTISE_OK) << begun.error();
  PlainHost stiff(arch());
  stiff.set_up("formulation/type = penalty");
  EXPECT_EQ(on_every_rank(mortise_restore(stiff.contact, size, bytes.data(), stiff.rows, stiff.multipliers, begun.d.data(), nullptr, begun.z.data())),
            MORTISE_BAD_BYTES);
  EXPECT_THAT(stiff.error(), HasSubstr("it is of another model or has other options"));
}

TEST(PlainMisuse, OfNoContact) {
  EXPECT_EQ(mortise_accept(nullptr), MORTISE_NULL_POINTER);
  EXPECT_STREQ(mortise_last_error(nullptr), "the contact is null");
  mortise_destroy(nullptr);
  mortise_contact* none = nullptr;
  mortise_destroy(&none);
  PlainHost host(arch());
  ASSERT_EQ(host.create(), MORTISE_OK);
  mortise_destroy(&host.contact);
  EXPECT_EQ(host.contact, nullptr);
  EXPECT_EQ(mortise_accept(host.contact), MORTISE_NULL_POINTER);
}

}  // namespace
}  // namespace mortise
