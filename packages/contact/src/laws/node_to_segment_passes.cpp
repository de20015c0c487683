#include "mortise/contact/formulation/node_to_segment.hpp"

namespace mortise {

void NodeToSegment::describe(Parameters& parameters) {
  parameters.add("passes", passes, {{"single", Passes::single}, {"two", Passes::two}},
                 "whether only slave nodes are kept from penetrating, or master nodes in a second pass as well");
}

}  // namespace mortise
