"""Random scenes of two bodies, each a plain description that can be mirrored, refined, and have its roles exchanged. 2D and 3D."""

import copy
import math

from scene_writer import numbers

LAWS = ["neo hooke", "hencky", "ciarlet neo hooke"]


class Scene:
    """Two bodies. The lower one, "base", lies below y = 0 (3D: z = 0) and is held at its bottom; "block" is above it.

    family  how it is loaded and what is known of the answer
    d       dimension
    W, w    sizes of base and block, one for each axis, the last one the height
    N, n    cells of base and block
    at      lower left corner of the block; its height is the gap, negative: an overlap
    angle   degrees that the block is turned by about its lower left corner (2D)
    E, nu   elastic constants of base and block
    press   way of the block's top, or traction on it in families under dead loads
    pull    way or traction aside
    """

    def __init__(self, random, family, d):
        self.family, self.d, self.steps = family, d, random.choice([2, 4, 5, 8])
        pick, between = random.choice, random.uniform
        self.w = [between(0.5, 1.5) for _ in range(d - 1)] + [between(0.4, 1.2)]
        self.W = [size + between(0.3, 1.5) for size in self.w[:-1]] + [between(0.4, 1.2)]
        most, least = (9, 3) if d == 2 else (4, 2)
        self.n = [random.randint(least, most) for _ in range(d)]
        self.N = [random.randint(least, most + 2) for _ in range(d)]
        self.n[-1], self.N[-1] = random.randint(2, 5 if d == 2 else 2), random.randint(2, 5 if d == 2 else 2)
        self.mu = pick([0.0, 0.0, 0.0, 0.05, 0.1, 0.3, 0.5, 1.0])
        self.nu = [pick([0.0, 0.2, 0.3, 0.45]) for _ in range(2)]
        modulus = 10.0 ** between(1, 4)
        self.E = [modulus, modulus * pick([1e-3, 1e-1, 0.5, 1.0, 1.0, 2.0, 1e1, 1e3])]
        self.laws = [pick(LAWS), pick(LAWS)]
        self.elements = [pick(["Q4", "Q4", "Q4 F-bar"]) for _ in range(2)] if d == 2 else [pick(["H8", "H8", "H8 F-bar", "Tet4"]) for _ in range(2)]
        self.slave = pick(["block", "block", "base"])
        self.rigid = False
        self.angle = 0.0
        self.pull = 0.0
        self.sides_held = False
        h = self.W[0] / self.N[0]
        # Where edges stand over nodes is what is hard, so it is not left to chance alone.
        self.at = []
        for axis in range(d - 1):
            step = self.W[axis] / self.N[axis]
            room = self.W[axis] - self.w[axis]
            free = -self.W[axis] / 2 + between(0.0, room)
            node = -self.W[axis] / 2 + step * random.randint(0, int(room / step))
            self.at.append(pick([free, node, node + step * 10.0 ** between(-12, -1)]))
        self.at.append(pick([0.0, 0.0, between(0.0, 0.3) * h, -between(0.0, 0.4) * h]))
        self.press = between(0.003, 0.02) * (self.w[-1] + self.W[-1]) + max(0.0, self.at[-1])
        getattr(self, family.replace(" ", "_"))(random)

    # Families: what is changed of the above.

    def pressed(self, random):
        """The block's top is pressed down by a prescribed way."""

    def over_the_edge(self, random):
        """As pressed, but the block hangs over the base's edge by up to half of its width; nodes over one another, or slivers of facets, are not rare."""
        step = self.w[0] / self.n[0]
        hang = random.choice([step * random.randint(1, max(1, self.n[0] // 2)), random.uniform(0.1, 0.5) * self.w[0]])
        self.at[0] = self.W[0] / 2 - self.w[0] + hang + random.choice([0.0, 0.0, step * 10.0 ** random.uniform(-12, -1)])

    def walls(self, random):
        """Same widths between smooth walls: confined compression of small strain, known exactly."""
        self.w[:-1] = self.W[:-1]
        self.at[:-1] = [-size / 2 for size in self.W[:-1]]
        self.at[-1] = 0.0
        self.press = random.uniform(0.001, 0.02)
        self.laws = ["small strain linear"] * 2
        self.elements = [element.replace(" F-bar", "") for element in self.elements]
        self.sides_held = True

    def dead_load(self, random):
        """A dead traction on the block's top, which cannot move aside: the force is known."""
        softer = min(self.E)
        self.press = random.uniform(0.001, 0.01) * softer
        self.at[-1] = random.choice([0.0, 0.0, random.uniform(0.0, 0.1) * self.W[0] / self.N[0]])

    def lifted(self, random):
        """A dead traction that lifts the block, which nothing holds: there is no answer."""
        self.dead_load(random)
        self.press = -self.press

    def pushed_too_hard(self, random):
        """Dead tractions down and aside, beyond what friction can bear, on a block that nothing else holds: there is no answer."""
        self.dead_load(random)
        self.at[-1] = 0.0
        self.pull = self.press * (1.3 * self.mu + 0.05)

    def held_by_friction(self, random):
        """Dead tractions down and aside, which friction can bear, on a low block that nothing else holds: forces are known."""
        self.dead_load(random)
        self.at[-1] = 0.0
        self.mu = random.choice([0.2, 0.3, 0.5])
        self.w[-1] = 0.25 * self.w[0]
        self.pull = random.uniform(0.1, 0.5) * self.mu * self.press

    def dragged(self, random):
        """Pressed, then drawn aside far enough to slip everywhere: Coulomb's law. The block is the slave and stays on the base."""
        self.mu = random.choice([0.05, 0.1, 0.2, 0.3])
        self.slave = "block"
        self.steps = 10
        self.w[-1] = max(self.w[-1], 0.5)
        self.press = random.uniform(0.003, 0.008) * (self.w[-1] + self.W[-1])
        self.at[-1] = 0.0
        self.E[1] = self.E[0] * random.choice([0.5, 1.0, 2.0])
        self.at[0] = -self.w[0] / 2
        self.pull = random.choice([-1, 1]) * 0.1

    def corner(self, random):
        """The block, turned, is pressed with a corner on a smooth rigid plane (2D), which can push along its normal only."""
        self.rigid, self.slave, self.mu = True, "block", 0.0
        self.angle = random.choice([random.uniform(2.0, 45.0), 45.0, 30.0, 10.0])
        self.at = [random.uniform(-0.2, 0.2), random.choice([0.0, 0.005])]
        self.W, self.N = [6.0, 0.5], [random.randint(3, 20), 1]
        self.press = random.uniform(0.01, 0.05) * self.w[-1] + self.at[-1]

    # Other scenes that can be made of it.

    def mirrored(self):
        """The scene seen in a mirror, x to -x."""
        other = copy.deepcopy(self)
        other.at[0] = -self.at[0] - (0.0 if self.angle else self.w[0])
        other.angle, other.pull = -self.angle, -self.pull
        return other

    def exchanged(self):
        other = copy.deepcopy(self)
        other.slave = "base" if self.slave == "block" else "block"
        return other

    def finer(self):
        other = copy.deepcopy(self)
        other.n, other.N = [2 * count for count in self.n], [2 * count for count in self.N]
        return other

    def apart(self):
        """The bodies of the scene, touching at the start and moved together by the overlap."""
        other = copy.deepcopy(self)
        other.press, other.at[-1] = self.press - self.at[-1], 0.0
        return other

    def facet(self):
        """The longest facet across, of the slave."""
        sizes, counts = (self.w, self.n) if self.slave == "block" else (self.W, self.N)
        return max(size / count for size, count in zip(sizes[:-1], counts[:-1]))

    def covered(self):
        """Widths of what of the block stands over the base."""
        return [min(self.at[i] + self.w[i], self.W[i] / 2) - max(self.at[i], -self.W[i] / 2) for i in range(self.d - 1)]

    def under_dead_load(self):
        return self.family in ("dead_load", "lifted", "pushed_too_hard", "held_by_friction")

    def has_no_answer(self):
        return self.family in ("lifted", "pushed_too_hard")

    # The scene file.

    def block_mesh(self):
        if self.d == 3:
            return {"type": "brick", "width": self.w[0], "depth": self.w[1], "height": self.w[2], "cells x": self.n[0], "cells y": self.n[1],
                    "cells z": self.n[2], "translation": numbers(self.at)}
        c, s = math.cos(math.radians(abs(self.angle))), math.sin(math.radians(abs(self.angle)))
        corners = [(c * x - s * y, s * x + c * y) for x, y in ((0, 0), (self.w[0], 0), (self.w[0], self.w[1]), (0, self.w[1]))]
        if self.angle < 0:  # in the mirror the lower left corner is the lower right one
            corners = [(-x, y) for x, y in (corners[1], corners[0], corners[3], corners[2])]
        return {"type": "block", "corners": numbers(value for corner in corners for value in corner), "cells x": self.n[0], "cells y": self.n[1],
                "translation": numbers(self.at)}

    def base_mesh(self):
        low = [-size / 2 for size in self.W[:-1]] + [-self.W[-1]]
        mesh = {"type": "block", "width": self.W[0], "height": self.W[-1], "cells x": self.N[0], "cells y": self.N[-1], "translation": numbers(low)}
        if self.d == 3:
            mesh.update({"type": "brick", "depth": self.W[1], "cells y": self.N[1], "cells z": self.N[2]})
        return mesh

    def to_scene(self):
        axes, up = "xyz"[:self.d], "xyz"[self.d - 1]
        across = [axis for axis in axes if axis != up]
        bodies = {"block": {"material": "block", "element": self.elements[1], "mesh": self.block_mesh()},
                  "base": {"rigid": True, "reference point": numbers([0.0] * self.d), "mesh": self.base_mesh()} if self.rigid else
                          {"material": "base", "element": self.elements[0], "mesh": self.base_mesh()}}
        scene = {"kinematics": "three dimensional" if self.d == 3 else "plane strain",
                 "materials": {name: {"type": self.laws[i], "young's modulus": self.E[i], "poisson's ratio": self.nu[i]} for i, name in enumerate(("base", "block"))},
                 "bodies": bodies}
        skin = "block/bottom"
        top = "block/top"
        if self.angle:
            high = self.at[1] + self.w[0] * math.sin(math.radians(abs(self.angle))) + self.w[1] * math.cos(math.radians(abs(self.angle)))
            middle = (high + self.at[1]) / 2
            scene["sets"] = {"skin": {"of": "block/surface", "kind": "sides", "where": f"{middle!r} - y"},
                             "tip": {"of": "block", "where": f"y - {high - 0.3 * (high - self.at[1])!r}"}}
            skin, top = "skin", "tip"
        slave, master = (skin, "base/top") if self.slave == "block" else ("base/top", skin)
        pair = {"slave": slave, "master": master}
        if self.mu > 0.0:
            pair["friction"] = {"type": "coulomb", "coefficient": self.mu}
        floor = {"set": "base/reference", **{axis: 0.0 for axis in axes}, "rotation": 0.0} if self.rigid else {"set": "base/bottom", **{axis: 0.0 for axis in axes}}
        if self.sides_held:
            floor = {"set": "base/bottom", up: 0.0}
        held = {"set": top, **{axis: 0.0 for axis in across}}
        conditions = {"floor": floor}
        if not self.under_dead_load():
            drag = self.pull != 0.0
            conditions["hand"] = {**held, up: f"-{self.press!r}*{'min(1, 2*t)' if drag else 't'}"}
            if drag:
                conditions["hand"]["x"] = f"{self.pull!r}*max(0, 2*t - 1)"
            if self.sides_held:
                conditions["hand"] = {"set": top, up: conditions["hand"][up]}
                for body in ("base", "block"):
                    for side, axis in (("left", "x"), ("right", "x"), ("front", "y"), ("back", "y"))[:2 * (self.d - 1)]:
                        conditions[f"{body} {side}"] = {"set": f"{body}/{side}", axis: 0.0}
        else:
            if self.pull == 0.0 and self.family != "pushed_too_hard":
                conditions["hand"] = held
            scene["loads"] = {"load": {"type": "dead traction", "set": top, up: f"-({self.press!r})*t", **({"x": f"{self.pull!r}*t"} if self.pull else {})}}
        scene["boundary conditions"] = conditions
        scene["contact"] = {"c": pair}
        scene["stepping"] = {"step": f"1/{self.steps}"}
        scene["output"] = {"fields": ""}
        at = "base/reference" if self.rigid else "base/bottom"
        scene["quantities"] = {
            **{f"f{axis}": {"type": "contact force", "component": axis} for axis in axes},
            **{f"floor_{axis}": {"type": "reaction", "set": at, "component": axis} for axis in axes},
            "peak": {"type": "peak pressure"}, "lowest": {"type": "extremum", "field": "contact pressure", "which": "minimum"},
            "gap": {"type": "extremum", "field": "gap", "which": "minimum"}, "active": {"type": "active count"},
            "imbalance": {"type": "momentum imbalance"}, "energy_error": {"type": "energy error"}, "largest": {"type": "extremum", "field": "displacement magnitude"}}
        return scene
