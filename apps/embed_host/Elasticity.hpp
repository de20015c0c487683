#pragma once
// Linear elasticity and conduction of heat as a Thyra::ModelEvaluator. Unknowns of a node are (ux, T, uy, uz); nodes are numbered backwards.

#include <Thyra_StateFuncModelEvaluatorBase.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <memory>

#include "Mesh.hpp"

namespace embed {

using Vector = Tpetra::Vector<double>;
using Matrix = Tpetra::CrsMatrix<double>;
using Map = Tpetra::Map<>;
using GO = Map::global_ordinal_type;
using LO = Map::local_ordinal_type;
using Node = Map::node_type;

class Elasticity : public Thyra::StateFuncModelEvaluatorBase<double> {
 public:
  Elasticity(std::shared_ptr<const Mesh> mesh, const Teuchos::RCP<const Teuchos::Comm<int>>& comm,
             const Teuchos::RCP<const Thyra::LinearOpWithSolveFactoryBase<double>>& solver);

  // The load of a step: how far the upper face has moved.
  void setMotion(double down, double right);
  void setInitialGuess(const Thyra::VectorBase<double>& x) { m_nominal.set_x(x.clone_v()); }

  static constexpr std::array<int, 3> slot = {0, 2, 3};  // of ux, uy, uz among the unknowns of a node
  GO row(long node, int place) const { return 4 * (static_cast<GO>(m_mesh->points.size()) - 1 - node) + place; }
  bool mine(long node) const { return m_rows->isNodeGlobalElement(row(node, 0)); }
  const Mesh& mesh() const { return *m_mesh; }
  const Teuchos::RCP<const Map>& rows() const { return m_rows; }
  Teuchos::RCP<Matrix> newMatrix() const { return Teuchos::rcp(new Matrix(m_graph)); }
  void assemble(Matrix& matrix) const;

  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> get_x_space() const override { return m_space; }
  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> get_f_space() const override { return m_space; }
  Thyra::ModelEvaluatorBase::InArgs<double> getNominalValues() const override { return m_nominal; }
  Teuchos::RCP<const Thyra::LinearOpWithSolveFactoryBase<double>> get_W_factory() const override { return m_solver; }
  Teuchos::RCP<Thyra::LinearOpBase<double>> create_W_op() const override;
  Thyra::ModelEvaluatorBase::InArgs<double> createInArgs() const override;

 private:
  Thyra::ModelEvaluatorBase::OutArgs<double> createOutArgsImpl() const override;
  void evalModelImpl(const Thyra::ModelEvaluatorBase::InArgs<double>& in, const Thyra::ModelEvaluatorBase::OutArgs<double>& out) const override;
  void fillBoundaryRows(Matrix& matrix) const;

  std::shared_ptr<const Mesh> m_mesh;
  Teuchos::RCP<const Map> m_rows;
  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> m_space;
  Teuchos::RCP<const Thyra::LinearOpWithSolveFactoryBase<double>> m_solver;
  Teuchos::RCP<const Tpetra::CrsGraph<>> m_graph;
  Teuchos::RCP<Matrix> m_stiffness;
  std::vector<std::pair<GO, double>> m_prescribed;  // own rows and their values
  Thyra::ModelEvaluatorBase::InArgs<double> m_nominal;
};

}  // namespace embed
