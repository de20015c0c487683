#pragma once
// Timers of one simulation, handed in; a thin handle on Teuchos::StackedTimer.

#include <Teuchos_StackedTimer.hpp>
#include <map>
#include <string>

#include "mortise/core/types.hpp"

namespace mortise {

/// Nested wall-clock timers. Copies share the same timers.
class Timers {
 public:
  Timers() : timer_(rcp(new Teuchos::StackedTimer("total"))) {}

  /// Stops its timer when it goes out of scope.
  class Scope {
   public:
    /// Starts the timer `name` of `timer`.
    Scope(RCP<Teuchos::StackedTimer> timer, std::string name) : timer_(std::move(timer)), name_(std::move(name)) { timer_->start(name_, false); }
    ~Scope() { timer_->stop(name_, false); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    RCP<Teuchos::StackedTimer> timer_;
    std::string name_;
  };

  /// Starts the timer `name` below the one that runs now.
  [[nodiscard]] Scope scope(const std::string& name) const { return Scope(timer_, name); }

  /// The timers themselves, for reports.
  Teuchos::StackedTimer& stacked() const { return *timer_; }

 private:
  RCP<Teuchos::StackedTimer> timer_;
};

}  // namespace mortise
