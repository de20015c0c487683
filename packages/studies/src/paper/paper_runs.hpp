#pragma once
// Runs for the paper's page.

#include <string>
#include <vector>

namespace mortise {

/// A scene of inputs/paper, part of the program so that it is found wherever the program stands.
struct PaperScene {
  std::string name;  ///< name of the file without its ending
  std::string text;
};

/// All scenes of inputs/paper, by name.
const std::vector<PaperScene>& paper_scenes();

/// One run of the page.
struct PaperRun {
  std::string name;
  std::string scene;                  ///< name of a PaperScene
  std::vector<std::string> settings;  ///< "path=value"
  bool is_rival = false;              ///< computed with the method that the paper compares with: that it fails is a result
  std::string misses{};               ///< why it is expected to miss checks of its scene; empty: it is not
};

/// The runs in the order of the paper.
const std::vector<PaperRun>& paper_runs();

/// The run's scene.
const PaperScene& scene_of(const PaperRun& run);

}  // namespace mortise
