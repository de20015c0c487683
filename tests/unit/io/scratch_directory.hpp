#pragma once
// An empty directory for the files of one test, removed at its end.

#include <gtest/gtest.h>
#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "mortise/core/types.hpp"

namespace mortise::test {

/// The same path on all ranks; made on rank 0. Collective.
class ScratchDirectory {
 public:
  explicit ScratchDirectory(RCP<const Communicator> comm, const std::string& name = "test") : comm_(std::move(comm)) {
    long process = getpid();
    Teuchos::broadcast(*comm_, 0, Teuchos::outArg(process));
    path_ = (std::filesystem::temp_directory_path() / ("mortise-io-" + name + "-" + std::to_string(process))).string();
    if (comm_->getRank() == 0) {
      std::filesystem::remove_all(path_);
      std::filesystem::create_directories(path_);
    }
    comm_->barrier();
  }
  ~ScratchDirectory() {
    comm_->barrier();
    std::error_code ignored;
    if (comm_->getRank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  RCP<const Communicator> comm_;
  std::string path_;
};

inline std::string content(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace mortise::test
