# Triangles become pixels: the nearest one to the eye at each pixel, found in a depth buffer. So bodies hide one another rightly, whatever their order.
import numpy as np

FRAGMENTS = 1 << 22  # pixels of bounding boxes that are looked at in one go


def nearest(xy, depth, width, height, limit=None):
    """The triangle at each pixel, -1 where there is none, and its depth. xy [triangles x 3 x 2] in pixels, depth [triangles x 3] toward the eye.

    A pixel belongs to the triangles that its centre lies in. Its depth is linear between the corners. With `limit`, depths [height x width], only
    what is nearer counts.
    """
    buffer = np.full(width * height, -np.inf) if limit is None else limit.ravel().copy()
    winner = np.full(width * height, -1, dtype=np.int64)
    low = np.floor(xy.min(axis=1) - 0.5).astype(np.int64).clip(0, [width, height])
    high = np.ceil(xy.max(axis=1) + 0.5).astype(np.int64).clip(0, [width, height])
    size = high - low
    area = signed_area(xy)
    seen = np.flatnonzero((size > 0).all(axis=1) & (np.abs(area) > 0))
    # Boxes of about the same size are looked at together.
    bucket = np.ceil(np.log2(size[seen].max(axis=1))).astype(int) if len(seen) else np.zeros(0, dtype=int)
    for power in np.unique(bucket):
        group, side = seen[bucket == power], 1 << int(power)
        count = max(1, FRAGMENTS // side**2)
        for start in range(0, len(group), count):
            _fill(group[start : start + count], side, xy, depth, area, low, high, width, buffer, winner)
    return winner.reshape(height, width), buffer.reshape(height, width)


def _fill(chosen, side, xy, depth, area, low, high, width, buffer, winner):
    columns = int((high - low)[chosen, 0].max())
    rows = int((high - low)[chosen, 1].max())
    x = low[chosen, 0][:, None, None] + np.arange(min(side, columns))[None, None, :]
    y = low[chosen, 1][:, None, None] + np.arange(min(side, rows))[None, :, None]
    corner = xy[chosen][:, :, :, None, None]
    px, py = x + 0.5, y + 0.5
    weights = []
    for k in range(3):
        a, b = corner[:, (k + 1) % 3], corner[:, (k + 2) % 3]
        weights.append(((b[:, 0] - a[:, 0]) * (py - a[:, 1]) - (b[:, 1] - a[:, 1]) * (px - a[:, 0])) / area[chosen][:, None, None])
    inside = (weights[0] >= -1e-9) & (weights[1] >= -1e-9) & (weights[2] >= -1e-9)
    inside &= (x < high[chosen, 0][:, None, None]) & (y < high[chosen, 1][:, None, None])
    z = sum(w * depth[chosen, k][:, None, None] for k, w in enumerate(weights))[inside]
    pixel = np.broadcast_to(y * width + x, inside.shape)[inside]
    triangle = np.broadcast_to(chosen[:, None, None], inside.shape)[inside]
    # Those that are nearer than before; of several in one pixel the nearest is written last.
    nearer = z > buffer[pixel]
    pixel, triangle, z = pixel[nearer], triangle[nearer], z[nearer]
    order = np.argsort(z, kind="stable")
    buffer[pixel[order]] = z[order]
    winner[pixel[order]] = triangle[order]


def signed_area(xy):
    """Twice the area of triangles, above 0 where the corners run from x to y."""
    a, b = xy[:, 1] - xy[:, 0], xy[:, 2] - xy[:, 0]
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def barycentric(xy, x, y):
    """Weights of the corners [points x 3] of triangles xy [points x 3 x 2] at points."""
    area = signed_area(xy)
    weights = []
    for k in range(3):
        a, b = xy[:, (k + 1) % 3], xy[:, (k + 2) % 3]
        weights.append(((b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (b[:, 1] - a[:, 1]) * (x - a[:, 0])) / area)
    return np.stack(weights, axis=1)


def averaged(image, factor):
    """The mean of each factor x factor pixels."""
    height, width, channels = image.shape
    return image.reshape(height // factor, factor, width // factor, factor, channels).mean(axis=(1, 3))
