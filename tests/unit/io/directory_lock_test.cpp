// Locks of directories where the file system has locks, and where it has none.

#include "files/directory_lock.hpp"

#include <gmock/gmock.h>
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
