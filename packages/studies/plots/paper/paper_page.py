# The page.
HERTZ = ["hertz_elastic", "hertz_elastic_frictionless", "hertz_elastic_as_printed", "hertz_elastic_as_printed_frictionless"]
EXAMPLES = [  # title, names of runs, section
    ("4.1 Patch test", ["patch_test", "patch_test_plastic"], patch_test),
    ("4.1 Block pile", ["block_pile", "block_pile_axisymmetric"], block_pile),
    ("4.2.1 Hertz problem, elastic", HERTZ, hertz_elastic),
    ("4.2.2 Hertz problem, plastic", list(FORMS), hertz_plastic),
    ("4.3 Conical extrusion", ["conical_extrusion"], extrusion)]

# One item each between blank lines.
OPEN = """
The paper's figures are lost to us: its text and tables are what stands beside ours. Geometry that only a figure gave is ours.

Table 1 lists E, ν and G, and for all three materials G contradicts the other two. Taken: E and ν. “ε” in the hardening laws is taken as the
accumulated equivalent plastic strain, their coefficients in MPa. The slope of the extrusion's aluminium is G/100 with the listed G.

Patch test: “a point load of 7.2 kN on each node at the top” cannot give a uniform stress with equal cells: end nodes carry one cell, inner
nodes two. Ours: half the force on the two end nodes. Blocks of 40 × 20 mm, meshes 5 × 3 on 7 × 3. The thickness is not given: 2 mm in the
elastic form, 0.75 mm in the plastic one, because with 1 mm (900 MPa) the von Mises stress of plane strain stays below the yield stress of
830 MPa.

Block pile: sizes, number of blocks and meshes are ours (four blocks, 40 × 25 mm). “Meant to behave as an axisymmetric bar”: plane strain
and axisymmetric are both computed.

Hertz, elastic: radius and block are ours (R = 50 mm, block 100 × 100 mm). Both printed results fix E*/R alone: R = 50 mm with 1000 times
the cylinder's modulus meets them, and so would R = 37.56 mm with the stated ones. “Only elastic strains will manifest” at 5 kN: with the
stated data the block first yields at about 1.2 kN/mm. A “maximal equivalent stress” of “327 kN/mm²” exceeds Young's modulus; the unit must
be another one.

Hertz, plastic: see there.

Extrusion: the billet is that of Simo and Laursen (1992), radius 50.8 mm, length 254 mm, 5 × 16 elements. The largest plastic strain sits at
a corner where it grows without bound on finer meshes, so that it can only be compared on this one.

Steps, tolerances and what the relative residual is relative to are given nowhere but for the 200 increments of the plastic Hertz problem.
"""


def section(title, names, contents):
    """The page: findings of the paper, endings of runs, figures, tables."""
    asked = [runs[name] for base in names for name in (base, base + RIVAL) if name in runs]
    if not asked:
        return []
    said, *parts = contents()
    images = [part for part in parts if part.startswith("<figure")]
    return [f"<section><h2>{escaped(title)}</h2>", said, *map(missed, asked), figures(images), *[part for part in parts if part not in images], "</section>"]


def page():
    found = judged()
    parts = answer_of(found)
    picture = differences(found)
    if picture:
        parts.append(figures([html_figure(picture, "Ours against the paper", f"differences to its printed numbers; grey: met, within {100 * NEAR:.0f} %")]))
    parts.append(paragraph("T. Doca, F. M. Andrade Pires, J. M. A. César de Sá, <i>A dual mortar-based contact formulation applied to finite",
                           f"plastic strains</i>, COMPLAS XI, 2011: every example, computed by Mortise {escaped(record['version'])} on",
                           f"{record['ranks']} MPI rank(s). Units mm, N, MPa. “–” is a number that the paper does not state, or that a scene does",
                           "not compute. Its “Lagrange” is node to segment here."))
    for example in EXAMPLES:
        parts += section(*example)
    if found:
        parts.append(f"<section><h2>All results</h2>{table_of(found)}</section>")
    parts += ["<section><h2>Runs</h2>", overview(runs.values()), commands(runs.values()), "</section>"]
    parts += ["<section><h2>What the paper leaves open</h2>", items(map(escaped, OPEN.strip().split("\n\n"))), "</section>"]
    return html_page("The examples of the paper, by Mortise", parts)


write_page(os.path.join(directory, "paper.html"), page())
