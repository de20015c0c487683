#pragma once
// A picture of what a run left.

#include <optional>
#include <string>

#include "mortise/core/types.hpp"

namespace mortise {

/// Content and file of a picture.
struct PictureOptions {
  std::string run;                   ///< directory of a run's results
  std::optional<std::string> field;  ///< "von_mises", "displacement.y", "cauchy_stress.xx", "body"; none: what the run has of stress or displacement
  std::optional<int> step;           ///< none: the last one that has fields
  std::optional<double> warp;        ///< factor of displacements; none: what makes them visible
  std::optional<std::string> view;   ///< in 3D: "iso", "x", "-y" ... or "1,-2,1", from the model to the eye; none: iso, or toward a contact surface
  std::optional<std::string> profile;  ///< a contact pair in 2D: pressure and shear along it, in the place of a field
  bool all_steps = false;              ///< an animation (.gif), or a picture of each step (.png)
  std::string output;                  ///< file; empty: picture.png, picture.gif or profile.png beside the results
};

/// Collective; rank 0 draws. Returns what was drawn with its range and where it is, for a line of the log; none on all ranks if there is no python
/// with matplotlib and h5py. The picture has its name when it is complete; nothing is touched if it cannot be drawn.
/// @throws InputError  a field, part, step or pair that the run does not have, an ending of the file that is none of a picture
/// @throws FileError   results that are missing or damaged; a file that cannot be written, or is not this program's to replace
std::optional<std::string> draw_picture(const RCP<const Communicator>& comm, const PictureOptions& options);

}  // namespace mortise
