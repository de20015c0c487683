# A run as it is drawn: what is solid and what is seen through, where nodes are at each step, how large all of it is.
import numpy as np


class Model:
    """Faces of a run, with the camera and the factor of displacements that hold for all steps that are drawn."""

    def __init__(self, run, field, steps, warp, view):
        self.run, self.mesh, self.field = run, run.mesh, field
        self.is_plane = self.mesh.dimension == 2
        every = faces_of(self.mesh)
        self.lines = self.mesh.cells.get("line2", np.zeros((0, 2), dtype=int))
        self.slaves = self._slave_nodes(steps) if field.is_contact else None
        self.solid = [faces for faces in every if not self._is_ghost(faces)]
        self.ghosts = [faces for faces in every if self._is_ghost(faces)]
        if self.slaves is not None and not self.is_plane:
            self.solid, more = self._apart(self.solid)
            self.ghosts += more
        if not np.isfinite(self.mesh.nodes).all():
            raise mortise_results.FileProblem(f"{run.path('fields/mesh.h5')} is damaged: a node has no position")
        self.used = np.unique(np.concatenate([one.ravel() for one in self.mesh.cells.values()] or [np.zeros(0, dtype=int)]))
        if len(self.used) == 0:
            raise mortise_results.FileProblem(f"{run.directory}: its mesh has no elements")
        self.moves = "displacement" in run.fields(steps[0])
        span = np.ptp(self.mesh.nodes[self.used], axis=0)
        self.size = float(np.linalg.norm(span))
        largest = max((np.linalg.norm(self._displacement(step)[self.used], axis=1).max() for step in steps), default=0.0)
        self.warp = warp_for(largest, self.size) if warp is None else warp
        self.is_deformed = self.warp * largest > 1e-4 * self.size
        self.camera = Camera(PLANE if self.is_plane else self._eye(view))

    @staticmethod
    def _is_ghost(faces):
        return bool(faces.rigid)

    def _slave_nodes(self, steps):
        """Nodes with a contact pressure or a gap at any of the steps: all others have neither."""
        slave = np.zeros(len(self.mesh.nodes), dtype=bool)
        for step in steps:
            for name in ("contact_pressure", "contact_traction", "gap", self.field.name):
                if name.partition(".")[0] in self.run.fields(step):
                    values = self.run.field(name, step)
                    slave |= (values != 0) if values.ndim == 1 else (values != 0).any(axis=1)
        return slave

    def _apart(self, solid):
        """Bodies with slave nodes, and those that would hide them."""
        bodies = {int(body) for faces in solid for body in np.unique(faces.body[self.slaves[faces.nodes].any(axis=1)])}
        if not bodies:
            return solid, []
        part = lambda inside: [one for one in (self._some(faces, np.isin(faces.body, list(bodies)) == inside) for faces in solid) if len(one.nodes)]
        return part(True), part(False)

    @staticmethod
    def _some(faces, chosen):
        some = Faces(faces.shape, faces.nodes[chosen], faces.cell[chosen], faces.body[chosen], faces.rigid)
        some.outline = faces.outline[chosen]
        return some

    def _eye(self, view):
        if view:
            return eye_of(view)
        if self.slaves is None:
            return eye_of("iso")
        normal = np.zeros(3)
        for faces in self.solid:
            inside = self.slaves[faces.corners()].all(axis=1)
            normal += face_normals(faces, self.mesh.nodes)[inside].sum(axis=0)
        length = np.linalg.norm(normal)
        return eye_toward(normal / length) if length > 0 else eye_of("iso")

    def _displacement(self, step):
        if not self.moves:
            return np.zeros_like(self.mesh.nodes)
        return finite(self.run, "displacement", step, "node", self.run.field("displacement", step))

    def points(self, step=None):
        """Camera coordinates of nodes at a step; in the reference configuration without one."""
        return self.camera(self.mesh.nodes if step is None else self.mesh.nodes + self.warp * self._displacement(step))

    def bounds(self, steps):
        """Lowest and highest right and up of all steps and of the reference configuration."""
        low, high = np.full(2, np.inf), np.full(2, -np.inf)
        for step in [None, *steps]:
            at = self.points(step)[self.used, :2]
            low, high = np.minimum(low, at.min(axis=0)), np.maximum(high, at.max(axis=0))
        return low, high

    def deforming(self, center, values):
        """Values at the nodes or cells of bodies that deform."""
        shapes = [name for name in self.mesh.cells if not self.mesh.is_rigid(name)]
        of = self.mesh.cells if center == "node" else self.mesh.ids
        chosen = np.unique(np.concatenate([of[name].ravel() for name in shapes] or [np.zeros(0, dtype=int)]))
        return values[chosen]
