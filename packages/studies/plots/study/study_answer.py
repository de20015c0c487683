# Conclusions of a study, in words, from what study.json holds.
ROUND_OFF = 1e-10  # relative errors up to this are what Newton's method leaves


def percent(error):
    return f"{100 * error:g} %"


def cell(value, digits=3):
    return "–" if not known(value) else f"{value:.{digits}g}"


def in_percent(error):
    return "–" if not known(error) else "round-off" if error <= ROUND_OFF else f"{100 * error:.2g} %"


def has_errors(error):
    """True if there is anything to draw: errors that are more than round-off."""
    return error["exact"] is None and any(map(known, error["error"]))


def cheapest_within(error, target, points):
    """"within 1 %: Q4, n = 8, 0.52 s (error 0.4 %)"; None if nothing counts."""
    found = target["cheapest"]
    if not found:
        return None
    point = points[found["point"]]
    unsure = "" if found["confirmed"] else ", <i>not confirmed by a finer run</i>"
    return (f"within {percent(target['error'])}: <b>{escaped(point['label'])}</b>, {cell(point['wall_s'])} s "
            f"(error {in_percent(error['error'][found['point']])}){unsure}")


def cheapest_of(error, points):
    """The cheapest runs for the bounds of one error, or how near the best run comes."""
    reached = [(one, i) for i, one in enumerate(error["error"]) if known(one)]
    if not reached:
        return "no errors are known."
    fastest = error["exact"]
    if fastest is not None:
        return f"all runs are exact but for round-off; the fastest is <b>{escaped(points[fastest]['label'])}</b>, {cell(points[fastest]['wall_s'])} s."
    found = [cheapest_within(error, target, points) for target in error["targets"]]
    text = "; ".join(one for one in found if one)
    none = [target for target, one in zip(error["targets"], found) if not one]
    if none:
        least, i = min(reached)
        crossing = ", but finer runs of its family are not as good" if any(least <= target["error"] for target in none) else ""
        text += f"{'; ' if text else ''}within {' or '.join(percent(target['error']) for target in none)}: none; the smallest error is {in_percent(least)} " \
                f"({escaped(points[i]['label'])}, {cell(points[i]['wall_s'])} s{crossing})"
    return text + "."


def winners(errors, points, curves):
    """Curves by how many of the bounds they are the cheapest for, those that are it most often; of how many bounds."""
    family = {i: curve["name"] for curve in curves for i in curve["points"]}
    found = [family[target["cheapest"]["point"]] for error in errors for target in error["targets"]
             if target["cheapest"] and target["cheapest"]["confirmed"]]
    most = max((found.count(name) for name in found), default=0)
    return [name for name in dict.fromkeys(found) if found.count(name) == most], most, len(found)


def summary_of(study):
    """The first sentence."""
    names, most, count = winners(study["errors"], study["points"], study["curves"])
    if not names:
        return "No run is confirmed to be within any of the bounds."
    listed = " and ".join(f"<b>{escaped(name)}</b>" for name in names)
    if len(names) == 1 and most == count:
        return f"{listed} is the cheapest within every bound that a run is confirmed to meet ({count})."
    each = "each " if len(names) > 1 else ""
    return f"{listed} {'are' if each else 'is'} {each}the cheapest for {most} of the {count} bounds that a run is confirmed to meet."


def order_words(error, index):
    """"order 1.00", or why there is none."""
    order = error["orders"][index]
    return f"order {order:.2f}" if order is not None else f"no order: {error['no_order'][index]}"


RULE = ("A run counts as within a bound only if all finer runs of its family are within it too, as an error that changes its sign passes through nothing. "
        "The finest run of a family has no finer one: it counts only where no confirmed run does, and is marked as not confirmed. "
        "Where all runs are exact but for round-off, the fastest of them meets every bound.")
