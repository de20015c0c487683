#pragma once
// The hardening laws that the tests of plasticity go through, and paths.

#include <string>
#include <vector>

#include "mortise/material/finite_j2.hpp"

namespace mortise {

struct NamedHardening {
  std::string name;
  Hardening law;
};

/// One of each kind, with a yield stress of about a hundredth of Young's modulus 1000.
inline std::vector<NamedHardening> every_hardening() {
  return {{"perfect", PerfectPlasticity{10.0}},
          {"linear", LinearHardening{10.0, 60.0}},
          {"ludwik", LudwikHardening{10.0, 8.0, 0.21}},
          {"swift", SwiftHardening{18.0, 0.01, 0.15}},
          {"voce", VoceHardening{10.0, 9.0, 8.0}},
          {"linear voce", LinearVoceHardening{{10.0, 7.0, 17.0}, 13.0}},
          {"table", TableHardening{Table{{0.0, 0.05, 0.2, 1.5}, {10.0, 14.0, 17.0, 21.0}}}}};
}

inline const ElasticConstants soft{1000.0, 0.3};

/// Materials of the paper's examples.
inline const ElasticConstants steel{210000.0, 0.33}, aluminium{71150.0, 0.3};
inline const LudwikHardening steel_hardening{830.0, 600.0, 0.21}, aluminium_hardening{370.0, 550.0, 0.223};

inline double von_mises(const Matrix3& stress) { return std::sqrt(1.5) * (stress - stress.trace() / 3.0 * Matrix3::Identity()).norm(); }

}  // namespace mortise
