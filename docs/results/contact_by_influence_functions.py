#!/usr/bin/env python3
"""Plane contact with Coulomb friction by influence functions: what a theory of small strain gives for contact on the undeformed surfaces of two
linearly elastic bodies, and what contact on their deformed surfaces changes. A second program: nothing of it is taken from the C++ one.

Problems (plane strain, forces per unit of thickness)

* partial-slip: two equal half discs (R = 8 or 32, E = 200, nu = 0.3) are clamped along their diameters, which may be moved but not turned. They are
  pressed together by P = 80/R, then drawn aside by Q = 7.48928/R with mu = 0.2.
* cb1: a cylinder (half disc of R = 50, E = 210000) with a load of 35000 spread evenly over its diameter is pressed on a block (200 x 200, E = 70000);
  nu = 0.3, mu = 0 and 0.1. One half is computed.

Theory (half planes; 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, 1/R* = 1/R1 + 1/R2)

* Hertz: half width b = sqrt(4 P R*/(pi E*)), pressure p(x) = p0 sqrt(1 - x^2/b^2) with p0 = 2 P/(pi b)
* Cattaneo, Mindlin: stick in |x| < c = b sqrt(1 - Q/(mu P)); |t(x)| = mu p(x) outside, less mu p0 (c/b) sqrt(1 - x^2/c^2) inside, so that
  |t(0)| = mu p0 (1 - c/b)

Conditions at the nodes of the upper body, with gap g, pressure p, shear traction t on the upper body, and slip s of the upper body in this step:

    g >= 0,  p >= 0,  g p = 0          |t| <= mu p,  s = 0 where |t| < mu p,  s has the sign of -t where |t| = mu p

* 'undeformed': each node faces the point of the lower body of the same x for good, and the normal is vertical, as in the theory.
* 'deformed': the normal is that of the upper body's deformed surface; a node faces the point where it meets the lower body's deformed surface. Slip
  is measured against the point that the node faced at the end of the last step.

Tractions are forces per undeformed length along x, except in the line 'deformed, measured there' of cb1. Half widths are those of the second moment
(divided by the area it is a^2/4 for a semi-ellipse), c that of mu p - |t|, which in theory is a semi-ellipse over the zone of stick.

Solution: biquadratic finite elements give, once for each body, the displacements of its surface nodes by hat functions of traction. The rest are
dense systems for the tractions. A step is solved by active sets: each node is open (p = 0), sticks (g = 0, s = 0) or slips to one side (g = 0,
|t| = mu p), and goes to another set where the solution violates a condition, until none does. On deformed surfaces that is repeated with the normals
and facing points of the last solution until tractions do not change. What does not converge ends the program with code 1.
"""
import argparse
import sys
import time
from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

OPEN, STICK, SLIP_LEFT, SLIP_RIGHT = range(4)
GRID = 1.25             # half length of the grid of possible contact over the theory's half width
BLOCK_GRID = 1.35       # the same of the block in cb1, along which the cylinder's nodes may move
STEPS_PARTIAL_SLIP = 20
STEPS_CB1 = 16


class NotConverged(Exception):
    """An iteration has not met its criterion, so there is no figure to print."""


class Body(NamedTuple):
    """Surface nodes, and their displacements (all along x, then all along y) by nodal tractions and by the load in full."""
    x: np.ndarray
    y: np.ndarray
    influence: np.ndarray
    by_load: np.ndarray
    weights: np.ndarray     # integrals of the hat functions


def quadratic(xi):
    """Shape functions of the nodes -1, 0, 1 and their derivatives."""
    return np.array([xi * (xi - 1) / 2, 1 - xi * xi, xi * (xi + 1) / 2]), np.array([xi - 0.5, -2 * xi, xi + 0.5])


def quadrilaterals(nodes):
    """Elements of nine nodes (number 3 i + j) of a grid of (2 n + 1) x (2 m + 1) node numbers."""
    rows, columns = nodes.shape
    return np.array([nodes[i:rows - 2 + i:2, j:columns - 2 + j:2].ravel() for i in range(3) for j in range(3)]).T


def with_middles(places):
    """The places with the middles between them."""
    return np.insert(places, np.arange(1, len(places)), (places[1:] + places[:-1]) / 2)


def graded(first, ratio, length):
    """Places (with middles) from 0 to length, whose steps grow by the ratio and start at about the first."""
    count = int(np.ceil(np.log(1 + length * (ratio - 1) / first) / np.log(ratio)))
    places = np.cumsum(np.append(0.0, ratio**np.arange(count)))
    return with_middles(places * length / places[-1])


def half_disc(radius, surface_x, depth):
    """Mesh of the lower half (or quarter, if surface_x begins at 0) of a disc that touches y = 0 at the origin.

    w = z/(1 + i z/(2 R)) makes the arc a straight line and the diameter an arc of radius 2 R. There the mesh is a grid below surface_x and rays from
    its border to the arc, so that its nodes are exactly on the boundary. Returns coordinates, elements, nodes below surface_x, nodes of the diameter
    from right to left.
    """
    cell = surface_x[-1] - surface_x[-2]
    x = with_middles(surface_x)
    z = x + 1j * (radius - np.sqrt(radius**2 - x**2))
    along = (z / (1 + 1j * z / (2 * radius))).real
    grid = along[:, None] + 1j * graded(cell / 2, 1.2, depth)
    nodes = np.arange(grid.size).reshape(grid.shape)
    left_side = nodes[0, -2::-1] if surface_x[0] < 0 else nodes[0, :0]
    border = np.concatenate([nodes[-1, :-1], nodes[::-1, -1], left_side])
    start = grid.ravel()[border]
    ways = 2 * radius * start / abs(start) - start
    rays = start[:, None] + ways[:, None] * graded(cell / (2 * radius - along[-1]), 1.25, 1.0)[1:]
    ray_nodes = np.column_stack([border, grid.size + np.arange(rays.size).reshape(rays.shape)])
    w = np.append(grid, rays)
    z = w / (1 - 1j * w / (2 * radius))
    elements = np.concatenate([quadrilaterals(nodes), quadrilaterals(ray_nodes[::-1])])
    return np.column_stack([z.real, z.imag]), elements, nodes[:, 0], ray_nodes[:, -1]


def stiffness_matrix(coordinates, elements, young, poisson):
    """Stiffness in plane strain; node k has the unknowns 2 k and 2 k + 1."""
    moduli = np.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, 0.5 - poisson]]) * young / (1 + poisson) / (1 - 2 * poisson)
    local = np.zeros((len(elements), 18, 18))
    determinants = []
    points, weights = np.polynomial.legendre.leggauss(3)
    for xi, weight_xi in zip(points, weights):
        for eta, weight_eta in zip(points, weights):
            (f, df), (h, dh) = quadratic(xi), quadratic(eta)
            derivatives = np.array([np.outer(df, h).ravel(), np.outer(f, dh).ravel()])
            jacobian = derivatives @ coordinates[elements]
            gradients = np.linalg.inv(jacobian) @ derivatives
            strains = np.zeros((len(elements), 3, 18))
            strains[:, 0, 0::2] = strains[:, 2, 1::2] = gradients[:, 0]
            strains[:, 1, 1::2] = strains[:, 2, 0::2] = gradients[:, 1]
            determinants.append(np.linalg.det(jacobian))
            area = abs(determinants[-1]) * weight_xi * weight_eta
            local += strains.transpose(0, 2, 1) @ (moduli @ strains) * area[:, None, None]
    if np.ptp(np.sign(determinants)) != 0:
        raise ValueError('a finite element is turned inside out')
    unknowns = np.stack([2 * elements, 2 * elements + 1], -1).reshape(-1, 18)
    entries = (local.ravel(), (np.repeat(unknowns, 18, 1).ravel(), np.tile(unknowns, 18).ravel()))
    return sparse.csc_matrix(entries, shape=(coordinates.size, coordinates.size))


def hat_forces(x):
    """Integrals over x of the shape function of each node of an edge (row) times the hat function of each corner (column)."""
    forces = np.zeros((len(x), len(x) // 2 + 1))
    for xi, weight in zip(*np.polynomial.legendre.leggauss(3)):
        functions, derivatives = quadratic(xi)
        hats = np.array([1 - xi, 1 + xi]) / 2
        for corner in range(len(x) // 2):
            nodes = slice(2 * corner, 2 * corner + 3)
            forces[nodes, corner:corner + 2] += weight * (derivatives @ x[nodes]) * np.outer(functions, hats)
    return forces


def make_body(coordinates, elements, surface, young, poisson, fixed, load=0.0):
    """The body with the tractions at the corners of the surface; the fixed unknowns are zero, the load is a force on each unknown."""
    stiffness = stiffness_matrix(coordinates, elements, young, poisson)
    free = np.setdiff1d(np.arange(coordinates.size), fixed)
    hats = hat_forces(coordinates[surface, 0])
    count = hats.shape[1]
    forces = np.zeros((coordinates.size, 2 * count + 1))
    forces[2 * surface, :count] = forces[2 * surface + 1, count:-1] = hats
    forces[:, -1] = load
    factors = splu(stiffness[free][:, free], permc_spec='MMD_AT_PLUS_A', diag_pivot_thresh=0.0, options={'SymmetricMode': True})
    displacements = np.zeros_like(forces)
    displacements[free] = factors.solve(forces[free])
    corners = surface[::2]
    displacements = displacements[np.append(2 * corners, 2 * corners + 1)]
    return Body(*coordinates[corners].T, displacements[:, :-1], displacements[:, -1], hats.sum(0))


def interpolation(grid, places):
    """Matrix from values at the grid to those at the places, linear between."""
    left = np.clip(np.searchsorted(grid, places) - 1, 0, len(grid) - 2)
    share = (places - grid[left]) / (grid[left + 1] - grid[left])
    rows = np.arange(len(places))
    return sparse.csr_matrix((np.append(1 - share, share), (np.append(rows, rows), np.append(left, left + 1))), (len(places), len(grid)))


class Contact:
    """The upper body's nodes on the lower body's surface. If symmetric, x = 0 is a line of symmetry, and node 0 is on it."""

    def __init__(self, upper, lower, deformed, symmetric):
        self.upper, self.lower, self.deformed, self.symmetric = upper, lower, deformed, symmetric
        self.count = len(upper.x)
        self.solution = np.zeros(2 * self.count + 2)    # p of all nodes, their t (positive to the right), translation of the upper body
        self.pressure, self.shear = self.solution[:self.count], self.solution[self.count:-2]
        self.state = np.full(self.count, OPEN)
        self.normal = np.array([np.zeros(self.count), np.ones(self.count)])
        self.facing = self.facing_before = upper.x      # points of the lower body, now and at the end of the last step
        self.place_before = np.zeros(self.count)        # along the tangent, relative to that point, at the end of the last step

    def frame(self):
        """Matrix from components along normal and tangent to those along x and y; it is its own inverse."""
        n_x, n_y = (sparse.diags(component) for component in self.normal)
        return sparse.bmat([[n_x, n_y], [n_y, -n_x]], 'csr')

    def tractions(self):
        """On the upper body, along x and y."""
        return self.frame() @ self.solution[:-2]

    def transfer(self):
        """Matrix from the upper body's tractions to the lower body's, which are opposite and per length of the lower body."""
        facing = np.interp(self.lower.x, self.facing, self.upper.x)
        stretch = np.gradient(facing, self.lower.x, edge_order=2)
        if self.symmetric:
            stretch[0] = facing[1] / self.lower.x[1]
        stretch[(self.lower.x < self.facing[0]) | (self.lower.x > self.facing[-1])] = 0
        return sparse.kron(np.eye(2), sparse.diags(-stretch) @ interpolation(self.upper.x, facing), 'csr')

    def distance(self, facing, load):
        """Matrix (of the solution) and constant of the nodes' distances from points of the lower body, along normals, then tangents."""
        upper, lower, frame = self.upper, self.lower, self.frame()
        relative = upper.influence - sparse.kron(np.eye(2), interpolation(lower.x, facing), 'csr') @ lower.influence @ self.transfer()
        translation = np.kron(np.eye(2), np.ones((self.count, 1)))
        undeformed = np.append(upper.x - facing, upper.y - np.interp(facing, lower.x, lower.y))
        return frame @ np.hstack([relative @ frame, translation]), frame @ (undeformed + load * upper.by_load)

    def upper_surface(self, load):
        """Deformed x and y of the nodes, and their derivatives along the undeformed x."""
        displacements = (self.upper.influence @ self.tractions() + load * self.upper.by_load).reshape(2, -1) + self.solution[-2:, None]
        places = np.array([self.upper.x, self.upper.y]) + displacements
        return places, np.gradient(places, self.upper.x, axis=1, edge_order=2)

    def update_geometry(self, load):
        """Normals of the upper body's deformed surface and the points where they meet the lower body's."""
        (x, y), (dx, dy) = self.upper_surface(load)
        grid = self.lower.x
        displacements = self.lower.influence @ (self.transfer() @ self.tractions())
        lower_x, lower_y = np.array([grid, self.lower.y]) + displacements.reshape(2, -1)
        self.normal = np.array([-dy, dx]) / np.hypot(dx, dy)
        if self.symmetric:
            self.normal[:, 0] = 0, 1
        for _ in range(30):
            before = self.facing
            aside = (np.interp(before, grid, lower_x) - x) * self.normal[1] - (np.interp(before, grid, lower_y) - y) * self.normal[0]
            self.facing = np.clip(before - aside, grid[0], grid[-1])
            if self.symmetric:
                self.facing[0] = 0      # exactly: otherwise the lower body's node 0 could seem to be outside
            if abs(self.facing - before).max() < 1e-13 * grid[-1]:
                return
        raise NotConverged('no points found that the nodes face')

    def step(self, friction, force_y, force_x=None, load=0.0):
        """Goes to these sums of the tractions on the upper body and this part of its load; without force_x it is not translated along x."""
        for _ in range(40):
            before = self.solution
            self.solve(friction, force_y, force_x, load)
            if not self.deformed:
                break
            self.update_geometry(load)
            if abs(self.solution - before)[:-2].max() < 1e-11 * self.pressure.max():
                break
        else:
            raise NotConverged('tractions and deformed surfaces still change')
        if self.state[-1] != OPEN or not self.symmetric and self.state[0] != OPEN:
            raise NotConverged('contact reaches the end of its grid')
        if abs(self.lower.weights @ (self.transfer() @ self.tractions())[len(self.lower.x):] + force_y) > 2e-3 * force_y:
            raise NotConverged('forces on the two bodies differ')       # 1e-3 with 8 cells, 1e-4 with 80
        self.facing_before = self.facing
        matrix, constant = self.distance(self.facing, load)
        self.place_before = (matrix @ self.solution + constant)[self.count:]

    def solve(self, friction, force_y, force_x, load):
        """Active sets with the present normals and facing points."""
        count = self.count
        matrix, constant = self.distance(self.facing, load)
        gap, gap_constant = matrix[:count], constant[:count]
        matrix, constant = self.distance(self.facing_before, load)
        slip, slip_constant = matrix[count:], constant[count:] - self.place_before
        sums = np.kron(np.eye(2), self.upper.weights) @ self.frame()
        if (self.state == OPEN).all():
            self.state[np.argsort(gap_constant)[:3]] = STICK    # to start with; a system without contact would be singular
        for _ in range(50):
            closed, stick, left, right = (np.flatnonzero(nodes) for nodes in (
                self.state != OPEN, self.state == STICK, self.state == SLIP_LEFT, self.state == SLIP_RIGHT))
            if self.symmetric:
                stick = stick[stick > 0]        # there t = 0
            elif force_x is not None and len(stick) == 0:
                raise NotConverged('all nodes slip')
            system = np.eye(2 * count + 2)      # rows that are left so: p = 0, t = 0, no translation
            right_side = np.zeros(2 * count + 2)
            system[closed], right_side[closed] = gap[closed], -gap_constant[closed]
            system[count + stick], right_side[count + stick] = slip[stick], -slip_constant[stick]
            system[count + left, left], system[count + right, right] = -friction, friction      # friction pushes to the other side
            for row, force in ((-2, force_x), (-1, force_y)):
                if force is not None:
                    system[row], right_side[row] = np.append(sums[row], [0, 0]), force
            self.solution = np.linalg.solve(system, right_side)
            self.pressure, self.shear = self.solution[:count], self.solution[count:-2]
            before = self.state
            self.state = self.next_state(gap @ self.solution + gap_constant, slip @ self.solution + slip_constant, friction,
                                         1 / abs(np.diag(gap)).mean())
            if (self.state == before).all():
                return
        raise NotConverged('sets of open, sticking and slipping nodes still change')

    def next_state(self, gap, slip, friction, stiffness):
        """Where the last solution tells the nodes to be; the stiffness makes slip and traction comparable."""
        closed = np.where(self.state == OPEN, gap < -1e-15 * self.upper.x[-1], self.pressure > 0)
        trial = self.shear - stiffness * np.where(self.state == STICK, 0, slip)     # where they slip the wrong way this is within the bound
        bound = friction * np.maximum(self.pressure, 0)
        result = np.where(trial > bound, SLIP_LEFT, np.where(trial < -bound, SLIP_RIGHT, STICK))
        if friction == 0:
            result[:] = SLIP_LEFT       # either side: t = 0
        elif self.symmetric:
            result[0] = STICK
        return np.where(closed, result, OPEN)


def half_width(x, traction, place=None, centred=False):
    """That of the semi-ellipse of the same second moment, about 0 or its centre; forces are traction dx, at x or another place."""
    moments = np.zeros(3)
    for xi, weight in zip(*np.polynomial.legendre.leggauss(2)):     # exact: all are linear between nodes
        force, middle = ((f[:-1] * (1 - xi) + f[1:] * (1 + xi)) / 2 for f in (traction, x if place is None else place))
        moments += (np.array([force, force * middle, force * middle**2]) * np.diff(x) * weight / 2).sum(1)
    return 2 * np.sqrt(moments[2] / moments[0] - centred * (moments[1] / moments[0])**2)


def percent(value, theory):
    """Deviation from theory."""
    return f'{100 * (value / theory - 1):+.2f}'


def partial_slip(cells):
    """The table of partial slip."""
    young, poisson, friction = 200.0, 0.3, 0.2
    start = time.perf_counter()
    rows = [('R', 'contact on', 'b', 'p0', 'c', 't(0) along x', 't(0) along the surface')]
    for radius in (8.0, 32.0):
        press, pull = 80 / radius, 7.48928 / radius
        b = np.sqrt(2 * press * radius / np.pi * 2 * (1 - poisson**2) / young)
        p0 = 2 * press / (np.pi * b)
        c = b * np.sqrt(1 - pull / (friction * press))
        t0 = friction * p0 * (1 - c / b)
        centre = round(GRID * cells)
        coordinates, elements, surface, diameter = half_disc(radius, np.arange(-centre, centre + 1) * b / cells, GRID * b)
        upper = make_body(coordinates, elements, surface, young, poisson, np.append(2 * diameter, 2 * diameter + 1))
        signs = np.repeat([1, -1], len(upper.x))
        lower = upper._replace(y=-upper.y, influence=upper.influence * np.outer(signs, signs))      # mirrored at y = 0
        for name in ('undeformed', 'deformed'):
            contact = Contact(upper, lower, name == 'deformed', symmetric=False)
            contact.step(0.0, press)        # pressing equal bodies leaves no shear
            contact.state[contact.state != OPEN] = STICK
            for number in range(1, STEPS_PARTIAL_SLIP + 1):
                contact.step(friction, press, -pull * number / STEPS_PARTIAL_SLIP)
            pressure, shear = contact.pressure, abs(contact.shear)
            stick_width = half_width(upper.x, np.maximum(friction * pressure - shear, 0), centred=True)
            rows.append((f'{radius:g}', name, percent(half_width(upper.x, pressure), b), percent(pressure.max(), p0), percent(stick_width, c),
                         percent(abs(contact.tractions()[centre]), t0), percent(shear[centre], t0)))
            print(f'partial slip, R = {radius:g}, {name}, {cells} cells: after {time.perf_counter() - start:.1f} s', file=sys.stderr)
    print('Partial slip of two cylinders: deviations from theory in percent')
    for row in rows:
        print('{:>4}  {:10}{:>8}{:>8}{:>8}{:>15}{:>25}'.format(*row))


def cb1_bodies(cells, radius, force, a):
    """Halves of the cylinder and of the block, whose middles are on x = 0."""
    coordinates, elements, surface, diameter = half_disc(radius, np.arange(round(GRID * cells) + 1) * a / cells, GRID * a)
    axis = np.flatnonzero(abs(coordinates[:, 0]) < 1e-9 * radius)
    load = np.zeros(coordinates.size)
    load[2 * diameter + 1] = hat_forces(coordinates[diameter, 0]).sum(1) * force / (2 * radius)     # from right to left, so downwards
    upper = make_body(coordinates, elements, surface, 210000.0, 0.3, np.append(2 * axis, 2 * diameter[-1] + 1), load)
    surface_x = with_middles(np.arange(round(BLOCK_GRID * cells) + 1) * a / cells)
    x = np.append(surface_x, surface_x[-1] + graded(1.2 * a / cells, 1.2, 100.0 - surface_x[-1])[1:])
    y = -graded(a / cells / 2, 1.2, 200.0)
    nodes = np.arange(len(x) * len(y)).reshape(len(x), len(y))
    fixed = np.concatenate([2 * nodes[0], 2 * nodes[:, -1], 2 * nodes[:, -1] + 1])
    coordinates = np.column_stack([np.repeat(x, len(y)), np.tile(y, len(x))])
    return upper, make_body(coordinates, quadrilaterals(nodes), nodes[:len(surface_x), 0], 70000.0, 0.3, fixed)


def cb1(cells):
    """The table of cb1."""
    radius, force = 50.0, 35000.0
    a = np.sqrt(4 * force * radius / np.pi * (1 - 0.3**2) * (1 / 210000 + 1 / 70000))
    peak = 2 * force / (np.pi * a)
    start = time.perf_counter()
    upper, lower = cb1_bodies(cells, radius, force, a)
    rows = {'undeformed': [], 'deformed': [], 'deformed, measured there': []}
    for friction, steps in ((0.0, 1), (0.1, STEPS_CB1)):
        for name in ('undeformed', 'deformed'):
            contact = Contact(upper, lower, name == 'deformed', symmetric=True)
            for number in range(1, steps + 1):
                contact.step(friction, force / 2 * number / steps, load=number / steps)
            highest, width = contact.pressure.max(), half_width(upper.x, contact.pressure)
            rows[name] += [f'{highest:.1f} ({percent(highest, peak)})', f'{width:.4f} ({percent(width, a)})']
            if contact.deformed:
                (x, _), (dx, dy) = contact.upper_surface(1.0)
                highest, width = (contact.pressure / np.hypot(dx, dy)).max(), half_width(upper.x, contact.pressure, x)
                rows['deformed, measured there'] += [percent(highest, peak), percent(width, a)]
            print(f'cb1, mu = {friction:g}, {name}, {cells} cells: after {time.perf_counter() - start:.1f} s', file=sys.stderr)
    print(f'CB1: peak pressure and half width, in brackets or alone deviations from theory ({peak:.1f}, {a:.4f}) in percent')
    for row in (['contact on', 'mu = 0: peak', 'half width', 'mu = 0.1: peak', 'half width'], *([name, *values] for name, values in rows.items())):
        print('{:25}{:>17}{:>17}{:>19}{:>17}'.format(*row))


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description='Contact with Coulomb friction in the plane by influence functions, on undeformed and on deformed '
                                                 'surfaces. Prints deviations from the theories of Hertz, Cattaneo and Mindlin, and progress on '
                                                 'stderr. Ends with 1 if anything does not converge.')
    parser.add_argument('problem', nargs='?', default='all', choices=('partial-slip', 'cb1', 'all'),
                        help='partial slip of two half discs, the benchmark CB1 (a cylinder on a block), or both (default)')
    parser.add_argument('--cells', type=int, default=80, metavar='N', help='finite elements over the half width of contact, from 8 on (default: 80, '
                                                                             'which takes half a minute for both; 20: some seconds)')
    arguments = parser.parse_args()
    if arguments.cells < 8:
        parser.error('--cells: at least 8')
    try:
        if arguments.problem != 'cb1':
            partial_slip(arguments.cells)
        if arguments.problem != 'partial-slip':
            cb1(arguments.cells)
    except NotConverged as error:
        sys.exit(f'Not converged: {error}.')


if __name__ == '__main__':
    main()
