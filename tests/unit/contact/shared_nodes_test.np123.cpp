// Pairs that share nodes in a way that has no answer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "two_surfaces.hpp"

namespace mortise {
namespace {

TEST(SharedNodes, AreRefused) {
  const auto comm = Tpetra::getDefaultComm();
  const auto nodes = rcp(new const Map(8, 0, comm));
  const auto dofs = make_dof_map(*nodes, 2);
  const auto reference = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
  const auto pair = [&](const std::string& name, int line, std::array<GlobalOrdinal, 2> slave, std::array<GlobalOrdinal, 2> master) {
    ContactPair result;
    result.name = name;
    result.place = {"scene.xml", line, "contact/" + name};
    result.youngs_modulus = 1.0;
    if (nodes->isNodeGlobalElement(slave[0]) || nodes->isNodeGlobalElement(slave[1])) result.slave.emplace_back(slave.begin(), slave.end());
    if (nodes->isNodeGlobalElement(master[0])) result.master.emplace_back(master.begin(), master.end());
    return result;
  };
  const auto message = [&](std::vector<ContactPair> pairs) -> std::string {
    try {
      ContactSystem(nodes, dofs, reference, fixed, {}, std::move(pairs), Timers());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message({pair("one", 3, {0, 1}, {2, 3}), pair("two", 9, {1, 4}, {6, 7})}),
              ::testing::HasSubstr("scene.xml:9: error: contact/two: node 1 is a slave"));
  EXPECT_THAT(message({pair("one", 3, {0, 1}, {2, 3}), pair("two", 9, {4, 5}, {1, 6})}),
              ::testing::HasSubstr("scene.xml:3: error: contact/one: node 1 is a slave here and a master"));
}

}  // namespace
}  // namespace mortise
