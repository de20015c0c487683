#pragma once
// Where a command leaves its files, and what it may replace there.

#include <memory>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Source of the results in the files of a directory.
struct Origin {
  std::string kind{};       ///< "run", "study" ...: a directory is not given from one kind to another; empty: any
  std::string source{};     ///< file that is run; empty: none
  bool is_default = false;  ///< nobody named the directory: one with results of another source is refused
};

/// A directory for results. Its file `.mortise` lists the files and directories that the program made there. Only these are ever replaced or removed:
/// what is not listed is another's, and a name that is taken by it is a FileError before anything is made or removed.
///
/// One of begin_run(), continue_run(), open() comes first. It takes the directory's lock, which is held until the last copy of this object is gone. A
/// second process that wants to write there gets a FileError that names the first. Then claim() and subdirectory() register names, each before the
/// file is made:
///
///     OutputDirectory directory(comm, "results/press", {"run", "press.xml"});
///     directory.begin_run();
///     write_file(*comm, directory.claim("summary.json"), text);
///     OutputDirectory fields = directory.subdirectory("fields");
///     Hdf5File file(comm, fields.claim("mesh.h5"), ...);
///
/// Members but is_open(), path() and file() are collective and throw FileError on all ranks. Copies share what they know.
class OutputDirectory {
 public:
  /// Makes sure that files can be made in the directory, or the directory where it does not exist. Touches nothing.
  /// @param keep  refuse a directory that holds results
  /// @throws FileError  not a directory, not writable, being written, of another origin; refused
  OutputDirectory(RCP<const Communicator> comm, std::string path, Origin origin = {}, bool keep = false);

  /// Makes the directory, with those above it, where it does not exist, and removes all that its list has.
  /// @param names  what else will be claimed: a name that another's file has is an error before anything is removed. Those of a run are known.
  void begin_run(const std::vector<std::string>& names = {});

  /// Takes up the directory of an earlier run, with its files and its list, which has to be there.
  void continue_run();

  /// Makes the directory where it does not exist, or takes up the one that is there with its files.
  /// @param names  as in begin_run()
  void open(const std::vector<std::string>& names = {});

  /// Registers a file that is about to be made or replaced. Returns its path. A registered name may be claimed again. A `*` in the name stands for
  /// any digits: a series of files is registered once.
  std::string claim(const std::string& name);

  /// Registers a directory and makes it where it does not exist. It has a list of its own, which is kept, and the same lock.
  OutputDirectory subdirectory(const std::string& name);

  /// Removes a file or directory that is registered; nothing if it is not there. Unregistered contents of a directory stay, with the directory.
  void remove(const std::string& name);

  /// Strikes from the list what was registered and has not been made: it may become another's.
  void strike_missing();

  /// Returns when lists of the directory, of those that it is a subdirectory of and of their subdirectories are on the disk, with the directories that
  /// were made for them. From then on a list is so after each change: results that are brought to the disk are found after a loss of power.
  void sync();

  /// True if it has been taken, by begin_run(), continue_run() or open().
  bool is_open() const;

  const std::string& path() const;
  /// Path of a file in the directory.
  std::string file(const std::string& name) const { return path() + "/" + name; }

 private:
  struct State;
  explicit OutputDirectory(std::shared_ptr<State> state) : state_(std::move(state)) {}
  void start(const std::vector<std::string>& names, bool has_to_exist, bool clears);

  std::shared_ptr<State> state_;
};

/// True if a run makes a file or directory of this name:
/// * summary.json, effective.xml, log.txt,
/// * newton.csv, history.csv, steps.jsonl, profiles.csv,
/// * fields.xdmf, fields, checkpoints, and fields.h5 of earlier versions,
/// * point.csv, point.svg, point.png.
bool is_run_file(const std::string& name);

}  // namespace mortise
