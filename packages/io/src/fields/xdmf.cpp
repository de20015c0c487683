#include "fields/xdmf.hpp"

#include <fmt/format.h>
#include <libxml/xmlreader.h>
#include <libxml/xmlwriter.h>

#include <memory>
#include <stdexcept>

namespace mortise {
namespace {

const xmlChar* text(const std::string& string) { return reinterpret_cast<const xmlChar*>(string.c_str()); }

/// Part of a document in memory, by libxml2's writer. Elements close with their scope.
class Part {
 public:
  Part() : buffer_(xmlBufferCreate(), xmlBufferFree), writer_(xmlNewTextWriterMemory(buffer_.get(), 0), xmlFreeTextWriter) {
    if (buffer_ == nullptr || writer_ == nullptr) throw std::bad_alloc();
    xmlTextWriterSetIndent(writer_.get(), 1);
  }

  class Element {
   public:
    Element(xmlTextWriter* writer, const std::string& name) : writer_(writer) { xmlTextWriterStartElement(writer_, text(name)); }
    ~Element() { xmlTextWriterEndElement(writer_); }
    Element(const Element&) = delete;
    Element& operator=(const Element&) = delete;
    Element& attribute(const std::string& name, const std::string& value) {
      xmlTextWriterWriteAttribute(writer_, text(name), text(value));
      return *this;
    }
    void content(const std::string& value) { xmlTextWriterWriteString(writer_, text(value)); }

   private:
    xmlTextWriter* writer_;
  };
  Element element(const std::string& name) { return Element(writer_.get(), name); }

  std::string finish() {
    xmlTextWriterFlush(writer_.get());
    return reinterpret_cast<const char*>(xmlBufferContent(buffer_.get()));
  }

 private:
  std::unique_ptr<xmlBuffer, decltype(&xmlBufferFree)> buffer_;
  std::unique_ptr<xmlTextWriter, decltype(&xmlFreeTextWriter)> writer_;
};

/// `dataset` is the HDF5 file and the path in it.
void data_item(Part& part, const std::string& dataset, const std::string& dimensions, bool whole) {
  auto item = part.element("DataItem");
  item.attribute("Dimensions", dimensions).attribute("NumberType", whole ? "Int" : "Float").attribute("Precision", "8").attribute("Format", "HDF");
  item.content(dataset);
}

void attribute(Part& part, const XdmfMesh& mesh, const StoredField& field, const std::string& file) {
  static const char* const types[] = {"Scalar", "Vector", "Tensor6", "Scalar"};
  const int components = stored_components(field.kind);
  const long long rows = field.center == Field::Center::node ? mesh.nodes : mesh.elements;
  auto attribute = part.element("Attribute");
  attribute.attribute("Name", field.name)
      .attribute("AttributeType", types[static_cast<int>(field.kind)])
      .attribute("Center", field.center == Field::Center::node ? "Node" : "Cell");
  data_item(part, file + ":/" + field.name, components == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, components),
            field.kind == FieldKind::integer);
}

void step_grid(Part& part, const XdmfMesh& mesh, const StoredStep& step) {
  auto grid = part.element("Grid");
  grid.attribute("Name", fmt::format("step {}", step.step)).attribute("GridType", "Uniform");
  part.element("Time").attribute("Value", fmt::format("{}", step.time));
  {
    auto topology = part.element("Topology");
    topology.attribute("TopologyType", "Mixed").attribute("NumberOfElements", fmt::format("{}", mesh.elements));
    data_item(part, mesh_file + ":/topology", fmt::format("{}", mesh.topology_size), true);
  }
  {
    auto geometry = part.element("Geometry");
    geometry.attribute("GeometryType", "XYZ");
    data_item(part, mesh_file + ":/coordinates", fmt::format("{} 3", mesh.nodes), false);
  }
  attribute(part, mesh, {"body", Field::Center::cell, FieldKind::integer}, mesh_file);
  for (const auto& field : step.fields) attribute(part, mesh, field, step_file(step.step));
}

}  // namespace

int stored_components(FieldKind kind) {
  if (kind == FieldKind::vector) return 3;
  return kind == FieldKind::symmetric_tensor ? 6 : 1;
}

std::string xdmf_head(const XdmfMesh& mesh) {
  std::string head = R"(<?xml version="1.0" encoding="UTF-8"?>
<Xdmf Version="3.0">
<Domain>
)";
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
    Part part;
    part.element("Information").attribute("Name", fmt::format("body {}", body)).attribute("Value", mesh.bodies[body]);
    head += part.finish();
  }
  return head + R"(<Grid Name="fields" GridType="Collection" CollectionType="Temporal">
)";
}

std::string xdmf_step(const XdmfMesh& mesh, const StoredStep& step) {
  Part part;
  step_grid(part, mesh, step);
  return part.finish();
}

void read_body_names(const std::string& path, std::vector<std::string>& names) {
  const std::unique_ptr<xmlTextReader, decltype(&xmlFreeTextReader)> reader(
      xmlReaderForFile(path.c_str(), nullptr, XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING), xmlFreeTextReader);
  while (reader != nullptr && xmlTextReaderRead(reader.get()) == 1) {
    const std::string element = reinterpret_cast<const char*>(xmlTextReaderConstName(reader.get()));
    if (element == "Grid") return;
    if (element != "Information") continue;
    const std::unique_ptr<xmlChar, decltype(xmlFree)> value(xmlTextReaderGetAttribute(reader.get(), text("Value")), xmlFree);
    if (value != nullptr) names.emplace_back(reinterpret_cast<const char*>(value.get()));
  }
}

std::string xdmf_tail() { return "</Grid>\n</Domain>\n</Xdmf>\n"; }

}  // namespace mortise
