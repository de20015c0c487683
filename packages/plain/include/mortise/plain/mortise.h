/** @file
 * Contact for programs in C, Fortran, Python: plain arrays in, compressed rows out. docs/plain.md shows it in use.
 *
 * Every function returns a mortise_status, the same one on every rank. mortise_last_error() has it in words. Nothing here prints, ends the program,
 * or keeps anything outside of a mortise_contact. Functions are collective on the communicator of mortise_create() unless they are said to be local.
 *
 * Arrays belong to the caller and are read or written within a call only. Those of a mortise_matrix belong to the mortise_contact. An array of length
 * 0 may be NULL. Ids are from 0. Units are those of the caller: lengths of its positions, and stresses of its Young's modulus. */
#ifndef MORTISE_PLAIN_MORTISE_H
#define MORTISE_PLAIN_MORTISE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Contact of one model, with its memory of slip. */
typedef struct mortise_contact mortise_contact;

/** Outcome of a call. */
typedef enum mortise_status {
  MORTISE_OK = 0,
  MORTISE_NULL_POINTER = 1, /**< an array or a result that has to be given is not */
  MORTISE_WRONG_LENGTH = 2, /**< an array is not as long as the model says */
  MORTISE_NOT_FINITE = 3,   /**< NaN or Inf is given: an iterate has diverged, or an array was not filled */
  MORTISE_WRONG_ORDER = 4,  /**< something has to be called before; ranks are in different calls; or a call of this contact is under way, in another
                               thread or in the linear solver that it calls: then without a text */
  MORTISE_REFUSED = 5,      /**< the model or an option is wrong: ids, facets, ranks, names, ranges */
  MORTISE_STEP_FAILED = 6,  /**< contact cannot be evaluated there: undo the step, take a smaller one */
  MORTISE_SOLVE_FAILED = 7, /**< the caller's linear solver said so */
  MORTISE_BAD_BYTES = 8,    /**< a stored history is damaged, or is of another model */
  MORTISE_NO_MEMORY = 9,
  MORTISE_INTERNAL = 10 /**< anything else: please report it */
} mortise_status;

/** In the place of a communicator: this process alone. MPI need not be initialised. */
#define MORTISE_THIS_PROCESS (-1)

/** Side of a pair. Multipliers are those of slave nodes. */
typedef enum mortise_side { MORTISE_SLAVE = 0, MORTISE_MASTER = 1 } mortise_side;

/** Derivatives of the contact forces f and of the conditions C. */
typedef enum mortise_block {
  MORTISE_F_D = 0, /**< df/dd at fixed z [rows x rows] */
  MORTISE_F_Z = 1, /**< df/dz [rows x multipliers] */
  MORTISE_C_D = 2, /**< dC/dd [multipliers x rows] */
  MORTISE_C_Z = 3  /**< dC/dz [multipliers x multipliers] */
} mortise_block;

/** A matrix in compressed rows: those of this rank, in the order in which they were given or numbered. It is valid until the call that gave it is
 * made again, or until mortise_destroy(). Entries may be 0. */
typedef struct mortise_matrix {
  int64_t rows;           /**< number of rows of this rank */
  const int64_t* starts;  /**< [rows + 1] of each row in the arrays below */
  const int64_t* columns; /**< [starts[rows]] global ids */
  const double* values;   /**< [starts[rows]] */
} mortise_matrix;

/** Norms and counts at one iterate, over all ranks. */
typedef struct mortise_norms {
  double gap;             /**< largest gap of closed nodes, over the length of the shortest facet */
  double complementarity; /**< largest |C| of what is not a gap, over the largest |z| */
  double force;           /**< |f| */
  int32_t active;         /**< closed nodes */
  int32_t sticking;       /**< of them */
  int32_t changed;        /**< nodes whose state is another one than at the last linearised iterate of the step */
} mortise_norms;

/** Outcome of mortise_augment(). */
typedef struct mortise_augmentation {
  double error;      /**< of the multipliers, over the largest one */
  double tolerance;  /**< of it */
  int32_t more;      /**< 1: solve again, with the multipliers' new start; 0: they are exact enough */
  int32_t exhausted; /**< 1: more would be needed than the pair allows */
} mortise_augmentation;

/** State of a slave node. */
typedef struct mortise_node {
  int64_t node;       /**< its id */
  int32_t state;      /**< 0 open, 1 sticks, 2 slips; without friction closed nodes slip */
  int32_t carries;    /**< 0: it has no multiplier, others act in its place */
  double pressure;    /**< z . n */
  double gap;         /**< mean distance to the master, weighted with the functions of the multiplier [length] */
  double shear;       /**< shear traction, in 3D its size */
  double shear_bound; /**< largest shear traction, of closed nodes with friction */
  double slip;        /**< since the start of the step [length] */
  double slip_path;   /**< over all accepted steps and this one [length] */
  double weight;      /**< area in the reference configuration that the node stands for; in 2D its length times the thickness */
  double traction[3]; /**< z: the force on the slave side is -z times the area that is covered; third component 0 in 2D */
  double normal[3];   /**< out of the slave */
} mortise_node;

/** The caller's linear solver: dd = A^-1 right, with the condensed matrix A and its rows of prescribed displacements. Not 0: it has failed. */
typedef int (*mortise_linear_solver)(void* user, int64_t rows, const double* right, double* dd);

/* ---- The model ----------------------------------------------------------------------------------------------------------------------------------
 */

/** Begins a model.
 * @param comm         handle of Fortran, MPI_Comm_c2f(communicator); it is duplicated. Or MORTISE_THIS_PROCESS
 * @param dimension    2 or 3
 * @param nodes        number of nodes that this rank owns: each node of the model belongs to one rank
 * @param node_ids     [nodes]
 * @param positions    [nodes x dimension] in the reference configuration
 * @param node_rows    [nodes x dimension] the row of the system that each component of the displacement is, or -1 for one that is no unknown
 * @param marks        [nodes x dimension] 1 where the displacement is prescribed although there is a row, 2 where it follows a rigid body, else 0.
 *                    NULL: 0 everywhere
 * @param rows         number of rows of the system that this rank owns, those of other fields included
 * @param row_ids      [rows] their global ids. Those of node_rows of the nodes of this rank are among them
 * @param options      "name = value" separated by ";" or line breaks: "thickness" (1), "axisymmetric" (false). NULL: none
 * @param contact      is set, to NULL where it fails
 * @param message      [message_size] gets the error in words, cut to its size; NULL: is not wanted */
int mortise_create(int comm, int dimension, int64_t nodes, const int64_t* node_ids, const double* positions, const int64_t* node_rows,
                   const int32_t* marks, int64_t rows, const int64_t* row_ids, const char* options, mortise_contact** contact, char* message,
                   int64_t message_size);

/** Adds a pair of surfaces.
 * @param name            for messages; each pair has another one
 * @param youngs_modulus  of the softer side, above 0
 * @param options         "name = value" separated by ";" or line breaks, as "friction/type = coulomb; friction/coefficient = 0.3". Names are those of
 * the list of a pair (docs/reference/contact.md), after the names of lists within it. Functions have to be numbers. NULL: none
 * @param pair            is set to its number, from 0 */
int mortise_add_pair(mortise_contact* contact, const char* name, double youngs_modulus, const char* options, int32_t* pair);

/** Adds the second pass of a pair whose formulation has two: a pair of its own, with the sides exchanged. It takes its facets as others do. */
int mortise_add_second_pass(mortise_contact* contact, int32_t of, int32_t* pair);

/** Adds facets of one kind to a side of a pair. Local: ranks add what they have. Errors are told again by mortise_ready() on every rank.
 * @param side             mortise_side. Every slave facet on each rank that owns a node of it, its nodes in the same order. Every master facet on one
 * rank
 * @param nodes_per_facet  2 or 3 in 2D: the body lies on the left of the way along the nodes. 3, 4, 6 or 8 in 3D: corners, then middles,
 * anticlockwise as seen from outside. Facets turned inside out are not detected: they never touch
 * @param nodes            [facets x nodes_per_facet] ids */
int mortise_add_facets(mortise_contact* contact, int32_t pair, int side, int64_t facets, int nodes_per_facet, const int64_t* nodes);

/** Ends the model. `multipliers` is set to the number of multiplier components of this rank: `dimension` for each slave node that it owns, but for
 * those that are held in every direction. */
int mortise_ready(mortise_contact* contact, int64_t* multipliers);

/** The multiplier components. Local. Arrays may be NULL.
 * @param ids      [multipliers] columns of MORTISE_F_Z and MORTISE_C_Z: above all rows
 * @param nodes    [multipliers] id of the slave node
 * @param weights  [multipliers] area that the node stands for */
int mortise_multipliers(mortise_contact* contact, int64_t multipliers, int64_t* ids, int64_t* nodes, double* weights);

/* ---- A step -------------------------------------------------------------------------------------------------------------------------------------
 */
/* In what follows `rows` and `multipliers` are the lengths of the caller's arrays, which are checked.
 * @param d           [rows] the rows' unknowns: displacements, whatever else it has
 * @param prescribed  [nodes x dimension] displacements, read where node_rows is -1. NULL: these do not move
 * @param z           [multipliers] tractions, compression is positive along the outward normal of the slave */

/** Begins a step at the accepted displacement. Slips are measured from there. Multipliers of nodes that touch are set to a small pressure. Calling it
 * again undoes the step: put d and z back before. */
int mortise_start_step(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* d, const double* prescribed, double* z);

/** Contact at an iterate: a function of d, z and what was accepted, whatever was called before.
 * @param f      [rows] contact forces, that the residual has: r = internal forces + f - loads. NULL: not wanted
 *   C      [multipliers] the conditions, 0 where they are met [stress]. NULL: not wanted
 * @param norms  NULL: not wanted */
int mortise_evaluate(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* d, const double* prescribed, const double* z,
                     double* f, double* C, mortise_norms* norms);

/** As mortise_evaluate(), with the derivatives that mortise_jacobian() and mortise_condense() need. */
int mortise_differentiate(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* d, const double* prescribed, const double* z,
                          double* f, double* C, mortise_norms* norms);

/** A block of derivatives at the last mortise_differentiate(). The states of its nodes are those that `changed` compares with from then on. */
int mortise_jacobian(mortise_contact* contact, int block, mortise_matrix* matrix);

/** Eliminates the multipliers from the Newton system at the last mortise_differentiate().
 *   starts, columns, values  the caller's K = d(internal forces - loads)/dd without contact, and without replaced rows of prescribed displacements
 * @param rhs                      [rows] the caller's -r without f. Becomes the right-hand side of the condensed system
 * @param matrix                   the condensed matrix, which has MORTISE_F_D too. Rows of prescribed displacements are to be replaced now */
int mortise_condense(mortise_contact* contact, int64_t rows, const int64_t* starts, const int64_t* columns, const double* values, double* rhs,
                     mortise_matrix* matrix);

/** Newton's step with the condensed system: calls `solver` once, or a few times more where slave nodes are hardly covered.
 * @param right  [rows] of mortise_condense(), with rows of prescribed displacements as the caller has them. In further calls these rows are 0
 * @param dd     [rows] increment of d
 * @param dz     [multipliers] increment of z */
int mortise_solve(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* right, mortise_linear_solver solver, void* user,
                  double* dd, double* dz);

/** The multipliers z that follow from dd alone: those of mortise_solve() where no node is hardly covered. */
int mortise_recover(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* dd, double* z);

/** Augmented Lagrange: updates the start of the multipliers after Newton's method has converged. To be called until `more` is 0, each time with a
 * solve before it. Other pairs are left as they are. */
int mortise_augment(mortise_contact* contact, mortise_augmentation* augmentation);

/** Takes the last evaluated state for the end of the step. */
int mortise_accept(mortise_contact* contact);

/** Number of slave nodes of a pair that this rank owns. Local. */
int mortise_count_nodes(mortise_contact* contact, int32_t pair, int64_t* nodes);

/** The states of these nodes at the last evaluation.
 * @param report  [nodes] */
int mortise_report(mortise_contact* contact, int32_t pair, int64_t nodes, mortise_node* report);

/* ---- Memory -------------------------------------------------------------------------------------------------------------------------------------
 */

/** What this rank has of the accepted history, as bytes. It is to be restored on as many ranks with the same nodes.
 * @param capacity  of `bytes`; too little is MORTISE_WRONG_LENGTH, and `size` is set
 * @param bytes     [capacity] NULL with capacity 0: only the size is wanted
 * @param size      is set to the number of bytes */
int mortise_store(mortise_contact* contact, int64_t capacity, void* bytes, int64_t* size);

/** Goes on from a stored history, in the state with displacements d and multipliers z in which it was stored. */
int mortise_restore(mortise_contact* contact, int64_t size, const void* bytes, int64_t rows, int64_t multipliers, const double* d,
                    const double* prescribed, const double* z);

/** Why the last call failed; "" if it did not. Valid until the next call. Local. */
const char* mortise_last_error(const mortise_contact* contact);

/** Frees the contact and sets the pointer to NULL. NULL is left as it is, and so is one of which a call is under way. Before
 * MPI_Finalize() if MPI is used. */
void mortise_destroy(mortise_contact** contact);

#ifdef __cplusplus
}
#endif

#endif
