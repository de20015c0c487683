#include "mortise/contact/surface_force.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>

#include "evaluation/evaluated_contact.hpp"

namespace mortise {
namespace {

/// Sine of the angle between what two master nodes do to a gap up to which the master counts as flat.
constexpr double flat = 1e-2;

/// sum_l dg_j/dx_l of each slave node, and how far the parts lie off one another.
struct MasterNormals {
  std::vector<SpatialVector> sum;
  std::vector<std::vector<SpatialVector>> parts;

  MasterNormals(const detail::PairEvaluation& pair, const std::vector<char>& asked)
      : sum(asked.size(), SpatialVector::Zero(pair.dimension())), parts(asked.size()) {
    const Eigen::Index dim = pair.dimension();
    for (const FacetCoupling& facet : pair.couplings())
      for (std::size_t j = 0; j < facet.slave.size(); ++j) {
        const auto s = static_cast<std::size_t>(facet.slave[j]);
        if (s >= asked.size() || asked[s] == 0) continue;
        for (const LocalOrdinal node : facet.master) {
          const auto column = std::find(facet.columns.begin(), facet.columns.end(), node) - facet.columns.begin();
          parts[s].emplace_back(facet.dgap.block(static_cast<Eigen::Index>(j), dim * column, 1, dim).transpose());
          sum[s] += parts[s].back();
        }
      }
  }

  /// The unit normal where the master is flat, else `own`.
  SpatialVector at(std::size_t s, const SpatialVector& own) const {
    const double length = sum[s].norm();
    if (!(length > 0.0)) return own;
    const SpatialVector normal = sum[s] / length;
    double off = 0.0;
    for (const SpatialVector& part : parts[s]) off = std::max(off, (part - part.dot(normal) * normal).norm());
    return off <= flat * length ? normal : own;
  }
};

}  // namespace

SurfaceForce surface_force(const ContactLaws& laws, std::size_t pair) {
  const detail::EvaluatedLaws& at = detail::evaluated(laws);
  const detail::ContactModel& model = *at.contact->model;
  const detail::PairEvaluation& of_pair = at.contact->pairs[pair];
  const FrictionLaw* friction = of_pair.pair().friction();
  std::vector<double> mine(6, 0.0), all(6);  // the sum along the master, what is allowed, normal forces, these times the lean
  if (!of_pair.pair().has_forces_of_gaps() && !of_pair.couplings().empty()) {
    std::vector<char> asked(of_pair.slave_nodes().size(), 0);
    for (std::size_t s = 0; s < asked.size(); ++s) asked[s] = model.multiplier_of[pair][s] >= 0 && at.state(pair, s) != ContactState::open;
    const MasterNormals normals(of_pair, asked);
    for (std::size_t s = 0; s < asked.size(); ++s) {
      if (asked[s] == 0) continue;
      const SpatialVector& z = at.multipliers[pair][s].z;
      const detail::NodeRow& row = of_pair.row(s);
      const SpatialVector force = of_pair.resultant(s, z), e = normals.at(s, row.normal), along = force - force.dot(e) * e;
      for (Eigen::Index i = 0; i < along.size(); ++i) mine[static_cast<std::size_t>(i)] += along[i];
      const double pressure = std::max(0.0, z.dot(row.normal)), weight = std::max(0.0, row.covered);
      if (friction != nullptr) mine[3] += weight * friction->bound(of_pair.friction_point(s, pressure)).value;
      mine[4] += weight * pressure;
      mine[5] += weight * pressure * (row.normal - row.normal.dot(e) * e).norm();
    }
  }
  Teuchos::reduceAll(model.comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return {std::hypot(all[0], all[1], all[2]), all[3], all[4] > 0.0 ? std::asin(std::min(1.0, all[5] / all[4])) : 0.0};
}

}  // namespace mortise
