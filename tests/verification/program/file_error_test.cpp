// Scenes that cannot be read, results that cannot be written.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene_support.hpp"

namespace {

using namespace scene_support;

TEST(Files, AnEmptySceneIsAnInputError) {
  const Ending ending = run(files::path(SCRATCH) / "empty", "", 2);
  EXPECT_EQ(ending.code, 2) << ending.output;
  EXPECT_NE(ending.output.find("not well-formed XML"), std::string::npos) << ending.output;
}

TEST(Files, AMissingSceneIsAFileError) {
  for (const int ranks : {1, 2}) {
    const Ending ending = launch({MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", std::string(SCRATCH) + "/no_such_scene.xml"}, 60);
    EXPECT_EQ(ending.code, 5) << ending.output;
    EXPECT_NE(ending.output.find("no_such_scene.xml"), std::string::npos) << ending.output;
  }
}

TEST(Files, OutputThatCannotBeWrittenIsAFileError) {
  for (const int ranks : {1, 2}) {
    // A file stands where the directory should be: that stops root too.
    const files::path directory = files::path(SCRATCH) / fmt::format("unwritable_np{}", ranks);
    files::remove_all(directory);
    files::create_directories(directory);
    std::ofstream(directory / "scene.xml") << good_scene;
    std::ofstream(directory / "results") << "a file";
    const Ending ending = launch({MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", directory / "scene.xml", "-o", directory / "results"}, 60);
    EXPECT_EQ(ending.code, 5) << ending.output;
    EXPECT_NE(ending.output.find("results"), std::string::npos) << ending.output;
    EXPECT_EQ(read_file(directory / "results"), "a file");
  }
}

TEST(Files, ADeviceThatGivesNothingIsNamedForWhatItIs) {
  const Ending ending = launch({MORTISE, "check", "/dev/null"}, 60);
  EXPECT_EQ(ending.code, 5) << ending.output;
  EXPECT_NE(ending.output.find("no regular file"), std::string::npos) << ending.output;
}

TEST(Files, AFileWithoutEndIsNotReadForEver) {
  const Ending ending = launch({MORTISE, "check", "/dev/zero"}, 60);
  EXPECT_EQ(ending.code, 5) << ending.output;
  EXPECT_NE(ending.output.find("/dev/zero: cannot be read: it has more than 268435456 bytes"), std::string::npos) << ending.output;
}

TEST(Files, ADescriptionThatCannotBeWrittenIsAFileError) {
  const Ending ending = launch({MORTISE, "describe", "--format", "md", "-o", "/dev/full"}, 60);
  EXPECT_EQ(ending.code, 5) << ending.output;
  EXPECT_NE(ending.output.find("cannot write to the directory /dev/full"), std::string::npos) << ending.output;
}

TEST(Files, StandardOutputThatCannotBeWrittenIsAFileError) {
  const files::path directory = files::path(SCRATCH) / "full";
  files::remove_all(directory);
  files::create_directories(directory);
  const std::string scene = directory / "scene.xml", results = directory / "results";
  std::ofstream(scene) << good_scene;
  for (const std::string& words : {"check '" + scene + "'", "run '" + scene + "' -o '" + results + "'"}) {
    const Ending ending = launch({"bash", "-c", "exec '" MORTISE "' " + words + " 2>&1 >/dev/full"}, 60);
    EXPECT_EQ(ending.code, 5) << ending.output;
    EXPECT_NE(ending.output.find("cannot write to standard output; the results in files are complete"), std::string::npos) << ending.output;
  }
  EXPECT_TRUE(files::exists(directory / "results/summary.json"));
}

// Standard streams that are closed are none that files could take the numbers of.
TEST(Files, AProcessWithoutStandardStreamsWritesItsFilesAndNoMoreIntoThem) {
  const files::path directory = files::path(SCRATCH) / "closed";
  files::remove_all(directory);
  files::create_directories(directory);
  std::ofstream(directory / "scene.xml") << good_scene;
  const std::string run = std::string("'" MORTISE "' run '") + (directory / "scene.xml").string() + "' -o '" + directory.string();
  ASSERT_EQ(launch({"bash", "-c", "exec " + run + "/open'"}, 60).code, 0);
  for (const std::string closed : {"<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-"}) {
    const Ending ending = launch({"bash", "-c", "exec " + run + "/closed' " + closed}, 60);
    EXPECT_EQ(ending.code, 0) << closed << "\n" << ending.output;
    for (const char* name : {"history.csv", "effective.xml"})
      EXPECT_EQ(read_file(directory / "closed" / name), read_file(directory / "open" / name)) << closed << ", " << name;
    EXPECT_NE(read_file(directory / "closed/log.txt").find("results in"), std::string::npos) << closed;
  }
  EXPECT_EQ(launch({"bash", "-c", "exec '" MORTISE "' list materials <&- >&-"}, 60).code, 0);
  const std::string wait = "while [ \"$(cat '" + directory.string() + "/long/history.csv' 2>/dev/null | wc -l)\" -le 2 ]; do sleep 0.02; done; ";
  const Ending streams = launch({"bash", "-c",
                                 run + "/long' --set stepping/step=1e-5 <&- >&- 2>&- & run=$!; " + wait +
                                     "readlink /proc/$run/fd/0 /proc/$run/fd/1 /proc/$run/fd/2; kill -KILL $run; wait $run 2>/dev/null"},
                                60);
  EXPECT_EQ(streams.output, "/dev/null\n/dev/null\n/dev/null\n");
}

}  // namespace
