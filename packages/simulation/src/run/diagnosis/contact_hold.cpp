#include "mortise/simulation/run/diagnosis/contact_hold.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <numeric>

#include "mortise/core/over_ranks.hpp"
#include "mortise/core/symmetric_spectrum.hpp"

namespace mortise {
namespace {

bool has_friction(const Model& model, const std::string& pair) {
  for (const auto& [effect, names] : model.effects())
    if (effect == "friction") return std::find(names.begin(), names.end(), pair) != names.end();
  return false;
}

}  // namespace

std::vector<int> coupled_bodies(const Eigen::MatrixXd& gram, int per_body) {
  const int bodies = static_cast<int>(gram.rows()) / per_body;
  std::vector<int> group(bodies);
  std::iota(group.begin(), group.end(), 0);
  for (int a = 0; a < bodies; ++a)
    for (int b = 0; b < a; ++b) {
      if (group[a] == group[b] || gram.block(per_body * a, per_body * b, per_body, per_body).isZero(0.0)) continue;
      const int from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
      std::replace(group.begin(), group.end(), from, to);
    }
  return group;
}

RCP<MultiVector> contact_places(const Mesh& mesh, const RigidModes& modes, const std::vector<Eigen::Vector3d>& x) {
  const auto result = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(1 + mesh.dimension)));
  const auto values = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    const int b = modes.number(mesh.body_of_node[node]);
    values(node, 0) = b;
    for (int i = 0; i < mesh.dimension; ++i) values(node, 1 + i) = b < 0 ? 0.0 : (x[node][i] - modes.centre(b)[i]) / modes.size(b);
  }
  return result;
}

Eigen::RowVectorXd work_of(const RigidModes& modes, const std::vector<HoldingRow::Wrench>& wrenches) {
  Eigen::RowVectorXd work = Eigen::RowVectorXd::Zero(modes.count());
  for (const auto& wrench : wrenches)
    modes.add_wrench(wrench.body, Eigen::Vector3d(wrench.force.data()), Eigen::Vector3d(wrench.moment.data()), work);
  return work;
}

void add_squared_work(const RigidModes& modes, const std::vector<HoldingRow::Wrench>& wrenches, Eigen::Ref<Eigen::MatrixXd> gram) {
  const Eigen::RowVectorXd work = work_of(modes, wrenches);
  const int n = modes.per_body();
  for (const auto& a : wrenches)
    for (const auto& b : wrenches) gram.block(n * a.body, n * b.body, n, n) += work.segment(n * a.body, n).transpose() * work.segment(n * b.body, n);
}

ContactHold contact_hold(const Model& model, const RigidModes& modes, const NodePlaces& at, const ContactLaws& laws, Holds holds) {
  const Mesh& mesh = *model.mesh();
  const int size = modes.count();
  const std::size_t pairs = model.contact()->pairs();
  // The Gram matrix, then closed nodes and sticking ones of each pair.
  std::vector<double> mine(static_cast<std::size_t>(size) * size + 2 * pairs, 0.0);
  Eigen::Map<Eigen::MatrixXd> gram(mine.data(), size, size);
  double* counts = mine.data() + static_cast<std::size_t>(size) * size;
  bool after_normal = false;  // tangents of a node follow its normal
  for (const HoldingRow& row : holding_rows(laws, *contact_places(mesh, modes, at.x), holds)) {
    if (!row.along_surface) ++counts[2 * row.pair];
    if (row.along_surface && after_normal) ++counts[2 * row.pair + 1];
    after_normal = !row.along_surface;
    add_squared_work(modes, row.bodies, gram);
  }
  const std::vector<double> all = sum_over_ranks(*mesh.comm, mine);
  ContactHold hold;
  hold.gram = Eigen::Map<const Eigen::MatrixXd>(all.data(), size, size);
  for (std::size_t p = 0; p < pairs; ++p) {
    const double* count = all.data() + static_cast<std::size_t>(size) * size + 2 * p;
    hold.pairs.push_back({static_cast<int>(count[0]), static_cast<int>(count[1])});
  }
  return hold;
}

Eigen::MatrixXd free_motions(const Eigen::MatrixXd& gram, int per_body, double hardly_held, const Eigen::MatrixXd& reference) {
  const std::vector<int> group = coupled_bodies(gram, per_body);
  Eigen::MatrixXd motions(gram.rows(), 0);
  for (int g = 0; g < static_cast<int>(group.size()); ++g) {
    std::vector<Eigen::Index> rows;
    for (std::size_t b = 0; b < group.size(); ++b)
      for (int m = 0; group[b] == g && m < per_body; ++m) rows.push_back(per_body * static_cast<Eigen::Index>(b) + m);
    if (rows.empty()) continue;
    const auto size = static_cast<Eigen::Index>(rows.size());
    const Eigen::MatrixXd part = gram(rows, rows);
    const double could_cost = reference.size() > 0 ? reference(rows, rows).cwiseAbs().rowwise().sum().maxCoeff() : 0.0;
    // Most groups are held: a factorisation says so, for a tenth of what eigenvalues cost. The largest sum of a row is no less than the largest
    // eigenvalue.
    const double bound = hardly_held * hardly_held * std::max(could_cost, part.cwiseAbs().rowwise().sum().maxCoeff());
    if (bound > 0.0 && (part - bound * Eigen::MatrixXd::Identity(size, size)).llt().info() == Eigen::Success) continue;
    const SymmetricSpectrum spectrum = symmetric_spectrum(part);
    const double most = std::max(could_cost, spectrum.values[size - 1]);
    const Eigen::Index found = most > 0.0 ? (spectrum.values.array() < hardly_held * hardly_held * most).count() : size;
    const Eigen::Index first = motions.cols();
    motions.conservativeResize(Eigen::NoChange, first + found);
    motions.rightCols(found).setZero();
    for (Eigen::Index i = 0; i < size; ++i) motions.row(rows[i]).tail(found) = spectrum.vectors.row(i).head(found);
  }
  return motions;
}

void ContactRecord::accept(const std::vector<PairHold>& pairs) {
  ever_closed_.resize(pairs.size(), 0);
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p].closed > 0) ever_closed_[p] = 1;
  last_ = pairs;
}

void ContactRecord::serialize(StateArchive& archive) {
  std::vector<int> closed, sticking;
  for (const PairHold& pair : last_) {
    closed.push_back(pair.closed);
    sticking.push_back(pair.sticking);
  }
  mortise::serialize(archive, "contact_record.closed", closed);
  mortise::serialize(archive, "contact_record.sticking", sticking);
  mortise::serialize(archive, "contact_record.ever_closed", ever_closed_);
  if (!archive.restores()) return;
  last_.clear();
  for (std::size_t p = 0; p < std::min(closed.size(), sticking.size()); ++p) last_.push_back({closed[p], sticking[p]});
}

std::string ContactRecord::describe(const Model& model, const std::vector<int>& bodies, const std::vector<PairHold>& now) const {
  std::vector<std::string> held, never;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const auto& touched = model.bodies_of_pairs()[p];
    if (std::none_of(bodies.begin(), bodies.end(), [&](int body) { return std::find(touched.begin(), touched.end(), body) != touched.end(); }))
      continue;
    const std::string name = fmt::format("contact \"{}\"", model.contact()->pair_name(p));
    const int closed = now[p].closed;
    if (closed == 0 && !last_.empty() && last_[p].closed > 0)
      held.push_back(fmt::format("{} has opened", name));
    else if (closed == 0 && !ever_closed_.empty() && ever_closed_[p])
      held.push_back(fmt::format("{} had opened before", name));
    else if (closed == 0)
      never.push_back(fmt::format("{} has not closed in any accepted state", name));
    else if (!has_friction(model, model.contact()->pair_name(p)))
      held.push_back(fmt::format("{} is closed at {} nodes, without friction", name, closed));
    else if (now[p].sticking == 0)
      held.push_back(fmt::format("{} slips at all {} closed nodes", name, closed));
    else
      held.push_back(fmt::format("{} sticks at {} of {} closed nodes", name, now[p].sticking, closed));
  }
  if (held.empty()) return never.empty() ? "" : fmt::format("contact alone could hold this: {}", fmt::join(never, ", "));
  held.insert(held.end(), never.begin(), never.end());
  return fmt::format("contact alone held this: {}", fmt::join(held, ", "));
}

}  // namespace mortise
