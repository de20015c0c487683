#include "mortise/simulation/scene/stabilisation.hpp"

namespace mortise {

void StabilisationOptions::describe(Parameters& parameters) {
  parameters.add("type", kind, {{"none", Kind::none}, {"viscous", Kind::viscous}},
                 "viscous: bodies that supports, ties and springs do not hold get a force per volume, a viscosity times the change of displacement "
                 "over the step by its length; it "
                 "falls linearly with time to nothing");
  parameters.add(
      "factor", factor,
      Says("viscosity over E T / L^2, with Young's modulus E, the time T until which it acts, and the size L of the model: bodies that move "
           "by a share of L in T feel a stress of that share of E, times this")
          .unit("-")
          .above(0.0));
  parameters.add("until", until,
                 Says("time from which on it is nothing; default: the end time, so that the last state has none").unit("time").above(0.0));
}

}  // namespace mortise
