#pragma once
// Reading of bytes that anybody may have written, one function for each kind of input. libFuzzer and the test of the corpus share
// them.

#include <string>
#include <vector>

#include "mortise/input/parameter_tree.hpp"

namespace mortise::fuzz {

/// One kind of input.
struct Target {
  std::string name;  ///< also that of its folder in corpus/
  /// Reads the bytes as that kind of input. It may throw an InputError or a FileError: anything else is a defect.
  void (*read)(const std::string& bytes);
  /// Allowed content of such a file; null where it does not consist of lists and parameters.
  ListRecord (*declarations)();
};

/// All of them.
const std::vector<Target>& targets();

/// The target of that name. Throws std::out_of_range if there is none.
const Target& target(const std::string& name);

/// Calls target.read; InputError and FileError end here, as they are right answers.
void read_or_refuse(const Target& target, const std::string& bytes);

/// Bytes that tell the target "checkpoint" of a file as a run writes it: the first entry of its corpus.
std::string whole_checkpoint();

/// The path of such a file as the program itself writes it.
std::string written_checkpoint();

/// Restores what a run stores from a checkpoint. Returns what was refused, one message for each value.
std::vector<std::string> restore_checkpoint(const std::string& path);

/// The path of a checkpoint with the datasets that the bytes tell.
std::string checkpoint_file(const std::string& bytes);

}  // namespace mortise::fuzz
