#pragma once
// Studies written and run by tests.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "launch.hpp"

namespace study_support {

inline const std::string directory = std::string(SCRATCH) + "/study";

inline Ending study(const std::string& file, const std::string& results, std::vector<std::string> before = {}) {
  before.insert(before.end(), {MORTISE, "study", file, "-o", results});
  return launch(before, 240);
}

/// Looks every 5 ms, for a minute at most.
inline void wait_until(const std::function<bool()>& wanted) {
  for (int i = 0; i < 12000 && !wanted(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Starts a study and kills it as soon as its points are as wanted.
inline void kill_when(const std::function<bool()>& wanted, const std::string& file, const std::string& results, std::vector<std::string> options,
                      int with = SIGKILL) {
  options.insert(options.begin(), {MORTISE, "study", file, "-o", results});
  std::vector<char*> words;
  for (std::string& option : options) words.push_back(option.data());
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    signal(with, SIG_DFL);  // shells have what runs in the background ignore SIGINT
    execv(words[0], words.data());
    _exit(127);
  }
  wait_until(wanted);
  kill(child, with);
  waitpid(child, nullptr, 0);
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A study of the two rings, whose exact solution is known; from the list "axes" on.
inline std::string write_study(const std::string& name, const std::string& rest) {
  std::filesystem::create_directories(directory);
  const std::string path = directory + "/" + name + ".xml";
  std::ofstream(path) << "<ParameterList name=\"rings\">\n<Parameter name=\"scene\" type=\"string\" value=\"" << INPUTS
                      << "/verification/ring_in_ring.xml\"/>\n<Parameter name=\"h\" type=\"string\" value=\"1/n\"/>\n"
                      << rest << "</ParameterList>\n";
  return path;
}

inline const std::string meshes = R"(<ParameterList name="n">
  <Parameter name="setting" type="string" value="variables/n"/><Parameter name="values" type="string" value="6, 12"/></ParameterList>
)";

}  // namespace study_support
