#pragma once
// The smallest host, whose arguments tests spoil.

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <string>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/dof_map.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::test {

/// Message of the exception that is thrown, on every rank alike: "" if there is none.
template <class Error, class Call>
std::string thrown(const Call& call) {
  std::string text;
  try {
    call();
  } catch (const Error& error) {
    text = error.what();
  }
  int mine = text.empty() ? 0 : 1, all = 0;
  Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  EXPECT_EQ(all, mine * Tpetra::getDefaultComm()->getSize()) << "not on every rank";
  return text;
}

/// Two facets that face each other, node n on rank n modulo the ranks, and how they are given.
struct Host {
  RCP<const Communicator> comm = Tpetra::getDefaultComm();
  RCP<const Map> nodes = owned(), dofs = make_dof_map(*nodes, 2);
  RCP<MultiVector> reference = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
  ContactPair pair;

  Host() {
    pair.name = "joint";
    pair.youngs_modulus = 1.0;
    const double x[4] = {0.0, 1.0, 1.0, 0.0};
    for (const GlobalOrdinal node : local_ids(*nodes)) reference->replaceGlobalValue(node, 0, x[node]);
    const auto mine = [&](GlobalOrdinal node) { return nodes->isNodeGlobalElement(node); };
    if (mine(0) || mine(1)) pair.slave = {{0, 1}};
    if (mine(2)) pair.master = {{2, 3}};
  }
  RCP<const Map> owned() const {
    std::vector<GlobalOrdinal> ids;
    for (GlobalOrdinal node = 0; node < 4; ++node)
      if (node % comm->getSize() == comm->getRank()) ids.push_back(node);
    return rcp(new Map(4, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
  }
  template <class Error>
  std::string refused() const {
    return thrown<Error>([&] { ContactSystem(nodes, dofs, reference, fixed, {}, {pair}, Timers()); });
  }
};

}  // namespace mortise::test
