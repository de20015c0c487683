#include "mortise/simulation/scene/contact_start.hpp"

namespace mortise {

void ContactStartOptions::describe(Parameters& parameters) {
  parameters.add("start", mesh, {{"as meshed", MeshAtStart::as_meshed}, {"adjust", MeshAtStart::adjusted}},
                 "adjust: slave nodes no further than the \"tolerance\" from the master are moved onto it along their normals before anything is "
                 "computed, which "
                 "strains nothing");
  parameters.add("tolerance", tolerance, Says("by how much nodes are adjusted at most").unit("length").at_least(0.0));
  if (mesh == MeshAtStart::adjusted && tolerance == 0.0) parameters.error("start", "adjusts no node without a \"tolerance\" above 0; please add it");
  if (mesh == MeshAtStart::as_meshed && tolerance > 0.0) parameters.error("tolerance", "is for \"start\" (string, adjust); please add that");
  parameters.add("initial overlap", initial_overlap, {{"interference", InitialOverlap::interference}, {"error", InitialOverlap::error}},
                 "surfaces that begin in one another: interference, they are pushed apart, whatever the depth; error, the scene is refused");
  parameters.add(
      "overlap taken up at", taken_up_at,
      Says(
          "pseudo-time at which nothing is left of an overlap that the surfaces begin with; it falls in proportion to time. Left out: the end of the "
          "first step, or its share if that is cut short")
          .above(0.0));
}

}  // namespace mortise
