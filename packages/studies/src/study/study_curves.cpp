#include "study/study_curves.hpp"

#include <boost/algorithm/string/join.hpp>
#include <map>

namespace mortise {

std::vector<StudyCurve> study_curves(const StudyPlan& plan) {
  using Labels = std::vector<std::string>;
  std::vector<StudyCurve> curves;
  std::map<Labels, std::size_t> found;  // by the labels, "" for that along the curve
  const auto key = [&](Labels labels) { return labels[plan.along].clear(), labels; };
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const StudyPoint& point = plan.points[i];
    const auto [at, is_new] = found.try_emplace(key(point.labels), curves.size());
    if (is_new) {
      Labels others = point.titles;
      others.erase(others.begin() + plan.along);
      curves.push_back({others.empty() ? point.formulation + ", " + point.element : boost::algorithm::join(others, ", "), 0, {}});
    }
    curves[at->second].points.push_back(i);
  }
  for (const auto& [labels, index] : found) {
    Labels base = labels;
    if (plan.series != plan.along) base[plan.series] = plan.labels[plan.series].front();
    const auto at = found.find(base);
    curves[index].base = at == found.end() ? index : at->second;
  }
  return curves;
}

}  // namespace mortise
