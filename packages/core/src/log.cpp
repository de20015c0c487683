#include "mortise/core/log.hpp"

namespace mortise {

void Log::add_sink(std::ostream& sink, Verbosity verbosity) { sinks_.push_back({&sink, verbosity}); }

void Log::info(const std::string& line) const {
  for (const Sink& sink : sinks_)
    if (sink.verbosity != Verbosity::quiet) *sink.stream << line << '\n' << std::flush;
}

void Log::detail(const std::string& line) const {
  for (const Sink& sink : sinks_)
    if (sink.verbosity == Verbosity::verbose) *sink.stream << line << '\n' << std::flush;
}

void Log::warning(const std::string& line) const {
  for (const Sink& sink : sinks_) *sink.stream << "warning: " << line << '\n' << std::flush;
}

}  // namespace mortise
