# From where a model is looked at, and by how much its displacements are enlarged.
import numpy as np

EYES = {"iso": (-1.0, -1.7, 1.1), "x": (1, 0, 0), "-x": (-1, 0, 0), "y": (0, 1, 0), "-y": (0, -1, 0), "z": (0, 0, 1), "-z": (0, 0, -1)}


def eye_of(view):
    """The direction from the model to the eye of "iso", "-y", ... or "1,-2,1"."""
    if view in EYES:
        return np.array(EYES[view], dtype=float)
    return np.array([float(one) for one in view.split(",")])


def eye_toward(normal):
    """The isometric direction that sees a surface with this mean normal from outside; where the normal does not decide, it stays."""
    eye = eye_of("iso")
    strong = np.abs(normal) > 0.2
    return np.where(strong, np.abs(eye) * np.sign(normal), eye)


class Camera:
    """A parallel projection: right and up in the picture, and toward the eye. z stands upright; seen along z it is y."""

    def __init__(self, eye):
        self.eye = eye / np.linalg.norm(eye)
        upright = np.array([0.0, 0.0, 1.0]) if abs(self.eye[2]) < 0.999 else np.array([0.0, 1.0, 0.0])
        right = np.cross(upright, self.eye)
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.eye, self.right)
        self.axes = np.stack([self.right, self.up, self.eye], axis=1)

    def __call__(self, x):
        """Right, up, depth [points x 3] of points."""
        return x @ self.axes


PLANE = np.array([0.0, 0.0, 1.0])  # the eye of plane models: x to the right, y up

VISIBLE = 0.02  # of the size of the model: displacements from here on are drawn as they are
AIM = 0.05  # what smaller ones are enlarged to


def warp_for(largest, size):
    """1 if a displacement shows in a model of this size; else the factor 1, 2 or 5 times a power of ten that makes it show."""
    if largest >= VISIBLE * size or largest <= 1e-12 * size:
        return 1.0
    wanted = AIM * size / largest
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(one for one in (1, 2, 5) if one <= wanted / power * (1 + 1e-9)))
