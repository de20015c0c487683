#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "program.hpp"

namespace mortise {

void print(const Program& program, const std::string& text) {
  if (!program.is_first_rank()) return;
  std::cout << text << std::flush;
  if (!std::cout) throw FileError("cannot write to standard output");
}

Outcome run_action(const Program& program, const std::function<ExitCode()>& action) {
  Outcome outcome;
  try {
    outcome.code = action();
  } catch (const InputError& error) {
    outcome = {ExitCode::invalid_input, error.what()};
  } catch (const FileError& error) {
    outcome = {ExitCode::files, error.what()};
  } catch (const std::filesystem::filesystem_error& error) {
    outcome = {ExitCode::files, error.path1().string() + ": " + error.code().message()};
  } catch (const StepFailure& failure) {
    outcome = {failure.kind() == FailureKind::input ? ExitCode::invalid_input : ExitCode::not_converged, failure.what()};
  } catch (const std::bad_alloc&) {
    outcome = {ExitCode::memory, "out of memory"};
  } catch (const std::exception& error) {
    // Kokkos has no type for it.
    const bool is_memory = std::string(error.what()).find("failed to allocate memory") != std::string::npos;
    outcome = {is_memory ? ExitCode::memory : ExitCode::internal, error.what()};
  } catch (...) {
    outcome = {ExitCode::internal, "unknown exception"};
  }
  // Errors of input, files and steps are thrown on every rank with the same text; anything else may be one rank's alone.
  if (outcome.code == ExitCode::memory && !outcome.message.empty())
    std::cerr << "mortise: rank " << program.comm->getRank() << " got no more memory" << std::endl;
  else if (outcome.code == ExitCode::internal)
    std::cerr << "mortise: internal error on rank " << program.comm->getRank() << ": " << outcome.message << std::endl;
  else if (!outcome.message.empty() && program.is_first_rank())
    std::cerr << outcome.message << std::endl;
  return outcome;
}

}  // namespace mortise
