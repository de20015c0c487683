#include "run/diagnosis/motion_hold.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <memory>

#include "mortise/core/over_ranks.hpp"

namespace mortise {
namespace {

/// Bound of free_motions(). A surface's tilt by a strain holds by a stiffness, however weak, which is for Newton's method to use. The square
/// roots of eigenvalues are known to 1e-7.
constexpr double truly_free = 1e-7;
constexpr double hardly_moves = 1e-3;  ///< of a motion of size 1: dofs that move by less do not tell it from others
constexpr double as_far = 1.0 - 1e-6;  ///< dofs that move as far but for round-off: the first one is taken, on any number of ranks

/// Motions of a group that are held, and the dofs that they are held at.
struct HeldGroup {
  std::vector<int> bodies;
  Eigen::MatrixXd motions;
  Eigen::MatrixXd known;  ///< [motions x dofs found] orthonormal: what the dofs found so far tell
};

/// The motions across the load.
Eigen::MatrixXd without_load(const FreeGroup& group) {
  if (!group.is_loaded()) return group.motions;
  const Eigen::Index n = group.motions.cols();
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(group.load).householderQ() * Eigen::MatrixXd::Identity(n, n);
  return group.motions * basis.rightCols(n - 1);
}

/// [owned dofs] true if the linear system has an equation of momentum there that is left as it is. Closed slave nodes have those of contact instead,
/// and followers have none.
std::vector<char> have_momentum(const Model& model, const ContactLaws& laws) {
  const Mesh& mesh = *model.mesh();
  const auto d = static_cast<std::size_t>(mesh.dimension);
  std::vector<char> result(d * static_cast<std::size_t>(mesh.owned_count()), 1);
  if (model.parts().rigid)
    for (const LocalOrdinal dof : model.parts().rigid->dofs()) result[dof] = 0;
  for (const LocalOrdinal dof : model.parts().constraints->dependent()) result[dof] = 0;
  const ContactStates states = laws.states();
  for (std::size_t p = 0; p < states.size(); ++p) {
    const std::vector<GlobalOrdinal> ids = model.contact()->slave_ids(p);
    for (std::size_t s = 0; s < ids.size(); ++s)
      if (states[p].states[s] != ContactState::open) {
        const auto node = static_cast<std::size_t>(mesh.owned_nodes->getLocalElement(ids[s]));
        std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(d * node), d, 0);
      }
  }
  return result;
}

/// Motion of a dof of one of a group's bodies in the motions of the group.
Eigen::VectorXd in_motions(const HeldGroup& group, std::size_t place, const DofMotion& motion) {
  const auto n = motion.size();
  return (motion * group.motions.middleRows(n * static_cast<Eigen::Index>(place), n)).transpose();
}

/// Dofs one after the other, each of which tells most of what those before it leave open.
std::vector<LocalOrdinal> choose_dofs(const Model& model, const FreeBodies& free, const ContactLaws& laws, std::vector<HeldGroup>& groups) {
  const Mesh& mesh = *model.mesh();
  const std::vector<char> allowed = have_momentum(model, laws);
  std::vector<int> group_of(free.modes().bodies().size(), -1), place_of(group_of.size());
  Eigen::Index rounds = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    rounds = std::max(rounds, groups[g].motions.cols());
    for (std::size_t i = 0; i < groups[g].bodies.size(); ++i) {
      group_of[groups[g].bodies[i]] = static_cast<int>(g);
      place_of[groups[g].bodies[i]] = static_cast<int>(i);
    }
  }
  const auto each = [&](const auto& visit) {
    free.each_dof([&](int b, LocalOrdinal node, int i, const DofMotion& motion) {
      const LocalOrdinal dof = model.space().row(node, i);
      if (group_of[b] < 0 || !allowed[dof]) return;
      HeldGroup& group = groups[group_of[b]];
      if (group.known.cols() == group.motions.cols()) return;
      Eigen::VectorXd moves = in_motions(group, static_cast<std::size_t>(place_of[b]), motion);
      moves -= group.known * (group.known.transpose() * moves);
      visit(static_cast<std::size_t>(group_of[b]), dof, moves);
    });
  };
  const Communicator& comm = *mesh.comm;
  std::vector<LocalOrdinal> chosen;
  for (Eigen::Index round = 0; round < rounds; ++round) {
    std::vector<double> far(groups.size(), 0.0);
    each([&](std::size_t g, LocalOrdinal, const Eigen::VectorXd& moves) { far[g] = std::max(far[g], moves.norm()); });
    far = most_over_ranks(comm, far);
    constexpr GlobalOrdinal none = std::numeric_limits<GlobalOrdinal>::max();
    std::vector<GlobalOrdinal> first(groups.size(), none);
    const Map& dofs = *model.parts().dofs;
    each([&](std::size_t g, LocalOrdinal dof, const Eigen::VectorXd& moves) {
      if (far[g] > hardly_moves && moves.norm() >= as_far * far[g]) first[g] = std::min(first[g], dofs.getGlobalElement(dof));
    });
    first = least_over_ranks(comm, first);
    std::size_t most = 0;
    for (const HeldGroup& group : groups) most = std::max(most, static_cast<std::size_t>(group.motions.cols()));
    std::vector<double> told(most * groups.size(), 0.0);
    each([&](std::size_t g, LocalOrdinal dof, const Eigen::VectorXd& moves) {
      if (dofs.getGlobalElement(dof) != first[g]) return;
      chosen.push_back(dof);
      const Eigen::VectorXd direction = moves.normalized();
      std::copy(direction.begin(), direction.end(), told.begin() + static_cast<std::ptrdiff_t>(most * g));
    });
    told = sum_over_ranks(comm, told);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (first[g] == none) continue;
      HeldGroup& group = groups[g];
      group.known.conservativeResize(group.motions.cols(), group.known.cols() + 1);
      group.known.rightCols(1) = Eigen::Map<const Eigen::VectorXd>(&told[most * g], group.motions.cols());
    }
  }
  // Motions that no dof tells stay with the solver.
  for (HeldGroup& group : groups) group.motions = (group.motions * group.known).eval();
  return chosen;
}

}  // namespace

// dd - V q with the q that makes |dd - V q| least over the dofs that are not prescribed: V^T V q = V^T dd.
std::optional<HeldMotions> motions_without_load(const Model& model, const SystemEvaluation& at, const std::vector<int>& bodies,
                                                double momentum_tolerance) {
  const auto free = std::make_shared<FreeBodies>(model, at, bodies, momentum_tolerance);
  const auto groups = std::make_shared<std::vector<HeldGroup>>();
  for (const FreeGroup& group : free->groups(free->held(), truly_free))
    if (Eigen::MatrixXd motions = without_load(group); motions.cols() > 0) {
      const Eigen::Index count = motions.cols();
      groups->push_back({group.bodies, std::move(motions), Eigen::MatrixXd(count, 0)});
    }
  if (groups->empty()) return std::nullopt;
  HeldMotions held;
  held.dofs = choose_dofs(model, *free, at.contact_laws(), *groups);
  std::sort(held.dofs.begin(), held.dofs.end());
  groups->erase(std::remove_if(groups->begin(), groups->end(), [](const HeldGroup& group) { return group.motions.cols() == 0; }), groups->end());
  if (groups->empty()) return std::nullopt;
  held.take_out = [free, groups, space = model.bodies()->shared_space()](Vector& dd) {
    const int n = free->modes().per_body();
    const std::vector<Eigen::MatrixXd> masses = free->masses();
    const Eigen::MatrixXd works = free->works(dd);
    Eigen::MatrixXd taken = Eigen::MatrixXd::Zero(n, works.cols());
    for (const HeldGroup& group : *groups) {
      Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(group.motions.cols(), group.motions.cols());
      Eigen::VectorXd work = Eigen::VectorXd::Zero(group.motions.cols());
      for (std::size_t i = 0; i < group.bodies.size(); ++i) {
        const auto part = group.motions.middleRows(n * static_cast<Eigen::Index>(i), n);
        mass += part.transpose() * masses[group.bodies[i]] * part;
        work += part.transpose() * works.col(group.bodies[i]);
      }
      const Eigen::VectorXd q = mass.ldlt().solve(work);
      for (std::size_t i = 0; i < group.bodies.size(); ++i)
        taken.col(group.bodies[i]) += group.motions.middleRows(n * static_cast<Eigen::Index>(i), n) * q;
    }
    const auto values = dd.getLocalViewHost(Tpetra::Access::ReadWrite);
    free->each_dof([&](int b, LocalOrdinal node, int i, const DofMotion& motion) { values(space->row(node, i), 0) -= motion.dot(taken.col(b)); });
  };
  return held;
}

}  // namespace mortise
