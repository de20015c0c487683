// Rules by which a directory for results lets files be replaced and removed, and by whom.

#include "mortise/io/output_directory.hpp"

#include <gmock/gmock.h>

#include <Tpetra_Core.hpp>
#include <cstdlib>

#include "file_error.hpp"
#include "mortise/core/error.hpp"
#include "mortise/io/output_file.hpp"
#include "scratch_directory.hpp"

namespace mortise {
namespace {

namespace files = std::filesystem;
using test::content;
using test::file_error;
using ::testing::AllOf;
using ::testing::HasSubstr;

RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }

/// Rank 0 acts, the others wait.
template <class Action>
void on_first_rank(const Action& action) {
  if (world()->getRank() == 0) action();
  world()->barrier();
}

void write(const std::string& path, const std::string& text = "theirs") { std::ofstream(path) << text; }

/// A directory that a run began, with these files of its own; nobody holds it.
void make_run(const std::string& path, const std::vector<std::string>& names, const Origin& origin = {"run"}) {
  OutputDirectory directory(world(), path, origin);
  directory.begin_run();
  for (const auto& name : names) {
    const std::string file = directory.claim(name);
    on_first_rank([&] { write(file, "ours"); });
  }
}

TEST(OutputDirectory, IsMadeWithItsParentsWhenARunBegins) {
  const test::ScratchDirectory scratch(world());
  OutputDirectory directory(world(), scratch.file("results/patch"));
  EXPECT_TRUE(files::is_empty(scratch.path())) << "nothing may be made before";
  world()->barrier();
  directory.begin_run();
  EXPECT_TRUE(files::is_directory(directory.path()));
  EXPECT_EQ(directory.file("log.txt"), scratch.file("results/patch") + "/log.txt");
  EXPECT_EQ(directory.claim("log.txt"), directory.file("log.txt"));
}

TEST(OutputDirectory, IsNeitherTheRootNorTheHomeDirectory) {
  const test::ScratchDirectory home(world());
  const char* former = std::getenv("HOME");
  const std::string kept = former != nullptr ? former : "";
  setenv("HOME", home.path().c_str(), 1);
  EXPECT_THAT(file_error([] { OutputDirectory(world(), "/"); }), HasSubstr("the root of the file system"));
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), home.path() + "/below/.."); }), HasSubstr("your home directory"));
  EXPECT_NO_THROW(OutputDirectory(world(), home.file("results")));
  world()->barrier();
  setenv("HOME", kept.c_str(), 1);
}

// The list is on the disk when sync() returns, with all above and below it; a later name is added to it there.
TEST(OutputDirectory, KeepsItsListThroughSync) {
  const test::ScratchDirectory scratch(world());
  OutputDirectory directory(world(), scratch.file("deep/results"));
  directory.begin_run();
  OutputDirectory below = directory.subdirectory("fields");
  below.claim("mesh.h5");
  below.sync();
  directory.claim("late.txt");
  EXPECT_THAT(content(directory.file(".mortise")), AllOf(HasSubstr("fields\n"), HasSubstr("late.txt\n")));
  EXPECT_THAT(content(below.file(".mortise")), HasSubstr("mesh.h5\n"));
}

TEST(OutputDirectory, ANameIsListedBeforeItsFileIsMade) {
  const test::ScratchDirectory scratch(world());
  OutputDirectory directory(world(), scratch.path(), {"run", scratch.file("of/scene.xml")});
  directory.begin_run();
  directory.claim("log.txt");
  directory.claim("log.txt");
  directory.subdirectory("fields").claim("mesh.h5");
  world()->barrier();
  EXPECT_THAT(content(scratch.file(".mortise")), ::testing::EndsWith("\n# holds: run\n# of: of/scene.xml\nlog.txt\nfields\n"));
  EXPECT_THAT(content(scratch.file("fields/.mortise")), ::testing::EndsWith("\nmesh.h5\n"));
  EXPECT_FALSE(files::exists(scratch.file("log.txt")));
}

TEST(OutputDirectory, ASeriesIsListedOnceAndRemovedWhole) {
  const test::ScratchDirectory scratch(world());
  {
    OutputDirectory directory(world(), scratch.path(), {"run"});
    directory.begin_run();
    OutputDirectory steps = directory.subdirectory("fields");
    for (int step = 8; step < 12; ++step) {
      steps.claim("step-*.h5");
      on_first_rank([&] { write(steps.file("step-" + std::to_string(step) + ".h5"), "ours"); });
    }
    on_first_rank([&] {
      const std::string list = content(steps.file(".mortise"));
      EXPECT_EQ(list.find("step-"), list.rfind("step-"));
      for (const char* name : {"step-.h5", "step-x.h5", "step-1.h5.old"}) write(steps.file(name));
      write(steps.file("step-12.h5.part"), "ours");
    });
  }
  OutputDirectory(world(), scratch.path(), {"run"}).begin_run();
  for (const char* name : {"step-8.h5", "step-11.h5", "step-12.h5.part"})
    EXPECT_FALSE(files::exists(scratch.file(std::string("fields/") + name))) << name;
  for (const char* name : {"step-.h5", "step-x.h5", "step-1.h5.old"}) EXPECT_TRUE(files::exists(scratch.file(std::string("fields/") + name))) << name;
}

TEST(OutputDirectory, ReplacesARunWholeAndLeavesTheRest) {
  const test::ScratchDirectory scratch(world());
  make_run(scratch.path(), {"summary.json", "fields.h5"});
  on_first_rank([&] {
    write(scratch.file("summary.json.part"), "half");
    write(scratch.file("notes.txt"));
  });
  OutputDirectory directory(world(), scratch.path(), {"run"});
  EXPECT_EQ(content(scratch.file("summary.json")), "ours") << "opening must not remove anything";
  world()->barrier();
  directory.begin_run();
  for (const char* name : {"summary.json", "fields.h5", "summary.json.part"}) EXPECT_FALSE(files::exists(scratch.file(name))) << name;
  EXPECT_TRUE(files::exists(scratch.file("notes.txt")));
}

TEST(OutputDirectory, WhatItDidNotMakeIsRefusedBeforeAnythingIsRemoved) {
  const test::ScratchDirectory scratch(world());
  make_run(scratch.path(), {"summary.json"});
  for (const char* name : {"history.csv", "history.csv.part", "fields", "runs"}) {
    on_first_rank([&] { write(scratch.file(name)); });
    const auto begin = [&] { OutputDirectory(world(), scratch.path(), {"run"}).begin_run({"runs"}); };
    EXPECT_THAT(file_error(begin),
                AllOf(HasSubstr(scratch.path()), HasSubstr(name), HasSubstr("choose another directory"), HasSubstr("move it away")));
    EXPECT_EQ(content(scratch.file(name)), "theirs");
    EXPECT_EQ(content(scratch.file("summary.json")), "ours");
    world()->barrier();
    on_first_rank([&] { files::remove(scratch.file(name)); });
  }
  EXPECT_NO_THROW(OutputDirectory(world(), scratch.path(), {"run"}).begin_run({"runs"}));
}

TEST(OutputDirectory, ANameThatIsTakenCannotBeClaimed) {
  const test::ScratchDirectory scratch(world());
  OutputDirectory directory(world(), scratch.path());
  directory.open();
  on_first_rank([&] {
    write(scratch.file("table.csv"));
    files::create_directory(scratch.file("runs"));
  });
  EXPECT_THAT(file_error([&] { directory.claim("table.csv"); }), HasSubstr("table.csv"));
  EXPECT_THAT(file_error([&] { directory.subdirectory("runs"); }), HasSubstr("runs"));
  EXPECT_THAT(file_error([&] { directory.remove("table.csv"); }), HasSubstr("table.csv"));
  EXPECT_EQ(content(scratch.file("table.csv")), "theirs");
}

TEST(OutputDirectory, WhatWasNotMadeMayBecomeAnothers) {
  const test::ScratchDirectory scratch(world());
  make_run(scratch.path(), {"summary.json"});
  {
    OutputDirectory directory(world(), scratch.path(), {"run"});
    directory.continue_run();
    directory.claim("point.svg");
    directory.strike_missing();
  }
  on_first_rank([&] { write(scratch.file("point.svg")); });
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.path(), {"run"}).begin_run(); }), HasSubstr("point.svg"));
  EXPECT_EQ(content(scratch.file("summary.json")), "ours");
}

TEST(OutputDirectory, ASeriesIsMadeOnceAFileOfItIs) {
  const test::ScratchDirectory scratch(world());
  {
    OutputDirectory directory(world(), scratch.path());
    directory.open();
    directory.claim("at-*.png");
    directory.claim("never-*.png");
    on_first_rank([&] { write(scratch.file("at-000012.png")); });
    directory.strike_missing();
  }
  on_first_rank([&] { write(scratch.file("never-000012.png")); });
  OutputDirectory directory(world(), scratch.path());
  directory.open({"at-*.png"});
  EXPECT_THAT(file_error([&] { directory.claim("never-*.png"); }), HasSubstr("never"));
  directory.remove("at-*.png");
  EXPECT_FALSE(files::exists(scratch.file("at-000012.png")));
}

TEST(OutputFile, IsADirectoryAndANameInIt) {
  const auto of = [](const std::string& path) {
    const OutputFile file = output_file(path, {".png", ".gif"});
    return file.directory + "|" + file.name;
  };
  EXPECT_EQ(of("a.png"), ".|a.png");
  EXPECT_EQ(of("./a.gif"), ".|a.gif");
  EXPECT_EQ(of("/a b/c.d/e.png"), "/a b/c.d|e.png");
  EXPECT_EQ(of("/e.png"), "/|e.png");
  for (const std::string wrong : {"", "a", "a.jpg", "a.png/", ".png", "x/.gif", "a.PNG", "a.png.part"})
    EXPECT_THAT([&] { of(wrong); }, testing::ThrowsMessage<InputError>(HasSubstr("ends in .png or .gif"))) << wrong;
  for (const std::string& wrong : {std::string("a*.png"), std::string("#a.png"), std::string("a\n.png"), std::string(252, 'a') + ".png"})
    EXPECT_THAT([&] { of(wrong); }, testing::ThrowsMessage<InputError>(HasSubstr("cannot be the name"))) << wrong;
}

TEST(OutputDirectory, RemovesOnlyWhatListsBelowItHave) {
  const test::ScratchDirectory scratch(world());
  {
    OutputDirectory directory(world(), scratch.path());
    directory.open();
    OutputDirectory runs = directory.subdirectory("runs");
    for (const char* name : {"first", "second"}) {
      OutputDirectory run = runs.subdirectory(name);
      const std::string file = run.claim("summary.json");
      on_first_rank([&] { write(file, "ours"); });
    }
  }
  on_first_rank([&] {
    write(scratch.file("runs/second/notes.txt"));
    files::create_directories(scratch.file("runs/third"));
    write(scratch.file("runs/third/summary.json"));
  });
  OutputDirectory directory(world(), scratch.path());
  directory.open();
  directory.remove("runs");
  EXPECT_FALSE(files::exists(scratch.file("runs/first")));
  EXPECT_FALSE(files::exists(scratch.file("runs/second/summary.json")));
  EXPECT_EQ(content(scratch.file("runs/second/notes.txt")), "theirs");
  EXPECT_EQ(content(scratch.file("runs/third/summary.json")), "theirs");
  world()->barrier();
  // The files that stayed are still in the program's directory.
  EXPECT_NO_THROW(directory.subdirectory("runs").subdirectory("second").claim("summary.json"));
  EXPECT_THAT(file_error([&] { directory.subdirectory("runs").subdirectory("third"); }), HasSubstr("third"));
}

TEST(OutputDirectory, FollowsNoLinkToRemove) {
  const test::ScratchDirectory scratch(world()), elsewhere(world(), "elsewhere");
  make_run(elsewhere.path(), {"summary.json"});
  {
    OutputDirectory directory(world(), scratch.path());
    directory.open();
    directory.claim("file"), directory.claim("runs");
  }
  on_first_rank([&] {
    files::create_symlink(elsewhere.path(), scratch.file("runs"));
    files::create_symlink(elsewhere.file("summary.json"), scratch.file("file"));
  });
  OutputDirectory(world(), scratch.path()).begin_run();
  EXPECT_FALSE(files::is_symlink(scratch.file("runs")));
  EXPECT_FALSE(files::is_symlink(scratch.file("file")));
  EXPECT_EQ(content(elsewhere.file("summary.json")), "ours");
}

TEST(OutputDirectory, AListThatNamesWhatIsElsewhereIsRefused) {
  const test::ScratchDirectory scratch(world());
  make_run(scratch.file("run"), {"summary.json"});
  const std::string list = content(scratch.file("run/.mortise"));
  for (const char* name : {"../victim", "/etc/passwd", "..", "a/b", ".mortise", ""}) {
    on_first_rank([&] {
      write(scratch.file("victim"));
      write(scratch.file("run/.mortise"), list + name + "\n");
    });
    EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.file("run")).begin_run(); }), HasSubstr("no name of a file")) << name;
    EXPECT_EQ(content(scratch.file("victim")), "theirs");
    world()->barrier();
  }
  on_first_rank([&] { write(scratch.file("run/.mortise"), "summary.json\n"); });
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.file("run")).begin_run(); }), HasSubstr("does not begin as a list"));
}

TEST(OutputDirectory, GoesOnOnlyWhereARunWas) {
  const test::ScratchDirectory scratch(world());
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.path(), {"run"}).continue_run(); }), HasSubstr("no results to go on with"));
  make_run(scratch.path(), {"history.csv"});
  OutputDirectory directory(world(), scratch.path(), {"run"});
  directory.continue_run();
  EXPECT_EQ(content(directory.claim("history.csv")), "ours");
}

TEST(OutputDirectory, ResultsOfAnotherKindOrFileStay) {
  const test::ScratchDirectory scratch(world());
  const std::string results = scratch.file("results");
  make_run(results, {"summary.json"}, {"run", scratch.file("a/press.xml")});
  const auto begin = [&](const Origin& origin) { OutputDirectory(world(), results, origin).begin_run(); };
  EXPECT_THAT(file_error([&] { begin({"study", scratch.file("a/press.xml")}); }), AllOf(HasSubstr("\"run\""), HasSubstr("\"study\"")));
  EXPECT_THAT(file_error([&] {
                begin({"run", scratch.file("b/press.xml"), true});
              }),
              AllOf(HasSubstr(scratch.file("a/press.xml")), HasSubstr(scratch.file("b/press.xml")), HasSubstr("-o")));
  EXPECT_EQ(content(scratch.file("results/summary.json")), "ours");
  world()->barrier();
  EXPECT_NO_THROW(begin({"run", scratch.file("a/press.xml"), true}));
  EXPECT_NO_THROW(begin({"run", scratch.file("b/press.xml")}));
}

TEST(OutputDirectory, IsWrittenByOneAtATime) {
  const test::ScratchDirectory scratch(world());
  {
    OutputDirectory first(world(), scratch.path(), {"run"});
    first.begin_run();
    const OutputDirectory below = first.subdirectory("fields");
    first = OutputDirectory(world(), scratch.file("elsewhere"));  // the one below holds the lock still
    const auto named = AllOf(HasSubstr("is being written by process "), HasSubstr(" on host "), HasSubstr("choose another directory"));
    EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.path(), {"run"}); }), named);
  }
  world()->barrier();  // rank 0 has given it up
  EXPECT_FALSE(files::exists(scratch.file(".mortise.lock")));
  world()->barrier();
  EXPECT_NO_THROW(OutputDirectory(world(), scratch.path(), {"run"}).begin_run());
}

TEST(OutputDirectory, WhatIsWrittenBelowIsNotRemoved) {
  const test::ScratchDirectory scratch(world());
  OutputDirectory directory(world(), scratch.path());
  directory.open();
  OutputDirectory(directory.subdirectory("runs").subdirectory("first"));
  OutputDirectory run(world(), scratch.file("runs/first"), {"run"});
  run.begin_run();
  EXPECT_THAT(file_error([&] { directory.remove("runs"); }), AllOf(HasSubstr("runs/first"), HasSubstr("is being written by")));
  EXPECT_TRUE(files::exists(scratch.file("runs/first/.mortise")));
}

TEST(OutputDirectory, KeepRefusesARun) {
  const test::ScratchDirectory scratch(world());
  EXPECT_NO_THROW(OutputDirectory(world(), scratch.path(), {"run"}, true));
  make_run(scratch.path(), {"newton.csv"});
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.path(), {"run"}, true); }),
              AllOf(HasSubstr(scratch.path()), HasSubstr("newton.csv")));
}

TEST(OutputDirectory, ALinkToNothingIsNamedWithItsTarget) {
  const test::ScratchDirectory scratch(world());
  on_first_rank([&] {
    files::create_symlink("on_a_disk/results", scratch.file("link"));
    files::create_directory(scratch.file("there"));
    files::create_symlink("there", scratch.file("whole"));
  });
  for (const char* path : {"link", "link/below"})
    EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.file(path)); }),
                AllOf(HasSubstr(scratch.file("link") + " is a symbolic link to on_a_disk/results, which does not exist"), HasSubstr("(-o)")));
  EXPECT_FALSE(files::exists(scratch.file("on_a_disk")));
  EXPECT_NO_THROW(OutputDirectory(world(), scratch.file("whole/below")).begin_run());
}

TEST(OutputDirectory, WhatIsNoDirectoryIsRefused) {
  const test::ScratchDirectory scratch(world());
  on_first_rank([&] { write(scratch.file("taken")); });
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.file("taken")); }), HasSubstr("not a directory"));
  EXPECT_THAT(file_error([&] { OutputDirectory(world(), scratch.file("taken/below")); }), HasSubstr(scratch.file("taken/below")));
}

}  // namespace
}  // namespace mortise
