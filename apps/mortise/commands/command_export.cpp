#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "declarations.hpp"
#include "mortise/io/exodus_file.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/io/output_file.hpp"
#include "program.hpp"

namespace mortise {

void add_export_command(CLI::App& app, Program& program) {
  struct Options {
    std::string run, output;
  };
  auto* command = app.add_subcommand("export", "write mesh and fields of a run as one Exodus file");
  const auto options = std::make_shared<Options>();
  command->add_option("RUN", options->run, "directory of the run's results")->required()->type_name(directory_value);
  command->add_option("-o,--output", options->output, "file to write, which ends in .exo or .e; default: fields.exo in RUN")
      ->type_name("EXODUS")
      ->check(CLI::Validator([](const std::string& name) { return name.empty() ? "the name of the file is empty" : ""; }, ""));
  command->footer(
      "A body is an element block, a component of a field is a variable. A file that this program did not make is not replaced.\n"
      "Example: mortise export results/hertz_elastic -o hertz.exo");
  command->callback([&program, options] {
    program.uses_mpi = false;
    program.action = [&program, options] {
      const OutputFile target = output_file(options->output.empty() ? options->run + "/fields.exo" : options->output, {".exo", ".e"});
      OutputDirectory directory(program.comm, target.directory);
      ExodusContent content;
      try {
        content = write_exodus(options->run, [&] {
          directory.open({target.name});
          return directory.claim(target.name);
        });
      } catch (const FileError&) {
        if (directory.is_open()) directory.strike_missing();
        throw;
      }
      print(program,
            fmt::format("{}: {} nodes, {} elements in {} blocks, {} variables on nodes and {} on elements, {} steps\n", directory.file(target.name),
                        content.nodes, content.elements, content.blocks, content.node_variables, content.element_variables, content.steps));
      return ExitCode::done;
    };
  });
}

}  // namespace mortise
