// Files that rank 0 writes for all, and what happens on all ranks if it cannot.

#include "mortise/io/files.hpp"

#include <gmock/gmock.h>

#include <Tpetra_Core.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "file_error.hpp"
#include "file_size_limit.hpp"
#include "mortise/core/error.hpp"
#include "mortise/io/csv_writer.hpp"
#include "scratch_directory.hpp"

namespace mortise {
namespace {

using test::content;
using test::file_error;
using ::testing::AllOf;
using ::testing::HasSubstr;

RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }

TEST(Files, ErrorOfOneRankReachesAll) {
  const auto comm = world();
  const int last = comm->getSize() - 1;
  const auto reason = comm->getRank() == last ? std::optional<std::string>("the disk is full") : std::nullopt;
  EXPECT_EQ(file_error([&] { throw_if_any_file_error(*comm, "cannot write", "a/b", reason); }), "cannot write a/b: the disk is full");
  EXPECT_NO_THROW(throw_if_any_file_error(*comm, "cannot write", "a/b", std::nullopt));
}

TEST(Files, JsonIsReplacedWholeAndReadsBackExactly) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("summary.json");
  const double third = 1.0 / 3.0, tiny = 4.9e-324;
  write_json(*world(), path, {{"old", std::string(100000, 'x')}});
  write_json(*world(), path, {{"third", third}, {"tiny", tiny}, {"nothing", std::nan("")}, {"text", "bad \xff byte"}});
  world()->barrier();
  const auto json = nlohmann::json::parse(content(path));
  EXPECT_EQ(json["third"].get<double>(), third);
  EXPECT_EQ(json["tiny"].get<double>(), tiny);
  EXPECT_TRUE(json["nothing"].is_null());
  EXPECT_FALSE(json.contains("old"));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(Files, AReplacementGoesThroughNoLink) {
  const test::ScratchDirectory scratch(world());
  if (world()->getRank() != 0) return;
  std::ofstream(scratch.file("theirs")) << "theirs";
  std::filesystem::create_symlink("theirs", scratch.file("ours.part"));
  EXPECT_EQ(replace_file(scratch.file("ours"), "ours"), std::nullopt);
  EXPECT_EQ(content(scratch.file("theirs")), "theirs");
  EXPECT_EQ(content(scratch.file("ours")), "ours");
}

TEST(Files, EndOfAFileIsReplacedOrKept) {
  const test::ScratchDirectory scratch(world());
  if (world()->getRank() != 0) return;
  const std::string path = scratch.file("index");
  ASSERT_EQ(replace_file(path, "head tail"), std::nullopt);
  EXPECT_EQ(replace_end_of_file(path, 5, "one tail"), std::nullopt);
  EXPECT_EQ(content(path), "head one tail");
  EXPECT_EQ(replace_end_of_file(path, 9, "."), std::nullopt);
  EXPECT_EQ(content(path), "head one .");
  {
    const test::FileSizeLimit limit(20);
    EXPECT_THAT(replace_end_of_file(path, 9, std::string(100, 'x')), ::testing::Optional(std::string("File too large")));
  }
  EXPECT_EQ(content(path), "head one .");
  EXPECT_THAT(replace_end_of_file(scratch.file("none"), 0, "a"), ::testing::Optional(std::string("No such file or directory")));
}

TEST(Files, UnwritablePathNamesPathAndReasonOnAllRanks) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("no/such/directory/summary.json");
  EXPECT_THAT(file_error([&] { write_json(*world(), path, {}); }), AllOf(HasSubstr(path), HasSubstr("No such file or directory")));
  EXPECT_THAT(file_error([&] { CsvWriter(world(), path, {"a"}); }), AllOf(HasSubstr(path), HasSubstr("No such file or directory")));
}

TEST(Files, DiskFullIsAnErrorOfTheRow) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT(file_error([&] { CsvWriter(world(), "/dev/full", {"a"}); }), HasSubstr("No space left on device"));
}

TEST(CsvWriter, NumbersReadBackExactlyAndTextIsQuoted) {
  const test::ScratchDirectory scratch(world());
  CsvWriter csv(world(), scratch.file("history.csv"), {"time", "peak, pressure", "count"});
  const double value = 0.1 + 0.2;
  csv.row({value, std::string("say \"no\""), 12345678901LL});
  world()->barrier();
  EXPECT_EQ(content(csv.path()), "time,\"peak, pressure\",count\n0.30000000000000004,\"say \"\"no\"\"\",12345678901\n");
  world()->barrier();  // nobody is to read the next row yet
  csv.row({-1e-300, std::numeric_limits<double>::quiet_NaN(), 0LL});
  world()->barrier();
  EXPECT_THAT(content(csv.path()), ::testing::EndsWith("\n-1e-300,nan,0\n"));
  EXPECT_THAT(file_error([&] { csv.row({1.0}); }), HasSubstr("1 values for 3 columns"));
}

TEST(CsvWriter, RowThatDoesNotFitOnTheDiskLeavesNoHalfLine) {
  const test::ScratchDirectory scratch(world());
  CsvWriter csv(world(), scratch.file("history.csv"), {"step", "note"});
  csv.row({1LL, std::string("first")});
  const std::string before = "step,note\n1,first\n";
  {
    const test::FileSizeLimit limit(40);
    EXPECT_THAT(file_error([&] {
                  csv.rows({{2LL, std::string("second")}, {3LL, std::string(100, 'x')}});
                }),
                AllOf(HasSubstr("history.csv"), HasSubstr("File too large")));
    world()->barrier();
    EXPECT_EQ(content(csv.path()), before);
    EXPECT_EQ(csv.size(), before.size());
  }
  csv.row({2LL, std::string("second")});
  world()->barrier();
  EXPECT_EQ(content(csv.path()), before + "2,second\n");
}

TEST(CsvWriter, ContinuedTableIsThatOfOneRun) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("history.csv");
  const std::vector<std::string> columns{"step", "note"};
  std::uintmax_t kept = 0;
  {
    CsvWriter csv(world(), path, columns);
    csv.row({1LL, std::string("two\nlines")});
    kept = csv.size();
    csv.row({2LL, std::string("is to go")});
    EXPECT_NO_THROW(csv.sync());
    EXPECT_EQ(csv.size(), kept + 11);
  }
  CsvWriter csv(world(), path, columns, kept);
  csv.row({2LL, std::string("again")});
  world()->barrier();
  EXPECT_EQ(content(path), "step,note\n1,\"two\nlines\"\n2,again\n");
  EXPECT_EQ(csv.size(), content(path).size());
}

TEST(CsvWriter, WhatCannotBeContinuedIsLeftAsItIs) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("history.csv");
  { CsvWriter(world(), path, {"a", "b"}).row({1LL, 2LL}); }
  world()->barrier();
  const auto refusal = [&](const std::vector<std::string>& columns, std::uintmax_t at) {
    return file_error([&] { CsvWriter(world(), path, columns, at); });
  };
  EXPECT_THAT(refusal({"a", "b"}, 9), AllOf(HasSubstr("cannot continue " + path), HasSubstr("it has 8 bytes"), HasSubstr("had written 9")));
  EXPECT_THAT(refusal({"a", "b"}, 7), HasSubstr("a line goes on at byte 7"));
  EXPECT_THAT(refusal({"a", "b"}, 3), HasSubstr("less than its header line, which takes 4"));
  EXPECT_THAT(refusal({"a", "c"}, 8), AllOf(HasSubstr("\"a,b\""), HasSubstr("\"a,c\"")));
  EXPECT_THAT(file_error([&] { CsvWriter(world(), scratch.file("none"), {"a"}, 2); }), HasSubstr("No such file"));
  EXPECT_EQ(content(path), "a,b\n1,2\n");
}

TEST(Files, FilesAndDirectoriesAreBroughtToTheDisk) {
  const test::ScratchDirectory scratch(world());
  if (world()->getRank() != 0) return;
  ASSERT_EQ(replace_file(scratch.file("a"), "text"), std::nullopt);
  EXPECT_EQ(sync_file(scratch.file("a")), std::nullopt);
  EXPECT_EQ(sync_directory(scratch.path()), std::nullopt);
  EXPECT_THAT(sync_file(scratch.file("b")), ::testing::Optional(std::string("No such file or directory")));
  EXPECT_THAT(sync_directory(scratch.file("a")), ::testing::Optional(std::string("Not a directory")));
}

}  // namespace
}  // namespace mortise
