#pragma once
// The products that an element's stiffness in 3D consists of.

namespace mortise {

/// Processors take up to 4 numbers at a time: rows are filled up to multiples of it.
constexpr int filled_up(int count) { return (count + 3) / 4 * 4; }

/// Rows of length 3 width, with width = filled_up(nodes), stand one after the other. For all nodes a, b and directions i, k
///   rows[3 a + i][k width + b] += sum_jl g[j][a] A[3 i + j][3 k + l] g[l][b].
/// Where the volume change is taken from the centre, `q` [9] is not null and the results change by
///   s = sum_j g[j][a] q[3 i + j],   rows[3 a + i][k width + b] -= s g[k][b],   volumetric[3 a + i] += s.
/// Entries that fill g and A up have to be 0. For the numbers of nodes of cells in 3D. Compiled for processors with vectors of 4 numbers and of 2;
/// the choice is made once.
template <int nodes>
void add_space_products(const double (&g)[3][filled_up(nodes)], const double (&A)[9][filled_up(9)], const double* q, double* rows,
                        double* volumetric);

}  // namespace mortise
