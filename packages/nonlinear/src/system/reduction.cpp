#include "system/reduction.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <TpetraExt_TripleMatrixMultiply.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

RCP<const Matrix> product(const Matrix& A, const Matrix& B) {
  const auto result = rcp(new Matrix(A.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(A, false, B, false, *result);
  return result;
}

}  // namespace

Reduction::Reduction(std::shared_ptr<const RigidConstraints> followers, std::shared_ptr<const AffineConstraints> constraints,
                     std::function<void(const Vector&, Vector&)> put_support_forces, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs)
    : followers_(std::move(followers)), constraints_(std::move(constraints)), put_support_forces_(std::move(put_support_forces)), dofs_(dofs) {
  if (followers_) following_ = followers_->dofs();
  dependents_ = following_;
  if (constraints_) dependents_.insert(dependents_.end(), constraints_->dependent().begin(), constraints_->dependent().end());
  std::sort(dependents_.begin(), dependents_.end());
  place_of_.assign(local_id_count(*dofs), 0);
  for (const LocalOrdinal dof : following_) place_of_[dof] = -1;
  LocalOrdinal count = 0;
  for (LocalOrdinal& place : place_of_)
    if (place >= 0) place = count++;
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  unknowns_ = rcp(new const Map(invalid, count, 0, dofs->getComm()));

  // Ids in unknowns() of what is followed, which may belong to other ranks.
  Vector ids(dofs), local_ids(local_dofs);
  {
    const auto view = ids.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t dof = 0; dof < place_of_.size(); ++dof)
      view(dof, 0) = place_of_[dof] < 0 ? -1.0 : static_cast<double>(unknowns_->getGlobalElement(place_of_[dof]));
  }
  local_ids.doImport(ids, Import(dofs, local_dofs), Tpetra::INSERT);
  const Vector start(local_dofs);
  const std::vector<Dependence> dependences = evaluate(start);
  {
    const auto view = local_ids.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const Dependence& dependence : dependences) {
      sources_.emplace_back();
      for (int k = 0; k < dependence.sources; ++k)
        sources_.back()[k] = static_cast<GlobalOrdinal>(view(local_dofs->getLocalElement(dependence.source[k]), 0));
    }
  }

  const auto graph = rcp(new Graph(dofs, Dependence::most));
  for (LocalOrdinal dof = 0; dof < static_cast<LocalOrdinal>(place_of_.size()); ++dof) {
    if (place_of_[dof] < 0) continue;
    const GlobalOrdinal column = unknowns_->getGlobalElement(place_of_[dof]);
    graph->insertGlobalIndices(dofs->getGlobalElement(dof), 1, &column);
  }
  for (std::size_t n = 0; n < following_.size(); ++n)
    graph->insertGlobalIndices(dofs->getGlobalElement(following_[n]), dependences[n].sources, sources_[n].data());
  graph->fillComplete(unknowns_, dofs);
  graph_ = graph;
  if (followers_) return;
  const auto renumbered = rcp(new Matrix(graph_));
  renumbered->setAllToScalar(1.0);
  renumbered->fillComplete(unknowns_, dofs_);
  constant_T_ = product(*constraints_->T(), *renumbered);
}

std::vector<LocalOrdinal> Reduction::held_places(const std::vector<LocalOrdinal>& prescribed) const {
  std::vector<LocalOrdinal> places;
  for (const LocalOrdinal dof : prescribed) places.push_back(place_of_.at(dof));
  if (!constraints_) return places;
  for (const LocalOrdinal dof : constraints_->dependent()) places.push_back(place_of_.at(dof));
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<Dependence> Reduction::evaluate(const Vector& local_unknowns) const {
  return followers_ ? followers_->evaluate(local_unknowns) : std::vector<Dependence>{};
}

FollowedUnknowns::FollowedUnknowns(std::shared_ptr<const Reduction> reduction, double time, const Vector& local_unknowns)
    : reduction_(std::move(reduction)), dependences_(reduction_->evaluate(local_unknowns)), T_(reduction_->constant_T_) {
  if (reduction_->constraints_) offset_ = reduction_->constraints_->offset(time, failure_);
  if (!T_.is_null()) return;
  const Map& dofs = *reduction_->dofs_;
  const auto of_followers = rcp(new Matrix(reduction_->graph_));
  of_followers->setAllToScalar(1.0);
  for (std::size_t n = 0; n < dependences_.size(); ++n)
    of_followers->replaceGlobalValues(dofs.getGlobalElement(reduction_->following_[n]), dependences_[n].sources, dependences_[n].gradient.data(),
                                      reduction_->sources_[n].data());
  of_followers->fillComplete(reduction_->unknowns_, reduction_->dofs_);
  T_ = of_followers;
  if (reduction_->constraints_) T_ = product(*reduction_->constraints_->T(), *of_followers);
}

RCP<const Vector> FollowedUnknowns::untied(const Vector& r) const {
  if (!reduction_->constraints_) return Teuchos::rcpFromRef(r);
  const auto gathered = rcp(new Vector(reduction_->dofs_));
  reduction_->constraints_->T()->apply(r, *gathered, Teuchos::TRANS);
  return gathered;
}

double FollowedUnknowns::deviation(const Vector& unknowns, double factor, Vector& deviation) const {
  Vector follows(unknowns, Teuchos::Copy);  // P (q, g(q)) + p
  {
    const auto value = follows.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t n = 0; n < dependences_.size(); ++n) value(reduction_->following_[n], 0) = dependences_[n].value;
  }
  if (reduction_->constraints_) {
    const Vector of_followers(follows, Teuchos::Copy);
    reduction_->constraints_->T()->apply(of_followers, follows);
    if (!offset_.is_null()) follows.update(1.0, *offset_, 1.0);
  }
  const auto d = unknowns.getLocalViewHost(Tpetra::Access::ReadOnly), value = follows.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto result = deviation.getLocalViewHost(Tpetra::Access::ReadWrite);
  double largest = 0.0;
  for (const LocalOrdinal dof : reduction_->dependents_) {
    const double difference = d(dof, 0) - value(dof, 0);
    largest = std::max(largest, std::abs(difference));
    result(dof, 0) = factor * difference;
  }
  return largest;
}

RCP<Vector> Reduction::unknown_part(const Vector& v) const {
  const auto q = rcp(new Vector(unknowns_));
  const auto from = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = q->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t dof = 0; dof < place_of_.size(); ++dof)
    if (place_of_[dof] >= 0) to(place_of_[dof], 0) = from(dof, 0);
  return q;
}

RCP<MultiVector> Reduction::unknown_rows(const MultiVector& v) const {
  const auto q = rcp(new MultiVector(unknowns_, v.getNumVectors()));
  const auto from = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = q->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t dof = 0; dof < place_of_.size(); ++dof)
    for (std::size_t c = 0; c < v.getNumVectors() && place_of_[dof] >= 0; ++c) to(place_of_[dof], c) = from(dof, c);
  return q;
}

NearNullSpace Reduction::reduced(const NearNullSpace& of_dofs) const {
  NearNullSpace result;
  if (of_dofs.coordinates.is_null()) return result;
  const auto dimension = static_cast<LocalOrdinal>(of_dofs.coordinates->getNumVectors());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const std::size_t rows = dimension * of_dofs.coordinates->getLocalLength();  // the first ones
  const auto following = std::count(place_of_.begin(), place_of_.begin() + static_cast<std::ptrdiff_t>(rows), -1);
  const auto nodes = rcp(new const Map(invalid, (rows - static_cast<std::size_t>(following)) / dimension, 0, dofs_->getComm()));
  const auto coordinates = rcp(new MultiVector(nodes, of_dofs.coordinates->getNumVectors()));
  {
    const auto from = of_dofs.coordinates->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = coordinates->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t node = 0; node < from.extent(0); ++node) {
      const LocalOrdinal place = place_of_[dimension * node];
      for (LocalOrdinal i = 0; i < dimension && place >= 0; ++i) to(place / dimension, i) = from(node, i);
    }
  }
  result.coordinates = coordinates;
  result.separation = of_dofs.separation;
  if (!of_dofs.rigid_body_modes.is_null()) result.rigid_body_modes = unknown_rows(*of_dofs.rigid_body_modes);
  return result;
}

FieldsOfRows Reduction::reduced(const FieldsOfRows& of_dofs) const {
  FieldsOfRows result{{}, {}, of_dofs.weights};
  for (std::size_t dof = 0; dof < place_of_.size(); ++dof) {
    if (place_of_[dof] < 0) continue;
    result.field_of_row.push_back(of_dofs.field_of_row[dof]);
    result.node_of_row.push_back(of_dofs.node_of_row[dof]);
  }
  return result;
}

Decoupling Reduction::reduced(const Decoupling& of_dofs) const {
  Matrix injection(dofs_, 1);
  for (std::size_t dof = 0; dof < place_of_.size(); ++dof) {
    if (place_of_[dof] < 0) continue;
    const GlobalOrdinal column = unknowns_->getGlobalElement(place_of_[dof]);
    const double one = 1.0;
    injection.insertGlobalValues(dofs_->getGlobalElement(static_cast<LocalOrdinal>(dof)), 1, &one, &column);
  }
  injection.fillComplete(unknowns_, dofs_);
  const auto part = [&](const Matrix& of_all) {
    Matrix columns(dofs_, 0);
    const auto both = rcp(new Matrix(unknowns_, 0));
    Tpetra::MatrixMatrix::Multiply(of_all, false, injection, false, columns);
    Tpetra::MatrixMatrix::Multiply(injection, true, columns, false, *both);
    return both;
  };
  return {part(*of_dofs.trial), part(*of_dofs.test), part(*of_dofs.eliminated), of_dofs.dimension};
}

RCP<Vector> FollowedUnknowns::reduced(const Vector& r) const {
  const auto q = rcp(new Vector(reduction_->unknowns_));
  T_->apply(r, *q, Teuchos::TRANS);
  return q;
}

RCP<Vector> FollowedUnknowns::expanded(const Vector& dq) const {
  const auto d = rcp(new Vector(reduction_->dofs_));
  T_->apply(dq, *d);
  return d;
}

RCP<Vector> FollowedUnknowns::convected(const Vector& rate) const {
  const Map& columns = *reduction_->graph_->getColMap();
  Vector sources(reduction_->graph_->getColMap());
  const RCP<const Import> importer = reduction_->graph_->getImporter();
  if (importer.is_null())
    Tpetra::deep_copy(sources, rate);
  else
    sources.doImport(rate, *importer, Tpetra::INSERT);
  const auto result = rcp(new Vector(reduction_->dofs_));
  {
    const auto from = sources.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = result->getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto rate_of = [&](std::size_t n, int k) { return from(columns.getLocalElement(reduction_->sources_[n][k]), 0); };
    for (std::size_t n = 0; n < dependences_.size(); ++n)
      for (int k = 0; k < dependences_[n].sources; ++k)
        for (int l = 0; l < dependences_[n].sources; ++l)
          to(reduction_->following_[n], 0) += dependences_[n].curvature[k][l] * rate_of(n, k) * rate_of(n, l);
  }
  if (!reduction_->constraints_) return result;
  const auto untied = rcp(new Vector(reduction_->dofs_));
  reduction_->constraints_->T()->apply(*result, *untied);
  return untied;
}

void FollowedUnknowns::gather(Vector& r) const {
  const RCP<Vector> q = reduced(r);
  if (reduction_->constraints_) r.assign(*untied(r));
  const auto from = q->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = r.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t dof = 0; dof < reduction_->place_of_.size(); ++dof)
    if (reduction_->place_of_[dof] >= 0) to(dof, 0) = from(reduction_->place_of_[dof], 0);
}

RCP<Vector> FollowedUnknowns::support_forces(const Vector& r) const {
  const auto gathered = rcp(new Vector(r, Teuchos::Copy));
  gather(*gathered);
  if (reduction_->constraints_ && reduction_->put_support_forces_) reduction_->put_support_forces_(r, *gathered);
  return gathered;
}

// A matrix of the few rows that are followed or tied; its diagonal is there even where nothing is curved.
RCP<Matrix> FollowedUnknowns::curvature(const Vector& r) const {
  const auto matrix = rcp(new Matrix(reduction_->unknowns_, Dependence::most));
  const RCP<const Vector> gathered = untied(r);
  const auto force = gathered->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t n = 0; n < dependences_.size(); ++n) {
    const Dependence& dependence = dependences_[n];
    for (int k = 0; k < dependence.sources; ++k) {
      std::array<double, Dependence::most> row{};
      for (int l = 0; l < dependence.sources; ++l) row[l] = force(reduction_->following_[n], 0) * dependence.curvature[k][l];
      matrix->insertGlobalValues(reduction_->sources_[n][k], dependence.sources, row.data(), reduction_->sources_[n].data());
    }
  }
  const auto add_diagonal = [&](const std::vector<LocalOrdinal>& of) {
    for (const LocalOrdinal dof : of) {
      const GlobalOrdinal id = reduction_->unknowns_->getGlobalElement(reduction_->place_of_[dof]);
      const double zero = 0.0;
      matrix->insertGlobalValues(id, 1, &zero, &id);
    }
  };
  if (reduction_->followers_) add_diagonal(reduction_->followers_->followed());
  if (reduction_->constraints_) add_diagonal(reduction_->constraints_->dependent());
  matrix->fillComplete(reduction_->unknowns_, reduction_->unknowns_);
  return matrix;
}

RCP<Matrix> FollowedUnknowns::reduced(const Matrix& A, const Vector& r) const {
  Matrix product(reduction_->unknowns_, 0);
  Tpetra::TripleMatrixMultiply::MultiplyRAP(*T_, true, A, false, *T_, false, product);
  return Tpetra::MatrixMatrix::add(1.0, false, product, 1.0, false, *curvature(r), reduction_->unknowns_, reduction_->unknowns_);
}

RCP<Matrix> FollowedUnknowns::reduced_rows(const Matrix& B) const {
  const auto product = rcp(new Matrix(reduction_->unknowns_, 0));
  Tpetra::MatrixMatrix::Multiply(*T_, true, B, false, *product);
  return product;
}

RCP<Matrix> FollowedUnknowns::reduced_columns(const Matrix& C) const {
  const auto product = rcp(new Matrix(C.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(C, false, *T_, false, *product);
  return product;
}

void FollowedUnknowns::add_curvature(const Vector& r, const Vector& v, Vector& y) const {
  Vector result(reduction_->unknowns_);
  curvature(r)->apply(*reduction_->unknown_part(v), result);
  const auto from = result.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = y.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t dof = 0; dof < reduction_->place_of_.size(); ++dof)
    if (reduction_->place_of_[dof] >= 0) to(dof, 0) += from(reduction_->place_of_[dof], 0);
}

}  // namespace mortise::detail
