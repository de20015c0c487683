# Colours of values: which map a field has, its range, and the bar that shows both.
import numpy as np
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap, Normalize

STATES = {"contact_state": ["open", "stick", "slip"]}  # names of whole numbers
WHOLE = ["#BBBBBB", "#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442"]  # Okabe and Ito's, grey first
ROUND_OFF = 1e-9  # of the largest value: a sign below it is none


class Colours:
    """The map from values to colours, with its range [low, high]: the extreme values that are drawn."""

    def __init__(self, low, high):
        self.low, self.high = float(low), float(high)
        size = max(abs(self.low), abs(self.high))
        if self.low < -ROUND_OFF * size and self.high > ROUND_OFF * size:
            # Both signs: grey is 0, and equal sizes are equally strong. The bar has the part of the map between the extremes.
            full = matplotlib.colormaps["coolwarm"]
            ends = np.linspace(0.5 + 0.5 * self.low / size, 0.5 + 0.5 * self.high / size, 256)
            self.map = LinearSegmentedColormap.from_list("signed", full(ends))
        else:
            self.map = matplotlib.colormaps["viridis_r" if self.low < -ROUND_OFF * size else "viridis"]
        # One value everywhere has the middle of the map.
        width = self.high - self.low
        pad = 0.0 if width > 1e-12 * size else max(0.5 * size, 0.5)
        self.norm = Normalize(self.low - pad, self.high + pad)

    def __call__(self, values):
        return self.map(self.norm(values))[..., :3]

    def ticks(self):
        """The extremes, and round values between them that stand clear of them, with their texts."""
        width = self.high - self.low
        if self.norm.vmax - self.norm.vmin > width:
            return [self.low], [number(self.low)]
        between = [one for one in MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]).tick_values(self.low, self.high)
                   if self.low + 0.09 * width < one < self.high - 0.09 * width]
        between = [0.0 if abs(one) < 1e-9 * width else one for one in between]
        values = [self.low, *between, self.high]
        return values, [number(one) for one in values]


class WholeColours:
    """Colours of whole numbers, as a contact state or the index of a body."""

    def __init__(self, values, names):
        self.values, self.names = [int(one) for one in values], names
        self.low, self.high = float(min(self.values)), float(max(self.values))
        self.map = ListedColormap([WHOLE[one % len(WHOLE)] for one in self.values])
        self.norm = BoundaryNorm(np.arange(len(self.values) + 1) - 0.5, len(self.values))

    def __call__(self, values):
        place = np.searchsorted(self.values, np.rint(values)).clip(0, len(self.values) - 1)
        return self.map(place)[..., :3]

    def ticks(self):
        names = [self.names[one] if 0 <= one < len(self.names) else str(one) for one in self.values]
        return list(range(len(self.values))), [plain(shortened(one, 18)) for one in names]


def number(value):
    """Four digits, as many as a reader can compare."""
    return f"{value:.4g}".replace("-", "−")


def shortened(text, length):
    return text if len(text) <= length else text[: length - 1] + "…"
