// Nodes, elements and materials of a deck of CalculiX.

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <iterator>

#include "mortise/material/materials.hpp"
#include "peer/calculix_deck.hpp"

namespace mortise {
namespace {

using Text = std::back_insert_iterator<std::string>;

/// Plastic strains at which a hardening law is sampled: CalculiX joins them by lines, and keeps the last yield stress beyond the last. From 1e-5 on a
/// geometric sequence with 8 points a decade, so that a power of the strain is met to about 1 % of its growth between two points.
std::vector<double> sampled_strains() {
  std::vector<double> strains{0.0};
  for (int i = 0; i <= 8 * 6; ++i) strains.push_back(std::pow(10.0, -5.0 + i / 8.0));
  return strains;
}

/// *ELASTIC is linear in Green's strain at finite strain; *PLASTIC is von Mises' with the multiplicative split, Cauchy stress against plastic strain.
void write_material(Text text, const MaterialOptions& material) {
  fmt::format_to(text, "*ELASTIC\n{:.10g},{:.10g}\n", material.youngs_modulus, material.poissons_ratio);
  const Law law = material.law();
  if (const auto* plastic = std::get_if<FiniteJ2>(&law)) {
    fmt::format_to(text, "*PLASTIC\n");
    for (const double strain : sampled_strains()) fmt::format_to(text, "{:.10g},{:.10g}\n", yield_stress(plastic->hardening, strain), strain);
  }
}

/// A line of a deck holds 16 numbers at most; a comma at its end continues it.
void write_numbers(Text text, const std::vector<GlobalOrdinal>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    fmt::format_to(text, "{}{}", numbers[i], i + 1 == numbers.size() ? "\n" : i % 16 == 15 ? ",\n" : ",");
}

}  // namespace

/// Nodes of cells are in CalculiX' order.
std::string deck_bodies(const Model& model) {
  const Mesh& mesh = *model.mesh();
  const DeckNumbers numbers(mesh);
  const auto id = [&](LocalOrdinal node) { return mesh.local_nodes->getGlobalElement(node); };
  std::string deck;
  const auto text = std::back_inserter(deck);
  fmt::format_to(text, "*NODE,NSET=ALL\n");
  for (int layer = 0; layer < numbers.layers; ++layer)
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      fmt::format_to(text, "{},{:.12g},{:.12g},{:.12g}\n", numbers.node(id(node), layer), mesh.coordinates[node][0], mesh.coordinates[node][1],
                     layer == 0 ? mesh.coordinates[node][2] : model.bodies()->thickness());
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Block& block = mesh.blocks[b];
    fmt::format_to(text, "{}*ELEMENT,TYPE={},ELSET=BODY{}\n", deck_comment(mesh.body_of(block).name), calculix_element(block.shape), b);
    for (LocalOrdinal element = 0; element < block.size(); ++element) {
      std::vector<GlobalOrdinal> line{block.element_ids[element] + 1};
      for (int layer = 0; layer < numbers.layers; ++layer)
        for (int a = 0; a < block.nodes_per_element; ++a) line.push_back(numbers.node(id(block.nodes(element)[a]), layer));
      write_numbers(text, line);
    }
    fmt::format_to(text, "*MATERIAL,NAME=MATERIAL{}\n", b);
    write_material(text, *model.bodies()->properties()[b].material);
    fmt::format_to(text, "*SOLID SECTION,ELSET=BODY{0},MATERIAL=MATERIAL{0}\n", b);
  }
  return deck;
}

}  // namespace mortise
