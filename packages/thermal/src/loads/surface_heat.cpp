#include "loads/surface_heat.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <utility>
#include <vector>

#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

/// r_a = -integral of N_a q(theta) dA0,  dr_a/dtheta_b = -integral of N_a q' N_b dA0.
class SurfaceHeat final : public Contribution {
 public:
  SurfaceHeat(std::shared_ptr<const ThermalBodies> bodies, std::string set, std::vector<LoadedSide> sides, std::unique_ptr<const SurfaceFluxLaw> law)
      : bodies_(std::move(bodies)), set_(std::move(set)), sides_(std::move(sides)), law_(std::move(law)) {
    for (const LoadedSide& side : sides_)
      for (const LocalOrdinal a : side.nodes)
        for (const LocalOrdinal b : side.nodes) positions_.push_back(bodies_->space().sparsity().position(a, b, bodies_->temperature()));
  }

  std::string name() const override { return law_->name(); }
  Kind kind() const override { return Kind::external; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 0}; }

  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override {
    const auto r = residual.getLocalViewHost(Tpetra::Access::ReadWrite);
    visit_points(at, false, failure, [&](const LoadedSide& side, const LocalOrdinal*, const SidePoint& point, double area, const ValueAndSlope& q) {
      for (std::size_t a = 0; a < side.nodes.size(); ++a)
        if (is_owned(side.nodes[a])) r(row(side.nodes[a]), 0) -= area * point.N[a] * q.value;
    });
  }

  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override {
    const NodalSparsity::Values values = bodies_->space().sparsity().open(jacobian);
    visit_points(at, true, failure,
                 [&](const LoadedSide& side, const LocalOrdinal* positions, const SidePoint& point, double area, const ValueAndSlope& q) {
                   const std::size_t nodes = side.nodes.size();
                   for (std::size_t a = 0; a < nodes; ++a) {
                     if (!is_owned(side.nodes[a])) continue;
                     double* entries = values.row(row(side.nodes[a]));
                     for (std::size_t b = 0; b < nodes; ++b)
                       entries[positions[nodes * a + b]] -= weights.unknowns * area * point.N[a] * q.slope * point.N[b];
                   }
                 });
    values.close();
  }

 private:
  bool is_owned(LocalOrdinal node) const { return node < bodies_->mesh()->owned_count(); }
  LocalOrdinal row(LocalOrdinal node) const { return bodies_->space().row(bodies_->temperature(), node, 0); }

  template <class Visit>
  void visit_points(const Configuration& at, bool with_slope, std::optional<StepFailure>& failure, const Visit& visit) const {
    const Mesh& mesh = *bodies_->mesh();
    const auto unknowns = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    const LocalOrdinal* positions = positions_.data();
    for (const LoadedSide& side : sides_) {
      for (const SidePoint& point : *side.rule) {
        const SidePosition reference = side.at(point, mesh, {});
        SurfacePoint here{at.time, {reference.position[0], reference.position[1], reference.position[2]}, 0.0};
        for (std::size_t a = 0; a < side.nodes.size(); ++a) here.temperature += point.N[a] * unknowns(row(side.nodes[a]), 0);
        std::optional<SurfaceFault> fault;
        const ValueAndSlope q = law_->at(here, with_slope, fault);
        if (fault) {
          if (!failure) failure = failure_of(*fault, here);
          return;
        }
        const double area = point.weight * reference.area.norm() * depth(bodies_->kinematics(), bodies_->thickness(), here.position[0]);
        visit(side, positions, point, area, q);
      }
      positions += side.nodes.size() * side.nodes.size();
    }
  }

  StepFailure failure_of(const SurfaceFault& fault, const SurfacePoint& point) const {
    const auto& X = point.position;
    return {FailureKind::input, fmt::format("{} on \"{}\": the {} at ({:.6g}) of the reference configuration, at the temperature {:g} and t = {:g}; "
                                            "allowed: {}; change the load where it is not so",
                                            law_->name(), set_, fault.what, fmt::join(X.begin(), X.begin() + bodies_->mesh()->dimension, ", "),
                                            point.temperature, point.time, fault.allowed)};
  }

  std::shared_ptr<const ThermalBodies> bodies_;
  std::string set_;
  std::vector<LoadedSide> sides_;
  std::unique_ptr<const SurfaceFluxLaw> law_;
  std::vector<LocalOrdinal> positions_;  ///< [sides x nodes x nodes] NodalSparsity::position
};

}  // namespace

std::shared_ptr<Contribution> make_surface_heat(std::shared_ptr<const ThermalBodies> bodies, const Located<std::string>& set,
                                                std::unique_ptr<const SurfaceFluxLaw> law) {
  const Mesh& mesh = *bodies->mesh();
  std::vector<LoadedSide> sides = sides_at_owned_nodes(mesh, set);
  std::vector<Diagnostic> diagnostics;
  for (const Side& side : mesh.side_sets.at(set.value).sides) {
    if (bodies->bodies()[side.block].properties) continue;
    diagnostics.push_back({set.place, fmt::format("the set \"{}\" has sides of the body \"{}\", which has no temperature; give the body thermal "
                                                  "properties, or load a set without it",
                                                  set.value, mesh.body_of(mesh.blocks[side.block]).name)});
    break;
  }
  throw_if_any(*mesh.comm, diagnostics);
  return std::make_shared<SurfaceHeat>(std::move(bodies), set.value, std::move(sides), std::move(law));
}

}  // namespace mortise
