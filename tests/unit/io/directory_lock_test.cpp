// Locks of directories where the file system has locks, and where it has none.

#include "files/directory_lock.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Tpetra_Core.hpp>
#include <cerrno>

#include "scratch_directory.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;

int no_locks(int, int) {
  errno = EOPNOTSUPP;
  return -1;
}

std::string this_host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

class DirectoryLocks : public ::testing::TestWithParam<DirectoryLock::Flock> {};

TEST_P(DirectoryLocks, OneIsHeldUntilItIsGivenUp) {
  const test::ScratchDirectory scratch(Tpetra::getDefaultComm());
  DirectoryLock first(GetParam()), second(GetParam());
  EXPECT_EQ(lock_holder(scratch.path(), GetParam()), std::nullopt);
  EXPECT_EQ(first.take(scratch.path()), std::nullopt);
  const auto names_it = Optional(AllOf(HasSubstr("process " + std::to_string(getpid()) + " on host " + this_host() + " since 2"),
                                       HasSubstr("please wait, or choose another directory")));
  EXPECT_THAT(second.take(scratch.path()), names_it);
  EXPECT_THAT(lock_holder(scratch.path(), GetParam()), names_it);
  first.release();
  EXPECT_EQ(lock_holder(scratch.path(), GetParam()), std::nullopt);
  EXPECT_EQ(second.take(scratch.path()), std::nullopt);
}

TEST_P(DirectoryLocks, OneOfAProcessThatDiedIsFree) {
  const test::ScratchDirectory scratch(Tpetra::getDefaultComm());
  const pid_t child = fork();
  if (child == 0) {
    DirectoryLock lock(GetParam());
    _exit(lock.take(scratch.path()) ? 1 : 0);  // without its destructor, as if it were killed
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch.file(".mortise.lock")));
  EXPECT_EQ(lock_holder(scratch.path(), GetParam()), std::nullopt);
  DirectoryLock lock(GetParam());
  EXPECT_EQ(lock.take(scratch.path()), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(OfFileSystems, DirectoryLocks, ::testing::Values(&::flock, &no_locks));

TEST(DirectoryLockByName, ALaterProcessOfTheSameNumberIsAnother) {
  const test::ScratchDirectory scratch(Tpetra::getDefaultComm());
  std::ofstream(scratch.file(".mortise.lock")) << this_host() << " " << getpid() << " 1 2026-01-01T00:00:00Z\n";
  DirectoryLock lock(no_locks);
  EXPECT_EQ(lock.take(scratch.path()), std::nullopt);
}

// Eight processes start at once, 25 times, where a process that died has left its lock.
TEST(DirectoryLockByName, HasOneHolderOfManyThatStartAtOnce) {
  constexpr int rounds = 25, starts = 8;
  for (int round = 0; round < rounds; ++round) {
    const test::ScratchDirectory scratch(Tpetra::getDefaultComm());
    std::ofstream(scratch.file(".mortise.lock")) << this_host() << " " << getpid() << " 1 2026-01-01T00:00:00Z\n";
    std::array<int, 2> begin{}, end{}, won{};
    ASSERT_EQ(pipe(begin.data()) + pipe(end.data()) + pipe(won.data()), 0);
    std::vector<pid_t> children;
    for (int child = 0; child < starts; ++child) {
      children.push_back(fork());
      if (children.back() != 0) continue;
      close(begin[1]), close(end[1]);
      char none = 0;
      if (read(begin[0], &none, 1) < 0) _exit(2);  // the end of the file: all begin
      DirectoryLock lock(no_locks);
      const char taken = lock.take(scratch.path()) ? 'n' : 'y';
      if (write(won[1], &taken, 1) != 1 || read(end[0], &none, 1) < 0) _exit(2);
      _exit(0);
    }
    close(begin[1]);
    int holders = 0;
    for (int child = 0; child < starts; ++child) {
      char taken = 0;
      ASSERT_EQ(read(won[0], &taken, 1), 1);
      holders += taken == 'y' ? 1 : 0;
    }
    close(end[1]);
    for (const pid_t child : children) waitpid(child, nullptr, 0);
    for (const int one : {begin[0], end[0], won[0], won[1]}) close(one);
    EXPECT_EQ(holders, 1) << "in round " << round;
  }
}

TEST(DirectoryLockInAPipe, IsRefused) {
  const test::ScratchDirectory scratch(Tpetra::getDefaultComm());
  ASSERT_EQ(mkfifo(scratch.file(".mortise.lock").c_str(), 0600), 0);
  EXPECT_EQ(lock_holder(scratch.path(), no_locks), std::nullopt);
  DirectoryLock lock;
  EXPECT_THAT(lock.take(scratch.path()), Optional(HasSubstr("is no file; please remove it")));
}

TEST(DirectoryLockByName, OneOfAnotherHostIsRefusedWithWhatToDo) {
  const test::ScratchDirectory scratch(Tpetra::getDefaultComm());
  std::ofstream(scratch.file(".mortise.lock")) << "elsewhere 12 34 2026-01-01T00:00:00Z\n";
  DirectoryLock lock(no_locks);
  EXPECT_THAT(lock.take(scratch.path()), Optional(AllOf(HasSubstr("process 12 on host elsewhere since 2026-01-01T00:00:00Z"),
                                                        HasSubstr("please remove " + scratch.file(".mortise.lock")))));
  EXPECT_TRUE(std::filesystem::exists(scratch.file(".mortise.lock")));
}

}  // namespace
}  // namespace mortise
