"""Two blocks that do not match, linear elastic with Poisson's ratio 0, pressed, then drawn aside with friction. usage: numpy_host.py libmortise.so"""
import ctypes as c, sys
import numpy as np
lib, contact, E, tolerance, i64, of = c.CDLL(sys.argv[1]), c.c_void_p(), 1000.0, 1e-10, c.c_int64, lambda a: a.ctypes.data_as(c.c_void_p)
lib.mortise_last_error.restype = c.c_char_p
class Norms(c.Structure):
    _fields_ = [(n, c.c_double) for n in ("gap", "complementarity", "force")] + [(n, c.c_int32) for n in ("active", "sticking", "changed")]
class Matrix(c.Structure):
    _fields_ = [("rows", i64), ("starts", c.POINTER(i64)), ("columns", c.POINTER(i64)), ("values", c.POINTER(c.c_double))]
Solver = c.CFUNCTYPE(c.c_int, c.c_void_p, i64, c.POINTER(c.c_double), c.POINTER(c.c_double))
def call(name, *arguments):
    if getattr(lib, "mortise_" + name)(*arguments) != 0:
        raise RuntimeError(message.value.decode() or lib.mortise_last_error(contact).decode())
# 5 x 5 nodes, on them 4 x 4; square elements with K = E (sym grad u) : (sym grad v); bottom and top are prescribed.
x = np.array([(i / (n - 1), b + j / (n - 1)) for b, n in ((0, 5), (1, 4)) for j in range(n) for i in range(n)])
elements = [[f + i + n * j for j in (v, v + 1) for i in (u, u + 1)] for f, n in ((0, 5), (25, 4)) for v in range(n - 1) for u in range(n - 1)]
s, t = np.array([(i, j) for i in (-1, 1) for j in (-1, 1)]).T / 12 ** 0.5 + 0.5
gradients = np.array([[t - 1, 1 - t, -t, t], [s - 1, -s, 1 - s, s]])  # [2 x nodes x points]
m = np.einsum("iaq,jbq->aibj", gradients, gradients) / 4
k = E / 2 * (np.einsum("akbk,ij->aibj", m, np.eye(2)) + m.transpose(0, 3, 2, 1)).reshape(8, 8)
rows, K = x.size, np.zeros((x.size, x.size))
for nodes in elements:
    dofs = (2 * np.array(nodes)[:, None] + [0, 1]).ravel()
    K[np.ix_(dofs, dofs)] += k
starts, columns, values = np.append(0, (K != 0).sum(1).cumsum()), np.nonzero(K)[1].copy(), K[K != 0]
held, ids, pair, size, message = np.repeat(x[:, 1] % 2 == 0, 2), np.arange(rows), c.c_int32(), i64(), c.create_string_buffer(1000)
call("create", -1, 2, i64(len(x)), of(ids), of(x), of(ids), of(held.astype(np.int32)), i64(rows), of(ids), None, c.byref(contact), message, i64(1000))
call("add_pair", contact, b"joint", c.c_double(E), b"friction/type = coulomb; friction/coefficient = 0.3", c.byref(pair))
call("add_facets", contact, pair, 0, i64(3), 2, of(np.array([25, 26, 26, 27, 27, 28])))
call("add_facets", contact, pair, 1, i64(4), 2, of(np.array([21, 20, 22, 21, 23, 22, 24, 23])))
call("ready", contact, c.byref(size))
d, z, n = np.zeros(rows), np.zeros(size.value), (i64(rows), size)
for time in np.arange(1, 9) / 4:
    target = np.where(x[:, 1:] == 2, [0.12 * max(0, time - 1), -0.02 * min(1, time)], 0).ravel()
    call("start_step", contact, *n, of(d), None, of(z))
    for iteration in range(30):
        f, norms, matrix, dd, dz = np.zeros(rows), Norms(), Matrix(), np.zeros(rows), np.zeros(size.value)
        call("differentiate", contact, *n, of(d), None, of(z), of(f), None, c.byref(norms))
        internal, off = K @ d, np.where(held, target - d, 0)
        balanced = np.linalg.norm((internal + f)[~held]) <= tolerance * np.linalg.norm(internal)
        if balanced and iteration > 0 and max(abs(off).sum(), norms.gap, norms.complementarity) <= tolerance and norms.changed == 0:
            break
        right = -internal
        call("condense", contact, n[0], of(starts), of(columns), of(values), of(right), c.byref(matrix))
        of_row = np.repeat(ids, np.diff(np.ctypeslib.as_array(matrix.starts, (rows + 1,))))
        A = np.zeros((rows, rows))
        A[of_row, np.ctypeslib.as_array(matrix.columns, of_row.shape)] = np.ctypeslib.as_array(matrix.values, of_row.shape)
        A[held], right[held] = E * np.eye(rows)[held], E * off[held]
        solver = Solver(lambda _, m, b, y: np.copyto(np.ctypeslib.as_array(y, (m,)), np.linalg.solve(A, np.ctypeslib.as_array(b, (m,)))) or 0)
        call("solve", contact, *n, of(right), solver, None, of(dd), of(dz))
        d, z = d + dd, z + dz
    call("accept", contact)
z_ids = np.zeros(size.value, np.int64)
call("multipliers", contact, size, of(z_ids), None, None)
print("\n".join([f"d {i} {v:.17g}" for i, v in enumerate(d)] + [f"z {i - rows} {v:.17g}" for i, v in zip(z_ids, z)]))
lib.mortise_destroy(c.byref(contact))
