#include "mortise/input/xml.hpp"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/tree.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "mortise/core/names.hpp"
#include "split.hpp"

namespace mortise {
namespace {

/// Of a file that is read as text: a device without end does not take all memory.
constexpr std::size_t most_bytes = std::size_t{1} << 28;

std::string text_of(const xmlChar* text) { return text ? reinterpret_cast<const char*>(text) : ""; }

/// The first error is the one that matters: those after it are of what the parser makes of the rest.
void keep_first(void* context, xmlError* error) {
  auto* first = static_cast<std::optional<Diagnostic>*>(static_cast<xmlParserCtxt*>(context)->_private);
  if (*first || error->level < XML_ERR_ERROR) return;
  std::string message = error->message;
  message.erase(message.find_last_not_of(" \n") + 1);
  const bool is_limit = message.find("XML_PARSE_HUGE") != std::string::npos || message.find("too long") != std::string::npos;
  *first = {
      {"", error->line, ""},
      is_limit ? fmt::format("too much: lists may be nested {} deep, and an attribute may have {} characters", xmlParserMaxDepth, XML_MAX_TEXT_LENGTH)
               : "not well-formed XML: " + message};
}

class Converter {
 public:
  Converter(std::string file, std::vector<Diagnostic>& diagnostics) : file_(std::move(file)), diagnostics_(diagnostics) {}

  XmlList list(xmlNode* node, const std::string& path, bool outermost) {
    XmlList result;
    result.name = attribute(node, "name", path, {"name"}, !outermost);
    result.place = {file_, line(node), outermost ? "" : join(path, result.name)};
    std::set<std::string> names;
    for (xmlNode* child = node->children; child; child = child->next) {
      const std::string tag = text_of(child->name);
      if (child->type == XML_COMMENT_NODE || child->type == XML_PI_NODE || xmlIsBlankNode(child)) continue;
      if (child->type == XML_ENTITY_REF_NODE) {
        say(child, result.place.path, fmt::format("the entity \"&{};\" stands in the place of elements; please write these out", tag));
      } else if (child->type != XML_ELEMENT_NODE) {
        say(child, result.place.path, fmt::format("text outside of elements: \"{}\"", text_of(child->content)));
      } else if (tag == "ParameterList") {
        result.lists.push_back(list(child, result.place.path, false));
        unique(child, names, result.lists.back().name, result.place.path);
      } else if (tag == "Parameter") {
        result.parameters.push_back(parameter(child, result.place.path));
        unique(child, names, result.parameters.back().name, result.place.path);
      } else {
        say(child, result.place.path, fmt::format("unknown element <{}>; please use <ParameterList> or <Parameter>", tag));
      }
    }
    return result;
  }

  void say(xmlNode* node, const std::string& path, const std::string& message) { diagnostics_.push_back({{file_, line(node), path}, message}); }

 private:
  static int line(xmlNode* node) { return static_cast<int>(xmlGetLineNo(node)); }
  static std::string join(const std::string& path, const std::string& name) { return path.empty() ? name : path + "/" + name; }

  std::string attribute(xmlNode* node, const std::string& wanted, const std::string& path, const std::vector<std::string>& allowed, bool required) {
    std::string value;
    bool found = false;
    for (xmlAttr* one = node->properties; one; one = one->next) {
      const std::string name = text_of(one->name);
      if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) {
        if (wanted == "name")
          say(node, path, fmt::format("unknown attribute \"{}\" of <{}>; known: {}", name, text_of(node->name), quoted_list(allowed)));
      } else if (name == wanted) {
        // Entities split a value into several nodes: the content is that of all of them.
        const std::unique_ptr<xmlChar, void (*)(void*)> content(xmlNodeGetContent(reinterpret_cast<xmlNode*>(one)), xmlFree);
        value = text_of(content.get());
        found = true;
      }
    }
    if (without_control_characters(value) != value)
      say(node, path,
          fmt::format("\"{}\" of <{}> has a control character, such as a line break or a tab, where \"{}\" has a \"?\"; please remove it", wanted,
                      text_of(node->name), without_control_characters(value)));
    if (required && (!found || (wanted == "name" && value.empty()))) say(node, path, fmt::format("<{}> without \"{}\"", text_of(node->name), wanted));
    return value;
  }

  XmlParameter parameter(xmlNode* node, const std::string& path) {
    const std::vector<std::string> allowed = {"name", "type", "value"};
    XmlParameter result;
    result.name = attribute(node, "name", path, allowed, true);
    result.type = attribute(node, "type", path, allowed, true);
    result.value = attribute(node, "value", path, allowed, true);
    result.place = {file_, line(node), path};
    const std::vector<std::string> types = {"double", "int", "bool", "string"};
    if (!result.type.empty() && std::find(types.begin(), types.end(), result.type) == types.end())
      say(node, path,
          fmt::format("parameter \"{}\" has the unknown type \"{}\"; known: {}{}", result.name, result.type, quoted_list(types),
                      did_you_mean(result.type, types)));
    return result;
  }

  void unique(xmlNode* node, std::set<std::string>& names, const std::string& name, const std::string& path) {
    if (!name.empty() && !names.insert(name).second) say(node, path, fmt::format("\"{}\" is given twice", name));
  }

  std::string file_;
  std::vector<Diagnostic>& diagnostics_;
};

}  // namespace

const XmlParameter* XmlList::parameter(const std::string& wanted) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const XmlParameter& one) { return one.name == wanted; });
  return found == parameters.end() ? nullptr : &*found;
}

const XmlList* XmlList::list(const std::string& wanted) const {
  const auto found = std::find_if(lists.begin(), lists.end(), [&](const XmlList& one) { return one.name == wanted; });
  return found == lists.end() ? nullptr : &*found;
}

std::string read_text(const Communicator& comm, const std::string& path) {
  std::string text;
  std::string reason = "rank 0 failed";
  long long size = -1;
  if (comm.getRank() == 0) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    const bool opened = file.is_open();
    std::vector<char> part(std::size_t{1} << 16);
    while (file && text.size() <= most_bytes) {
      file.read(part.data(), static_cast<std::streamsize>(part.size()));
      text.append(part.data(), static_cast<std::size_t>(file.gcount()));
    }
    const int failure = errno;
    std::error_code none;
    if (text.size() > most_bytes)
      reason = fmt::format("it has more than {} bytes, the most that is read", most_bytes);
    else if (!opened || file.bad())
      reason = failure != 0 ? std::strerror(failure) : "its reading ended with an error";
    else if (text.empty() && !std::filesystem::is_regular_file(path, none))  // a device or pipe may give nothing without an error
      reason = "it is empty, and no regular file";
    else
      size = static_cast<long long>(text.size());
  }
  Teuchos::broadcast(comm, 0, Teuchos::outArg(size));
  if (size < 0) throw FileError(fmt::format("{}: cannot be read: {}", path, reason));
  text.resize(size);
  Teuchos::broadcast(comm, 0, static_cast<int>(size), text.data());
  return text;
}

XmlList parse_xml(const std::string& text, const std::string& file) {
  const std::unique_ptr<xmlParserCtxt, void (*)(xmlParserCtxt*)> context(xmlNewParserCtxt(), xmlFreeParserCtxt);
  std::optional<Diagnostic> first;
  context->_private = &first;
  context->sax->serror = keep_first;
  const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA | XML_PARSE_BIG_LINES;
  const std::unique_ptr<xmlDoc, void (*)(xmlDoc*)> document(
      xmlCtxtReadMemory(context.get(), text.data(), static_cast<int>(text.size()), file.c_str(), nullptr, options), xmlFreeDoc);
  if (!document) {
    if (!first) first = {{}, "not well-formed XML: empty file"};
    first->place.file = file;
    throw InputError({*first});
  }
  std::vector<Diagnostic> diagnostics;
  Converter converter(file, diagnostics);
  xmlNode* root = xmlDocGetRootElement(document.get());
  if (text_of(root->name) != "ParameterList") {
    converter.say(root, "", fmt::format("the outermost element is <{}>; please use <ParameterList name=\"...\">", text_of(root->name)));
    throw InputError(diagnostics);
  }
  XmlList result = converter.list(root, "", true);
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return result;
}

std::string wrong_assignment(const std::string& assignment) {
  const std::string advice = "; please write path=value, for example variables/n=8";
  if (const std::string shown = without_control_characters(assignment); shown != assignment)
    return fmt::format("\"{}\" has a control character, such as a line break or a tab, in the place of a \"?\"; please remove it", shortened(shown));
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) return fmt::format("\"{}\" has no \"=\"{}", shortened(assignment), advice);
  const std::string path = '/' + assignment.substr(0, equals) + '/';
  if (path.find("//") != std::string::npos)
    return fmt::format("\"{}\" names nothing before, after or between two \"/\" of its path{}", shortened(assignment), advice);
  return "";
}

namespace {
/// True if a value of the list, or of one within, holds `name` as a word.
bool uses(const XmlList& list, const std::string& name) {
  return std::any_of(list.parameters.begin(), list.parameters.end(), [&](const XmlParameter& one) { return has_word(one.value, name); }) ||
         std::any_of(list.lists.begin(), list.lists.end(), [&](const XmlList& one) { return uses(one, name); });
}
}  // namespace

void apply_override(XmlList& root, const std::string& assignment) {
  const Place place{"command line: --set " + shortened(assignment), 0, ""};
  if (const std::string wrong = wrong_assignment(assignment); !wrong.empty()) throw InputError(place, wrong);
  const auto equals = assignment.find('=');
  apply_override(root, assignment.substr(0, equals), assignment.substr(equals + 1), place);
}

void apply_override(XmlList& root, const std::string& path, const std::string& value, const Place& place) {
  std::istringstream stream(path);
  std::vector<std::string> names;
  for (std::string name; std::getline(stream, name, '/');) names.push_back(name);
  if (names.empty()) names.emplace_back();
  XmlList* list = &root;
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    auto found = std::find_if(list->lists.begin(), list->lists.end(), [&](const XmlList& one) { return one.name == names[i]; });
    if (found == list->lists.end()) {
      const auto is_it = [&](const XmlParameter& one) { return one.name == names[i]; };
      if (std::any_of(list->parameters.begin(), list->parameters.end(), is_it))
        throw InputError(place, fmt::format("\"{}\" is a parameter: it has a value, and nothing below it", names[i]));
      const std::string parent = list->place.path;
      list->lists.push_back({names[i], {place.file, place.line, parent.empty() ? names[i] : parent + "/" + names[i]}, {}, {}});
      found = list->lists.end() - 1;
    }
    list = &*found;
  }
  const auto found =
      std::find_if(list->parameters.begin(), list->parameters.end(), [&](const XmlParameter& one) { return one.name == names.back(); });
  if (found == list->parameters.end() && names.size() == 2 && names[0] == "variables" && !uses(root, names[1])) {
    std::vector<std::string> known;
    for (const XmlParameter& one : list->parameters) known.push_back(one.name);
    throw InputError(place, fmt::format("there is no variable \"{}\", and no value uses one{}; {}", names[1], did_you_mean(names[1], known),
                                        known.empty() ? "the file has none" : "the file has " + quoted_list(known)));
  }
  XmlParameter parameter{names.back(), "", value, {place.file, place.line, list->place.path}};
  if (found == list->parameters.end())
    list->parameters.push_back(parameter);
  else
    *found = parameter;
}

}  // namespace mortise
