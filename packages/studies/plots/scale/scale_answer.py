# Conclusions of a series of runs on growing numbers of ranks, in words. A point is an entry of scale.json.
MEMORY_BOUND = 0.85  # a phase whose efficiency is at least this share of the memory's uses what there is
SHORT, ENOUGH = 1.0, 3  # seconds below which a run is within the noise of a machine, unless so many repeats tell how large that is


def value(number, digits=3):
    return "–" if number is None else f"{number:.{digits}g}"


def lost_seconds(point):
    """Of each phase: what it took more than the phase would with full efficiency."""
    return {name: phase["seconds"] * (1 - phase["efficiency"]) for name, phase in point["phases"].items() if phase["efficiency"] is not None}


def limit_of(point):
    """The phase that lost most, its lost seconds, and those of the whole run, to which other phases may add or from which they take; None if none was."""
    lost, total = lost_seconds(point), point["seconds"] * (1 - point["efficiency"])
    name = max(lost, key=lost.get, default=None)
    return (name, lost[name], total) if lost and lost[name] > 0 and total > 0 else None


def middle(point):
    """Seconds of the middle one of the repeats; of an even number, the slower of the two."""
    return sorted(point["repeats"])[len(point["repeats"]) // 2]


def spread(points):
    """Excess of the middle repeat of a point over the fastest, which counts; one slow repeat does not matter."""
    return max(middle(point) - point["seconds"] for point in points)


def digits_of(points):
    """As many as repeats agree in; two if there are none."""
    if any(len(point["repeats"]) < 2 for point in points):
        return 2
    relative = max(spread([point]) / point["seconds"] for point in points)
    return 3 if relative < 0.01 else 2 if relative < 0.1 else 1


def rounded(number, digits):
    """Without an exponent, which few digits of a large number would have."""
    return f"{float(f'{number:.{digits}g}'):.9g}"


def why_noise(points, lost):
    """Why so many seconds lost between these points mean nothing; empty if they do."""
    if any(point["seconds"] < SHORT and len(point["repeats"]) < ENOUGH for point in points):
        return f"Runs below {SHORT:g} s with fewer than {ENOUGH} repeats are within the noise of the machine."
    if spread(points) >= lost:
        return f"That is within the noise of the machine: the middle repeat takes up to {rounded(spread(points), 2)} s more than the fastest."
    return ""


def limit_words(first, last):
    """Limit of a series, as far as its times tell."""
    limit = limit_of(last)
    noise = why_noise([first, last], limit[1] if limit else np.inf)
    advice = f" {noise} Measure with a larger <code>--repeats</code>, or a larger scene, before you trust these times." if noise else ""
    if not limit:
        return advice.strip()
    phase, lost, total = limit
    digits = 1 if noise else digits_of([first, last])
    share = f"{rounded(lost, digits)} s of the {rounded(total, digits)} s that the run loses" if lost <= total else \
        f"{rounded(lost, digits)} s; the run loses {rounded(total, digits)} s, as other phases gain"
    if noise:
        return f"Most seems to be lost in the {escaped(phase)}, {share}.{advice}"
    if lost <= total:
        share += f" ({rounded(100 * lost / total, min(digits, 2))} %)"
    return f"What limits it is the {escaped(phase)}, with {share}: {cause(phase, last, first)}."


def not_grown(series):
    """Points of a weak series that have no more unknowns than the first, and so no efficiency."""
    done = [point for point in series if point["finished"]]
    return [point for point in done if point["series"] == "weak" and done[0]["ranks"] == 1 and point["efficiency"] is None]


def growth_words(series):
    """That these points are no weak scaling; empty if all have grown."""
    flat = not_grown(series)
    if not flat:
        return ""
    ranks = ", ".join(str(point["ranks"]) for point in flat)
    return f"The number of unknowns did not grow with the ranks: it is {value(flat[-1]['dofs'], 9)} on {ranks} ranks, not more than on one. This is no weak scaling, " \
           "and no efficiency is given."


def cause(name, point, first):
    """Why a phase lost time, as far as what was measured tells it."""
    efficiency, memory = point["phases"][name]["efficiency"], point["bandwidth_efficiency"]
    if name in ("solver set-up", "solution") and not first["linear_iterations"] and point["linear_iterations"]:
        return "the linear solver is direct on one rank and iterative here"
    if name in ("solver set-up", "solution") and point["linear_iterations"] > 1.1 * first["linear_iterations"]:
        return f"the linear solver takes {point['linear_iterations']:.0f} iterations instead of {first['linear_iterations']:.0f}"
    if name in ("search", "integrals") and point["contact_imbalance"] > 1.2:
        return f"the rank with most contact has {point['contact_imbalance']:.2f} times the mean work"
    if memory is None:
        return f"its efficiency is {value(efficiency, 2)}"
    if efficiency >= MEMORY_BOUND * memory:
        return f"its efficiency of {value(efficiency, 2)} is what the memory serves so many ranks with ({value(memory, 2)})"
    return f"its efficiency of {value(efficiency, 2)} is below that of the memory ({value(memory, 2)}), which is not the cause"


def series_words(series):
    """Sentences on one series: how far it scales and what limits it."""
    done = [point for point in series if point["finished"] and point["efficiency"] is not None]
    if not done or done[0]["ranks"] != 1:
        return ["The run on one rank did not come to its end: there is nothing to compare with."]
    first, last, name = done[0], done[-1], done[0]["series"]
    growth = growth_words(series)
    if first is last and growth:
        return [f"<b>Weak scaling:</b> {growth[0].lower()}{growth[1:]}"]
    if first is last:
        return [f"Only one rank was measured, {value(first['seconds'])} s: there is nothing to compare."]
    digits = digits_of([first, last])
    seconds = lambda point: rounded(point["seconds"], digits)
    efficiency = f"an efficiency of {rounded(last['efficiency'], min(digits, 2))}"
    well = [point["ranks"] for point in done if point["efficiency"] >= 0.5][-1]
    if name == "strong":
        best = min(done, key=lambda point: point["seconds"])
        speed = first["seconds"] / last["seconds"]
        ratio = rounded(max(speed, 1 / speed), digits)
        compared = "as long" if ratio == "1" else f"{ratio} times as {'fast' if speed >= 1 else 'long'}"
        words = [f"<b>Strong scaling:</b> {last['ranks']} ranks take {seconds(last)} s, one takes {seconds(first)} s: {compared}, "
                 f"{efficiency}."]
        if best is first:
            words.append("More than one rank does not pay.")
        elif best is not last:
            words.append(f"The fastest run has {best['ranks']} ranks, {seconds(best)} s.")
    else:
        words = [f"<b>Weak scaling:</b> {last['ranks']} ranks take {seconds(last)} s for {value(last['dofs'], 9)} unknowns, one takes "
                 f"{seconds(first)} s for {value(first['dofs'], 9)}: {efficiency}."]
    words.append(f"The efficiency is at least 0.5 up to {well} rank{'s' if well > 1 else ''}.")
    return words + [one for one in (limit_words(first, last), growth) if one]
