#pragma once
// Errors that all ranks have together: a check that fails on one of them fails on every one.

#include <exception>
#include <initializer_list>
#include <optional>
#include <string>

#include "mortise/core/types.hpp"
#include "mortise/plain/mortise.h"

namespace mortise {

/// One thing that is wrong on this rank.
struct Problem {
  mortise_status status = MORTISE_OK;
  std::string text;
};

/// The first one that there is.
std::optional<Problem> first_of(std::initializer_list<std::optional<Problem>> problems);

/// What the exception that is being handled means to a host.
Problem problem_of_exception();

/// Checks over the ranks of a communicator. Collective in all members.
class Agreement {
 public:
  explicit Agreement(const Communicator& comm) : comm_(comm) {}

  /// Throws PlainError on every rank if one of them has a problem, or is in another call, or gives something else that has to be alike.
  /// @param call   name of the call
  /// @param alike  all that has to be alike, as text
  void check(const std::string& call, const std::optional<Problem>& mine, const std::string& alike = "") const;

  /// Calls `work`. What it throws on any rank is an error of every rank, with the same status.
  template <class Work>
  void run(const Work& work) const {
    std::optional<Problem> problem;
    std::exception_ptr own;
    try {
      work();
    } catch (...) {
      own = std::current_exception();
      problem = problem_of_exception();
    }
    finish(own, problem);
  }

 private:
  void finish(const std::exception_ptr& own, const std::optional<Problem>& mine) const;
  Problem of_lowest_rank(int lowest, const std::optional<Problem>& mine) const;
  const Communicator& comm_;
};

}  // namespace mortise
