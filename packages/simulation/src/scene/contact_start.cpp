#include "mortise/simulation/scene/contact_start.hpp"

namespace mortise {

void ContactStartOptions::describe(Parameters& parameters) {
  parameters.add("start", mesh, {{"as meshed", MeshAtStart::as_meshed}, {"adjust", MeshAtStart::adjusted}},
                 "adjust: slave nodes no further than the \"tolerance\" from the master are moved onto it along their normals before anything is "
                 "computed, which "
                 "strains nothing");
  parameters.add("tolerance", tolerance, Says("largest distance by which nodes are moved").unit("length").at_least(0.0));
  if (mesh == MeshAtStart::adjusted && tolerance == 0.0) parameters.error("start", "adjusts no node without a \"tolerance\" above 0; please add it");
  if (mesh == MeshAtStart::as_meshed && tolerance > 0.0) parameters.error("tolerance", "is for \"start\" (string, adjust); please add that");
  parameters.add("facets", facets, {{"flat", FacetShape::flat}, {"round", FacetShape::round}},
                 "round: linear facets stand for the smooth surface through their nodes where they turn by less than 30 degrees from one to the "
                 "next. Gaps change by the distance between facets and surface in the reference configuration. For round parts with a clearance");
  if (mesh == MeshAtStart::adjusted && facets == FacetShape::round)
    parameters.error("facets", "\"round\" is not for slave nodes that are moved onto flat facets; please leave out \"start\" = \"adjust\"");
  parameters.add("initial overlap", initial_overlap, {{"interference", InitialOverlap::interference}, {"error", InitialOverlap::error}},
                 "surfaces that overlap at the start: interference, they are pushed apart, whatever the depth; error, the scene is refused");
  parameters.add(
      "overlap taken up at", taken_up_at,
      Says(
          "pseudo-time at which nothing is left of an overlap that the surfaces start with; it falls in proportion to time. Left out: the end of the "
          "first step, or its share if that is cut short")
          .above(0.0));
}

}  // namespace mortise
