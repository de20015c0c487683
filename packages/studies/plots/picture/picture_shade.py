# The image of the bodies: faces cut into triangles, seen by a camera, coloured by a field.
import numpy as np

FINE = 2  # pixels of the raster for one of the picture, each way
LINE, OUTLINE = 1.1, 2.2  # half the width of lines between cells, and of outlines, in pixels of the raster
NUDGE = 0.02  # of a pixel, between the depths of bodies that lie in one plane
GHOST = np.array([0.55, 0.55, 0.58])  # of what is seen through


class Triangles:
    """All triangles of some faces at one state: screen coordinates with depth, values of the corners, and the sides of their faces as lines."""

    def __init__(self, all_faces, points, center, values, whole):
        """points: camera coordinates of nodes in pixels [nodes x 3]; values: at nodes or cells."""
        corner, value, self.lines, begin = [], [], [], 0
        body, face = [], []
        for faces in all_faces:
            cut = CUT[faces.shape]
            at = np.einsum("pn,fni->fpi", cut.N, points[faces.nodes])
            if center == "cell":
                of = np.repeat(values[faces.cell][:, None], len(cut.N), axis=1)
            elif whole:
                of = values[faces.nodes][:, cut.N.argmax(axis=1)]
            else:
                of = np.einsum("pn,fn->fp", cut.N, values[faces.nodes])
            corner.append(at[:, cut.triangles].reshape(-1, 3, 3))
            value.append(of[:, cut.triangles].reshape(-1, 3))
            body.append(np.repeat(faces.body, len(cut.triangles)))
            face.append(np.repeat(np.arange(begin, begin + len(at)), len(cut.triangles)))
            self.lines.append(FaceLines(begin, at[:, :, :2], cut, faces.outline))
            begin += len(at)
        join = lambda parts, shape: np.concatenate(parts) if parts else np.zeros(shape, dtype=int)
        self.corner, self.value = join(corner, (0, 3, 3)).astype(float), join(value, (0, 3))
        self.body, self.face = join(body, 0), join(face, 0)
        # Faces of several bodies in one plane, as on planes of symmetry: those of the later body are nearer by next to nothing.
        self.corner[:, :, 2] += NUDGE * self.body[:, None]


class FaceLines:
    """Sides of faces of one shape, numbered from `begin` on, in pixels."""

    def __init__(self, begin, at, cut, outline):
        self.begin, self.end, self.cut, self.at, self.outline = begin, begin + len(at), cut, at, outline
        area = np.abs(signed_area(at[:, cut.triangles].reshape(-1, 3, 2))).reshape(len(at), -1).sum(axis=1) / 2
        rim = at[:, cut.rims]
        length = np.linalg.norm(np.diff(rim, axis=2), axis=3).sum(axis=2)
        # Lines fade out where the one across comes near to a pixel.
        across = area[:, None] / np.maximum(length, 1e-300) * (2 if len(cut.rims) == 3 else 1)
        self.fade = ((across - 4) / 10).clip(0, 1)

    def dark(self, face, x, y):
        """Darkness of each pixel by the lines of its face."""
        face = face - self.begin
        dark = np.zeros(len(face))
        for side, rim in enumerate(self.cut.rims):
            squared = np.full(len(face), np.inf)
            for one, other in zip(rim[:-1], rim[1:]):
                a, b = self.at[:, one], self.at[:, other]
                d = (b - a)[face]
                px, py = x - a[face, 0], y - a[face, 1]
                t = ((px * d[:, 0] + py * d[:, 1]) / np.maximum((d * d).sum(axis=1), 1e-300)).clip(0, 1)
                squared = np.minimum(squared, (px - t * d[:, 0]) ** 2 + (py - t * d[:, 1]) ** 2)
            distance = np.sqrt(squared)
            dark = np.maximum(dark, 0.55 * self.fade[face, side] * (LINE + 0.5 - distance).clip(0, 1))
            dark = np.maximum(dark, np.where(self.outline[face, side], 0.85 * (OUTLINE + 0.5 - distance).clip(0, 1), 0))
        return dark


def shaded(solid, ghost, colours, width, height, plane):
    """RGBA image [height x width x 4], its first row at the top. Ghosts are seen through; where `plane`, there is no light."""
    w, h = FINE * width, FINE * height
    winner, depth = nearest(solid.corner[:, :, :2], solid.corner[:, :, 2], w, h)
    image = np.zeros((h, w, 4))
    seen = winner >= 0
    y, x = np.nonzero(seen)
    which = winner[seen]
    weights = barycentric(solid.corner[which, :, :2], x + 0.5, y + 0.5)
    colour = colours((weights * solid.value[which]).sum(axis=1))
    if not plane:
        colour = colour * _light(solid.corner)[which][:, None]
    dark = _lines(solid, which, x, y)
    image[seen, :3] = colour * (1 - dark)[:, None]
    image[seen, 3] = 1
    if not plane:
        _silhouettes(image, np.where(seen, solid.body[np.maximum(winner, 0)] if len(solid.body) else -1, -1), depth, max(w, h))
    if len(ghost.corner):
        _add_ghosts(image, ghost, depth, w, h)
    # The mean of pixels with the weight of what covers them.
    image[..., :3] *= image[..., 3:]
    mean = averaged(image, FINE)
    mean[..., :3] /= np.maximum(mean[..., 3:], 1e-9)
    return mean[::-1]


def _light(corner):
    n = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    n /= np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300)
    lamp = np.array([-0.35, 0.55, 0.76])
    return 0.72 + 0.28 * np.abs(n @ lamp)


def _lines(triangles, which, x, y):
    """Darkness of each pixel by the lines of its triangle's face. A pixel beside a line may lie in another triangle of the same face."""
    face, dark = triangles.face[which], np.zeros(len(which))
    for lines in triangles.lines:
        here = np.flatnonzero((face >= lines.begin) & (face < lines.end))
        dark[here] = lines.dark(face[here], x[here] + 0.5, y[here] + 0.5)
    return dark


def _silhouettes(image, body, depth, size):
    """Darkens pixels beside another body, or beside what lies far behind."""
    for axis in (0, 1):
        first = [slice(None)] * 2
        second = [slice(None)] * 2
        first[axis], second[axis] = slice(None, -1), slice(1, None)
        first, second = tuple(first), tuple(second)
        jump = np.abs(np.nan_to_num(depth[first], neginf=-1e30) - np.nan_to_num(depth[second], neginf=-1e30)) > 0.03 * size
        edge = (body[first] != body[second]) | jump
        for part in (first, second):
            mark = np.zeros(body.shape, dtype=bool)
            mark[part] = edge
            image[mark & (body >= 0), :3] *= 0.35


def _add_ghosts(image, ghost, depth, w, h):
    """Faces nearer than the solid bodies cover them by a third."""
    winner, _ = nearest(ghost.corner[:, :, :2], ghost.corner[:, :, 2], w, h, depth)
    seen = winner >= 0
    y, x = np.nonzero(seen)
    which = winner[seen]
    dark = _lines(ghost, which, x, y)
    alpha = 0.22 + 0.45 * dark
    colour = GHOST * (1 - 0.6 * dark)[:, None] * _light(ghost.corner)[which][:, None]
    below, cover = image[seen, :3], image[seen, 3]
    total = alpha + cover * (1 - alpha)
    image[seen, :3] = (colour * alpha[:, None] + below * (cover * (1 - alpha))[:, None]) / total[:, None]
    image[seen, 3] = total
