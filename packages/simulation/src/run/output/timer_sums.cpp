#include "run/output/timer_sums.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

namespace mortise {

std::map<std::string, double> seconds_by_name(const Timers& timers, const RCP<const Communicator>& comm) {
  // Of StackedTimer's outputs the XML one is the only one made for being read: <timing name="total" value="1.0e+00"> ... </timing>.
  std::ostringstream xml;
  timers.stacked().reportXML(xml, "", "", comm);
  const std::string text = xml.str();
  std::map<std::string, double> seconds;
  static const std::regex timing("<timing name=\"([^\"]*)\" value=\"([^\"]*)\"");
  for (std::sregex_iterator match(text.begin(), text.end(), timing), end; match != end; ++match) {
    std::string name = (*match)[1];
    if (name == "Remainder") continue;  // what StackedTimer calls the time of a timer that none of its children accounts for
    std::replace(name.begin(), name.end(), ' ', '_');
    seconds[name] += std::stod((*match)[2]);
  }
  return seconds;
}

std::string timer_report(const Timers& timers, const RCP<const Communicator>& comm) {
  std::ostringstream text;
  Teuchos::StackedTimer::OutputOptions options;
  options.output_fraction = options.output_minmax = true;
  timers.stacked().report(text, comm, options);
  return text.str();
}

}  // namespace mortise
