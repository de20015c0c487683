#include "Elasticity.hpp"

#include <Intrepid2_CellTools.hpp>
#include <Intrepid2_DefaultCubatureFactory.hpp>
#include <Intrepid2_FunctionSpaceTools.hpp>
#include <Intrepid2_HGRAD_HEX_C1_FEM.hpp>
#include <Shards_CellTopology.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <algorithm>

namespace embed {
namespace {

constexpr double E = 1000.0, nu = 0.3, conductivity = 1.0;
constexpr double stiffness = E;  // of boundary rows

using Device = Kokkos::Device<Kokkos::Serial, Kokkos::HostSpace>;
using View = Kokkos::DynRankView<double, Device>;
using Convert = Thyra::TpetraOperatorVectorExtraction<double, LO, GO, Node>;
using Base = Thyra::ModelEvaluatorBase;

// Gradients of the shape functions at the points of a cell, and their measures.
struct CellGradients {
  const shards::CellTopology hexahedron{shards::getCellTopologyData<shards::Hexahedron<8>>()};
  Intrepid2::Basis_HGRAD_HEX_C1_FEM<Device, double, double> basis;
  View points, weights, reference, nodes{"nodes", 1, 8, 3}, jacobian, inverse, determinant, gradients, measure;

  CellGradients() {
    const auto cubature = Intrepid2::DefaultCubatureFactory::create<Device, double, double>(hexahedron, 2);
    const int n = cubature->getNumPoints();
    points = View("points", n, 3), weights = View("weights", n), reference = View("reference", 8, n, 3);
    jacobian = View("jacobian", 1, n, 3, 3), inverse = View("inverse", 1, n, 3, 3), determinant = View("determinant", 1, n);
    gradients = View("gradients", 1, 8, n, 3), measure = View("measure", 1, n);
    cubature->getCubature(points, weights);
    basis.getValues(reference, points, Intrepid2::OPERATOR_GRAD);
  }
  void evaluate() {
    Intrepid2::CellTools<Device>::setJacobian(jacobian, points, nodes, hexahedron);
    Intrepid2::CellTools<Device>::setJacobianInv(inverse, jacobian);
    Intrepid2::CellTools<Device>::setJacobianDet(determinant, jacobian);
    Intrepid2::FunctionSpaceTools<Device>::HGRADtransformGRAD(gradients, inverse, reference);
    Intrepid2::FunctionSpaceTools<Device>::computeCellMeasure(measure, determinant, weights);
  }
};

}  // namespace

Elasticity::Elasticity(std::shared_ptr<const Mesh> mesh, const Teuchos::RCP<const Teuchos::Comm<int>>& comm,
                       const Teuchos::RCP<const Thyra::LinearOpWithSolveFactoryBase<double>>& solver)
    : m_mesh(std::move(mesh)), m_solver(solver) {
  std::vector<GO> own;
  double width = 0.0;
  for (const Point& point : m_mesh->points) width = std::max(width, point[0]);
  for (long node = static_cast<long>(m_mesh->points.size()); node-- > 0;) {
    const int owner = std::min(comm->getSize() - 1, static_cast<int>(m_mesh->points[node][0] / width * comm->getSize()));
    if (owner == comm->getRank())
      for (int place = 0; place < 4; ++place) own.push_back(row(node, place));
  }
  m_rows = Teuchos::rcp(new Map(4 * m_mesh->points.size(), own.data(), static_cast<LO>(own.size()), 0, comm));
  m_space = Thyra::createVectorSpace<double, LO, GO, Node>(m_rows);
  const auto graph = Teuchos::rcp(new Tpetra::CrsGraph<>(m_rows, 108));
  for (const auto& cell : m_mesh->cells)
    for (const long a : cell)
      for (const long b : cell)
        for (int i = 0; i < 4 && mine(a); ++i) {
          const std::array<GO, 4> columns = {row(b, 0), row(b, 1), row(b, 2), row(b, 3)};
          graph->insertGlobalIndices(row(a, i), 4, columns.data());
        }
  graph->fillComplete(m_rows, m_rows);
  m_graph = graph;
  m_stiffness = newMatrix();
  assemble(*m_stiffness);
  m_stiffness->fillComplete(m_rows, m_rows);
  m_nominal = createInArgs();
  const auto x = Thyra::createMember(*m_space);
  Thyra::assign(x.ptr(), 0.0);
  m_nominal.set_x(x);
  setMotion(0.0, 0.0);
}

void Elasticity::setMotion(double down, double right) {
  m_prescribed.clear();
  for (long node = 0; node < static_cast<long>(m_mesh->points.size()); ++node) {
    if (!mine(node) || !(m_mesh->isClamped(node) || m_mesh->isDriven(node))) continue;
    const bool driven = m_mesh->isDriven(node);
    const std::array<double, 4> values = {driven ? right : 0.0, driven ? 1.0 : 0.0, 0.0, driven ? -down : 0.0};
    for (int place = 0; place < 4; ++place) m_prescribed.emplace_back(row(node, place), values[place]);
  }
}

void Elasticity::assemble(Matrix& matrix) const {
  const double lambda = E * nu / (1.0 + nu) / (1.0 - 2.0 * nu), mu = E / 2.0 / (1.0 + nu);
  CellGradients cell;
  for (const auto& nodes : m_mesh->cells) {
    if (std::none_of(nodes.begin(), nodes.end(), [&](long node) { return mine(node); })) continue;
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) cell.nodes(0, a, i) = m_mesh->points[nodes[a]][i];
    cell.evaluate();
    for (int a = 0; a < 8; ++a) {
      if (!mine(nodes[a])) continue;
      for (int b = 0; b < 8; ++b) {
        double k[4][4] = {};
        for (int q = 0; q < static_cast<int>(cell.weights.extent(0)); ++q) {
          double product = 0.0;
          for (int l = 0; l < 3; ++l) product += cell.gradients(0, a, q, l) * cell.gradients(0, b, q, l);
          product *= cell.measure(0, q);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              k[slot[i]][slot[j]] += cell.measure(0, q) * (lambda * cell.gradients(0, a, q, i) * cell.gradients(0, b, q, j) +
                                                           mu * cell.gradients(0, a, q, j) * cell.gradients(0, b, q, i)) +
                                     (i == j ? mu * product : 0.0);
          k[1][1] += conductivity * product;
        }
        const std::array<GO, 4> columns = {row(nodes[b], 0), row(nodes[b], 1), row(nodes[b], 2), row(nodes[b], 3)};
        for (int i = 0; i < 4; ++i) matrix.sumIntoGlobalValues(row(nodes[a], i), 4, k[i], columns.data());
      }
    }
  }
}

void Elasticity::fillBoundaryRows(Matrix& matrix) const {
  for (const auto& [id, value] : m_prescribed) {
    const LO local = m_rows->getLocalElement(id);
    Matrix::local_inds_host_view_type columns;
    Matrix::values_host_view_type unused;
    matrix.getLocalRowView(local, columns, unused);
    std::vector<double> values(columns.extent(0), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (matrix.getColMap()->getGlobalElement(columns(k)) == id) values[k] = stiffness;
    matrix.replaceLocalValues(local, static_cast<LO>(values.size()), values.data(), columns.data());
  }
}

Teuchos::RCP<Thyra::LinearOpBase<double>> Elasticity::create_W_op() const {
  const auto matrix = newMatrix();
  matrix->fillComplete(m_rows, m_rows);
  const Teuchos::RCP<Tpetra::Operator<double, LO, GO, Node>> op = matrix;
  return Thyra::tpetraLinearOp<double, LO, GO, Node>(m_space, m_space, op);
}

Base::InArgs<double> Elasticity::createInArgs() const {
  Base::InArgsSetup<double> in;
  in.setModelEvalDescription("elasticity");
  in.setSupports(Base::IN_ARG_x);
  return in;
}

Base::OutArgs<double> Elasticity::createOutArgsImpl() const {
  Base::OutArgsSetup<double> out;
  out.setModelEvalDescription("elasticity");
  out.setSupports(Base::OUT_ARG_f);
  out.setSupports(Base::OUT_ARG_W_op);
  return out;
}

void Elasticity::evalModelImpl(const Base::InArgs<double>& in, const Base::OutArgs<double>& out) const {
  const auto x = Convert::getConstTpetraVector(in.get_x());
  if (!out.get_f().is_null()) {
    const auto f = Convert::getTpetraVector(out.get_f());
    m_stiffness->apply(*x, *f);
    for (const auto& [id, value] : m_prescribed) {
      const LO local = m_rows->getLocalElement(id);
      f->replaceLocalValue(local, stiffness * (x->getData()[local] - value));
    }
  }
  if (!out.get_W_op().is_null()) {
    const auto W = Teuchos::rcp_dynamic_cast<Matrix>(Convert::getTpetraOperator(out.get_W_op()), true);
    W->resumeFill();
    W->setAllToScalar(0.0);
    assemble(*W);
    fillBoundaryRows(*W);
    W->fillComplete(m_rows, m_rows);
  }
}

}  // namespace embed
