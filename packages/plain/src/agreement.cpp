#include "agreement.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <new>
#include <stdexcept>

#include "mortise/core/error.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/plain/plain_contact.hpp"
#include "text_hash.hpp"

namespace mortise {
namespace {

/// Positive, so that its negative has a place.
long long number_of(const std::string& text) { return static_cast<long long>(text_hash(text.data(), text.size()) >> 2); }

}  // namespace

std::optional<Problem> first_of(std::initializer_list<std::optional<Problem>> problems) {
  for (const auto& problem : problems)
    if (problem) return problem;
  return std::nullopt;
}

Problem problem_of_exception() {
  try {
    throw;
  } catch (const PlainError& error) {
    return {error.status(), error.what()};
  } catch (const StepFailure& error) {
    return {MORTISE_STEP_FAILED, fmt::format("{}: {}", to_string(error.kind()), error.what())};
  } catch (const InputError& error) {
    return {MORTISE_REFUSED, error.what()};
  } catch (const FileError& error) {
    return {MORTISE_BAD_BYTES, error.what()};
  } catch (const std::invalid_argument& error) {
    return {MORTISE_REFUSED, error.what()};
  } catch (const std::bad_alloc&) {
    return {MORTISE_NO_MEMORY, "there is not enough memory"};
  } catch (const std::exception& error) {
    return {MORTISE_INTERNAL, error.what()};
  } catch (...) {
    return {MORTISE_INTERNAL, "an exception of an unknown type"};
  }
}

Problem Agreement::of_lowest_rank(int lowest, const std::optional<Problem>& mine) const {
  const bool here = lowest == comm_.getRank();
  Problem result = here ? *mine : Problem{};
  std::array<int, 2> numbers{static_cast<int>(result.status), static_cast<int>(result.text.size())};
  Teuchos::broadcast(comm_, lowest, 2, numbers.data());
  result.status = static_cast<mortise_status>(numbers[0]);
  result.text.resize(static_cast<std::size_t>(numbers[1]));
  if (numbers[1] > 0) Teuchos::broadcast(comm_, lowest, numbers[1], result.text.data());
  return result;
}

void Agreement::check(const std::string& call, const std::optional<Problem>& mine, const std::string& alike) const {
  const int size = comm_.getSize();
  const std::vector<long long> all = most_over_ranks(
      comm_, std::vector<long long>{mine ? size - comm_.getRank() : 0, number_of(call), -number_of(call), number_of(alike), -number_of(alike)});
  if (all[1] != -all[2])
    throw PlainError(MORTISE_WRONG_ORDER,
                     fmt::format("{}: ranks are in different calls: all of them have to make the same calls in the same order", call));
  if (all[0] != 0) {
    const Problem problem = of_lowest_rank(size - static_cast<int>(all[0]), mine);
    throw PlainError(problem.status, fmt::format("{}: {}", call, problem.text));
  }
  if (all[3] != -all[4]) throw PlainError(MORTISE_REFUSED, fmt::format("{}: ranks give different names, numbers or options", call));
}

void Agreement::finish(const std::exception_ptr& own, const std::optional<Problem>& mine) const {
  const int size = comm_.getSize(), highest = most_over_ranks(comm_, mine ? size - comm_.getRank() : 0);
  if (highest == 0) return;
  const Problem problem = of_lowest_rank(size - highest, mine);
  if (own && problem.status == mine->status) std::rethrow_exception(own);
  throw PlainError(problem.status, problem.text);
}

}  // namespace mortise
