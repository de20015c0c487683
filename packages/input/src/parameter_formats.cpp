// The tree of parameters as text, Markdown, RELAX NG and scene XML.

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <nlohmann/json.hpp>

#include "mortise/input/parameter_tree.hpp"

namespace mortise {
namespace {

using Kind = ListRecord::Kind;

std::string escaped(std::string text) {
  boost::replace_all(text, "&", "&amp;");
  boost::replace_all(text, "<", "&lt;");
  boost::replace_all(text, ">", "&gt;");
  boost::replace_all(text, "\"", "&quot;");
  return text;
}

std::string default_text(const ParameterRecord& one) {
  if (one.says.is_required()) return "required";
  return one.value.empty() ? "-" : one.value;
}

void text_of(const ListRecord& list, const std::string& indent, std::string& out) {
  for (const ParameterRecord& one : list.parameters) {
    out += fmt::format("{}\"{}\"  {}", indent, one.name, one.kind_text());
    if (!one.says.unit().empty()) out += fmt::format(" [{}]", one.says.unit());
    if (const std::string range = one.range_text(); !range.empty()) out += ", " + range;
    out += fmt::format("; default: {}\n{}    {}\n", default_text(one), indent, one.says.sentence());
  }
  for (const auto& [name, kind] : list.kinds) {
    out += fmt::format("{}with \"type\" = \"{}\": {}\n", indent, name, kind.says.sentence());
    text_of(kind, indent + "    ", out);
  }
  for (const ListRecord& one : list.lists) {
    out += fmt::format("{}list \"{}\": {}\n", indent, one.name, one.says.sentence());
    text_of(one, indent + "    ", out);
  }
}

void table_of(const std::vector<ParameterRecord>& parameters, std::string& out) {
  if (parameters.empty()) return;
  out += "\n| parameter | kind | default | unit | range | meaning |\n|---|---|---|---|---|---|\n";
  const auto cell = [](std::string text) {
    boost::replace_all(text, "|", "\\|");
    boost::replace_all(text, "<", "&lt;");
    return text;
  };
  for (const ParameterRecord& one : parameters)
    out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", one.name, cell(one.kind_text()), cell(default_text(one)), cell(one.says.unit()),
                       cell(one.range_text()), cell(one.says.sentence()));
}

void markdown_of(const ListRecord& list, const std::string& path, std::string& out) {
  table_of(list.parameters, out);
  for (const auto& [name, kind] : list.kinds) {
    out += fmt::format("\n**`type` = `{}`**: {}\n", name, kind.says.sentence());
    markdown_of(kind, path, out);
  }
  for (const ListRecord& one : list.lists) {
    const std::string below = path.empty() ? one.name : path + "/" + one.name;
    out += fmt::format("\n## `{}`\n\n{}\n", below, one.says.sentence());
    markdown_of(one, below, out);
  }
}

nlohmann::ordered_json json_of(const ListRecord& list) {
  nlohmann::ordered_json json{{"name", list.name}, {"sentence", list.says.sentence()}};
  for (const ParameterRecord& one : list.parameters) {
    nlohmann::ordered_json parameter{{"name", one.name}, {"kind", one.kind_text()}};
    if (one.says.is_required()) parameter["required"] = true;
    for (const auto& [key, text] :
         {std::pair{"default", one.says.is_required() ? "" : one.value}, {"unit", one.says.unit()}, {"range", one.range_text()}})
      if (!text.empty()) parameter[key] = text;
    if (!one.choices.empty()) parameter["choices"] = one.choices;
    parameter["sentence"] = one.says.sentence();
    json["parameters"].push_back(std::move(parameter));
  }
  for (const auto& [type, kind] : list.kinds) json["kinds"][type] = json_of(kind);
  for (const ListRecord& one : list.lists) json["lists"].push_back(json_of(one));
  return json;
}

class RelaxNg {
 public:
  std::string grammar(const ListRecord& tree, bool symbols) {
    line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    line("<grammar xmlns=\"http://relaxng.org/ns/structure/1.0\" datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\">");
    line("<start><element name=\"ParameterList\"><optional><attribute name=\"name\"/></optional><zeroOrMore><choice>");
    if (symbols) {
      free_list("variables", false);
      free_list("tables", true);
    }
    alternatives(tree);
    line("</choice></zeroOrMore></element></start>");
    line(
        "<define name=\"anything\"><zeroOrMore><choice><ref name=\"parameter\"/><element name=\"ParameterList\"><attribute name=\"name\"/>"
        "<ref name=\"anything\"/></element></choice></zeroOrMore></define>");
    line(
        "<define name=\"parameter\"><element name=\"Parameter\"><attribute name=\"name\"/><attribute name=\"type\"/><attribute "
        "name=\"value\"/></element></define>");
    line("</grammar>");
    return out_;
  }

 private:
  void line(const std::string& text) { out_ += text + "\n"; }

  void free_list(const std::string& name, bool lists) {
    line(fmt::format("<element name=\"ParameterList\"><attribute name=\"name\"><value>{}</value></attribute>{}</element>", name,
                     lists ? "<ref name=\"anything\"/>" : "<zeroOrMore><ref name=\"parameter\"/></zeroOrMore>"));
  }

  void parameter(const ParameterRecord& one, const std::string& fixed_value) {
    line(fmt::format("<element name=\"Parameter\"><attribute name=\"name\"><value>{}</value></attribute>", escaped(one.name)));
    std::string types = "<value>string</value>";
    if (one.type() != "string") types += fmt::format("<value>{}</value>", one.type());
    if (one.type() == "double" || one.kind == ParameterRecord::Kind::numbers) types += "<value>int</value>";
    const bool expression = one.kind == ParameterRecord::Kind::expression || one.kind == ParameterRecord::Kind::optional_expression;
    if (expression || one.kind == ParameterRecord::Kind::numbers) types += "<value>double</value>";
    if (expression) types += "<value>int</value>";
    line(fmt::format("<attribute name=\"type\"><choice>{}</choice></attribute>", types));
    std::string values;
    if (!fixed_value.empty()) {
      values = fmt::format("<value>{}</value>", escaped(fixed_value));
    } else if (one.kind == ParameterRecord::Kind::enumeration) {
      for (const std::string& choice : one.choices) values += fmt::format("<value>{}</value>", escaped(choice));
      values = "<choice>" + values + "</choice>";
    } else {
      values = "<text/>";
    }
    line("<attribute name=\"value\">" + values + "</attribute></element>");
  }

  // Allowed content of a list, in any order. RELAX NG cannot interleave elements of one name, so that each parameter stands once and none is
  // missing is left to the reader.
  void content(const ListRecord& list) {
    if (list.kind == Kind::verbatim) {
      line("<ref name=\"anything\"/>");
    } else if (list.kind == Kind::named) {
      line("<zeroOrMore><element name=\"ParameterList\"><attribute name=\"name\"/>");
      content(list.lists.front());
      line("</element></zeroOrMore>");
    } else if (list.kinds.empty()) {
      line("<zeroOrMore><choice><notAllowed/>");
      alternatives(list);
      line("</choice></zeroOrMore>");
    } else {
      const auto type = std::find_if(list.parameters.begin(), list.parameters.end(), [](const ParameterRecord& one) { return one.name == "type"; });
      line("<choice>");
      for (const auto& [name, kind] : list.kinds) {
        line("<zeroOrMore><choice>");
        parameter(*type, name);
        alternatives(list);
        alternatives(kind);
        line("</choice></zeroOrMore>");
      }
      line("</choice>");
    }
  }

  void alternatives(const ListRecord& list) {
    for (const ParameterRecord& one : list.parameters)
      if (list.kinds.empty() || one.name != "type") parameter(one, "");
    for (const ListRecord& one : list.lists) {
      line(fmt::format("<element name=\"ParameterList\"><attribute name=\"name\"><value>{}</value></attribute>", escaped(one.name)));
      content(one);
      line("</element>");
    }
  }

  std::string out_;
};

void verbatim_of(const Teuchos::ParameterList& list, const std::string& indent, std::string& out) {
  for (const auto& one : list) {
    const std::string& name = one.first;
    const Teuchos::ParameterEntry& entry = one.second;
    if (entry.isList()) {
      out += fmt::format("{}<ParameterList name=\"{}\">\n", indent, escaped(name));
      verbatim_of(list.sublist(name), indent + "  ", out);
      out += indent + "</ParameterList>\n";
      continue;
    }
    std::string type = "string", value;
    if (entry.isType<bool>()) {
      type = "bool";
      value = list.get<bool>(name) ? "true" : "false";
    } else if (entry.isType<int>()) {
      type = "int";
      value = fmt::format("{}", list.get<int>(name));
    } else if (entry.isType<double>()) {
      type = "double";
      value = fmt::format("{}", list.get<double>(name));
    } else {
      value = list.get<std::string>(name);
    }
    out += fmt::format("{}<Parameter name=\"{}\" type=\"{}\" value=\"{}\"/>\n", indent, escaped(name), type, escaped(value));
  }
}

void scene_of(const ListRecord& list, const std::string& indent, std::string& out) {
  out += fmt::format("{}<ParameterList name=\"{}\">\n", indent, escaped(list.name));
  for (const ParameterRecord& one : list.parameters) {
    if (one.optional() && one.value.empty()) continue;  // chosen by the program
    out += fmt::format("{}  <Parameter name=\"{}\" type=\"{}\" value=\"{}\"/>\n", indent, escaped(one.name), one.type(), escaped(one.value));
  }
  if (list.kind == Kind::verbatim) verbatim_of(list.verbatim, indent + "  ", out);
  for (const ListRecord& one : list.lists) scene_of(one, indent + "  ", out);
  out += indent + "</ParameterList>\n";
}

}  // namespace

std::string to_text(const ListRecord& tree) {
  std::string out;
  text_of(tree, "", out);
  return out;
}

std::string to_markdown(const ListRecord& tree) {
  std::string out = fmt::format("# {}\n{}{}", tree.name, tree.says.sentence(), tree.says.sentence().empty() ? "" : "\n");
  markdown_of(tree, "", out);
  return out;
}

std::string to_json(const ListRecord& tree) { return json_of(tree).dump(2) + "\n"; }

std::string to_relax_ng(const ListRecord& tree, bool symbols) { return RelaxNg().grammar(tree, symbols); }

std::string to_scene_xml(const ListRecord& tree, const std::vector<ListRecord>& extra) {
  ListRecord whole = tree;
  whole.lists.insert(whole.lists.begin(), extra.begin(), extra.end());
  std::string out = "<?xml version=\"1.0\"?>\n";
  scene_of(whole, "", out);
  return out;
}

}  // namespace mortise
