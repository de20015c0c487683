#pragma once
// Error messages, in a few lines, about lists that are passed to a package of Trilinos.

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"

namespace mortise::detail {

/// Parameters of `given` that are not in `valid`, one message each. Names of sublists that begin with `levels`, if that is not empty, are passed
/// over, and their parameters looked for in `valid` as well.
/// @param owner  who has the parameters, and where they are listed: "MueLu", "the MueLu User's Guide"
std::vector<Diagnostic> unknown_parameters(const Teuchos::ParameterList& given, const Teuchos::ParameterList& valid, const Place& place,
                                           const std::string& owner, const std::string& listed, const std::string& levels = "");

/// The message of an exception of Teuchos in one line: without the file, the number and the test that threw it, and without lists of all that is
/// valid.
std::string in_one_line(const std::string& message);

}  // namespace mortise::detail
