#pragma once
// Forces on so few slave nodes that the master's curvature within their facets decides on approach and pressure.

#include <string>
#include <vector>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Remembers of each pair the accepted state in which it pressed hardest, and what was wrong with it.
class CoarseSlaveWatch {
 public:
  CoarseSlaveWatch(const Model& model, const Scene& scene);

  /// An accepted state, at which contact was evaluated last. Collective.
  void accept(const Vector& displacement, const ContactLaws& laws, double time);
  /// One line for each pair with too coarse a slave where it pressed hardest, or in the last state. Collective.
  std::vector<std::string> warnings(const Vector& displacement, const ContactLaws& laws, double time) const;
  /// Stores or restores what it knows of the accepted states.
  void serialize(StateArchive& archive);

 private:
  struct Hardest {
    double pressure = 0.0;  ///< largest of a node
    std::string words;      ///< error of that state; empty: none
  };

  const Model& model_;
  const Scene& scene_;
  std::vector<Hardest> hardest_;  ///< [pairs of the scene]
};

/// Why Newton's method found no equilibrium, if contact was sought at a node or two whose facets are too coarse for the master; else empty.
/// Collective.
std::string explain_by_coarse_slave(const FailedTry& failed, const Model& model, const Scene& scene, const SemiSmoothSystem& system);

}  // namespace mortise
