// Nodes where pairs meet carry no multiplier.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>

#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using Facets = std::vector<std::array<GlobalOrdinal, 2>>;

/// Slaves are the upper sides of bodies below y = 0, from right to left; masters the lower sides of bodies above.
class Crosspoints : public ::testing::Test {
 protected:
  /// Of nodes 0 to 5 at (n, 0) and 6 to 11 at (n - 6, 0), whose facets may touch those.
  Crosspoints()
      : nodes_(rcp(new const Map(12, 0, Tpetra::getDefaultComm()))),
        reference_(rcp(new MultiVector(nodes_, 2))),
        fixed_(rcp(new MultiVector(nodes_, 2))) {
    const auto x = reference_->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(*nodes_)); ++node)
      x(node, 0) = static_cast<double>(nodes_->getGlobalElement(node) % 6);
  }

  ContactPair pair(const std::string& name, const Facets& slave, const Facets& master,
                   const std::shared_ptr<Formulation>& formulation = nullptr) const {
    ContactPair result;
    result.name = name;
    result.place = {"scene.xml", 3, "contact/" + name};
    result.youngs_modulus = 1.0;
    for (const auto& [a, b] : slave)
      if (nodes_->isNodeGlobalElement(a) || nodes_->isNodeGlobalElement(b)) result.slave.push_back({a, b});
    for (const auto& [a, b] : master)
      if (nodes_->isNodeGlobalElement(a)) result.master.push_back({a, b});
    if (formulation) result.options.formulation.options = formulation;
    return result;
  }

  /// Nodes that carry a multiplier, over all ranks.
  std::vector<int> carriers(std::vector<ContactPair> pairs) const {
    const ContactSystem contact(nodes_, make_dof_map(*nodes_, 2), reference_, fixed_, {}, std::move(pairs), Timers());
    std::vector<int> mine(12, 0), all(12);
    for (const GlobalOrdinal id : local_ids(*contact.multiplier_map())) mine[static_cast<std::size_t>((id - 24) / 2)] = 1;
    Teuchos::reduceAll(*nodes_->getComm(), Teuchos::REDUCE_MAX, 12, mine.data(), all.data());
    std::vector<int> result;
    for (int node = 0; node < 12; ++node)
      if (all[static_cast<std::size_t>(node)] != 0) result.push_back(node);
    return result;
  }

 private:
  RCP<const Map> nodes_;
  RCP<MultiVector> reference_, fixed_;
};

TEST_F(Crosspoints, SlavesOfTwoPairs) {
  const Facets left{{2, 1}, {1, 0}}, right{{4, 3}, {3, 2}};
  const std::vector<ContactPair> both{pair("left", left, {{6, 7}, {7, 8}}), pair("right", right, {{9, 10}})};
  EXPECT_THAT(carriers({both[0]}), ::testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(carriers(both), ::testing::ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(carriers({both[1], both[0]}), ::testing::ElementsAre(0, 1, 3, 4));  // whichever comes first
}

TEST_F(Crosspoints, SlavesThatAreMastersElsewhere) {
  const std::vector<ContactPair> both{pair("left", {{2, 1}, {1, 0}}, {{6, 7}}), pair("right", {{11, 10}, {10, 9}}, {{2, 3}})};
  EXPECT_THAT(carriers(both), ::testing::ElementsAre(0, 1, 9, 10, 11));
  // A multiplier that no momentum row eliminates may be at any node.
  const auto standard = std::make_shared<StandardMortar>();
  EXPECT_THAT(carriers({pair("left", {{2, 1}, {1, 0}}, {{6, 7}}, standard), pair("right", {{11, 10}, {10, 9}}, {{2, 3}}, standard)}),
              ::testing::ElementsAre(0, 1, 2, 9, 10, 11));
}

TEST_F(Crosspoints, FacetsOfCrosspointsAloneAreRefused) {
  try {
    carriers({pair("one", {{2, 1}, {1, 0}}, {{6, 7}}), pair("two", {{2, 1}}, {{8, 9}})});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                ::testing::AllOf(::testing::HasSubstr("contact/"), ::testing::HasSubstr("slave facets can carry no contact"),
                                 ::testing::HasSubstr("belong to other pairs too"), ::testing::HasSubstr("all of its masters in one set")));
  }
}

}  // namespace
}  // namespace mortise
