"""The one look of all plots: for print (6.3 inches of text width, vector fonts) and for colour-blind readers (Okabe and Ito's colours, and a dash
pattern of its own for every line, so that nothing hangs on colour alone)."""
import sys

MISSING = 69  # exit code: matplotlib is not here

try:
    import matplotlib
except ImportError:
    sys.exit(MISSING)
matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
DASHES = ["-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (3, 1)), (0, (1, 2))]

# Colour and marker of each formulation, on every page.
FORMULATIONS = {
    "dual mortar": ("#0072B2", "o"), "standard mortar": ("#D55E00", "s"), "variational mortar": ("#56B4E9", "^"), "node to segment": ("#CC79A7", "D"),
    "penalty": ("#E69F00", "v"), "augmented lagrange": ("#009E73", "P"), "CalculiX mortar": ("#000000", "X"),
    "CalculiX surface to surface": ("#777777", "<"), "CalculiX node to surface": ("#AAAAAA", ">")}
OTHER_FORMULATION = ("#7A5C00", "*")

# Timers of the summary, colour and hatch of each phase of a run, on every page. What no timer of these has counted is the rest.
PHASES = {
    "mesh": (["mesh"], "#555555", ""), "search": (["search"], "#56B4E9", ""), "integrals": (["contact_integrals"], "#0072B2", "///"),
    "condensation": (["condensation", "contact_graph", "contact_residual"], "#CC79A7", "\\\\\\"), "bulk": (["bulk", "loads"], "#E69F00", ""),
    "solver set-up": (["linear_setup"], "#D55E00", "..."), "solution": (["linear_solve"], "#009E73", "xxx"), "output": (["output"], "#F0E442", ""),
    "rest": ([], "#BBBBBB", "---")}

plt.style.use("default")  # a file matplotlibrc in the working directory sets nothing
plt.rcParams.update({
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS, linestyle=DASHES),
    "axes.grid": True, "axes.axisbelow": True, "grid.color": "#DDDDDD", "grid.linewidth": 0.6,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 8, "legend.frameon": False,
    "lines.linewidth": 1.5, "figure.dpi": 100, "savefig.dpi": 200, "savefig.bbox": "tight",
    "svg.hashsalt": "mortise", "svg.fonttype": "path",
})


def plain(text):
    """Text as it is: dollars begin no formula, and a legend leaves out no name that begins with _."""
    text = str(text).replace("$", r"\$")
    return " " + text if text.startswith("_") else text


def panels(count, title):
    """A row of so many panels, 6.3 inches wide in all (two of them) or less."""
    figure, axes = plt.subplots(1, count, figsize=(3.15 * count + (1.2 if count == 1 else 0.0), 2.7), squeeze=False, layout="constrained")
    figure.suptitle(plain(title), fontsize=10)
    return figure, list(axes[0])


def save(figure, stem):
    """stem.svg and stem.png, the same bytes for the same data."""
    figure.savefig(stem + ".svg", metadata={"Date": None})
    figure.savefig(stem + ".png", metadata={"Software": None})
