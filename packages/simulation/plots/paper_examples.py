# The examples of the paper, one function each, which gives the HTML of its section: what the paper says, our figures, our numbers beside its own.
STEEL, ALUMINIUM = (210000.0, 0.33), (71150.0, 0.30)
LAGRANGE = "nodes on segments, one pass, Lagrange multipliers: the paper's “Lagrange”"


def hertz(force, first, second, radius=50.0):
    """Peak pressure and half width by the paper's equations (14) to (16)."""
    (e1, nu1), (e2, nu2) = first, second
    modulus = 2 * e1 * e2 / (e1 * (1 - nu2**2) + e2 * (1 - nu1**2))
    return np.sqrt(force * modulus / (2 * np.pi * radius)), np.sqrt(8 * force * radius / (np.pi * modulus))


STATED = {"cylinder": STEEL, "block": ALUMINIUM}
AS_PRINTED = {"cylinder": (1000 * STEEL[0], STEEL[1]), "block": ALUMINIUM}


def upset(compression):
    """Exact uniaxial compression: |ln l| = tau/E + alpha, tau = 830 + 600 alpha^0.21, J = exp(-(1 - 2 nu) tau/E); stress, alpha, lateral stretch."""
    (modulus, nu), stretch = STEEL, 1 - compression
    low, high = 0.0, -np.log(stretch)
    for _ in range(200):
        alpha = 0.5 * (low + high)
        tau = 830 + 600 * alpha**0.21
        low, high = (alpha, high) if tau / modulus + alpha < -np.log(stretch) else (low, alpha)
    volume = np.exp(-(1 - 2 * nu) * tau / modulus)
    return -tau / volume, alpha, np.sqrt(volume / stretch)


def patch_test():
    parts = [paragraph("Two steel blocks on each other with meshes that do not match, pressed from above, no friction. The paper shows a",
                       "constant stress with dual mortar (figure 4) and an uneven one with nodes on segments (figure 3). It states no other",
                       "numbers.")]
    for run in complete("patch_test", "patch_test_plastic"):
        form = "elastic" if run.name == "patch_test" else "plastic"
        parts.append(html_figure(displacement_and_stress(run, f"Patch test, {form}"), "Figure 4",
                                 f"patch test, {form} form: displacement and von Mises stress on the deformed mesh"))
        rows = [["largest deviation of a stress from its mean, over the mean stress", run.quantity("stress_spread"), 0.0],
                ["imbalance of momentum, relative", run.quantity("momentum_imbalance"), 0.0],
                ["mean axial stress / MPa", run.quantity("axial_stress"), None],
                ["mean equivalent plastic strain", run.quantity("equivalent_plastic_strain"), None]]
        parts.append(comparison([row for row in rows if row[1] is not None], f"Patch test, {form}", "exact"))
    for run in rivals("patch_test", "patch_test_plastic"):
        form = "elastic" if run.name == "patch_test" + RIVAL else "plastic"
        parts.append(html_figure(displacement_and_stress(run, f"Patch test, {form}, node to segment"), "Figure 3", f"the same with {LAGRANGE}"))
        parts.append(comparison([["largest deviation of a stress from its mean, over the mean stress", run.quantity("stress_spread"), 0.0],
                                 ["imbalance of momentum, relative", run.quantity("momentum_imbalance"), 0.0]],
                                f"Patch test, {form}, node to segment", "exact"))
    return parts


def block_pile():
    parts = [paragraph("Four steel blocks on each other, compressed by 15 mm, no friction. The paper: the blocks deform alike, “a smooth",
                       "deformation of the entire structure and a uniform uniaxial stress field” (figure 6); with nodes on segments corner",
                       "nodes slip off (figure 5). It states no other numbers.")]
    for run in complete("block_pile", "block_pile_axisymmetric"):
        round_bar = run.name.endswith("axisymmetric")
        form, names = ("axisymmetric", ("r", "z")) if round_bar else ("plane strain", ("x", "y"))
        stress, alpha, lateral = upset(0.15) if round_bar else (None, None, None)
        parts.append(html_figure(displacement_and_stress(run, f"Block pile, {form}", names), "Figure 6",
                                 f"block pile, {form}: displacement and von Mises stress on the deformed mesh"))
        parts.append(comparison([["axial stress / MPa", run.quantity("axial_stress"), stress],
                                 ["equivalent plastic strain", run.quantity("equivalent_plastic_strain"), alpha],
                                 ["lateral stretch", run.quantity("lateral_stretch"), lateral],
                                 ["largest deviation of a stress from its mean, relative", run.quantity("stress_spread"), 0.0],
                                 ["difference of the blocks' corners / mm", run.quantity("lateral_spread"), 0.0],
                                 ["smallest gap (negative: penetration) / mm", run.quantity("largest_penetration"), 0.0]],
                                f"Block pile, {form}", "exact"))
    for run in rivals("block_pile", "block_pile_axisymmetric"):
        round_bar = "axisymmetric" in run.name
        form, names = ("axisymmetric", ("r", "z")) if round_bar else ("plane strain", ("x", "y"))
        parts.append(html_figure(displacement_and_stress(run, f"Block pile, {form}, node to segment", names), "Figure 5",
                                 f"block pile, {form}, with {LAGRANGE}: the last state that was found"))
        parts.append(comparison([["largest deviation of a stress from its mean, relative", run.quantity("stress_spread"), 0.0],
                                 ["difference of the blocks' corners / mm", run.quantity("lateral_spread"), 0.0]],
                                f"Block pile, {form}, node to segment", "exact"))
        parts.append(paragraph(how_far(run), "Corner nodes of a slave side leave the master side, as the paper says of its own: then the master's",
                               "corner goes into the slave, where nothing holds it."))
    return parts


def hertz_elastic():
    parts = [paragraph("A steel cylinder on an aluminium block, 5 kN per mm, μ = 0.1, elastic. The paper compares with Hertz by its equations",
                       "(14) to (16) and prints P<sub>max</sub> = 1577.32 N/mm², a = 2.018 mm. With R = 50 mm these follow only if the",
                       "cylinder's modulus is 1000 times the stated one, and then to all printed digits. Both sets of moduli stand here. The",
                       "paper's dual mortar took 3 iterations to a relative residual of 1e-10.")]
    sets = [("stated moduli", STATED, ["hertz_elastic", "hertz_elastic_frictionless"], "eq. (14)"),
            ("moduli that give the printed numbers", AS_PRINTED, ["hertz_elastic_as_printed", "hertz_elastic_as_printed_frictionless"], "printed")]
    sets = [one for one in sets if complete(*one[2])]
    if not sets:
        return parts
    figure, axes = panels(len(sets), "Contact stress, elastic, 5 kN/mm")
    rows = []
    for panel, (label, moduli, names, source) in zip(axes, sets):
        peak, half_width = (1577.32, 2.018) if source == "printed" else hertz(5000.0, moduli["cylinder"], moduli["block"])
        hertz_profile(panel, peak, half_width, f"Hertz, {source}")
        for run, colour, marker in zip(complete(*names), COLOURS, "os"):
            contact_profile(panel, run, friction(run), colour, marker)
            rows += [[f"P<sub>max</sub> / MPa, {label}, {friction(run)}; beside: {source}", run.quantity("peak_pressure"), peak],
                     [f"a / mm, {label}, {friction(run)}; beside: {source}", run.quantity("half_width"), half_width]]
        for run in rivals(*names):
            contact_profile(panel, run, "node to segment, " + friction(run), COLOURS[2], "^")
            rows += [[f"P<sub>max</sub> / MPa, {label}, node to segment; beside: {source}", run.quantity("peak_pressure"), peak],
                     [f"a / mm, {label}, node to segment; beside: {source}", run.quantity("half_width"), half_width]]
        finish_profile(panel, label, 1.5 * half_width)
    parts.append(html_figure(figure, "Figure 8", "contact stress of the elastic Hertz problem over the current position; each mark is a node"))
    parts.append(comparison(rows, "Hertz problem, elastic", "Hertz"))
    both = complete("hertz_elastic", "hertz_elastic_as_printed") + rivals("hertz_elastic", "hertz_elastic_as_printed")
    parts.append(beside([["total variation of the nodal pressures over their peak, − 1 (no oscillation: 0)", "oscillation"],
                         ["relative L2 error of the pressure", "pressure_error_l2"]], both, [run.name for run in both],
                        "Oscillation of the contact pressure"))
    for run in complete("hertz_elastic"):
        parts.append(own_checks(run))
        parts.append(html_figure(mesh_near_contact(run, "Hertz, elastic", 5.0), "Figure 7, detail",
                                 f"von Mises stress near the contact, stated moduli, {friction(run)}"))
    return parts


def roughness(history, quantity):
    """RMS of the second differences over the RMS, of values at as many equal distances in time as there are steps; None without such a history."""
    if quantity not in history:
        return None
    time = history["time"]
    values = np.interp(np.linspace(time[0], time[-1], len(time)), time, history[quantity])
    rms = lambda numbers: np.sqrt(np.mean(numbers**2))
    return rms(np.diff(values, 2)) / rms(values) if len(values) > 2 and values.any() else None


def length_on_cone(fields):
    """From the start of the cone, z = 0, along its wall to the last closed node."""
    closed = fields.values["contact_pressure"].ravel() > 0
    return max(fields.position[closed, 1].max(), 0.0) / np.cos(np.radians(5))


def extrusion():
    parts = [paragraph("An aluminium billet is pushed 177.8 mm through a rigid cone with a wall of 5°, μ = 0.1, 80 elements. The paper states",
                       "a largest equivalent plastic strain of 1.39 at the front corner and a contact length of 257.33 mm, without saying how",
                       "that was counted; its curves of forces are lost. It calls the friction force of dual mortar smooth and that of nodes",
                       "on segments oscillating.")]
    for run in complete("conical_extrusion"):
        figure, axes = panels(1, "Conical extrusion")
        strain = run.fields.values["equivalent_plastic_strain"].ravel()
        on_mesh(figure, axes[0], run.fields, strain, "equivalent plastic strain", ("r", "z"), lying=True)
        parts.append(html_figure(figure, "Figure 11", "equivalent plastic strain of the billet at the end; means of elements"))
        parts.append(comparison([["largest equivalent plastic strain", run.quantity("peak_equivalent_plastic_strain"), 1.39],
                                 ["contact length / mm, whole billet", run.quantity("contact_length"), 257.33],
                                 ["contact length / mm, on the cone", length_on_cone(run.fields), 257.33],
                                 ["rear force at the end / N", run.quantity("rear_force"), None],
                                 ["friction force at the end / N", run.quantity("friction_force"), None],
                                 ["roughness (RMS of second differences over RMS) of the friction force", roughness(run.history, "friction_force"),
                                  None],
                                 ["roughness of the extrusion force", roughness(run.history, "rear_force"), None]], "Conical extrusion"))
        parts.append(own_checks(run))
        found = [run, *rivals(run.name)]
        for figure_name, quantity, name in (("Figure 12", "rear_force", "extrusion force"), ("Figure 13", "friction_force", "friction force")):
            if quantity in run.history:
                figure = against_displacement(found, quantity, f"{name} / kN", name.capitalize(), 177.8)
                parts.append(html_figure(figure, figure_name, f"{name} of the whole billet over the displacement of its rear face"))
    for run in rivals("conical_extrusion"):
        parts.append(comparison([["largest equivalent plastic strain", run.quantity("peak_equivalent_plastic_strain"), 1.39],
                                 ["contact length / mm, whole billet", run.quantity("contact_length"), 257.33],
                                 ["rear force at the end / N", run.quantity("rear_force"), None],
                                 ["friction force at the end / N", run.quantity("friction_force"), None],
                                 ["roughness of the friction force", roughness(run.history, "friction_force"), None],
                                 ["roughness of the extrusion force", roughness(run.history, "rear_force"), None]],
                                "Conical extrusion, node to segment"))
        parts.append(paragraph(how_far(run)))
    return parts
