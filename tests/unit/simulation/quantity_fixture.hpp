#pragma once
// Two blocks in contact with displacements, pressures and forces made by hand, and the quantities of them.

#include <Tpetra_Core.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <functional>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/quantities/quantity_kinds.hpp"
#include "quantity_text.hpp"

namespace mortise::test {

using Point = std::array<double, 2>;

inline constexpr double youngs_modulus = 100.0, poissons_ratio = 0.25, thickness = 2.0, width = 4.0;
inline constexpr double lambda = 40.0, mu = 40.0;  // of the constants above
inline constexpr int upper_cells = 5;

/// u of uniform strain: xx 0.01, yy -0.02, u_x,y = 0.006.
inline Point uniform_strain(const Point& X) { return {0.01 * X[0] + 0.006 * X[1], -0.02 * X[1]}; }
inline constexpr double stress_xx = lambda * -0.01 + 2.0 * mu * 0.01, stress_yy = lambda * -0.01 + 2.0 * mu * -0.02, stress_zz = lambda * -0.01,
                        stress_xy = mu * 0.006;

/// "lower" [0, 4] x [0, 1] of 4 x 2 squares and "upper" [0, 4] x [1, 2] of 10 x 4 triangles; the underside of "upper" is the slave.
class TwoBlocks {
 public:
  explicit TwoBlocks(Kinematics kinematics = Kinematics::plane_strain, ContactGeometry geometry = ContactGeometry::current, bool rubs = false) {
    const auto lower = std::make_shared<BlockMesh>(), upper = std::make_shared<BlockMesh>();
    lower->width = upper->width = width;
    lower->cells_x = 4, lower->cells_y = upper->cells_y = 2, upper->cells_x = upper_cells;
    upper->translation = {0.0, 1.0};
    mesh = build_mesh(Tpetra::getDefaultComm(), {{"lower", {}, lower, CellShape::quadrilateral4}, {"upper", {}, upper, CellShape::triangle3}},
                      {"lower/top", "upper/bottom"});
    const std::shared_ptr<MaterialOptions> material = std::make_shared<ElasticMaterialOptions<SmallStrainLinear>>();
    material->youngs_modulus = youngs_modulus, material->poissons_ratio = poissons_ratio;
    bodies =
        std::make_unique<Bodies>(displacement_space(mesh), kinematics, thickness,
                                 std::vector<BodyProperties>{{"lower", {}, material, ElementType::q4}, {"upper", {}, material, ElementType::t3}});

    ContactPair pair;
    pair.name = "pair";
    pair.options.geometry = geometry;
    if (rubs) pair.options.friction.options = std::make_shared<TrescaFriction>();
    pair.slave = facets_at_owned_nodes(*mesh, mesh->side_sets.at("upper/bottom"));
    pair.master = facets_of_owned_elements(*mesh, mesh->side_sets.at("lower/top"));
    pair.youngs_modulus = youngs_modulus;
    const auto reference = rcp(new MultiVector(mesh->owned_nodes, 2));
    for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node)
      for (int i = 0; i < 2; ++i) reference->replaceLocalValue(node, i, mesh->coordinates[node][i]);
    const InterfaceMeasure measure{kinematics == Kinematics::axisymmetric, thickness};
    contact = std::make_unique<ContactSystem>(mesh->owned_nodes, bodies->space().dofs(), reference, rcp(new MultiVector(mesh->owned_nodes, 2)),
                                              measure, std::vector<ContactPair>{pair}, Timers());
    multipliers = rcp(new Vector(contact->multiplier_map()));
    displacement = nodal([](int, const Point&) { return Point{0.0, 0.0}; });
    reaction = nodal([](int, const Point&) { return Point{0.0, 0.0}; });
    external = nodal([](int, const Point&) { return Point{0.0, 0.0}; });
    history = contact->initial_history(*displacement);
    move([](int, const Point&) { return Point{0.0, 0.0}; });
  }

  using Function = std::function<Point(int body, const Point& X)>;
  /// A vector on the owned dofs.
  RCP<Vector> nodal(const Function& value) const {
    const auto vector = rcp(new Vector(bodies->space().dofs()));
    for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node) {
      const Point at = value(mesh->body_of_node[node], {mesh->coordinates[node][0], mesh->coordinates[node][1]});
      for (int i = 0; i < 2; ++i) vector->replaceLocalValue(2 * node + i, at[i]);
    }
    return vector;
  }

  void move(const Function& u) {
    displacement = nodal(u);
    local_displacement = rcp(new Vector(bodies->space().local_dofs()));
    local_displacement->doImport(*displacement, *bodies->space().ghost_import(), Tpetra::INSERT);
    evaluation = contact->evaluate(*displacement, *history);
  }

  /// z = p n + (shear, 0) with n = (0, -1); p of x.
  void press(const std::function<double(double)>& pressure, double shear = 0.0) {
    const GlobalOrdinal offset = bodies->space().dofs()->getMaxAllGlobalIndex() + 1;
    for (const GlobalOrdinal id : local_ids(*multipliers->getMap())) {
      const LocalOrdinal node = mesh->owned_nodes->getLocalElement((id - offset) / 2);
      multipliers->replaceGlobalValue(id, (id - offset) % 2 == 0 ? shear : -pressure(mesh->coordinates[node][0]));
    }
  }

  QuantityContext context(double time = 1.0) const {
    laws = evaluation->laws(*multipliers);
    QuantityContext context{*bodies};
    context.contact = contact.get();
    context.pairs = {{"pair", "upper/bottom", "lower/top"}};
    context.time = time;
    context.displacement = displacement.get();
    context.local_displacement = local_displacement.get();
    context.laws = &*laws;
    context.reaction = reaction.get();
    context.external_force = external.get();
    context.force_round_off = force_round_off;
    context.prescribed = &prescribed;
    return context;
  }

  double value(const Quantity& quantity, double time = 1.0) const { return quantity.make_evaluator(context(time))->evaluate(context(time)); }

  /// Owned dofs of a set.
  std::vector<LocalOrdinal> dofs(const std::string& set) const {
    std::vector<LocalOrdinal> dofs;
    for (const LocalOrdinal node : mesh->node_sets.at(set))
      if (node < mesh->owned_count()) dofs.insert(dofs.end(), {2 * node, 2 * node + 1});
    return dofs;
  }

  RCP<Mesh> mesh;
  std::unique_ptr<Bodies> bodies;
  std::unique_ptr<ContactSystem> contact;
  std::optional<ContactHistory> history;
  std::optional<ContactEvaluation> evaluation;
  mutable std::optional<ContactLaws> laws;  ///< of the last context()
  RCP<Vector> displacement, local_displacement, multipliers, reaction, external;
  std::vector<LocalOrdinal> prescribed;
  double force_round_off = 0.0;
};

/// A quantity of a field, on a set, a body or a pair.
template <class Kind>
Kind field(PointField field, const std::string& on) {
  Kind quantity;
  quantity.field = field;
  quantity.on = {on, {}};
  return quantity;
}

}  // namespace mortise::test
