// Files that a run can go on from: what comes back, on other numbers of ranks too, and what damage does.

#include "mortise/io/checkpoint_file.hpp"

#include <gmock/gmock.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "file_error.hpp"
#include "mortise/core/error.hpp"
#include "scratch_directory.hpp"

namespace mortise {
namespace {

using test::content;
using test::file_error;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }

constexpr GlobalOrdinal count = 37;

/// A number that tells its id and column.
double number(GlobalOrdinal id, std::size_t column) { return std::sqrt(static_cast<double>(id)) + 100.0 * static_cast<double>(column); }

/// Ids 5, 8, 11, ..., dealt out to the ranks like cards; each rank sees those of the next one as well.
RowIds some_ids(const Communicator& comm) {
  RowIds ids{"cards", {}, 0};
  for (const int ghost : {0, 1})
    for (GlobalOrdinal n = 0; n < count; ++n)
      if (n % comm.getSize() == (comm.getRank() + ghost) % comm.getSize() && (ghost == 0 || comm.getSize() > 1)) {
        ids.ids.push_back(5 + 3 * n);
        ids.owned += ghost == 0;
      }
  return ids;
}

std::vector<double> some_rows(const RowIds& ids, std::size_t columns) {
  std::vector<double> rows;
  for (const GlobalOrdinal id : ids.ids)
    for (std::size_t c = 0; c < columns; ++c) rows.push_back(number(id, c));
  return rows;
}

const std::vector<double> awkward{1.0 / 3.0, -0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::denorm_min()};

void write_all(const RCP<const Communicator>& comm, const std::string& path) {
  CheckpointWriter file(comm, path);
  std::vector<double> values = awkward, none;
  file.values("awkward", values);
  file.values("none", none);
  std::string text("a\0b\xff\n", 5), empty;
  file.text("text", text);
  file.text("empty", empty);
  const RowIds ids = some_ids(*comm);
  std::vector<double> rows = some_rows(ids, 3);
  file.rows("table", ids, 3, rows);
  std::vector<std::vector<double>> ragged;
  for (const GlobalOrdinal id : ids.ids) ragged.emplace_back(static_cast<std::size_t>(id % 4), static_cast<double>(id));
  serialize(file, *comm, "ragged", ids, ragged);
  EXPECT_GT(file.finish(), 0U);
}

void expect_all(const RCP<const Communicator>& comm, const std::string& path) {
  CheckpointReader file(comm, path);
  std::vector<double> values, none{1.0};
  file.values("awkward", values);
  EXPECT_EQ(values, awkward);
  EXPECT_TRUE(std::signbit(values[1]));
  file.values("none", none);
  EXPECT_THAT(none, IsEmpty());
  std::string text, empty("x");
  file.text("text", text);
  EXPECT_EQ(text, std::string("a\0b\xff\n", 5));
  file.text("empty", empty);
  EXPECT_EQ(empty, "");
  const RowIds ids = some_ids(*comm);
  std::vector<double> rows;
  file.rows("table", ids, 3, rows);
  EXPECT_EQ(rows, some_rows(ids, 3));
  std::vector<std::vector<double>> ragged;
  serialize(file, *comm, "ragged", ids, ragged);
  ASSERT_EQ(ragged.size(), ids.ids.size());
  for (std::size_t n = 0; n < ragged.size(); ++n)
    EXPECT_EQ(ragged[n], std::vector<double>(static_cast<std::size_t>(ids.ids[n] % 4), static_cast<double>(ids.ids[n])));
}

TEST(CheckpointFile, GivesBackWhatItTookOnOtherNumbersOfRanksToo) {
  const test::ScratchDirectory scratch(world());
  const int rank = world()->getRank();
  const RCP<const Communicator> alone = world()->split(rank, 0);
  const std::string by_all = scratch.file("all.h5"), by_one = scratch.file("one.h5");
  write_all(world(), by_all);
  if (rank == 0) write_all(alone, by_one);
  world()->barrier();
  for (const std::string& path : {by_all, by_one}) {
    expect_all(world(), path);
    expect_all(alone, path);
  }
}

TEST(CheckpointFile, AVectorComesBackInBits) {
  const test::ScratchDirectory scratch(world());
  const auto map = rcp(new Map(100, 0, world()));
  Vector stored(map), restored(map);
  stored.randomize();
  {
    CheckpointWriter file(world(), scratch.file("vector.h5"));
    serialize(file, "x", "unknowns", stored);
    file.finish();
  }
  CheckpointReader file(world(), scratch.file("vector.h5"));
  serialize(file, "x", "unknowns", restored);
  restored.update(-1.0, stored, 1.0);
  EXPECT_EQ(restored.normInf(), 0.0);
}

TEST(CheckpointFile, WhatIsNotFinishedLeavesTheFormerFile) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("kept.h5");
  write_all(world(), path);
  world()->barrier();
  const std::string before = content(path);
  {
    CheckpointWriter file(world(), path);
    std::vector<double> values(1000, 1.0);
    file.values("many", values);
  }
  world()->barrier();
  EXPECT_EQ(content(path), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(std::filesystem::path(path).parent_path()), {}), 1);
}

TEST(CheckpointFile, NamesWhatItLacks) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("some.h5");
  write_all(world(), path);
  CheckpointReader file(world(), path);
  std::vector<double> values;
  EXPECT_THAT(file_error([&] { file.values("other", values); }), HasSubstr("it has no \"/values/other\""));
  RowIds ids = some_ids(*world());
  EXPECT_THAT(file_error([&] { file.rows("table", ids, 2, values); }), HasSubstr("\"table\" has 37 x 3 numbers; expected are 37 x 2"));
  ids.name = "other cards";
  EXPECT_THAT(file_error([&] { file.rows("table", ids, 3, values); }), HasSubstr("it has no \"/ids/other cards\""));
  RowIds more = some_ids(*world());
  if (world()->getRank() == world()->getSize() - 1) more.ids.push_back(6);
  CheckpointReader again(world(), path);
  EXPECT_THAT(file_error([&] { again.rows("table", more, 3, values); }), HasSubstr("lack the id 6: it is of another mesh"));
  double one = 0.0;
  EXPECT_THAT(file_error([&] { serialize(again, "awkward", one); }), HasSubstr("4 numbers \"awkward\""));
}

// A checksum can be right and what it is of still nonsense: no count and no size is believed.
TEST(CheckpointFile, RefusesNumbersThatNothingCanBe) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("nonsense.h5");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RowIds ids = some_ids(*world());
  {
    CheckpointWriter file(world(), path);
    std::vector<double> huge{1e300}, letters{65.0, 256.0}, negative{-1.0}, many{1e12}, two{2.0}, rows(ids.ids.size(), 1.0),
        ragged(3 * ids.ids.size(), 1.0);
    file.values("huge", huge);
    file.values("negative", negative);
    file.values("text.letters", letters);
    if (world()->getRank() == world()->getSize() - 1) rows[ids.owned - 1] = nan, ragged[3 * (ids.owned - 1)] = 3.0;
    file.rows("states", ids, 1, rows);
    file.values("wide.longest", many);
    file.rows("wide", ids, 3, ragged);
    file.values("ragged.longest", two);
    file.rows("ragged", ids, 3, ragged);
    file.finish();
  }
  CheckpointReader file(world(), path);
  int whole = 0;
  std::size_t size = 0;
  std::string text;
  EXPECT_THAT(file_error([&] { serialize(file, "huge", whole); }), HasSubstr("\"huge\" holds 1e+300"));
  EXPECT_THAT(file_error([&] { serialize(file, "negative", size); }), HasSubstr("\"negative\" holds -1"));
  EXPECT_THAT(file_error([&] { file.text("letters", text); }), HasSubstr("\"text.letters\" holds 256"));
  std::vector<int> states;
  EXPECT_THAT(file_error([&] { serialize(file, "states", ids, states); }), HasSubstr("\"states\" holds nan"));
  std::vector<std::vector<double>> ragged;
  EXPECT_THAT(file_error([&] { serialize(file, *world(), "wide", ids, ragged); }), HasSubstr("expected are 37 x 1000000000001"));
  EXPECT_THAT(file_error([&] { serialize(file, *world(), "ragged", ids, ragged); }),
              HasSubstr("a row of \"ragged\" is 3 long; the longest one has 2"));
}

// Numbers that are not finite are refused by the name of their dataset, on all ranks, wherever they are.
TEST(CheckpointFile, RefusesNumbersThatAreNotFinite) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("not_finite.h5");
  const auto map = rcp(new Map(100, 0, world()));
  const RowIds ids = some_ids(*world());
  const std::vector<double> wrong{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  const std::vector<std::string> said{"nan", "inf", "-inf"};
  for (std::size_t n = 0; n < wrong.size(); ++n) {
    {
      CheckpointWriter file(world(), path);
      Vector x(map);
      if (map->isNodeGlobalElement(73)) x.replaceGlobalValue(73, wrong[n]);
      serialize(file, "x", "unknowns", x);
      std::vector<double> table(3 * ids.ids.size(), 1.0), values{1.0, 2.0, wrong[n]}, one{wrong[n]};
      std::vector<std::vector<double>> ragged(ids.ids.size(), {1.0, 2.0});
      if (world()->getRank() == world()->getSize() - 1) table[3 * ids.owned - 1] = ragged[ids.owned - 1][1] = wrong[n];
      file.rows("table", ids, 3, table);
      serialize(file, *world(), "ragged", ids, ragged);
      file.values("values", values);
      file.values("one", one);
      file.finish();
    }
    CheckpointReader file(world(), path);
    Vector x(map);
    std::vector<double> values;
    std::vector<std::vector<double>> ragged;
    double one = 0.0;
    std::optional<double> maybe;
    EXPECT_THAT(
        file_error([&] { serialize(file, "x", "unknowns", x); }),
        AllOf(HasSubstr("cannot read the checkpoint " + path), HasSubstr("\"x\" holds " + said[n] + " in the row of the id 73 of \"unknowns\"")));
    EXPECT_THAT(file_error([&] { file.rows("table", ids, 3, values); }), HasSubstr("\"table\" holds " + said[n] + " in the row of the id "));
    EXPECT_THAT(file_error([&] { serialize(file, *world(), "ragged", ids, ragged); }), HasSubstr("\"ragged\" holds " + said[n]));
    EXPECT_THAT(file_error([&] { serialize(file, "values", values); }), HasSubstr("\"values\" holds " + said[n] + " as number 3 of 3"));
    EXPECT_THAT(file_error([&] { serialize(file, "one", one); }), HasSubstr("\"one\" holds " + said[n]));
    EXPECT_THAT(file_error([&] { serialize(file, "one", maybe); }), HasSubstr("\"one\" holds " + said[n]));
    EXPECT_EQ(one, 0.0);
    EXPECT_EQ(x.normInf(), 0.0);
  }
}

TEST(CheckpointFile, RefusesIdsThatAreNotThere) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("ids.h5");
  RowIds ids = some_ids(*world());
  ids.ids.resize(ids.owned);
  RowIds stored = ids;
  if (world()->getRank() == 0) stored.ids.front() = std::numeric_limits<GlobalOrdinal>::max();
  std::vector<double> rows(ids.owned, 1.0);
  {
    CheckpointWriter file(world(), path);
    file.rows("table", stored, 1, rows);
    file.finish();
  }
  CheckpointReader file(world(), path);
  EXPECT_THAT(file_error([&] { file.rows("table", ids, 1, rows); }), HasSubstr("holds the id 9223372036854775807; the last one here is 113"));
}

// A CRC finds every single flip.
TEST(CheckpointFile, EveryFlippedBitAndEveryCutIsFound) {
  const test::ScratchDirectory scratch(world());
  const std::string path = scratch.file("whole.h5"), damaged = scratch.file("damaged.h5");
  write_all(world(), path);
  world()->barrier();
  EXPECT_EQ(checkpoint_damage(*world(), path), std::nullopt);
  const std::string whole = content(path);
  std::mt19937 random(1);
  const auto damage_of = [&](const std::string& bytes) {
    world()->barrier();
    if (world()->getRank() == 0) std::ofstream(damaged, std::ios::binary) << bytes;
    world()->barrier();
    return checkpoint_damage(*world(), damaged);
  };
  const int tries = world()->getSize() == 1 ? 1000 : 50;
  for (int n = 0; n < tries; ++n) {
    std::string bytes = whole;
    const std::size_t place = n < 64 ? whole.size() - 1 - static_cast<std::size_t>(n) : random() % whole.size();
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << (random() % 8)));
    EXPECT_TRUE(damage_of(bytes)) << "byte " << place << " of " << whole.size();
  }
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{64}, whole.size() / 2, whole.size() - 64, whole.size() - 1})
    EXPECT_TRUE(damage_of(whole.substr(0, length))) << length;
  EXPECT_TRUE(damage_of(whole + "x"));
  EXPECT_THAT(file_error([&] { CheckpointReader file(world(), damaged); }), HasSubstr("damaged.h5"));
  EXPECT_THAT(file_error([&] { CheckpointReader file(world(), scratch.file("none.h5")); }), HasSubstr("No such file"));
}

}  // namespace
}  // namespace mortise
