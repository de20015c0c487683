"""The page of the ordinary parts: its table and what stands around it."""


def shown(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)


ROWS = [("reaction", "reaction, N"), ("mean_displacement", "mean displacement, mm"), ("von_mises", "largest von Mises stress, MPa"),
        ("plastic_strain", "largest plastic strain"), ("pressure", "largest contact pressure, MPa"), ("largest_push", "largest reaction on the way, N"),
        ("largest_pull", "smallest reaction on the way, N"), ("largest_displacement", "largest mean displacement on the way, mm"),
        ("drawn", "force at the ear, N"), ("thrust", "thrust across the plane of symmetry, N"),
        ("largest_thrust", "largest thrust on the way, N")]


def table(name, ours, theirs):
    """Rows of a part: how the runs went, then what came out; a run that stopped on its way has no results."""
    def went(result):
        if result is None:
            return "not computed"
        end = "" if result["code"] == 0 and result.get("done", True) else f", stops at t = {result['time']:.3g}"
        return f"{result['seconds']:.0f} s, {result['steps']} steps, {result['iterations']} iterations, {result['cutbacks']} cutbacks{end}"

    rows = [[name, f"{ours['dofs']} dofs" if ours and "dofs" in ours else "", went(ours), went(theirs), ""]]
    for key, text in ROWS:
        one, other = ((result or {"quantities": {}})["quantities"].get(key) for result in (ours, theirs))
        if one is None:
            continue
        compared = ours["code"] == 0 and theirs and theirs["done"] and other is not None and other == other
        difference = f"{100 * (one - other) / abs(other):+.2g} %" if compared and other else ""
        rows.append(["", text, shown(one) if ours["code"] == 0 else "-", shown(other) if compared else "-", difference])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


PAGE = """# Ordinary parts

This page shows ten parts as they are drawn and meshed in Gmsh: `inputs/parts/*.geo`. Their scenes, `inputs/parts/*.xml`, name materials, supports and loads,
and the program finds what touches. CalculiX 2.20 computes each on the same mesh. `tests/verification/parts/ordinary_parts.py` makes the meshes, runs both programs
one after the other and writes this page:

    python3 tests/verification/parts/ordinary_parts.py build/release/apps/mortise/mortise ccx results/parts docs/results/ordinary_parts.md

Seconds are user CPU time. Elements are `C3D10`, `CPE6` and `CAX6` there, contact is surface to surface with a penalty, and its stiffness stands in the
script. Increments are no longer than the steps here. Stresses and plastic strains are the largest ones at integration points. Contact pressures are the
largest of a slave node here and of an integration point there: at edges both depend on the mesh.

| part | quantity | Mortise | CalculiX | difference |
|---|---|---|---|---|
ROWS

CAUSES
"""


def write_page(path, rows, causes):
    with open(path, "w", encoding="utf-8") as file:
        file.write(PAGE.replace("ROWS", "\n".join(rows)).replace("CAUSES", causes))
