#include <fmt/format.h>
#include <stdlib.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/names.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/io/output_file.hpp"
#include "mortise/studies/picture.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"

namespace mortise {
namespace {

constexpr int input_code = 2, files_code = 5;  ///< of picture_plot, with the reason as its output

/// A directory of this process alone, which goes with this object: what cannot be drawn to its end leaves nothing elsewhere.
class ScratchDirectory {
 public:
  ScratchDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "mortise-picture-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw FileError(fmt::format("cannot make the directory {}: {}", name, std::strerror(errno)));
    path_ = name;
  }
  ~ScratchDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

OutputFile target_of(const PictureOptions& options) {
  const std::string name = options.profile ? "profile.png" : options.all_steps ? "picture.gif" : "picture.png";
  const std::string path = options.output.empty() ? options.run + "/" + name : options.output;
  return output_file(path, options.all_steps ? std::vector<std::string>{".gif", ".png"} : std::vector<std::string>{".png"});
}

template <class Value>
nlohmann::json json_of(const std::optional<Value>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

/// The text of a file of the scratch directory.
std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) throw FileError("cannot read " + path.string());
  return content;
}

/// Findings of a rank, for all ranks: they throw the same, or none does.
struct Finding {
  std::optional<std::string> wrong_input, file_error;
  bool has_python = true;
  std::string said;
};

Finding draw(const PictureOptions& options, const std::string& output) {
  nlohmann::json request{{"run", options.run}, {"steps", options.all_steps}, {"output", output}};
  request["field"] = json_of(options.field), request["step"] = json_of(options.step), request["warp"] = json_of(options.warp);
  request["view"] = json_of(options.view), request["profile"] = json_of(options.profile);
  const auto ending = run_script(std::string(page_needs) + results_loader + picture_plot,
                                 {results_module, request.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)});
  Finding finding;
  if (!ending)
    finding.has_python = false;
  else if (ending->code == input_code)
    finding.wrong_input = without_control_characters(ending->output);
  else if (ending->code == files_code)
    finding.file_error = without_control_characters(ending->output);
  else if (ending->code != 0)
    finding.file_error = fmt::format("cannot draw {}: python ended with code {}: {}", options.run, ending->code, ending->last_line());
  else
    finding.said = without_control_characters(ending->output);
  return finding;
}

std::string broadcast(const Communicator& comm, const std::string& text) {
  int size = static_cast<int>(text.size());
  Teuchos::broadcast(comm, 0, Teuchos::outArg(size));
  std::string all(text);
  all.resize(static_cast<std::size_t>(size));
  Teuchos::broadcast(comm, 0, size, all.data());
  return all;
}

}  // namespace

std::optional<std::string> draw_picture(const RCP<const Communicator>& comm, const PictureOptions& options) {
  const OutputFile target = target_of(options);
  std::optional<ScratchDirectory> scratch;
  Finding finding;
  if (comm->getRank() == 0) {
    try {
      scratch.emplace();
      finding = draw(options, (scratch->path() / target.name).string());
    } catch (const std::exception& error) {
      finding.file_error = error.what();
    }
  }
  std::vector<Diagnostic> diagnostics;
  if (finding.wrong_input) diagnostics.push_back({{}, *finding.wrong_input});
  throw_if_any(*comm, diagnostics);
  int state = finding.file_error ? 0 : finding.has_python ? 1 : 2;
  Teuchos::broadcast(*comm, 0, Teuchos::outArg(state));
  if (state == 0) throw FileError(broadcast(*comm, finding.file_error.value_or("")));
  if (state == 2) return {};

  // A series has one name in the list of the directory.
  const bool is_series = options.all_steps && target.name.substr(target.name.size() - 4) == ".png";
  const std::string name = is_series ? target.name.substr(0, target.name.size() - 4) + "-*.png" : target.name;
  OutputDirectory directory(comm, target.directory);
  directory.open({name});
  if (is_series) directory.remove(name);  // steps of two runs do not mix
  directory.claim(name);
  std::string file;
  std::optional<std::string> reason;
  if (comm->getRank() == 0)
    for (const std::string& one : scratch->files()) {
      file = directory.file(one);
      if ((reason = replace_file(file, content_of(scratch->path() / one)))) break;
    }
  directory.strike_missing();
  throw_if_any_file_error(*comm, "cannot write", file, reason);
  return broadcast(*comm, fmt::format("{}: {}", directory.file(name), finding.said));
}

}  // namespace mortise
