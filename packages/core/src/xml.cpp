#include "mortise/core/xml.hpp"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

namespace mortise {
namespace {

std::string text_of(const xmlChar* text) { return text ? reinterpret_cast<const char*>(text) : ""; }

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
      if (child->type != XML_ELEMENT_NODE) {
        say(child, result.place.path, fmt::format("text outside of elements: \"{}\"", text_of(child->content).substr(0, 40)));
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
        const std::unique_ptr<xmlChar, void (*)(void*)> content(xmlNodeGetContent(one->children ? one->children : reinterpret_cast<xmlNode*>(one)),
                                                                xmlFree);
        value = text_of(content.get());
        found = true;
      }
    }
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
  long long size = -1;
  if (comm.getRank() == 0) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    std::error_code none;
    const bool empty = std::filesystem::is_regular_file(path, none) && std::filesystem::file_size(path, none) == 0;
    if (file && (content << file.rdbuf() || empty)) {  // nothing to copy is a failure of <<
      text = content.str();
      size = static_cast<long long>(text.size());
    }
  }
  Teuchos::broadcast(comm, 0, Teuchos::outArg(size));
  if (size < 0) throw FileError(fmt::format("{}: cannot be read: {}", path, comm.getRank() == 0 ? std::strerror(errno) : "rank 0 failed"));
  text.resize(size);
  Teuchos::broadcast(comm, 0, static_cast<int>(size), text.data());
  return text;
}

XmlList parse_xml(const std::string& text, const std::string& file) {
  const std::unique_ptr<xmlParserCtxt, void (*)(xmlParserCtxt*)> context(xmlNewParserCtxt(), xmlFreeParserCtxt);
  const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA | XML_PARSE_BIG_LINES;
  const std::unique_ptr<xmlDoc, void (*)(xmlDoc*)> document(
      xmlCtxtReadMemory(context.get(), text.data(), static_cast<int>(text.size()), file.c_str(), nullptr, options), xmlFreeDoc);
  if (!document) {
    const xmlError* error = xmlCtxtGetLastError(context.get());
    std::string message = error && error->message ? error->message : "empty file";
    message.erase(message.find_last_not_of(" \n") + 1);
    throw InputError({file, error ? error->line : 0, ""}, "not well-formed XML: " + message);
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

void apply_override(XmlList& root, const std::string& assignment) {
  const auto equals = assignment.find('=');
  const Place place{"command line: --set " + assignment, 0, ""};
  if (equals == std::string::npos || equals == 0) throw InputError(place, "please write --set path=value, for example --set variables/n=8");
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
  XmlParameter parameter{names.back(), "", value, {place.file, place.line, list->place.path}};
  if (found == list->parameters.end())
    list->parameters.push_back(parameter);
  else
    *found = parameter;
}

}  // namespace mortise
