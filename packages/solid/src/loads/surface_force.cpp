// A force on a surface, spread evenly over its reference area.

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <map>

#include "bodies/host_view.hpp"
#include "loads/load_support.hpp"
#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

/// f_a = F w_a / sum_b w_b with w_a = integral of N_a dGamma0, in 2D dGamma0 = reference length x thickness or 2 pi R. As sum_a N_a = 1 the sum of the
/// w_a is the area, and that of the f_a is F.
class SurfaceForce final : public Load {
 public:
  SurfaceForce(std::shared_ptr<const Bodies> bodies, const SurfaceForceOptions& options)
      : bodies_(std::move(bodies)), components_(components(*bodies_, options.x, options.y, options.z)) {
    const Mesh& mesh = *bodies_->mesh();
    double mine = 0.0, area = 0.0;
    for (const LoadedSide& side : sides_at_owned_nodes(mesh, options.set))
      for (const SidePoint& point : *side.rule) {
        const double weight = reference_area(*bodies_, side, point);
        for (std::size_t a = 0; a < side.nodes.size(); ++a)
          if (side.nodes[a] < mesh.owned_count()) {
            shares_[side.nodes[a]] += weight * point.N[a];
            mine += weight * point.N[a];
          }
      }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(area));
    if (!(area > 0.0))
      throw InputError(options.set.place, fmt::format("set \"{}\" has no area that a force could be spread over", options.set.value));
    for (auto& [node, share] : shares_) share /= area;
  }

  void add_residual(double time, const Vector&, Vector& residual, std::optional<StepFailure>& failure) const override {
    const HostWriteView r(residual);
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const double force = evaluate(components_[i], time, {}, failure);
      for (const auto& [node, share] : shares_) r.data()[bodies_->space().row(node, static_cast<int>(i))] -= share * force;
    }
  }

 private:
  std::shared_ptr<const Bodies> bodies_;
  std::vector<ScalarFunction> components_;
  std::map<LocalOrdinal, double> shares_;  ///< of the owned nodes of the surface; all ranks' sum is 1
};

}  // namespace

void SurfaceForceOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("side set that carries the force").required());
  parameters.add("x", x, Says("force on the whole set in x (axisymmetric: r), of t").unit("force").arguments({"t"}));
  parameters.add("y", y, Says("force on the whole set in y (axisymmetric: z, on the whole circle), of t").unit("force").arguments({"t"}));
  parameters.add("z", z, Says("force on the whole set in z, in three dimensions, of t; left out: none").unit("force").arguments({"t"}));
}

std::unique_ptr<Load> SurfaceForceOptions::make(const std::shared_ptr<const Bodies>& bodies) const {
  return std::make_unique<SurfaceForce>(bodies, *this);
}

}  // namespace mortise
