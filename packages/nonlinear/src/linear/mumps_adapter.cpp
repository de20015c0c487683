// Amesos2 has an adapter for MUMPS, which Debian's Trilinos did not compile. It is instantiated here, and nowhere else: the macro must not be
// seen by any other file that uses Amesos2.
#define HAVE_AMESOS2_MUMPS
#include <Amesos2_config.h>

#include <Amesos2.hpp>
#include <Amesos2_MUMPS_decl.hpp>

#include "linear/direct_solver.hpp"

namespace mortise::detail {
namespace {
// The adapter shows nothing of what an analysis and a factorisation tell.
double foreseen = 0.0;
int determinant_sign = 0;
}  // namespace
}  // namespace mortise::detail

// The adapter's own version prints to the terminal and takes warnings (positive codes) for errors. It is called after each phase, so that parameters
// that the adapter does not know are set here for the next: ICNTL(33) asks a factorisation for the determinant, RINFOG(12) * 2^INFOG(34).
template <>
void Amesos2::MUMPS<mortise::Matrix, mortise::MultiVector>::MUMPS_ERROR() const {
  constexpr int analysis = 1, factorisation = 2;
  mumps_par.icntl[32] = 1;
  if (mumps_par.job == analysis) mortise::detail::foreseen = mumps_par.info[14];
  if (mumps_par.job == factorisation) {
    const double mantissa = mumps_par.rinfog[11];
    mortise::detail::determinant_sign = mumps_par.infog[0] < 0 ? 0 : (mantissa > 0.0) - (mantissa < 0.0);
  }
  if (mumps_par.infog[0] < 0) throw mortise::detail::MumpsError(mumps_par.infog[0], mumps_par.infog[1]);
}

#include <Amesos2_MUMPS_def.hpp>

namespace mortise::detail {

MumpsError::MumpsError(int code, int detail)
    : std::runtime_error((code == -6 || code == -10 ? "the matrix is singular" : "MUMPS failed") + std::string(" (INFOG(1) = ") +
                         std::to_string(code) + ", INFOG(2) = " + std::to_string(detail) + ")"),
      code_(code) {}

namespace {
template <class Value>
void set(Amesos2Solver& mumps, const std::string& name, Value value) {
  const auto list = Teuchos::parameterList("Amesos2");
  list->sublist("MUMPS").set(name, value);
  mumps.setParameters(list);
}
}  // namespace

RCP<Amesos2Solver> make_mumps_adapter(const RCP<const Matrix>& matrix) {
  const RCP<Amesos2Solver> mumps = rcp(new Amesos2::MUMPS<Matrix, MultiVector>(matrix, Teuchos::null, Teuchos::null));
  if (!ids_have_no_gaps(*matrix->getRowMap())) set(*mumps, "IsContiguous", false);
  return mumps;
}

double mumps_memory_foreseen() { return foreseen; }

int mumps_determinant_sign() { return determinant_sign; }

void set_mumps_work_space(Amesos2Solver& mumps, int percent) { set(mumps, "ICNTL(14)", percent); }

}  // namespace mortise::detail
