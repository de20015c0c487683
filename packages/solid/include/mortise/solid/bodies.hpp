#pragma once
// Deforming bodies: unknowns, internal forces, stiffness, stresses.

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"
#include "mortise/material/tensor_components.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/solid/element_type.hpp"

namespace mortise {

class ElementBlock;
class StateArchive;

/// One quadrature point of an element at a given displacement.
struct MaterialPoint {
  LocalOrdinal block = 0, element = 0;  ///< element: index in the block
  int point = 0;
  std::array<double, 3> reference_position{}, position{};  ///< (x, y, 0), (r, z, 0) or (x, y, z)
  double weight = 0.0;                                     ///< reference volume: quadrature weight x area x thickness or 2 pi R; or x volume
  double volume_ratio = 1.0;                               ///< current / reference volume: det F; 1 for small strain
  Matrix3 deformation_gradient;  ///< F that the law sees: with the hoop or out-of-plane stretch as component 33, of F-bar elements the modified one
  Matrix3 cauchy_stress;         ///< [stress]
  double equivalent_plastic_strain = 0.0;  ///< alpha; 0 for laws without plasticity
  double plastic_work = 0.0;               ///< spent on plastic flow per reference volume; 0 for laws without
  double energy = 0.0;                     ///< stored energy per reference volume, of deformation_gradient
};

/// Stress or strain xx, yy, zz, xy, then in three dimensions yz, xz, else 0; shear strains are tensor components. Axisymmetric: rr, zz, hoop, rz.
using StressComponents = std::array<double, 6>;

/// The space of displacements alone. Collective.
std::shared_ptr<const FieldSpace> displacement_space(RCP<const Mesh> mesh);

/// All bodies of a model.
///
/// Each rank computes every element that touches one of its nodes and writes only the rows it owns: assembly does not communicate.
/// Displacement arguments live on the local dofs of the space: owned, then ghosts. They hold the other fields too, of which bodies that know the
/// temperature read that.
class Bodies {
 public:
  /// A step so long that no rate is left.
  static constexpr double without_rates = std::numeric_limits<double>::infinity();

  /// The first field of `space` are the displacements. `thickness` [length] counts for the plane kinematics. One entry of `bodies` for each block of
  /// the mesh, in its order. `heat_at_start`: share of the temperatures at the start of a step in its heat, s of ThermalLaw; with one, begin() has
  /// to be called before the first step.
  /// Collective. Throws InputError for combinations without meaning and for reference elements with det J <= 0, naming the body at its place.
  Bodies(std::shared_ptr<const FieldSpace> space, Kinematics kinematics, double thickness, std::vector<BodyProperties> bodies,
         double heat_at_start = 0.0);
  ~Bodies();
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  const RCP<const Mesh>& mesh() const { return mesh_; }
  Kinematics kinematics() const { return kinematics_; }
  /// Unknowns a node: 2 or 3.
  int dimension() const { return mortise::dimension(kinematics_); }
  /// Number of StressComponents: 4 or 6.
  int stress_components() const { return dimension() == 3 ? 6 : 4; }
  double thickness() const { return thickness_; }
  const std::vector<BodyProperties>& properties() const { return properties_; }
  /// Factor that makes a length in 2D at radius r an area: the thickness, or 2 pi r; 1 in 3D.
  double depth(double radius) const;

  /// Rows of the displacements and of what other fields the model has.
  const FieldSpace& space() const { return *space_; }
  const std::shared_ptr<const FieldSpace>& shared_space() const { return space_; }

  /// True if the law of a body takes the temperature: its material has ThermomechanicalProperties, and a field "temperature" of the space lives on
  /// its nodes. Forces of such bodies depend on that field. The same on all ranks.
  bool know_temperature() const { return know_temperature_; }

  /// True if bodies add their heat to the rows of the temperature. The same on all ranks.
  bool heat() const;

  /// residual += f_int, f_int = integral of tau : grad eta dV0, on owned dofs. A det F <= 0 (or at the centre, det F0 <= 0) is put into `failure` if
  /// that is empty; the sum is then meaningless. Bodies that heat add -integral of N_a H dV0 to the rows of the temperature, with the power H of
  /// ThermalLaw for a step of length `time_step`.
  void add_internal_force(const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure,
                          double time_step = without_rates) const;

  /// matrix += factor d f_int / d displacement, of bodies that know the temperature also by it, and the derivatives of their heat. `matrix` has the
  /// graph of the space, or more entries and more columns after its own.
  void add_stiffness(const Vector& local_displacement, Matrix& matrix, std::optional<StepFailure>& failure, double factor = 1.0,
                     double time_step = without_rates) const;

  /// Both in one pass over the elements, for the time that add_stiffness() takes.
  void add_internal_force_and_stiffness(const Vector& local_displacement, Vector& residual, Matrix& matrix, std::optional<StepFailure>& failure,
                                        double factor = 1.0, double time_step = without_rates) const;

  /// Power of each body that becomes heat, plastic and thermoelastic, summed over all ranks. Collective.
  std::vector<double> heat_powers(const Vector& local_unknowns, double time_step) const;

  /// matrix += factor M, the consistent mass matrix: M_ab = integral of rho0 N_a N_b dV0 for each component. Rigid bodies have no elements and add
  /// nothing. `matrix` is as for add_stiffness().
  void add_mass(Matrix& matrix, double factor = 1.0) const;

  /// Lumped mass of each owned node. Linear elements give it the sum of its row of M, quadratic ones, whose sums can be negative, their diagonal of M
  /// scaled to their mass.
  std::vector<double> nodal_masses() const;

  /// Masses that stand at owned nodes besides those of elements: they have weight. Empty: none.
  const std::vector<double>& point_masses() const { return point_masses_; }
  void set_point_masses(std::vector<double> masses) { point_masses_ = std::move(masses); }

  /// Mass of each body of the mesh, summed over all ranks; 0 for rigid ones. Collective.
  std::vector<double> masses() const;

  /// The state from which the first step starts: its temperatures.
  void begin(const Vector& local_unknowns);

  /// The step that ended at this displacement is accepted: material points with a history move on to it. Everything else that is asked for at a
  /// displacement takes it as the end of a step from the last committed one.
  void commit(const Vector& local_displacement);

  /// Stores or restores the histories of the last committed step. Collective.
  void serialize(StateArchive& archive);

  /// Bytes that the history of a body takes on this rank; 0 for laws without.
  std::size_t history_bytes(LocalOrdinal block) const;

  /// Number of times that the forces, the stiffness or the history of a body with a history were computed on this rank; 0 for laws without.
  long history_evaluations(LocalOrdinal block) const;

  /// Calls `visit` for each quadrature point of each owned element, in order.
  void visit_points(const Vector& local_displacement, const std::function<void(const MaterialPoint&)>& visit) const;

  /// Volume-weighted mean Cauchy stress of each owned element of a block.
  std::vector<StressComponents> element_stresses(const Vector& local_displacement, LocalOrdinal block) const;

  /// Volume-weighted mean accumulated plastic strain of each owned element of a block; 0 for laws without plasticity.
  std::vector<double> element_plastic_strains(const Vector& local_displacement, LocalOrdinal block) const;

  /// Volume-weighted mean strain of each owned element of a block: 1/2 ln(F F^T) of the law's F; for small strain the symmetric part of F - 1.
  std::vector<StressComponents> element_strains(const Vector& local_displacement, LocalOrdinal block) const;

  /// Cauchy stress at each owned node: stress_components() columns on mesh()->owned_nodes. It is the mean over the elements around the node of what
  /// their points, extrapolated, give there: a polynomial fitted to them, linear in each direction. A node has elements of one body only, so bodies
  /// do not mix. 0 at nodes without elements.
  RCP<MultiVector> nodal_stresses(const Vector& local_displacement) const;

  /// The strain of element_strains() at each owned node, as nodal_stresses() has it.
  RCP<MultiVector> nodal_strains(const Vector& local_displacement) const;

  /// Stored energy of each body, summed over all ranks. Collective.
  std::vector<double> stored_energies(const Vector& local_displacement) const;

  /// Work that plastic flow of each body has taken, summed over all ranks; 0 for laws without plasticity. Collective.
  std::vector<double> plastic_works(const Vector& local_displacement) const;

  /// Integral of N_a dV0 over the body `block`, for each owned node a.
  std::vector<double> nodal_volumes(LocalOrdinal block) const;

  /// Volumes of the owned nodes in a block that are above 0 in any element, with the volume as their sum: see nodal_masses().
  std::vector<double> lumped_volumes(LocalOrdinal block) const;

 private:
  using PointTensor = std::function<Matrix3(const MaterialPoint&)>;
  std::vector<StressComponents> element_means(const Vector& local_displacement, LocalOrdinal block, const PointTensor& tensor) const;
  RCP<MultiVector> nodal_means(const Vector& local_displacement, const PointTensor& tensor) const;
  PointTensor strain_of_points() const;

  std::shared_ptr<const FieldSpace> space_;
  RCP<const Mesh> mesh_;
  Kinematics kinematics_;
  double thickness_;
  std::vector<BodyProperties> properties_;
  std::vector<std::unique_ptr<ElementBlock>> blocks_;
  std::vector<double> point_masses_;
  bool know_temperature_ = false;
  double heat_at_start_;
};

/// The rigid body modes about the current configuration, on the owned dofs. Collective.
/// * 2D: translations in x and y and the rotation (-y, x) about the centre of the current nodes;
/// * axisymmetric: the translation in z;
/// * 3D: three translations, rotations about x, y and z.
RCP<MultiVector> rigid_body_modes(const Bodies& bodies, const Vector& displacement);

/// Current positions of the owned nodes, a column for each direction. `displacement` is on the owned dofs.
RCP<MultiVector> current_coordinates(const Bodies& bodies, const Vector& displacement);

}  // namespace mortise
