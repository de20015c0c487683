#include <CLI/CLI.hpp>
#include <memory>

#include "declarations.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/studies/describe_scene.hpp"
#include "program.hpp"

namespace mortise {

void add_describe_command(CLI::App& app, Program& program) {
  struct Options {
    std::string path, directory;
    DescriptionFormat format = DescriptionFormat::text;
  };
  auto* command = app.add_subcommand("describe", "say every parameter with its default, unit, range and meaning");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("PATH", options->path,
                   "a list of the scene, e.g. contact or stepping, or point, study, hard, machine: those files; default: the whole scene")
      ->type_name(list_value);
  const std::map<std::string, DescriptionFormat> formats{{"text", DescriptionFormat::text},
                                                         {"md", DescriptionFormat::markdown},
                                                         {"rng", DescriptionFormat::relax_ng},
                                                         {"json", DescriptionFormat::json}};
  command
      ->add_option_function<std::string>(
          "--format", [options, formats](const std::string& name) { options->format = formats.at(name); },
          "text, md (Markdown), rng (RELAX NG schema) or json")
      ->check(one_of("format", {"text", "md", "rng", "json"}))
      ->option_text("FORMAT");
  add_directory(*command, options->directory,
                "write into this directory: with rng or json the one file, else the whole reference, a page for each list, and the schemas");
  command->footer("Example: mortise describe contact");
  command->callback([&program, options] {
    program.uses_mpi = false;
    program.action = [&program, options] {
      if (options->directory.empty()) {
        print(program, describe_scene(options->path, options->format));
        return ExitCode::done;
      }
      OutputDirectory directory(program.comm, options->directory, {"reference"});
      if (options->format == DescriptionFormat::relax_ng || options->format == DescriptionFormat::json) {
        const std::string kind = options->path.empty() ? "scene" : options->path.substr(0, options->path.find('/'));
        const std::string name = kind + (options->format == DescriptionFormat::json ? ".json" : ".rng"),
                          text = describe_scene(options->path, options->format);
        directory.open({name});
        write_file(*program.comm, directory.claim(name), [&] { return text; });
        return ExitCode::done;
      }
      const std::vector<ReferencePage> pages = reference_pages();
      std::vector<std::string> names;
      for (const auto& page : pages) names.push_back(page.file);
      directory.open(names);
      for (const auto& page : pages) write_file(*program.comm, directory.claim(page.file), [&] { return page.content; });
      return ExitCode::done;
    };
  });
}

void add_list_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("list", "say what can be chosen in a scene");
  const auto topic = std::make_shared<std::string>();
  command->add_option("TOPIC", *topic, "what to list")->required()->check(one_of("topic", choice_topics()));
  command->callback([&program, topic] {
    program.uses_mpi = false;
    program.action = [&program, topic] { return print(program, list_choices(*topic)), ExitCode::done; };
  });
}

}  // namespace mortise
