#pragma once
// Links of springs and dashpots, made from their options.

#include <string>
#include <vector>

#include "mortise/solid/connectors.hpp"

namespace mortise {

/// Makes the links of a list of springs or dashpots, one after the other, and keeps what is wrong with them.
class LinkMaker {
 public:
  /// @param word  "stiffness" or "coefficient", as parameters have it
  LinkMaker(const Bodies& bodies, std::string word) : bodies_(bodies), mesh_(*bodies.mesh()), word_(std::move(word)) {}

  /// The next one. Collective.
  void add(const ConnectorOptions& options, const Place& place);
  /// Throws InputError on all ranks with all that is wrong. Collective.
  std::vector<ConnectorLink> finish();

 private:
  void check(const ConnectorOptions& options, const Place& place) const;
  void add_components(const ConnectorOptions& options);
  void add_over_sides(const ConnectorOptions& options, const ConnectorLaw& law);
  void add_at_nodes(const ConnectorOptions& options, const ConnectorLaw& law);
  void add_between(const ConnectorOptions& options);
  void add_axial(const ConnectorOptions& options, const Place& place);
  void add_rotation(const ConnectorOptions& options);
  /// e = mean(u of `to`) - mean(u of `set`), or of `set` alone.
  ConnectorLink link_of_means(const ConnectorOptions& options);
  void add_mean(const Located<std::string>& set, double sign, ConnectorLink& link) const;
  ConnectorLaw law_of_components(const ConnectorOptions& options) const;

  const Bodies& bodies_;
  const Mesh& mesh_;
  std::string word_;
  std::size_t number_ = 0;
  std::vector<ConnectorLink> links_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace mortise
