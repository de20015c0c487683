// Gmsh's formats MSH 2.2 and 4.1, as text and as bytes. The file is read once, from its begin to its end.

#include <fmt/format.h>

#include <cctype>

#include "readers/gmsh/gmsh_mesh.hpp"
#include "readers/readers.hpp"

namespace mortise {
namespace {

constexpr const char* how_to_write = "save it as MSH 4.1 or 2.2 (gmsh -save -format msh41, or Mesh.MshFileVersion=4.1)";

class GmshReader {
 public:
  explicit GmshReader(const std::string& path) : stream_(path), numbers_(stream_, errors_) { mesh_.file.path = path; }

  MeshFile read() {
    read_format();
    while (!section().empty()) read_section();
    if (!has_nodes_) stop("there is no section $Nodes: the file is cut off, or holds no mesh");
    if (!has_elements_) stop("there is no section $Elements: the file is cut off, or holds no mesh");
    errors_.finish();
    if (version_ == 2) merge_gmsh_copies(mesh_);
    require_distinct_gmsh_elements(numbers_, mesh_);
    name_gmsh_sets(mesh_);
    return std::move(mesh_.file);
  }

 private:
  std::int64_t here() { return numbers_.binary() ? stream_.offset() : stream_.line(); }
  [[noreturn]] void stop(const std::string& message) { numbers_.stop_at(here(), message); }

  /// The next line of text that is not blank, without blanks at its ends.
  std::string text_line() {
    std::string_view line;
    while (stream_.next_line(line)) {
      while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
      while (!line.empty() && std::isspace(static_cast<unsigned char>(line.front()))) line.remove_prefix(1);
      if (!line.empty()) return std::string(line);
    }
    return {};
  }

  void read_format() {
    stream_.skip_byte_order_mark();
    const std::string first = text_line();
    const Place place = place_of_line(stream_.path(), 1);
    if (first == "$NOD" || first == "$NOE") errors_.stop(place, fmt::format("the file is of Gmsh's format 1; {}", how_to_write));
    if (first != "$MeshFormat")
      errors_.stop(place, fmt::format("expected $MeshFormat in the first line, found \"{}\": this is no mesh of Gmsh", first));
    const std::string version = std::string(numbers_.word()), type = std::string(numbers_.word()), size = std::string(numbers_.word());
    const std::int64_t line = stream_.line();
    if (version == "4.1")
      version_ = 4;
    else if (version == "2.2" || version == "2.1" || version == "2" || version == "2.0")
      version_ = 2;
    else
      numbers_.stop_at(line, fmt::format("the format's version is \"{}\"; {}", version, how_to_write));
    if (type != "0" && type != "1") numbers_.stop_at(line, fmt::format("the file's type is \"{}\"; 0 (text) and 1 (binary) are known", type));
    if (size != "8") numbers_.stop_at(line, fmt::format("numbers take \"{}\" bytes; files with 8 are read", size));
    if (type == "1") read_byte_order(line);
    expect_end("$EndMeshFormat");
  }

  /// Behind the line of the format a binary file has the number 1, which tells the order of its bytes.
  void read_byte_order(std::int64_t line) {
    std::string_view rest;
    std::array<unsigned char, 4> one{};
    stream_.next_line(rest);
    if (!stream_.read(one.data(), one.size())) numbers_.stop_at(line, "the file is cut off behind its format");
    const std::array<unsigned char, 4> little{1, 0, 0, 0}, big{0, 0, 0, 1};
    if (one != little && one != big)
      numbers_.stop_at(
          line, fmt::format("expected the number 1 in 4 bytes behind the format, found the bytes {} {} {} {}", one[0], one[1], one[2], one[3]));
    const std::uint16_t two_bytes = 1;
    const bool is_little = *reinterpret_cast<const unsigned char*>(&two_bytes) == 1;
    numbers_.set_encoding(true, is_little != (one == little), version_ == 4);
  }

  /// The name of the section that begins, or nothing at the end of the file.
  const std::string& section() {
    begin_ = numbers_.spot();
    section_ = text_line();
    if (section_.empty() || (section_[0] == '$' && section_.compare(0, 4, "$End") != 0)) return section_;
    numbers_.stop_at(begin_, fmt::format("expected a section, as $Nodes, found \"{}\"", section_));
  }

  void read_section() {
    const bool is_nodes = section_ == "$Nodes", is_elements = section_ == "$Elements";
    if ((is_nodes && has_nodes_) || (is_elements && has_elements_)) numbers_.stop_at(begin_, fmt::format("{} stands twice", section_));
    if (is_elements && !has_nodes_) numbers_.stop_at(begin_, "$Elements stands before $Nodes, or without them");
    numbers_.about(nullptr, 0);
    if (section_ == "$PhysicalNames") {
      read_physical_names();
    } else if (is_nodes) {
      has_nodes_ = true;
      version_ == 4 ? read_gmsh_4_nodes(numbers_, mesh_) : read_gmsh_2_nodes(numbers_, mesh_);
    } else if (is_elements) {
      has_elements_ = true;
      version_ == 4 ? read_gmsh_4_elements(numbers_, mesh_) : read_gmsh_2_elements(numbers_, mesh_);
    } else if (version_ == 4 && (section_ == "$Entities" || section_ == "$PartitionedEntities")) {
      if (has_elements_) numbers_.stop_at(begin_, fmt::format("{} stands behind $Elements", section_));
      read_gmsh_4_entities(numbers_, mesh_, section_ == "$PartitionedEntities");
    } else if (section_ == "$ParametricNodes") {
      numbers_.stop_at(begin_, "$ParametricNodes is not read; please save the mesh with Mesh.SaveParametric=0");
    } else {
      skip_section();
      return;
    }
    expect_end("$End" + section_.substr(1));
  }

  void expect_end(const std::string& end) {
    const std::int64_t at = numbers_.spot();
    const std::string found(numbers_.word());
    if (found != end)
      numbers_.stop_at(at, found.empty() ? fmt::format("expected {}, found the end of the file: it is cut off", end)
                                         : fmt::format("expected {}, found \"{}\"; is a count of the section {} wrong?", end, found, section_));
  }

  /// Names are text in binary files too.
  void read_physical_names() {
    const std::string head = text_line();
    const auto count = whole_number_of(head);
    if (!count || *count < 0) stop(fmt::format("expected the number of physical names, found \"{}\"", head));
    for (std::int64_t n = 0; n < *count; ++n) {
      const std::int64_t at = numbers_.spot();
      const std::string dimension_word(numbers_.word()), tag_word(numbers_.word()), rest = text_line();
      const auto dimension = whole_number_of(dimension_word), tag = whole_number_of(tag_word);
      const bool is_quoted = rest.size() >= 2 && rest.front() == '"' && rest.back() == '"';
      if (!dimension || *dimension < 0 || *dimension > 3 || !tag || !is_quoted)
        numbers_.stop_at(at, fmt::format("expected a dimension, a tag and a name in quotes, found '{} {} {}'", dimension_word, tag_word, rest));
      mesh_.names[{static_cast<int>(*dimension), *tag}].push_back(rest.substr(1, rest.size() - 2));
    }
  }

  /// Other sections hold nothing of a mesh. In binary files nothing but their end says where they end.
  void skip_section() {
    const std::string end = "$End" + section_.substr(1);
    std::size_t matched = 0;
    while (matched < end.size()) {
      const int byte = stream_.get();
      if (byte < 0) numbers_.stop_at(begin_, fmt::format("the section {} has no end: the file is cut off", section_));
      // A $ begins the end, and stands nowhere else in it.
      matched = byte == static_cast<unsigned char>(end[matched]) ? matched + 1 : byte == '$' ? 1 : 0;
    }
  }

  ByteStream stream_;
  FileErrors errors_;
  GmshNumbers numbers_;
  GmshMesh mesh_;
  int version_ = 0;
  bool has_nodes_ = false, has_elements_ = false;
  std::string section_ = "$MeshFormat";
  std::int64_t begin_ = 1;  ///< of the section
};

}  // namespace

MeshFile read_gmsh(const std::string& path) { return GmshReader(path).read(); }

}  // namespace mortise
