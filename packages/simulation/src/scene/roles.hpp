#pragma once
// Choice of the slave of two surfaces, and the cost of a slave that is stiffer and finer than its master.

#include <limits>
#include <string>

#include "mortise/mesh/mesh.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Traits on which the choice depends.
struct SurfaceTraits {
  double modulus = std::numeric_limits<double>::infinity();  ///< Young's modulus of the stiffest body; of a rigid one infinite
  double facet = 0.0;                                        ///< shortest side of a facet
  int faces = 1;                                             ///< number of bodies that it faces
};

/// Collective.
SurfaceTraits surface_traits(const Mesh& mesh, const Scene& scene, const Located<std::string>& set);

/// Of two surfaces the better slave.
struct RoleChoice {
  bool is_first = true;
  bool is_tie = false;  ///< nothing but their order tells them apart
  std::string reason;
};

/// The deformable one; the softer one, if moduli differ by more than a factor of 2. Else the one that faces fewer bodies, unless its facets are twice
/// as long or more; the finer one; the first.
RoleChoice better_slave(const SurfaceTraits& first, const SurfaceTraits& second);

/// By how much of itself the peak pressure may come out too high with this slave: 0, unless it is stiffer and finer.
double excess_of_peak(const SurfaceTraits& slave, const SurfaceTraits& master, int dimension);

/// Finds the pairs that the scene leaves to the program, and exchanges slave and master of pairs with automatic roles where the master is the better
/// slave. Collective; without either it does nothing.
/// @throws InputError for what a mesh cannot be made of, and for unknown sets
void assign_roles(const Communicator& comm, Scene& scene);

}  // namespace mortise
