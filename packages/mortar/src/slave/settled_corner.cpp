#include "slave/settled_corner.hpp"

#include "normals/corner_normal.hpp"
#include "slave/slave_facet.hpp"

namespace mortise {
namespace {

/// Cosine of the angle to the master's normal from which on a facet faces it, and twice that at which it has its whole weight. Both 2D and 3D cut off
/// at a sine of 0.05 against its plane.
constexpr double faces_from = 0.05, faces_wholly_from = 0.15;

/// A value and its slope.
struct SeenShare {
  double value, slope;
};

// w = c S((c - 0.05) / 0.1) of the cosine c, S(t) = t^2 (3 - 2 t) on [0, 1]. A wall that leans over begins to be covered as a whole once it faces the
// master. With c alone the multiplier of the corner, if it acts along the facet as standard ones do, would act on the wall's next node at once.
SeenShare seen_share(double cosine) {
  if (!(cosine > faces_from)) return {0.0, 0.0};
  const double width = faces_wholly_from - faces_from, t = (cosine - faces_from) / width;
  if (t >= 1.0) return {cosine, 1.0};
  const double S = t * t * (3.0 - 2.0 * t);
  return {cosine * S, S + cosine * 6.0 * t * (1.0 - t) / width};
}

// The weights of the facets as seen along the corner's normal, with its derivative in the corner's columns (empty without derivatives).
template <int dim>
void measure_weights(SettledCorner& corner, const SpatialVector& normal, const Eigen::MatrixXd& slope, bool moves) {
  for (const CornerSide& side : corner.sides) {
    const NodalNormal& own = *side.normal;
    const SeenShare share = seen_share(own.normal.dot(normal));
    corner.weight.push_back(share.value);
    corner.slope_of_weight.emplace_back(Eigen::RowVectorXd::Zero(slope.cols()));
    if (!moves || !(share.slope > 0.0)) continue;
    corner.slope_of_weight.back() = own.normal.transpose() * slope;
    add_columns<dim>(corner.columns, own.columns, Eigen::RowVectorXd(normal.transpose() * own.derivative), corner.slope_of_weight.back());
    corner.slope_of_weight.back() *= share.slope;
  }
}

// n_j of m_j and the facets' normals: the surface turns from the first to the second.
CornerNormal<2> direction_of(const SettledCorner& corner, const Eigen::Vector2d& facing, const NormalStencil&) {
  return corner_normal(facing, corner.sides[0].normal->normal, corner.sides[1].normal->normal);
}

// The same in 3D, where a corner may stand on planes of symmetry. Let P leave out the components across these planes. The half that is seen and its
// images have the sum P m_j, and the part of their cone in all these planes is the cone of P n_f. So P m_j and P n_f take the place of m_j and n_f.
CornerNormal<3> direction_of(const SettledCorner& corner, const Eigen::Vector3d& facing, const NormalStencil& stencil) {
  const Eigen::Matrix3d P = Eigen::Vector3d(!stencil.projected[0], !stencil.projected[1], !stencil.projected[2]).asDiagonal();
  constexpr double none = 1e-6;  // of a facet across these planes, which adds nothing to the cone
  std::vector<Eigen::Vector3d> seen;
  std::vector<Eigen::Matrix3d> of_facet(corner.sides.size(), Eigen::Matrix3d::Zero());
  std::vector<std::size_t> from;
  for (std::size_t e = 0; e < corner.sides.size(); ++e) {
    const Eigen::Vector3d along = P * corner.sides[e].normal->normal;
    const double length = along.norm();
    if (!(length > none)) continue;
    seen.push_back(along / length);
    of_facet[e] = (P - seen.back() * seen.back().transpose()) / length;
    from.push_back(e);
  }
  CornerNormal<3> result = corner_normal(Eigen::Vector3d(P * facing), seen);
  result.of_facing *= P;
  for (std::size_t g = 0; g < from.size(); ++g) of_facet[from[g]] = result.of_facets[g] * of_facet[from[g]];
  result.of_facets = std::move(of_facet);
  return result;
}

template <int dim>
bool has_direction(const Eigen::Matrix<double, dim, 1>& facing, const NormalStencil& stencil) {
  double square = 0.0;
  for (int i = 0; i < dim; ++i)
    if (!stencil.projected[i]) square += facing[i] * facing[i];
  return square > 0.0;
}

// On a line of symmetry in 2D: the corner's normal lies along it.
void settle_half(SettledCorner& corner, bool derivatives, bool moves, const NodalNormal& normal) {
  for (const CornerSide& side : corner.sides) corner.columns = side.normal->columns;
  measure_weights<2>(corner, normal.normal, Eigen::MatrixXd::Zero(2, derivatives ? 2 * static_cast<Eigen::Index>(corner.columns.size()) : 0), moves);
}

}  // namespace

template <int dim>
bool settle(SettledCorner& corner, bool derivatives, bool moves, const NormalStencil& stencil, NodalNormal& normal) {
  if (dim == 2 && is_projected(stencil)) {
    settle_half(corner, derivatives, moves, normal);
    return true;
  }
  Eigen::Matrix<double, dim, 1> facing = Eigen::Matrix<double, dim, 1>::Zero();
  for (const CornerSide& side : corner.sides) {
    for (const LocalOrdinal node : side.normal->columns) place_of(corner.columns, node);
    if (side.coupling == nullptr) continue;
    facing += side.coupling->facing.row(side.place).transpose();
    for (const LocalOrdinal node : side.coupling->columns) place_of(corner.columns, node);
  }
  if (!has_direction<dim>(facing, stencil)) return false;
  const CornerNormal<dim> found = direction_of(corner, facing, stencil);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(dim, derivatives ? dim * static_cast<Eigen::Index>(corner.columns.size()) : 0);
  if (moves)
    for (std::size_t e = 0; e < corner.sides.size(); ++e) {
      const CornerSide& side = corner.sides[e];
      if (side.coupling != nullptr)
        add_columns<dim>(corner.columns, side.coupling->columns,
                         Eigen::MatrixXd(found.of_facing * side.coupling->dfacing.template middleRows<dim>(dim * side.place)), slope);
      add_columns<dim>(corner.columns, side.normal->columns, Eigen::MatrixXd(found.of_facets[e] * side.normal->derivative), slope);
    }
  normal.normal = found.normal;
  normal.columns = corner.columns;
  normal.derivative = slope;
  measure_weights<dim>(corner, normal.normal, slope, moves);
  return true;
}

template bool settle<2>(SettledCorner&, bool, bool, const NormalStencil&, NodalNormal&);
template bool settle<3>(SettledCorner&, bool, bool, const NormalStencil&, NodalNormal&);

}  // namespace mortise
