#pragma once
// A facet's coupling as it travels from the rank that integrates it to those that own its nodes.

#include <functional>
#include <optional>

#include "exchange/word_stream.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// Header of the message of a facet.
struct CouplingHeader {
  SurfaceFacet slave;
  std::size_t segments = 0;  ///< integrated; 0: there is no coupling
};

/// Appends the header and, if there are segments, the coupling, with nodes turned into ids.
void put_coupling(WordWriter& to, const CouplingHeader& header, const FacetCoupling& coupling, const std::function<GlobalOrdinal(LocalOrdinal)>& id);

CouplingHeader get_header(WordReader& from);
/// Reads the coupling that follows a header with segments, with ids turned into local nodes.
void get_coupling(WordReader& from, const CouplingHeader& header, const std::function<LocalOrdinal(GlobalOrdinal)>& local, FacetCoupling& coupling);

}  // namespace mortise
