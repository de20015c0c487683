#pragma once
// CalculiX in tests: the program ccx, a script in its place, or nothing.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "launch.hpp"

namespace peer_support {

inline const std::string peers = std::string(SCRATCH) + "/peer";

/// "PATH=..." with a script `ccx` before all others; empty: with everything in PATH but ccx.
inline std::string path_with(const std::string& name, const std::string& ccx) {
  const std::string bin = peers + "/" + name, path = std::getenv("PATH");
  std::filesystem::remove_all(bin);
  std::filesystem::create_directories(bin);
  if (!ccx.empty()) {
    std::ofstream(bin + "/ccx") << "#!/bin/sh\n" << ccx << "\n";
    std::filesystem::permissions(bin + "/ccx", std::filesystem::perms::owner_all);
    return "PATH=" + bin + ":" + path;
  }
  std::istringstream folders(path);
  std::error_code passed_over;  // what an earlier folder has counts
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::is_directory(folder))
      for (const auto& program : std::filesystem::directory_iterator(folder))
        if (program.path().filename() != "ccx")
          std::filesystem::create_symlink(program.path(), bin + "/" + program.path().filename().string(), passed_over);
  return "PATH=" + bin;
}

inline bool installed() { return launch({"ccx", "-v"}).code != 127; }

inline nlohmann::json quantities(const std::string& results) { return nlohmann::json::parse(read_file(results + "/summary.json")).at("quantities"); }

}  // namespace peer_support
