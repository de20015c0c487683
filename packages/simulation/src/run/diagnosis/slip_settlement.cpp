#include "run/diagnosis/slip_settlement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mortise/contact/holding_nodes.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/core/symmetric_spectrum.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/simulation/run/diagnosis/body_motion.hpp"
#include "mortise/simulation/run/diagnosis/contact_hold.hpp"
#include "mortise/simulation/run/diagnosis/friction_balance.hpp"
#include "run/diagnosis/state_check.hpp"

namespace mortise {
namespace {

constexpr double hardly_slips = 1e-4;  ///< work of slips on a motion, over the most that they do on another one, below which friction does not see it
constexpr double hardly_held =
    1e-2;                         ///< of free_motions(): what tilts of the surface hold is weak next to friction, or Newton's step along it is short
constexpr double at_rest = 1e-6;  ///< share of its bound that the traction of a node is below it by, if it does not slip: it moves by 700 roundings
constexpr double round_off = 1e-13;  ///< forces missing along motions, over what friction bears, below which none is missing
constexpr double same = 1e-6;        ///< change of the multipliers over the largest below which an iterate is the one before
constexpr double in_balance = 1e-2;  ///< imbalance of a body along motions that are held, over the load along those that slip

TangentVector slip_of(const SlidingNode& node) {
  return Eigen::Map<const Eigen::VectorXd>(node.slip.data(), static_cast<Eigen::Index>(node.slip.size()));
}

/// Rows tau_a in `dimension` dimensions.
Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 3> tangents_of(const SlidingNode& node, int dimension) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 3> tangents(node.tangents.size(), dimension);
  for (Eigen::Index a = 0; a < tangents.rows(); ++a)
    for (Eigen::Index i = 0; i < tangents.cols(); ++i) tangents(a, i) = node.tangents[static_cast<std::size_t>(a)][static_cast<std::size_t>(i)];
  return tangents;
}

/// The work of sliding nodes on some motions, columns of `motions`.
std::vector<SlidingRow> sliding_rows(const std::vector<SlidingNode>& nodes, const std::vector<TangentVector>& slips, const RigidModes& modes,
                                     const Eigen::MatrixXd& motions) {
  std::vector<SlidingRow> rows;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SlidingNode& node = nodes[i];
    SlidingRow row{node.bound, node.weight, slips[i], Eigen::MatrixXd(node.along.size(), motions.cols())};
    for (std::size_t a = 0; a < node.along.size(); ++a) {
      const Eigen::RowVectorXd work = work_of(modes, node.along[a]);
      row.work.row(static_cast<Eigen::Index>(a)) = work * motions;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

/// Motions that nothing holds but friction of nodes that slip, at one iterate.
struct SlipSettlement::Sliding {
  std::optional<RigidModes> modes;
  NodePlaces at;
  Eigen::MatrixXd motions;  ///< orthonormal columns
  std::vector<SlidingNode> nodes;
  std::vector<TangentVector> traction;  ///< of the multipliers
  std::vector<SlidingRow> rows;         ///< works on `motions`
  std::vector<PairHold> pairs;
  Eigen::VectorXd load;      ///< load that friction has to bear for the residual to vanish along the motions
  double imbalance = 0.0;    ///< of the forces along all other motions
  bool is_singular = false;  ///< or Newton's step along the motions is longer than the slips, which give it its stiffness
};

bool SlipSettlement::is_needed(const Model& model) {
  const bool rubs = std::any_of(model.effects().begin(), model.effects().end(),
                                [](const auto& effect) { return effect.first == "friction" && !effect.second.empty(); });
  return rubs && StateCheck::is_needed(model);
}

// Bodies whose rotation is a degree of freedom of its own are left alone.
SlipSettlement::SlipSettlement(const Model& model)
    : model_(model), bodies_(without_turning_points(*model.mesh(), bodies_held_by_contact_only(model))) {}

double SlipSettlement::sum(double mine) const { return sum_over_ranks(*model_.mesh()->comm, mine); }

// In place: matrices look into the values.
void SlipSettlement::sum(std::vector<double>& values) const {
  const std::vector<double> all = sum_over_ranks(*model_.mesh()->comm, values);
  std::copy(all.begin(), all.end(), values.begin());
}

// Of what contact and boundary conditions leave free, the motions that slipping nodes do work on. Stiffness along them is that of tractions that turn
// with the slip,  rho c_t / |y| (I - e e^T), none in 2D, and of what hardly holds them.
bool SlipSettlement::find_sliding(const Vector& x, const Vector& F, const ContactLaws& laws, Sliding& found) const {
  const Mesh& mesh = *model_.mesh();
  const RCP<const Map>& dofs = model_.parts().dofs;
  const RCP<const Vector> z = x.offsetView(model_.contact()->multiplier_map(), local_id_count(*dofs));
  found.at = places_at(model_, x);
  found.modes.emplace(modes_at(model_, bodies_, found.at));
  const RigidModes& modes = *found.modes;
  const Eigen::Index count = modes.count();
  const ContactHold hold = contact_hold(model_, modes, found.at, laws);
  found.pairs = hold.pairs;
  const Eigen::MatrixXd held = held_by_supports(model_, modes, found.at) + hold.gram;

  // Motions that slipping nodes would hold if they were stuck, rows of unit forces as those of `held`.
  found.nodes = sliding_nodes(laws, *contact_places(mesh, modes, found.at.x));
  std::vector<double> if_all_stuck(static_cast<std::size_t>(count * count), 0.0);
  Eigen::Map<Eigen::MatrixXd> stuck(if_all_stuck.data(), count, count);
  for (const SlidingRow& row :
       sliding_rows(found.nodes, std::vector<TangentVector>(found.nodes.size()), modes, Eigen::MatrixXd::Identity(count, count)))
    stuck += row.work.transpose() * row.work / (row.weight * row.weight);
  sum(if_all_stuck);
  const Eigen::MatrixXd free = free_motions(held, modes.per_body(), hardly_held, stuck);
  if (free.cols() == 0) return false;

  // Of a node that has just begun to slip the law knows the direction, although u = 0: y = z_tau + c_t u is beyond the bound by c_t times a slip.
  const auto multipliers = z->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<TangentVector> directions, slips;
  for (const SlidingNode& node : found.nodes) {
    SpatialVector of_node(mesh.dimension);
    for (int c = 0; c < mesh.dimension; ++c) of_node[c] = multipliers(node.multiplier + c, 0);
    found.traction.emplace_back(tangents_of(node, mesh.dimension) * of_node);
    const TangentVector y = found.traction.back() + node.stiffness * slip_of(node);
    directions.emplace_back(y / y.norm());
    slips.emplace_back((y.norm() - node.bound) / node.stiffness * directions.back());
  }
  const auto works = [&](const Eigen::MatrixXd& motions) { return sliding_rows(found.nodes, slips, modes, motions); };
  std::vector<double> seen(static_cast<std::size_t>(free.cols() * free.cols()), 0.0);
  Eigen::Map<Eigen::MatrixXd> of_slips(seen.data(), free.cols(), free.cols());
  for (const SlidingRow& row : works(free)) of_slips += row.bound * row.bound * row.work.transpose() * row.work;
  sum(seen);
  const SymmetricSpectrum on_free = symmetric_spectrum(of_slips);
  const double most = on_free.values.maxCoeff();
  if (!(most > 0.0)) return false;
  found.motions = free * on_free.vectors.rightCols((on_free.values.array() > hardly_slips * hardly_slips * most).count());
  found.rows = works(found.motions);

  const Eigen::Index n = found.motions.cols();
  std::vector<double> sums(static_cast<std::size_t>(count + 2 * n + n * n + 3), 0.0);
  Eigen::Map<Eigen::RowVectorXd> residual(sums.data(), count);
  Eigen::Map<Eigen::VectorXd> borne(sums.data() + count, n), by_law(borne.data() + n, n);
  Eigen::Map<Eigen::MatrixXd> stiffness(by_law.data() + n, n, n);
  double &if_stuck = sums[sums.size() - 3], &forces = sums[sums.size() - 2], &slipped = sums.back();
  residual = work_of_residual(model_.space(), modes, found.at, *model_.supports().fixed, F);
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const SlidingNode& node = found.nodes[i];
    const Eigen::MatrixXd& work = found.rows[i].work;
    const TangentVector &t = found.traction[i], &e = directions[i];
    const double length = (t + node.stiffness * slip_of(node)).norm();
    borne += work.transpose() * t;
    by_law += node.bound * work.transpose() * e;
    const TangentMatrix turning = TangentMatrix::Identity(e.size(), e.size()) - e * e.transpose();
    stiffness += node.stiffness * node.bound / length * work.transpose() * turning * work;
    if_stuck += node.stiffness * work.squaredNorm();
    forces += node.bound * work.norm();
    slipped += node.bound * slips[i].norm();
  }
  sum(sums);
  found.load = borne - found.motions.transpose() * residual.transpose();
  found.imbalance = (residual - residual * found.motions * found.motions.transpose()).norm();
  const Eigen::VectorXd missing = found.load - by_law;
  if (missing.norm() <= round_off * forces) return false;  // singular, but consistent
  stiffness += if_stuck * found.motions.transpose() * held * found.motions / std::max(held.norm(), stuck.norm());
  const SymmetricSpectrum tangent = symmetric_spectrum(stiffness);
  found.is_singular = !(tangent.values[0] > hardly_slips * if_stuck);
  if (found.is_singular) return true;
  const Eigen::VectorXd step = tangent.vectors * (tangent.vectors.transpose() * missing).cwiseQuotient(tangent.values);
  double along = 0.0;
  for (const SlidingRow& row : found.rows) along += row.bound * (row.work * step).norm();
  return sum(along) > slipped;
}

std::string SlipSettlement::describe_overload(const Sliding& sliding, const Eigen::VectorXd& direction) const {
  double capacity = 0.0;
  for (const SlidingRow& row : sliding.rows) capacity += row.bound * (row.work * direction).norm();
  capacity = sum(capacity);
  const double load = sliding.load.dot(direction);
  if (!(load > capacity) || sliding.imbalance > in_balance * load) return {};
  const RigidModes& modes = *sliding.modes;
  const Eigen::VectorXd motion = sliding.motions * direction;
  std::vector<std::string> bodies, slipping;
  for (const MainMotions& main : main_motions(modes, motion)) {
    bodies.push_back(to_string(*model_.mesh(), modes, main));
    for (std::size_t p = 0; p < sliding.pairs.size(); ++p) {
      const auto& touched = model_.bodies_of_pairs()[p];
      const std::string pair = fmt::format("{} of {} closed nodes of contact \"{}\"", sliding.pairs[p].closed - sliding.pairs[p].sticking,
                                           sliding.pairs[p].closed, model_.contact()->pair_name(p));
      const bool touches = std::find(touched.begin(), touched.end(), bodies_[main.body]) != touched.end();
      if (touches && sliding.pairs[p].closed > 0 && std::find(slipping.begin(), slipping.end(), pair) == slipping.end()) slipping.push_back(pair);
    }
  }
  return fmt::format("no equilibrium: friction is used up by body {}: the load along this motion is {:.6g}, friction bears at most {:.6g}; {} slip",
                     fmt::join(bodies, ", "), load, capacity, fmt::join(slipping, ", "));
}

// True if Newton's method came back to where it was given another start. Bricks that are about to tip are held by pressures at a few nodes close to
// one another, a hundredth of what friction holds motions with. A node that slips then seems to be all that holds the tilt. Put to rest it bears more
// than its bound, and slips again.
bool SlipSettlement::has_led_back(const Vector& z) {
  const RCP<const Vector> before = offered_at_;
  offered_at_ = rcp(new Vector(z, Teuchos::Copy));
  if (before.is_null()) return false;
  Vector change(z, Teuchos::Copy);
  change.update(-1.0, *before, 1.0);
  return led_back_ = change.normInf() <= same * z.normInf();
}

RCP<Vector> SlipSettlement::better_start(const SystemEvaluation& at) {
  const Vector& x = at.x();
  Sliding sliding;
  if (led_back_ || !find_sliding(x, at.residual(), at.contact_laws(), sliding) || has_led_back(at.contact_laws().multipliers())) return Teuchos::null;
  const Mesh& mesh = *model_.mesh();
  const std::vector<SlidingNode>& nodes = sliding.nodes;
  const FrictionBalance balance =
      balance_friction(sliding.rows, sliding.load, model_.parts().length, [&](std::vector<double>& values) { sum(values); });
  overload_ = balance.borne ? "" : describe_overload(sliding, balance.motion.normalized());

  const RCP<const Map>& dofs = model_.parts().dofs;
  const auto result = rcp(new Vector(x, Teuchos::Copy));
  if (balance.borne) {
    std::vector<Eigen::Vector3d> middles;
    for (std::size_t b = 0; b < bodies_.size(); ++b) middles.push_back(sliding.modes->centre(static_cast<int>(b)));
    move_bodies(model_.space(), *sliding.modes, sliding.motions * balance.motion, middles, sliding.at, 1.0, *result->offsetViewNonConst(dofs, 0));
  }
  const RCP<Vector> z = result->offsetViewNonConst(model_.contact()->multiplier_map(), local_id_count(*dofs));
  const auto values = z->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto change_shear = [&](std::size_t i, const TangentVector& change) {
    const SpatialVector dz = tangents_of(nodes[i], mesh.dimension).transpose() * change;
    for (int c = 0; c < mesh.dimension; ++c) values(nodes[i].multiplier + c, 0) += dz[c];
  };
  // The law says stick where |z_tau + c_t u| is below the bound.
  std::vector<TangentVector> tractions = sliding.traction;
  double resting = 0.0, least = std::numeric_limits<double>::max();
  std::size_t slipped_least = 0;
  const auto rest = [&](std::size_t i) {
    tractions[i] = -nodes[i].stiffness * slip_of(nodes[i]);
    if (balance.borne) tractions[i] -= nodes[i].stiffness * sliding.rows[i].work * balance.motion;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SlidingRow& row = sliding.rows[i];
    const double slip = (balance.borne ? TangentVector(row.slip + row.work * balance.motion) : row.slip).norm() / row.weight;
    if (slip < least) least = slip, slipped_least = i;
    if (!balance.borne) continue;
    tractions[i] = balance.traction[i] + nodes[i].stiffness * (row.slip - slip_of(nodes[i]));
    if (balance.traction[i].norm() >= (1.0 - at_rest) * nodes[i].bound) continue;
    ++resting;
    rest(i);
  }
  const double least_of_all = least_over_ranks(*mesh.comm, least);
  const bool some_rest = sum(resting) > 0.0;
  if (balance.borne && !some_rest && mesh.dimension == 2) return Teuchos::null;  // W is flat there: Newton's own step is as good
  if (!balance.borne && least == least_of_all && !nodes.empty()) rest(slipped_least);
  for (std::size_t i = 0; i < nodes.size(); ++i) change_shear(i, tractions[i] - sliding.traction[i]);
  return result;
}

}  // namespace mortise
