// Linear constraints as a closed set: chains over ranks, in any order, prescribed values, circles.

#include "mortise/nonlinear/affine_constraints.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace mortise {
namespace {

constexpr GlobalOrdinal count = 12;

/// x_id = sum of coefficients times unknowns + factor times a value.
struct Constraint {
  GlobalOrdinal id;
  std::vector<std::pair<GlobalOrdinal, double>> terms;
  std::vector<std::pair<std::size_t, double>> shares;
};

/// Ids go round the ranks, so that chains do.
RCP<const Map> dealt_dofs() {
  const RCP<const Communicator> comm = Tpetra::getDefaultComm();
  std::vector<GlobalOrdinal> ids;
  for (GlobalOrdinal id = comm->getRank(); id < count; id += comm->getSize()) ids.push_back(id);
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
}

std::vector<double> values_at(double time, std::optional<StepFailure>&) { return {1.0 + time, 10.0 * time}; }

AffineConstraints closed(const RCP<const Map>& dofs, const std::vector<Constraint>& constraints) {
  std::vector<AffineConstraints::Line> lines;
  for (const Constraint& one : constraints)
    if (dofs->isNodeGlobalElement(one.id)) lines.push_back({dofs->getLocalElement(one.id), one.terms, one.shares});
  return {dofs, std::move(lines), values_at};
}

/// 3 and 7 are prescribed; 2 follows 5, which follows 0, 3 and 9, of which 9 follows 1; 11 follows 9.
const std::vector<Constraint> chain{{9, {{1, 2.0}}, {{1, 0.5}}},
                                    {2, {{5, 3.0}}, {{0, 1.0}}},
                                    {7, {}, {{1, 2.0}, {0, -1.0}}},
                                    {11, {{9, -1.0}, {4, 1.0}}, {}},
                                    {5, {{0, 1.0}, {3, 0.25}, {9, 4.0}}, {}},
                                    {3, {}, {{0, 1.0}}}};

/// All unknowns at a time, put into one another by hand.
std::map<GlobalOrdinal, double> by_hand(const std::map<GlobalOrdinal, double>& free, double t) {
  std::map<GlobalOrdinal, double> x = free;
  x[3] = 1.0 + t;
  x[7] = 20.0 * t - (1.0 + t);
  x[9] = 2.0 * x[1] + 5.0 * t;
  x[11] = x[4] - x[9];
  x[5] = x[0] + 0.25 * x[3] + 4.0 * x[9];
  x[2] = 3.0 * x[5] + 1.0 + t;
  return x;
}

TEST(AffineConstraints, AreClosedInAnyOrder) {
  const RCP<const Map> dofs = dealt_dofs();
  std::vector<Constraint> lines = chain;
  for (int order = 0; order < 4; ++order) {
    std::rotate(lines.begin(), lines.begin() + 1, lines.end());
    const AffineConstraints constraints = closed(dofs, lines);
    Vector x(dofs), result(dofs);
    std::map<GlobalOrdinal, double> free;
    for (const GlobalOrdinal id : {0, 1, 4, 6, 8, 10}) free[id] = std::sin(1.0 + static_cast<double>(id));
    const double t = 0.3;
    std::optional<StepFailure> failure;
    const std::vector<double> prescribed = constraints.prescribed_values(t, failure);
    for (const auto& [id, value] : free)
      if (dofs->isNodeGlobalElement(id)) x.replaceGlobalValue(id, value);
    for (std::size_t n = 0; n < prescribed.size(); ++n) x.replaceLocalValue(constraints.prescribed()[n], prescribed[n]);
    for (const LocalOrdinal row : constraints.dependent()) x.replaceLocalValue(row, 1e6);  // has no influence
    constraints.T()->apply(x, result);
    result.update(1.0, *constraints.offset(t, failure), 1.0);
    EXPECT_FALSE(failure);
    for (const auto& [id, value] : by_hand(free, t))
      if (dofs->isNodeGlobalElement(id)) EXPECT_NEAR(result.getData()[dofs->getLocalElement(id)], value, 1e-13 * (1.0 + std::abs(value))) << id;
  }
}

TEST(AffineConstraints, WithoutDependentOnesHaveNoMatrix) {
  const RCP<const Map> dofs = dealt_dofs();
  const AffineConstraints none = closed(dofs, {}), prescribed = closed(dofs, {{3, {}, {{0, 1.0}}}});
  std::optional<StepFailure> failure;
  for (const AffineConstraints* one : {&none, &prescribed}) {
    EXPECT_TRUE(one->T().is_null());
    EXPECT_TRUE(one->offset(1.0, failure).is_null());
  }
  const AffineConstraints at_rest = closed(dofs, {{3, {{4, 1.0}}, {}}});
  EXPECT_FALSE(at_rest.T().is_null());
  EXPECT_TRUE(at_rest.offset(1.0, failure).is_null());
}

std::string refused(const std::vector<Constraint>& lines) {
  try {
    closed(dealt_dofs(), lines);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(AffineConstraints, RefuseContradictionsAndCirclesOnAllRanks) {
  EXPECT_EQ(refused({{3, {}, {{0, 1.0}}}, {5, {{1, 1.0}}, {}}, {3, {{1, 1.0}}, {}}}), "two constraints of the unknown 3");
  const std::string circle = refused({{3, {{4, 1.0}}, {}}, {4, {{5, 1.0}}, {}}, {5, {{3, 1.0}}, {}}});
  EXPECT_NE(circle.find("constraints depend on one another in a circle, at the unknown "), std::string::npos) << circle;
  EXPECT_NE(refused({{6, {{6, 0.5}}, {}}}), "");
}

}  // namespace
}  // namespace mortise
