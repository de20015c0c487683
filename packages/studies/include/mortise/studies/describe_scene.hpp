#pragma once
// The declared parameters of scenes, and what can be chosen in them, as text.

#include <string>
#include <vector>

namespace mortise {

enum class DescriptionFormat { text, markdown, relax_ng, json };

/// Describes the list at `path` ("" : the whole scene; "contact", "bodies/<name>/mesh", ...), "<name>" standing for any name. Throws InputError,
/// with the nearest names, if there is no such list. "point" and what is below it ("point/path") is about point files, "study" about study files.
/// The schema is that of the whole scene, point or study file, whatever the path.
std::string describe_scene(const std::string& path, DescriptionFormat format);

/// Names of what describe_scene describes: the lists of a scene and the other kinds of files.
std::vector<std::string> described_lists();

/// A page of the reference: file name and content. Together they hold every parameter.
struct ReferencePage {
  std::string file, content;
};
/// All pages: index.md and one for each list of the scene, and scene.rng; a page and a schema for point files and study files.
std::vector<ReferencePage> reference_pages();

/// Topics of `list_choices`: "materials", "elements", "meshes", ...
const std::vector<std::string>& choice_topics();

/// The names that can be chosen, each with its sentence, one a line. Throws InputError for an unknown topic.
std::string list_choices(const std::string& topic);

}  // namespace mortise
