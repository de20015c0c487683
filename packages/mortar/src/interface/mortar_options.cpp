#include "mortise/mortar/mortar_options.hpp"

#include "mortise/core/parameters.hpp"

namespace mortise {

void MortarOptions::describe(Parameters& parameters) {
  parameters.add("gap weighting", gap_weighting, {{"dual", GapWeighting::dual}, {"standard", GapWeighting::standard}},
                 "functions that weight the gap: the dual ones of the multiplier, or the standard shape functions, which keep the gap's sign on "
                 "strongly curved coarse facets");
  parameters.add(
      "search reach", search_reach,
      Says("distance up to which facets can touch; default: the length of the pair's longest facet, and more if the surfaces are known to overlap "
           "deeper at the start")
          .unit("length")
          .above(0.0));
  parameters.add(
      "linearisation", linearisation, {{"exact", Linearisation::exact}, {"frozen normals", Linearisation::frozen_normals}},
      "derivatives of the contact geometry in Newton's method: all, or all but those of the nodal normals, as in many programs; changes no solution");
  parameters.add(
      "corners", corners,
      {{"master normal", CornerRule::master_normal}, {"nearest facet", CornerRule::nearest_facet}, {"averaged", CornerRule::averaged}},
      "normals at convex edges and corners of a slave surface, where facets meet at an angle. master normal: the facets have their own, "
      "and the node that of the master that they cover. nearest facet: the node has that of its facet nearest to the master, in 2D. "
      "averaged: all take the average. Variational mortar takes the nearest facet for the master's normal, and 3D the average for the nearest "
      "facet");
  parameters.add(
      "balance", balance,
      Says("largest over mean work of the ranks, in overlaps of two facets, above which the next search gives slave facets to other ranks; "
           "changes no solution")
          .unit("-")
          .at_least(1.0));
  parameters.add(
      "gauss points", gauss_points,
      Says("quadrature points on each overlap of two facets in 2D; in 3D each triangle of an overlap has 7").unit("-").at_least(2.0).at_most(20.0));
}

}  // namespace mortise
