// Words that start runs.

#include "mortise/studies/launcher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

using testing::ElementsAre;

const std::vector<std::string> run{"mortise", "run"};

TEST(Launcher, IsMpirunForSeveralRanksByDefault) {
  EXPECT_EQ(Launcher().command(1, run), run);
  EXPECT_THAT(Launcher().command(2, run), ElementsAre("mpirun", "-n", "2", "mortise", "run"));
}

TEST(Launcher, KnowsWhereTheNumberOfRanksStands) {
  EXPECT_THAT(read_launcher("srun --mpi=pmix").command(1, run), ElementsAre("srun", "--mpi=pmix", "-n", "1", "mortise", "run"));
  EXPECT_THAT(read_launcher("/opt/bin/mpiexec").command(3, run), ElementsAre("/opt/bin/mpiexec", "-n", "3", "mortise", "run"));
  EXPECT_THAT(read_launcher("flux").command(3, run), ElementsAre("flux", "run", "-n", "3", "mortise", "run"));
  EXPECT_THAT(read_launcher("flux run -o pmi=pmix").command(3, run), ElementsAre("flux", "run", "-o", "pmi=pmix", "-n", "3", "mortise", "run"));
  EXPECT_THAT(read_launcher("jsrun").command(3, run), ElementsAre("jsrun", "-p", "3", "mortise", "run"));
}

TEST(Launcher, TakesAnyCommandWithAPlaceForRanks) {
  EXPECT_THAT(read_launcher(" own  --tasks={ranks} -x {ranks}\t--").command(12, run),
              ElementsAre("own", "--tasks=12", "-x", "12", "--", "mortise", "run"));
  EXPECT_THAT(read_launcher("own 'a b' --c=\"d 'e'\" {ranks} ''").words, ElementsAre("own", "a b", "--c=d 'e'", "{ranks}", ""));
}

TEST(Launcher, RefusesWhatItCannotRead) {
  EXPECT_THROW(read_launcher("own --tasks"), InputError);
  EXPECT_THROW(read_launcher("srun 'a b"), InputError);
  EXPECT_THROW(read_launcher(""), InputError);
  EXPECT_THROW(require_launcher(read_launcher("no-such-program-anywhere {ranks}")), FileError);
  EXPECT_THROW(require_launcher(read_launcher("/no/such/srun")), FileError);
  EXPECT_NO_THROW(require_launcher(Launcher()));
  EXPECT_NO_THROW(require_launcher(read_launcher("env {ranks}")));
}

}  // namespace
}  // namespace mortise
