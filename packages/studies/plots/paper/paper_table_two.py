# The plastic Hertz problem: figure 9 and Table 2.
PAPER_TWO = {  # dual mortar, Lagrange
    "displacement of the cylinder / mm": (0.431, 0.433), "displacement of the block / mm": (0.431, 0.432),
    "average deformation of the cylinder / mm": (0.182, 0.184), "average deformation of the block / mm": (0.431, 0.416),
    "contact length / mm": (3.198, 3.178)}
PAPER_RESIDUALS = {  # increment: relative residual norms in percent of dual mortar, of Lagrange
    1: ([0.836091e-2, 0.739726e-6, 0.922262e-10], [0.575085e-1, 0.140132e-4, 0.212436e-6, 0.172358e-10]),
    100: ([0.223108e-3, 0.198341e-7, 0.135704e-11], [0.213476e-1, 0.510660e-4, 0.399832e-9, 0.340939e-12]),
    200: ([0.754524e-4, 0.917062e-8, 0.896271e-12], [0.354716e-1, 0.485938e-3, 0.337746e-6, 0.852251e-11])}
INCREMENTS = 200
FORMS = {"hertz_plastic": "stated data", "hertz_plastic_as_printed": "as-printed modulus, no yield"}


def downward(fields, body, end):
    """Downward displacement of a body's node on the line of symmetry at its upper (end = 1) or lower (-1) end."""
    nodes = fields.nodes_of(body)
    on_line = nodes[np.abs(fields.reference[nodes, 0]) < 1e-9]
    return -fields.displacement[on_line[np.argmax(end * fields.reference[on_line, 1])], 1]


def indentation(run):
    """The first five rows of Table 2. The paper does not say what it measured: taken is the contact point's displacement; the block's deformation is
    that against its fixed bottom, the cylinder's that of its diameter against the contact point."""
    fields = run.fields
    cylinder, block = sorted(np.unique(fields.body), key=lambda body: -fields.reference[fields.nodes_of(body), 1].max())
    tip, surface = downward(fields, cylinder, -1), downward(fields, block, 1)
    return [tip, surface, downward(fields, cylinder, 1) - tip, surface - downward(fields, block, -1), run.quantity("contact_length")]


def headed(found, others):
    """Our runs, the paper's column, our runs with nodes on segments, the paper's column."""
    ours = lambda runs: [f"ours, {method_of(run)}, {FORMS[run.name.replace(RIVAL, '')]}" for run in runs]
    return [*ours(found), "paper, dual mortar", *ours(others), "paper, Lagrange"]


def first_half_of_table_two(found, others):
    rows = []
    values, rival_values = [indentation(run) for run in found], [indentation(run) for run in others]
    for i, (name, (mortar, lagrange)) in enumerate(PAPER_TWO.items()):
        cells = lambda all_values, paper: [f"{number(one[i], 4)} ({difference(one[i], paper)})" for one in all_values]
        rows.append([name, *cells(values, mortar), given(mortar), *cells(rival_values, lagrange), given(lagrange)])
    return html_table(["quantity", *headed(found, others)], rows, "Table 2, first half: at 12.5 kN/mm")


def residual_table(found, others):
    rows = []
    for increment, (mortar, lagrange) in PAPER_RESIDUALS.items():
        residuals = lambda runs: [[100 * one for one in run.residuals(run.history["time"][-1] * increment / INCREMENTS)] for run in runs]
        ours, rival = residuals(found), residuals(others)
        for i in range(max([len(mortar) + 1, len(lagrange) + 1] + [len(one) for one in ours + rival])):
            cell = lambda values, i: f"{values[i]:.1e}" if 0 <= i < len(values) else ""
            rows.append([f"{increment}, {i}", *[cell(one, i) for one in ours], cell(mortar, i - 1), *[cell(one, i) for one in rival],
                         cell(lagrange, i - 1)])
    return html_table(["increment, iteration", *headed(found, others)], rows, "Table 2, second half: relative residual norm in %")


def hertz_plastic():
    parts = [paragraph("The same at 12.5 kN per mm in 200 increments, with both hardening laws. The paper finds plastic strains on both sides",
                       "of the contact.")]
    found = complete(*FORMS)
    if not found:
        return parts
    others = [run for run in rivals(*FORMS) if run.complete]
    for run in found:
        figure, axes = one_panel(f"Contact stress, 12.5 kN/mm, {FORMS[run.name]}")
        for one in [rival for rival in others if rival.name == run.name + RIVAL] + [run]:
            contact_profile(axes, one, f"normal, {method_of(one)}")
            contact_profile(axes, one, f"tangential, {method_of(one)}", shear=True, filled=False)
        x, pressure, _ = run.fields.contact()
        finish_profile(axes, 1.5 * x[pressure > 0].max())
        parts.append(html_figure(figure, "Figure 9", f"contact stress with {FORMS[run.name]} over the current position; each mark is a node"))
    for run in complete("hertz_plastic"):
        parts.append(html_figure(mesh_near_contact(run, "Hertz, plastic", 8.0), "Figure 7, detail",
                                 "von Mises stress near the contact at 12.5 kN/mm, stated data"))
    parts += [first_half_of_table_two(found, others), residual_table(found, others)]
    parts.append(paragraph("What the paper's displacements are is not said: taken is the displacement of the contact point; the block's",
                           "deformation is that against its fixed bottom, the cylinder's that of its diameter against the contact point.",
                           "Residuals: ours are those after each iteration, 0 being the start, over the largest of internal, external and",
                           "contact forces; what the paper's are relative to is not said, nor whether its first one is that after an iteration."))
    parts.append(paragraph("The paper's displacements and contact length belong to a practically rigid cylinder on a practically elastic block",
                           "(Hertz with such a cylinder: a = 3.191 mm) and cannot come from the stated materials, of which the block yields",
                           "from about 1.2 kN/mm on. The iteration counts and their quadratic decay can be compared."))
    every = found + others
    parts.append(comparison(every, [("P<sub>max</sub> / MPa", "peak_pressure", None),
                                    ("largest equivalent plastic strain", "peak_equivalent_plastic_strain", None),
                                    ("that in the cylinder", "peak_plastic_strain_cylinder", None),
                                    ("tangential contact force / (N/mm)", "friction_force", None),
                                    ("oscillation: total variation of the nodal pressures over their peak, − 1", "oscillation", None)],
                            "Hertz problem, plastic", names=lambda run: f"{method_of(run)}, {FORMS[run.name.replace(RIVAL, '')]}"))
    parts.append(own_checks(complete("hertz_plastic")) if complete("hertz_plastic") else "")
    return parts
