# What a series of runs on growing numbers of ranks says, in words. A point is an entry of scale.json.
MEMORY_BOUND = 0.85  # a phase whose efficiency is at least this share of the memory's uses what there is


def value(number, digits=3):
    return "–" if number is None else f"{number:.{digits}g}"


def lost_seconds(point):
    """Of each phase: what it took more than the phase would with full efficiency."""
    return {name: phase["seconds"] * (1 - phase["efficiency"]) for name, phase in point["phases"].items() if phase["efficiency"] is not None}


def limit_of(point):
    """The phase that lost most, its lost seconds, and their share of all that were lost; None if none was."""
    lost = {name: seconds for name, seconds in lost_seconds(point).items() if seconds > 0}
    if not lost:
        return None
    name = max(lost, key=lost.get)
    return name, lost[name], lost[name] / sum(lost.values())


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
    if first is last:
        return [f"Only one rank was measured, {value(first['seconds'])} s: there is nothing to compare."]
    well = [point["ranks"] for point in done if point["efficiency"] >= 0.5][-1]
    if name == "strong":
        best = min(done, key=lambda point: point["seconds"])
        speed = first["seconds"] / last["seconds"]
        compared = f"{value(speed)} times as fast" if speed >= 1 else f"{value(1 / speed)} times as long"
        words = [f"<b>Strong scaling:</b> {last['ranks']} ranks take {value(last['seconds'])} s, one takes {value(first['seconds'])} s: {compared}, "
                 f"an efficiency of {value(last['efficiency'], 2)}."]
        if best is first:
            words.append("More than one rank does not pay.")
        elif best is not last:
            words.append(f"The fastest run has {best['ranks']} ranks, {value(best['seconds'])} s.")
    else:
        words = [f"<b>Weak scaling:</b> {last['ranks']} ranks take {value(last['seconds'])} s for {value(last['dofs'], 9)} unknowns, one takes "
                 f"{value(first['seconds'])} s for {value(first['dofs'], 9)}: an efficiency of {value(last['efficiency'], 2)}."]
    words.append(f"The efficiency is at least 0.5 up to {well} rank{'s' if well > 1 else ''}.")
    limit = limit_of(last)
    if limit:
        phase, seconds, share = limit
        words.append(f"What limits it is the {escaped(phase)}, with {value(seconds)} s or {100 * share:.0f} % of the time that is lost: "
                     f"{cause(phase, last, first)}.")
    return words
