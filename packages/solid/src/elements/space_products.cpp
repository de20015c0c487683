#include "elements/space_products.hpp"

namespace mortise {
namespace {

template <int lanes>
struct VectorOfLanes {
  typedef double Type __attribute__((vector_size(8 * lanes), aligned(8), may_alias));
};

/// Row by row: g_a A first, 9 numbers, then times g_b for all b at once, which is the innermost loop. The compiler finds neither loop by itself.
template <int nodes, int lanes>
__attribute__((always_inline)) inline void add_products(const double (&g)[3][filled_up(nodes)], const double (&A)[9][filled_up(9)], const double* q,
                                                        double* rows, double* volumetric) {
  using Lanes = typename VectorOfLanes<lanes>::Type;
  constexpr int width = filled_up(nodes);
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) {
      double left[filled_up(9)];
      for (int p = 0; p < 9; p += lanes)
        *reinterpret_cast<Lanes*>(left + p) = g[0][a] * *reinterpret_cast<const Lanes*>(A[3 * i] + p) +
                                              g[1][a] * *reinterpret_cast<const Lanes*>(A[3 * i + 1] + p) +
                                              g[2][a] * *reinterpret_cast<const Lanes*>(A[3 * i + 2] + p);
      if (q != nullptr) {
        const double share = g[0][a] * q[3 * i] + g[1][a] * q[3 * i + 1] + g[2][a] * q[3 * i + 2];
        volumetric[3 * a + i] += share;
        for (int k = 0; k < 3; ++k) left[4 * k] -= share;
      }
      double* row = rows + (3 * a + i) * 3 * width;
      for (int k = 0; k < 3; ++k)
        for (int b = 0; b < width; b += lanes)
          *reinterpret_cast<Lanes*>(row + k * width + b) += left[3 * k] * *reinterpret_cast<const Lanes*>(g[0] + b) +
                                                            left[3 * k + 1] * *reinterpret_cast<const Lanes*>(g[1] + b) +
                                                            left[3 * k + 2] * *reinterpret_cast<const Lanes*>(g[2] + b);
    }
}

#if defined(__x86_64__)
template <int nodes>
__attribute__((target("avx2,fma"))) void add_products_of_four(const double (&g)[3][filled_up(nodes)], const double (&A)[9][filled_up(9)],
                                                              const double* q, double* rows, double* volumetric) {
  add_products<nodes, 4>(g, A, q, rows, volumetric);
}

bool has_vectors_of_four() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}
#endif

}  // namespace

template <int nodes>
void add_space_products(const double (&g)[3][filled_up(nodes)], const double (&A)[9][filled_up(9)], const double* q, double* rows,
                        double* volumetric) {
#if defined(__x86_64__)
  if (has_vectors_of_four()) return add_products_of_four<nodes>(g, A, q, rows, volumetric);
#endif
  add_products<nodes, 2>(g, A, q, rows, volumetric);
}

template void add_space_products<4>(const double (&)[3][4], const double (&)[9][12], const double*, double*, double*);
template void add_space_products<5>(const double (&)[3][8], const double (&)[9][12], const double*, double*, double*);
template void add_space_products<6>(const double (&)[3][8], const double (&)[9][12], const double*, double*, double*);
template void add_space_products<8>(const double (&)[3][8], const double (&)[9][12], const double*, double*, double*);
template void add_space_products<10>(const double (&)[3][12], const double (&)[9][12], const double*, double*, double*);
template void add_space_products<15>(const double (&)[3][16], const double (&)[9][12], const double*, double*, double*);
template void add_space_products<20>(const double (&)[3][20], const double (&)[9][12], const double*, double*, double*);

}  // namespace mortise
