// Inputs that fuzzing found, and those it began with: none may do anything but be read or be refused with a message.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fuzz_targets.hpp"

namespace mortise::fuzz {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class FuzzCorpus : public ::testing::TestWithParam<std::string> {};

TEST_P(FuzzCorpus, IsReadOrRefused) {
  const Target& one = target(GetParam());
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(CORPUS) / one.name)) {
    ++count;
    EXPECT_NO_THROW(read_or_refuse(one, content(entry.path()))) << entry.path();
  }
  EXPECT_GT(count, 0);
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, ::testing::Values("scene", "point", "study", "expression", "checkpoint", "gmsh", "abaqus", "exodus"),
                         [](const auto& info) { return info.param; });

TEST(FuzzTargets, AllHaveACorpus) {
  for (const Target& one : targets()) EXPECT_TRUE(std::filesystem::is_directory(std::filesystem::path(CORPUS) / one.name)) << one.name;
}

// Data that the target of checkpoints asks for is in the files that the program writes, and in those that it makes from bytes.
TEST(FuzzTargets, AWholeCheckpointIsRestored) {
  EXPECT_EQ(restore_checkpoint(written_checkpoint()), std::vector<std::string>());
  EXPECT_EQ(restore_checkpoint(checkpoint_file(whole_checkpoint())), std::vector<std::string>());
  EXPECT_EQ(whole_checkpoint(), content(std::filesystem::path(CORPUS) / "checkpoint/whole"));
}

}  // namespace
}  // namespace mortise::fuzz
