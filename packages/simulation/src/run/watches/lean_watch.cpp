#include "run/watches/lean_watch.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/contact/contact_report.hpp"
#include "mortise/contact/surface_force.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

/// Share of what acts on a body from which on it is worth saying.
constexpr double worth_saying = 1e-2;

/// Of the largest force of a pair: a sum of the forces on a body below it is nothing but their round-off.
constexpr double no_force = 1e-6;

/// Of E L^(d-1), with the softest material: a force below it strains nothing.
constexpr double no_strain = 1e-12;

double magnitude(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

LeanWatch::LeanWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), scene_(scene), warn_(std::move(warn)) {
  const Mesh& mesh = *model.mesh();
  const auto bodies = [&](const Located<std::string>& set) {
    std::vector<std::size_t> result;
    for (const SidesOfBody& sides : sides_by_body(mesh, require_side_set(mesh, set))) result.push_back(sides.body);
    return result;
  };
  double softest = std::numeric_limits<double>::max(), softest_of_all = softest;
  for (const Block& block : mesh.blocks) softest = std::min(softest, youngs_modulus(scene, mesh, block));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, softest, Teuchos::outArg(softest_of_all));
  hardly_strains_ = no_strain * softest_of_all * std::pow(model.parts().length, mesh.dimension - 1);
  for (const auto& contact : scene.contact) pairs_.push_back({bodies(contact.value.slave), bodies(contact.value.master), false, ""});
}

// The force on a body is the sum over all its pairs, in balance with its loads and supports. For a body between two others that is 0: then the
// largest of them.
void LeanWatch::examine(const ContactLaws& laws) {
  std::vector<std::array<double, 3>> acting(model_.mesh()->bodies.size(), std::array<double, 3>{});
  std::vector<double> largest(acting.size(), 0.0);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const std::array<double, 3> force = resultant(laws, p);  // on the slave
    for (const double sign : {1.0, -1.0})
      for (const std::size_t body : sign > 0.0 ? pairs_[p].slave : pairs_[p].master) {
        for (int i = 0; i < 3; ++i) acting[body][i] += sign * force[i];
        largest[body] = std::max(largest[body], magnitude(force));
      }
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    Pair& pair = pairs_[p];
    pair.found.clear();
    const SurfaceForce borne = surface_force(laws, p);
    const double excess = borne.along - borne.allowed;
    double share = 0.0;
    std::size_t which = 0;
    for (const auto* bodies : {&pair.slave, &pair.master}) {
      if (bodies->size() != 1) continue;  // what acts on each of several is not known
      const std::size_t body = bodies->front();
      const double whole = magnitude(acting[body]), load = whole > no_force * largest[body] ? whole : largest[body];
      if (load > hardly_strains_ && excess / load > share) share = excess / load, which = body;
    }
    if (!(share > worth_saying)) continue;
    pair.found = fmt::format(
        "contact \"{}\" bears {:.4g} along the master, {}: the slave's normals lean from the master's, by {:.2g} degrees in the mean, as they are "
        "averages over coarse facets or those of its end; this bears {:.2g} % of what acts on body '{}'; please make the slave finer there, or "
        "exchange slave and master, or at an end put the side beside it into the slave",
        scene_.contact[p].name, borne.along, borne.allowed > 0.0 ? fmt::format("where friction bears {:.4g}", borne.allowed) : "without friction",
        borne.lean * 180.0 / M_PI, 100.0 * share, model_.mesh()->bodies[which].name);
  }
}

void LeanWatch::accept() {
  for (Pair& pair : pairs_) {
    if (pair.found.empty() || pair.is_warned) continue;
    pair.is_warned = true;
    warn_("  " + pair.found);
  }
}

void LeanWatch::serialize(StateArchive& archive) {
  std::vector<int> warned;
  for (const Pair& pair : pairs_) warned.push_back(pair.is_warned ? 1 : 0);
  mortise::serialize(archive, "lean_watch.warned", warned);
  for (std::size_t p = 0; p < std::min(warned.size(), pairs_.size()); ++p) pairs_[p].is_warned = warned[p] != 0;
}

}  // namespace mortise
