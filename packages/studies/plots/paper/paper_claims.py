# Statements of the paper, number by number and finding by finding, and whether our runs meet them.
NEAR = 0.05  # of a printed number
NOTHING = 1e-9  # of what has to vanish

# Why a result is not met, where that is known.
MODULI = "the printed numbers do not follow from the stated moduli and any round radius"
FRICTION = "Hertz knows no friction, which hinders bodies of different stiffness from spreading"
TABLE_TWO = "Table 2 belongs to a practically rigid cylinder on a practically elastic block, not to the stated materials"
MEASURED = "the paper does not say what it measured"
FIRST = "contact is found from one touching node, which bears the whole load at first"
YIELDING = "the block's yielding keeps the pressure below what steel bears"
STRAIGHT = "the wall is straight and smooth, so that nodes have little to catch on"


class Claim:
    """One result of the paper beside ours. of: what to compute of the run, None if it is not there; met: whether that agrees with the paper; paper: its
    printed number, None for a finding in words; reason: why a miss is expected."""

    def __init__(self, run, what, of, met, said, paper=None, reason=""):
        self.run, self.what, self.of, self.met, self.said, self.paper, self.reason = run, what, of, met, said, paper, reason

    def verdict(self, ours):
        """met, expected (to be missed), missed."""
        return "met" if self.met(ours) else "expected" if self.reason else "missed"


def printed(run, what, name, paper, reason=""):
    """A number that the paper prints. name: our quantity, or a function of the run."""
    of = name if callable(name) else lambda one: one.quantity(name)
    return Claim(run, what, of, lambda ours: abs(ours / paper - 1) <= NEAR, repr(paper), paper, reason)


def vanishes(run, what, name, said):
    return Claim(run, what, lambda one: one.quantity(name), lambda ours: abs(ours) <= NOTHING, said)


def at_least(run, what, name, bound, said, reason=""):
    of = name if callable(name) else lambda one: one.quantity(name)
    return Claim(run, what, of, lambda ours: ours >= bound, said, reason=reason)


def at_most(run, what, of, bound, said, reason=""):
    return Claim(run, what, of, lambda ours: ours <= bound, said, reason=reason)


def iterations_of(increment):
    def of(run):
        residuals = run.residuals(run.history["time"][-1] * increment / INCREMENTS)
        return len(residuals) - 1 if residuals else None
    return of


def claims():
    found = []
    for name in ("patch_test", "patch_test_plastic"):
        found += [vanishes(name, "deviation of stresses", "stress_spread", "constant stress"),
                  at_least(name + RIVAL, "deviation of stresses", "stress_spread", 0.01, "uneven stress")]
    for name in ("block_pile", "block_pile_axisymmetric"):
        found += [vanishes(name, "deviation of stresses", "stress_spread", "uniform stress"),
                  vanishes(name, "difference of corners / mm", "lateral_spread", "blocks deform alike"),
                  at_least(name + RIVAL, "difference of corners / mm", "lateral_spread", 1.0, "corner nodes slip off")]
    for name, reason, less in (("hertz_elastic", MODULI, MODULI), ("hertz_elastic_frictionless", MODULI, MODULI),
                               ("hertz_elastic_as_printed", FRICTION, ""), ("hertz_elastic_as_printed_frictionless", "", "")):
        found += [printed(name, "largest pressure / MPa", "peak_pressure", 1577.32, reason), printed(name, "half width / mm", "half_width", 2.018, less)]
    for name in ("hertz_elastic", "hertz_elastic_as_printed", "hertz_plastic", "hertz_plastic_as_printed"):
        found.append(at_least(name + RIVAL, "oscillation of the pressure", "oscillation", 0.1, "pressures oscillate"))
    for name, reasons in (("hertz_plastic", [TABLE_TWO] * 5), ("hertz_plastic_as_printed", ["", "", MEASURED, "", ""])):
        for i, ((what, (paper, _)), reason) in enumerate(zip(PAPER_TWO.items(), reasons)):
            found.append(printed(name, what, lambda run, i=i: indentation(run)[i], paper, reason))
        for increment in PAPER_RESIDUALS:
            found.append(at_most(name, f"Newton iterations, increment {increment}", iterations_of(increment), 3, "3", FIRST if increment == 1 else ""))
    found.append(at_least("hertz_plastic", "plastic strain in the cylinder", "peak_plastic_strain_cylinder", 1e-6, "plastic strain on both sides", YIELDING))
    found += [printed("conical_extrusion", "largest plastic strain", "peak_equivalent_plastic_strain", 1.39),
              printed("conical_extrusion", "contact length / mm", "contact_length", 257.33, MEASURED),
              at_least("conical_extrusion" + RIVAL, "roughness of the friction force over dual mortar's",
                       lambda run: relative_roughness(run, runs.get("conical_extrusion")), 2.0, "oscillates with nodes on segments", STRAIGHT)]
    return found


def relative_roughness(run, other):
    if other is None or not other.complete:
        return None
    ours, theirs = roughness(run.history, "friction_force"), roughness(other.history, "friction_force")
    return ours / theirs if known(ours) and known(theirs) and theirs > 0 else None


def judged():
    """(claim, ours, verdict) of all that was asked for; "unknown" of runs that did not come to their end."""
    found = []
    for claim in claims():
        if claim.run in runs:
            run = runs[claim.run]
            ours = claim.of(run) if run.complete else None
            found.append((claim, ours, claim.verdict(ours) if known(ours) else "unknown"))
    return found


VERDICTS = {"met": "met", "expected": "missed, as expected", "missed": "<b>missed</b>", "unknown": "<b>no result</b>"}


def count_of(verdicts):
    """"12 of 20 results of the paper are met, 8 are missed as expected"."""
    of = {name: verdicts.count(name) for name in VERDICTS}
    text = f"{of['met']} of {len(verdicts)} results of the paper are met, {of['expected']} are missed for a known reason"
    if of["missed"]:
        text += f", <b>{of['missed']} without one</b>"
    if of["unknown"]:
        text += f", <b>{of['unknown']} have no result, as runs failed</b>"
    return text + "."


def without_unit(what):
    return what.split(" / ")[0]


def of_runs(missed_ones):
    """"run: result, result; run: result"."""
    names = dict.fromkeys(claim.run for claim in missed_ones)
    results = lambda name: ", ".join(escaped(without_unit(claim.what)) for claim in missed_ones if claim.run == name)
    return "; ".join(f"{escaped(name)}: {results(name)}" for name in names)


def answer_of(found):
    if not found:
        return []
    open_ones = of_runs([claim for claim, _, verdict in found if verdict == "missed"])
    lines = [f"<b>without a known reason</b>: {open_ones}"] if open_ones else []
    expected = [claim for claim, _, verdict in found if verdict == "expected"]
    for reason in dict.fromkeys(claim.reason for claim in expected):
        lines.append(f"{escaped(reason)}: {of_runs([claim for claim in expected if claim.reason == reason])}")
    return ['<section class="answer">', paragraph(f"<b>{count_of([verdict for *_, verdict in found])}</b>"),
            *([paragraph("Missed:"), items(lines)] if lines else []),
            paragraph(f"A printed number is met within {100 * NEAR:.0f} %, as meshes and steps of the paper are not known; a stress is constant, and blocks "
                      f"deform alike, within {NOTHING:g}."), "</section>"]


def differences(found):
    """Printed numbers: our difference in percent; None without any."""
    shown = [(claim, 100 * (ours / claim.paper - 1), verdict) for claim, ours, verdict in found if claim.paper is not None and known(ours)]
    if not shown:
        return None
    heads = len({claim.run for claim, *_ in shown})
    figure, axes = one_panel("difference to the printed numbers", 1.2 + 0.5 * len(shown) + 0.3 * heads)
    figure.subplots_adjust(left=0.2 / WIDTH, right=1 - 0.2 / WIDTH)
    most, row, last = 40.0, 0.0, None
    axes.axvspan(-100 * NEAR, 100 * NEAR, color="#DDDDDD", zorder=0)
    axes.axvline(0, color="black", linewidth=0.8)
    colour, marker = FORMULATIONS["dual mortar"]
    labels = set()
    for claim, percent, verdict in shown:
        if claim.run != last:
            row += 0.6
            axes.annotate(plain(claim.run), (-most, row - 0.55), va="bottom", weight="bold", annotation_clip=False)
            last = claim.run
        kind = {"met": "met", "expected": "missed, as expected", "missed": "missed"}[verdict]
        at = min(max(percent, -most), most)
        axes.plot(at, row, color=colour, linestyle="none", marker=marker if abs(percent) <= most else "<" if percent < 0 else ">", markersize=8,
                  fillstyle="full" if verdict == "met" else "none", markeredgecolor=colour if verdict != "missed" else "#D55E00",
                  label=None if kind in labels else kind)
        labels.add(kind)
        axes.annotate(plain(f"{without_unit(claim.what)}: {percent:+.1f} %"), (-most, row - 0.16), va="bottom", annotation_clip=False)
        row += 1
    axes.set_yticks([])
    axes.set_xlim(-most - 3, most + 3)
    axes.set_ylim(row - 0.6, -0.3)
    axes.grid(False, axis="y")
    axes.set_xlabel("difference / %")
    legend_below(axes)
    return figure


def table_of(found):
    reason = lambda claim, verdict: f": {escaped(claim.reason)}" if verdict == "expected" else ""
    rows = [[escaped(claim.run), escaped(claim.what), number(ours, 4), escaped(claim.said), difference(ours, claim.paper),
             VERDICTS[verdict] + reason(claim, verdict)] for claim, ours, verdict in found]
    return html_table(["run", "result", "ours", "paper", "difference", "verdict"], rows, "What the paper states, and what we find", [1, 3, 5])
