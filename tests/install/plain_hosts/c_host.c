/* A host in C: two blocks that do not match, linear elastic with Poisson's ratio 0, pressed, then drawn aside with friction. All of it but contact is
 * here: elements, dense Gaussian elimination, Newton's method. Runs on any number of ranks; nodes with x < 1/2 belong to the first, others to the last.
 *   c_host DIMENSION */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mortise/plain/mortise.h"

enum { most_nodes = 5 * 5 * 5 + 4 * 4 * 4, most_rows = 3 * most_nodes };
static const double E = 1000.0, down = 0.02, right = 0.12, tolerance = 1e-10;
static const int cells[2] = {4, 3};

static int dimension, rank, ranks, all_rows, first[3];      /* first: node of each block, and behind the last */
static int rows, row_ids[most_rows];                        /* of this rank */
static double K[most_rows][most_rows], A[most_rows][most_rows];
static int coupled[most_rows][most_rows], pivots[most_rows];
static mortise_contact* contact;

static void check(int status) {
  if (status == MORTISE_OK) return;
  fprintf(stderr, "%s\n", mortise_last_error(contact));
  MPI_Abort(MPI_COMM_WORLD, status);
}

static double sum_over_ranks(double mine) {
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------------------------------------- */

static int power(int base) { return dimension == 2 ? base * base : base * base * base; }

static int node_at(int block, const int* at) {
  const int along = cells[block] + 1;
  return first[block] + at[0] + along * (at[1] + along * at[2]);
}

static void position(int node, double* x) {
  const int block = node < first[1] ? 0 : 1, along = cells[block] + 1, n = node - first[block];
  const int at[3] = {n % along, n / along % along, n / along / along};
  for (int i = 0; i < 3; ++i) x[i] = 1.0 * at[i] / cells[block];
  x[dimension - 1] += block;
}

static int is_mine(int node) {
  double x[3];
  position(node, x);
  return (x[0] < 0.5 ? 0 : ranks - 1) == rank;
}

/* 1: the bottom, which stays; 2: the top, which moves; 0: neither. */
static int held(int node) {
  double x[3];
  position(node, x);
  return x[dimension - 1] == 0.0 ? 1 : x[dimension - 1] == 2.0 ? 2 : 0;
}

static double target(int row, double time) {
  if (held(row / dimension) != 2) return 0.0;
  if (row % dimension == 0) return right * fmax(0.0, time - 1.0);
  return row % dimension == dimension - 1 ? -down * fmin(1.0, time) : 0.0;
}

/* Corners of a cell, or of a side of as many directions: x first. */
static int corners(int block, const int* cell, int directions, int* nodes) {
  for (int corner = 0; corner < 1 << directions; ++corner) {
    const int at[3] = {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1)};
    nodes[corner] = node_at(block, at);
  }
  return 1 << directions;
}

/* The integral of N_a,i N_b,j over a cell with sides h. */
static double product(int a, int b, int i, int j, double h) {
  double result = 1.0;
  for (int k = 0; k < dimension; ++k) {
    const double of_a = (a >> k & 1) ? 1.0 : -1.0, of_b = (b >> k & 1) ? 1.0 : -1.0;
    if (k == i && k == j)
      result *= of_a * of_b / h;
    else if (k == i)
      result *= 0.5 * of_a;
    else if (k == j)
      result *= 0.5 * of_b;
    else
      result *= h * (of_a == of_b ? 1.0 / 3.0 : 1.0 / 6.0);
  }
  return result;
}

static void assemble(void) {
  for (int block = 0; block < 2; ++block)
    for (int cell = 0; cell < power(cells[block]); ++cell) {
      const int along = cells[block], at[3] = {cell % along, cell / along % along, cell / along / along};
      int nodes[8];
      const int size = corners(block, at, dimension, nodes);
      for (int a = 0; a < size; ++a)
        for (int b = 0; b < size; ++b) {
          double sum = 0.0;
          for (int k = 0; k < dimension; ++k) sum += product(a, b, k, k, 1.0 / along);
          for (int i = 0; i < dimension; ++i)
            for (int j = 0; j < dimension; ++j) {
              const int row = dimension * nodes[a] + i, column = dimension * nodes[b] + j;
              K[row][column] += 0.5 * E * ((i == j ? sum : 0.0) + product(a, b, j, i, 1.0 / along));
              coupled[row][column] = 1;
            }
        }
    }
}

/* ---- Contact: the model ------------------------------------------------------------------------------------------------------------------------- */

static void add_facets(int32_t pair, int block) {
  const int along = cells[block], count = power(along) / along, size = 1 << (dimension - 1);
  int64_t nodes[16 * 4];
  int facets = 0;
  for (int k = 0; k < count; ++k) {
    int at[3] = {k % along, k / along % along, 0}, around[4], any_mine = 0;
    at[dimension - 1] = block == 0 ? along : 0;
    corners(block, at, dimension - 1, around);
    if (dimension == 3) { /* against the clock, seen from above */
      const int swapped = around[2];
      around[2] = around[3], around[3] = swapped;
    }
    for (int n = 0; n < size; ++n) { /* outward normals: up for the lower block, down for the upper one */
      const int taken = (dimension == 3) == (block == 1) ? size - 1 - n : n;
      nodes[size * facets + n] = around[taken];
      any_mine |= is_mine(around[n]);
    }
    if (block == 1 ? any_mine : is_mine((int)nodes[size * facets])) ++facets;
  }
  check(mortise_add_facets(contact, pair, block == 1 ? MORTISE_SLAVE : MORTISE_MASTER, facets, size, nodes));
}

static int64_t set_up_contact(void) {
  static int64_t node_ids[most_nodes], node_rows[most_rows], ids[most_rows];
  static double positions[most_rows];
  static int32_t marks[most_rows];
  int nodes = 0;
  for (int node = 0; node < first[2]; ++node) {
    double x[3];
    if (!is_mine(node)) continue;
    position(node, x);
    for (int i = 0; i < dimension; ++i) {
      positions[rows] = x[i];
      marks[rows] = held(node) ? 1 : 0;
      row_ids[rows] = dimension * node + i;
      node_rows[rows] = ids[rows] = row_ids[rows];
      ++rows;
    }
    node_ids[nodes++] = node;
  }
  char message[1000];
  if (mortise_create((int)MPI_Comm_c2f(MPI_COMM_WORLD), dimension, nodes, node_ids, positions, node_rows, marks, rows, ids, NULL, &contact, message,
                     sizeof(message)) != MORTISE_OK) {
    fprintf(stderr, "%s\n", message);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  int32_t pair;
  int64_t multipliers;
  check(mortise_add_pair(contact, "joint", E, "friction/type = coulomb; friction/coefficient = 0.3", &pair));
  add_facets(pair, 1);
  add_facets(pair, 0);
  check(mortise_ready(contact, &multipliers));
  return multipliers;
}

/* ---- Linear solver: all of A on every rank ------------------------------------------------------------------------------------------------------ */

static void factorise(void) {
  for (int row = 0; row < all_rows; ++row) MPI_Allreduce(MPI_IN_PLACE, A[row], all_rows, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  for (int k = 0; k < all_rows; ++k) {
    pivots[k] = k;
    for (int row = k + 1; row < all_rows; ++row)
      if (fabs(A[row][k]) > fabs(A[pivots[k]][k])) pivots[k] = row;
    for (int c = 0; c < all_rows; ++c) {
      const double swapped = A[k][c];
      A[k][c] = A[pivots[k]][c], A[pivots[k]][c] = swapped;
    }
    for (int row = k + 1; row < all_rows; ++row) {
      if (A[row][k] == 0.0) continue;
      A[row][k] /= A[k][k];
      for (int c = k + 1; c < all_rows; ++c) A[row][c] -= A[row][k] * A[k][c];
    }
  }
}

static int solve(void* user, int64_t size, const double* b, double* x) {
  static double all[most_rows];
  (void)user;
  memset(all, 0, sizeof(all));
  for (int64_t row = 0; row < size; ++row) all[row_ids[row]] = b[row];
  MPI_Allreduce(MPI_IN_PLACE, all, all_rows, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  for (int k = 0; k < all_rows; ++k) {
    const double swapped = all[k];
    all[k] = all[pivots[k]], all[pivots[k]] = swapped;
  }
  for (int row = 0; row < all_rows; ++row)
    for (int c = 0; c < row; ++c) all[row] -= A[row][c] * all[c];
  for (int row = all_rows - 1; row >= 0; --row) {
    for (int c = row + 1; c < all_rows; ++c) all[row] -= A[row][c] * all[c];
    all[row] /= A[row][row];
  }
  for (int64_t row = 0; row < size; ++row) x[row] = all[row_ids[row]];
  return 0;
}

/* ---- Newton's method ---------------------------------------------------------------------------------------------------------------------------- */

static int solve_step(int64_t multipliers, const int64_t* starts, const int64_t* columns, const double* values, double time, double* d, double* z) {
  static double internal[most_rows], f[most_rows], rhs[most_rows], dd[most_rows], dz[most_rows], everywhere[most_rows];
  check(mortise_start_step(contact, rows, multipliers, d, NULL, z));
  for (int iteration = 0; iteration < 30; ++iteration) {
    mortise_norms norms;
    mortise_matrix condensed;
    double unbalanced = 0.0, size = 0.0, off = 0.0;
    check(mortise_differentiate(contact, rows, multipliers, d, NULL, z, f, NULL, &norms));
    memset(everywhere, 0, sizeof(everywhere));
    for (int row = 0; row < rows; ++row) everywhere[row_ids[row]] = d[row];
    MPI_Allreduce(MPI_IN_PLACE, everywhere, all_rows, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    for (int row = 0; row < rows; ++row) {
      internal[row] = 0.0;
      for (int64_t k = starts[row]; k < starts[row + 1]; ++k) internal[row] += values[k] * everywhere[columns[k]];
      size += internal[row] * internal[row];
      if (held(row_ids[row] / dimension))
        off += fabs(target(row_ids[row], time) - d[row]);
      else
        unbalanced += pow(internal[row] + f[row], 2);
      rhs[row] = -internal[row];
    }
    unbalanced = sqrt(sum_over_ranks(unbalanced)), size = sqrt(sum_over_ranks(size)), off = sum_over_ranks(off);
    if (iteration > 0 && unbalanced <= tolerance * size && off <= tolerance && norms.gap <= tolerance && norms.complementarity <= tolerance &&
        norms.changed == 0)
      return 1;
    check(mortise_condense(contact, rows, starts, columns, values, rhs, &condensed));
    memset(A, 0, sizeof(A));
    for (int row = 0; row < rows; ++row) {
      const int id = row_ids[row];
      if (held(id / dimension)) { /* the row of a prescribed displacement */
        A[id][id] = E;
        rhs[row] = E * (target(id, time) - d[row]);
      } else {
        for (int64_t k = condensed.starts[row]; k < condensed.starts[row + 1]; ++k) A[id][condensed.columns[k]] = condensed.values[k];
      }
    }
    factorise();
    check(mortise_solve(contact, rows, multipliers, rhs, solve, NULL, dd, dz));
    for (int row = 0; row < rows; ++row) d[row] += dd[row];
    for (int64_t k = 0; k < multipliers; ++k) z[k] += dz[k];
  }
  return 0;
}

int main(int argc, char** argv) {
  static double d[most_rows], z[most_rows];
  static int64_t starts[most_rows + 1], ids[most_rows];
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  dimension = argc > 1 && atoi(argv[1]) == 3 ? 3 : 2;
  first[1] = power(cells[0] + 1), first[2] = first[1] + power(cells[1] + 1), all_rows = dimension * first[2];
  const int64_t multipliers = set_up_contact();
  assemble();
  int64_t entries = 0;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < all_rows; ++c) entries += coupled[row_ids[row]][c];
  int64_t* columns = malloc(sizeof(int64_t) * (size_t)(entries + 1));
  double* values = malloc(sizeof(double) * (size_t)(entries + 1));
  entries = 0;
  for (int row = 0; row < rows; ++row) {
    for (int c = 0; c < all_rows; ++c)
      if (coupled[row_ids[row]][c]) columns[entries] = c, values[entries++] = K[row_ids[row]][c];
    starts[row + 1] = entries;
  }
  for (int step = 1; step <= 8; ++step) {
    if (!solve_step(multipliers, starts, columns, values, 0.25 * step, d, z)) MPI_Abort(MPI_COMM_WORLD, 2);
    check(mortise_accept(contact));
  }
  check(mortise_multipliers(contact, multipliers, ids, NULL, NULL));
  for (int row = 0; row < rows; ++row) printf("d %d %.17g\n", row_ids[row], d[row]);
  for (int64_t k = 0; k < multipliers; ++k) printf("z %lld %.17g\n", (long long)ids[k] - all_rows, z[k]);
  free(columns);
  free(values);
  mortise_destroy(&contact);
  MPI_Finalize();
  return 0;
}
