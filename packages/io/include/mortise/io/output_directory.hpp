#pragma once
// Where a run leaves its files.

#include <string>

#include "mortise/core/types.hpp"

namespace mortise {

/// A directory for the files of one run.
class OutputDirectory {
 public:
  /// Makes sure that files can be made in the directory, or the directory where it does not exist. Touches nothing. Collective.
  /// @param keep  refuse a directory that holds files of a run
  /// @throws FileError on all ranks: not a directory, not writable, refused
  OutputDirectory(RCP<const Communicator> comm, std::string path, bool keep);

  /// Makes the directory, with those above it, where it does not exist. Collective. Throws FileError on all ranks.
  void make() const;

  /// Makes the directory and removes the files of an earlier run, whole. Files that no run writes are left. Collective.
  /// @throws FileError on all ranks
  void begin_run() const;

  const std::string& path() const { return path_; }
  /// Path of a file in the directory.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  RCP<const Communicator> comm_;
  std::string path_;
};

/// Whether a run writes a file of this name, relative to its directory:
/// * summary.json, effective.xml, log.txt, checkpoint-*.h5,
/// * newton.csv, history.csv, profiles.csv,
/// * fields.xdmf, fields/mesh.h5, fields/step-*.h5, and fields.h5 of earlier versions,
/// * point.csv, point.svg, point.png.
bool is_run_file(const std::string& name);

}  // namespace mortise
