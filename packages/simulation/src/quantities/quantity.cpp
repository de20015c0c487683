#include "mortise/simulation/quantities/quantity.hpp"

#include "mortise/simulation/quantities/quantity_kinds.hpp"

namespace mortise {

const Registry<Quantity>& quantity_registry() {
  static const Registry<Quantity> registry = [] {
    Registry<Quantity> kinds;
    kinds.add<Reaction>("reaction", "force of the supports on a set of nodes");
    kinds.add<Rotation>("rotation", "rotation of a reference point");
    kinds.add<ContactForce>("contact force", "sum of the contact forces on the slave side of a pair");
    kinds.add<MomentumImbalance>("momentum imbalance", "how far forces are from balance, relative");
    kinds.add<Extremum>("extremum", "largest or smallest value of a field");
    kinds.add<Mean>("mean", "mean of a field: over nodes, over volume, over the slave surface");
    kinds.add<Spread>("spread", "max|sigma_ij - mean sigma_ij| / max|mean sigma_kl| over all quadrature points");
    kinds.add<PointDisplacement>("displacement", "displacement of a point");
    kinds.add<ErrorNorm>("error norm", "relative L2 error of a field against a named exact solution");
    kinds.add<HalfWidth>("half width", "half width of the contact zone from the second moment of the pressure: 2 sqrt(int p x^2 / int p)");
    kinds.add<StickHalfWidth>("stick half width", "half width of what sticks, from the second moment of what is left of the friction bound");
    kinds.add<ContactTraction>("contact traction", "pressure or shear of a pair: the largest, or at a position");
    kinds.add<ContactRadius>("contact radius", "radius of a Hertzian pressure about an axis, from the pressures' second moment; in 3D");
    kinds.add<PeakPressure>("peak pressure", "largest contact pressure of a pair");
    kinds.add<ContactLength>("contact length", "length of the slave surface, where the pair's geometry is, that belongs to closed nodes");
    kinds.add<ContactArea>("contact area", "area of the slave surface, where the pair's geometry is, that belongs to closed nodes");
    kinds.add<PressureVariation>("pressure variation", "total variation of the nodal contact pressures along the slave surface of a pair");
    kinds.add<ActiveCount>("active count", "number of closed slave nodes of a pair");
    kinds.add<FormulaQuantity>("formula", "an expression of t, the scene's variables and the quantities before it");
    kinds.add<OverTime>("over time", "the largest or smallest value that a quantity before it had at the end of any step");
    kinds.add<Energy>("energy", "stored energy, plastic work, friction, or the work of external or internal forces");
    kinds.add<EnergyError>("energy error", "what external work leaves after internal work and friction, relative");
    return kinds;
  }();
  return registry;
}

}  // namespace mortise
