#pragma once
// Text of a FileError that every rank has to throw.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <string>

#include "mortise/core/error.hpp"

namespace mortise::test {

/// Text of the FileError that `action` throws; a failure if it throws none. Every rank calls it.
template <class Action>
std::string file_error(const Action& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no FileError on rank " << Tpetra::getDefaultComm()->getRank();
  return {};
}

}  // namespace mortise::test
