#include "mortise/simulation/model/run_log.hpp"

#include <iostream>

#include "mortise/io/files.hpp"

namespace mortise {

RunLog::RunLog(const RCP<const Communicator>& comm, Verbosity verbosity) : comm_(comm), verbosity_(verbosity) {
  if (comm_->getRank() != 0) return;
  log_.add_sink(std::cout, verbosity_);
  log_.add_sink(early_, Verbosity::verbose);
}

void RunLog::open(const std::string& path, bool append) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) {
    file_.open(path, append ? std::ios::app : std::ios::trunc);
    file_ << early_.str() << std::flush;
    if (!file_) reason = "it cannot be written";
    log_ = Log();
    log_.add_sink(std::cout, verbosity_);
    log_.add_sink(file_, Verbosity::verbose);
  }
  throw_if_any_file_error(*comm_, "the log", path, reason);
}

void RunLog::flush() {
  if (comm_->getRank() != 0) return;
  std::cout.flush();
  file_.flush();
}

}  // namespace mortise
