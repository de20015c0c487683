#pragma once
// Files that a run can go on from: values by name and tables by ids, in HDF5, with a checksum.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/state_archive.hpp"

namespace mortise {

/// Writes one file, which appears whole or not at all. Members are collective and throw FileError on all ranks.
///
/// The file is HDF5, with what each rank owns written in parallel.
/// /values/<name>  [count], equal on every rank
/// /values/text.<name>  [bytes], equal on every rank
///   /rows/<name>    [rows x columns], and /ids/<name of the rows>, the id of each row
///
/// Behind the end of HDF5's own data stands one line with version, length and checksum of what comes before.
class CheckpointWriter final : public StateArchive {
 public:
  /// Begins the file <path>.part.
  CheckpointWriter(RCP<const Communicator> comm, std::string path);
  /// Removes what was not finished.
  ~CheckpointWriter() override;

  bool restores() const override { return false; }
  void values(const std::string& name, std::vector<double>& values) override;
  void text(const std::string& name, std::string& text) override;
  void rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) override;
  void refuse_if(const std::optional<std::string>& wrong) override;

  /// Puts the checksum behind, waits until the disk has it all, and gives the file its name.
  /// @return its size in bytes
  std::uintmax_t finish();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Reads such a file, on any number of ranks. Members are collective and throw FileError on all ranks.
class CheckpointReader final : public StateArchive {
 public:
  /// Looks whether the file is whole: length and checksum.
  CheckpointReader(RCP<const Communicator> comm, std::string path);
  ~CheckpointReader() override;

  bool restores() const override { return true; }
  void values(const std::string& name, std::vector<double>& values) override;
  void text(const std::string& name, std::string& text) override;
  void rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) override;
  void refuse_if(const std::optional<std::string>& wrong) override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Error message for a file as a checkpoint: no such file, too short, another version, another checksum. None: it is whole. Collective.
std::optional<std::string> checkpoint_damage(const Communicator& comm, const std::string& path);

}  // namespace mortise
