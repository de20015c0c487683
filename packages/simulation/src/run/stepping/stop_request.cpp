#include "run/stepping/stop_request.hpp"

#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <array>
#include <csignal>

namespace mortise {
namespace {

struct NamedSignal {
  int number;
  const char* name;
};
// In the order of their weight: of several the first is reported.
constexpr std::array<NamedSignal, 4> stopping{{{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}, {SIGUSR1, "SIGUSR1"}}};
constexpr int checkpointing = SIGUSR2;

// Written by handlers, which may do nothing else.
volatile std::sig_atomic_t interrupts = 0;
std::array<volatile std::sig_atomic_t, stopping.size()> stops{};
volatile std::sig_atomic_t wants_checkpoint = 0;
std::array<struct sigaction, stopping.size() + 1> before{};

void note_signal(int number) {
  if (number == SIGINT && ++interrupts > 1) _exit(128 + SIGINT);
  if (number == checkpointing) wants_checkpoint = 1;
  for (std::size_t n = 0; n < stopping.size(); ++n)
    if (stopping[n].number == number) stops[n] = 1;
}

// A signal that the starter of the program wants to be ignored stays so: SIGINT of jobs in the background.
void listen(int number, const struct sigaction& action, struct sigaction& former) {
  sigaction(number, nullptr, &former);
  if (former.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
}

constexpr double margin = 1.2;      ///< steps may take longer than those before
constexpr double forgetting = 0.9;  ///< of the longest step, with each that is shorter

}  // namespace

StopRequest::StopRequest(bool watch_signals, std::optional<double> time_limit, std::chrono::steady_clock::time_point begin)
    : watches_(watch_signals), limit_(time_limit), begin_(begin) {
  if (!watches_) return;
  interrupts = wants_checkpoint = 0;
  for (auto& stop : stops) stop = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t n = 0; n < stopping.size(); ++n) listen(stopping[n].number, action, before[n]);
  listen(checkpointing, action, before.back());
}

StopRequest::~StopRequest() {
  if (!watches_) return;
  for (std::size_t n = 0; n < stopping.size(); ++n) sigaction(stopping[n].number, &before[n], nullptr);
  sigaction(checkpointing, &before.back(), nullptr);
}

Request StopRequest::after_step(const Communicator& comm) {
  const auto now = Clock::now();
  longest_ = std::max(forgetting * longest_, std::chrono::duration<double>(now - last_).count());
  last_ = now;
  std::array<int, stopping.size() + 2> mine{}, any{};
  if (watches_) {
    for (std::size_t n = 0; n < stopping.size(); ++n) mine[n] = stops[n];
    mine[stopping.size()] = wants_checkpoint;
    wants_checkpoint = 0;
  }
  if (limit_) mine.back() = std::chrono::duration<double>(now - begin_).count() + margin * longest_ + reserved_ > *limit_ ? 1 : 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), any.data());
  Request request;
  request.checkpoint = any[stopping.size()] != 0;
  if (any.back() != 0) request.stop = "time limit";
  for (std::size_t n = stopping.size(); n-- > 0;)
    if (any[n] != 0) request.stop = stopping[n].name;
  return request;
}

std::optional<std::string> StopRequest::within_step(const Communicator& comm) const {
  if (!watches_) return std::nullopt;
  std::array<int, stopping.size()> mine{}, any{};
  for (std::size_t n = 0; n < stopping.size(); ++n) mine[n] = stops[n];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), any.data());
  for (std::size_t n = 0; n < stopping.size(); ++n)
    if (any[n] != 0) return stopping[n].name;
  return std::nullopt;
}

}  // namespace mortise
