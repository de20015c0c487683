#pragma once
// Scenes written by tests.

#include <fmt/format.h>
#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "mortise/simulation/scene/read_scene.hpp"

namespace mortise::test {

inline std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return fmt::format("<Parameter name=\"{}\" type=\"{}\" value=\"{}\"/>\n", name, type, value);
}

inline std::string list(const std::string& name, const std::string& content) {
  return fmt::format("<ParameterList name=\"{}\">\n{}</ParameterList>\n", name, content);
}

/// Written by rank 0, read by all.
inline Scene read_text(const std::string& text) {
  const auto comm = Tpetra::getDefaultComm();
  int id = static_cast<int>(::getpid());
  Teuchos::broadcast(*comm, 0, Teuchos::outArg(id));
  const std::string file = (std::filesystem::temp_directory_path() / fmt::format("mortise_scene_{}.xml", id)).string();
  if (comm->getRank() == 0) std::ofstream(file) << text;
  comm->barrier();
  Scene scene = read_scene(*comm, file, {});
  comm->barrier();
  if (comm->getRank() == 0) std::filesystem::remove(file);
  return scene;
}

}  // namespace mortise::test
