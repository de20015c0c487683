#include "mortise/contact/formulation/node_to_segment.hpp"

namespace mortise {

void NodeToSegment::describe(Parameters& parameters) {
  parameters.add("passes", passes, {{"single", Passes::single}, {"two", Passes::two}},
                 "single: slave nodes are kept from penetrating; two: master nodes as well, in a second pass");
}

}  // namespace mortise
