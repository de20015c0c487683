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


def with_rivals(*names):
    """Runs that came to their end, each followed by the same with nodes on segments."""
    return [run for name in names for run in complete(name) + rivals(name)]


def patch_test():
    parts = [paragraph("Two steel blocks on each other with meshes that do not match, pressed from above, no friction. The paper shows a",
                       "constant stress with dual mortar (figure 4) and an uneven one with nodes on segments (figure 3). It states no other",
                       "numbers.")]
    for name, form in (("patch_test", "elastic"), ("patch_test_plastic", "plastic")):
        found = with_rivals(name)
        for run in found:
            figure = displacement_and_stress(run, f"Patch test, {form}, {method_of(run)}")
            parts.append(html_figure(figure, "Figure 3" if run.name.endswith(RIVAL) else "Figure 4",
                                     f"patch test, {form} form, {method_of(run)}: displacement and von Mises stress on the deformed mesh"))
        parts.append(comparison(found, [("largest deviation of a stress from its mean, over the mean stress", "stress_spread", 0),
                                        ("imbalance of momentum, relative", "momentum_imbalance", 0), ("mean axial stress / MPa", "axial_stress", None),
                                        ("mean equivalent plastic strain", "equivalent_plastic_strain", None)], f"Patch test, {form}", "exact"))
    return parts


def block_pile():
    parts = [paragraph("Four steel blocks on each other, compressed by 15 mm, no friction. The paper: the blocks deform alike, “a smooth",
                       "deformation of the entire structure and a uniform uniaxial stress field” (figure 6); with nodes on segments corner",
                       "nodes slip off (figure 5). It states no other numbers.")]
    for name, form, names in (("block_pile", "plane strain", ("x", "y")), ("block_pile_axisymmetric", "axisymmetric", ("r", "z"))):
        found = with_rivals(name)
        stress, alpha, lateral = upset(0.15) if form == "axisymmetric" else (None, None, None)
        for run in found:
            figure = displacement_and_stress(run, f"Block pile, {form}, {method_of(run)}", names)
            parts.append(html_figure(figure, "Figure 5" if run.name.endswith(RIVAL) else "Figure 6",
                                     f"block pile, {form}, {method_of(run)}: displacement and von Mises stress on the deformed mesh"))
        parts.append(comparison(found, [("axial stress / MPa", "axial_stress", stress), ("equivalent plastic strain", "equivalent_plastic_strain", alpha),
                                        ("lateral stretch", "lateral_stretch", lateral),
                                        ("largest deviation of a stress from its mean, relative", "stress_spread", 0),
                                        ("difference of the blocks' corners / mm", "lateral_spread", 0),
                                        ("smallest gap (negative: penetration) / mm", "largest_penetration", 0)], f"Block pile, {form}", "exact"))
        for run in rivals(name):
            parts.append(paragraph(f"Node to segment, {form}:", how_far(run), "Corner nodes of a slave side leave the master side, as the paper says of its",
                                   "own: then the master's corner goes into the slave, where nothing holds it."))
    return parts


def hertz_elastic():
    parts = [paragraph("A steel cylinder on an aluminium block, 5 kN per mm, μ = 0.1, elastic. The paper compares with Hertz by its equations",
                       "(14) to (16) and prints P<sub>max</sub> = 1577.32 N/mm², a = 2.018 mm. With R = 50 mm these follow only if the",
                       "cylinder's modulus is 1000 times the stated one, and then to all printed digits. Both sets of moduli stand here. The",
                       "paper's dual mortar took 3 iterations to a relative residual of 1e-10.")]
    sets = [("stated moduli", STATED, ["hertz_elastic", "hertz_elastic_frictionless"], "eq. (14)"),
            ("moduli that give the printed numbers", AS_PRINTED, ["hertz_elastic_as_printed", "hertz_elastic_as_printed_frictionless"], "printed")]
    named = lambda run: f"{method_of(run)}, {friction(run)}"
    for label, moduli, names, source in sets:
        found = with_rivals(*names)
        if not found:
            continue
        peak, half_width = (1577.32, 2.018) if source == "printed" else hertz(5000.0, moduli["cylinder"], moduli["block"])
        figure, axes = one_panel(f"Contact stress, 5 kN/mm, {label}")
        hertz_profile(axes, peak, half_width, f"Hertz, {source}")
        for run in found:
            contact_profile(axes, run, named(run), filled=friction(run) == "with friction")
        finish_profile(axes, 1.5 * half_width)
        parts.append(html_figure(figure, "Figure 8", f"contact stress with {label} over the current position; each mark is a node"))
        parts.append(comparison(found, [("P<sub>max</sub> / MPa", "peak_pressure", peak), ("a / mm", "half_width", half_width),
                                        ("oscillation: total variation of the nodal pressures over their peak, − 1", "oscillation", 0),
                                        ("relative L2 error of the pressure", "pressure_error_l2", 0)], f"Hertz problem, elastic, {label}",
                                f"Hertz, {source}", named))
    for run in complete("hertz_elastic"):
        parts.append(html_figure(mesh_near_contact(run, "Hertz, elastic", 5.0), "Figure 7, detail",
                                 f"von Mises stress near the contact, stated moduli, {friction(run)}"))
        parts.append(own_checks([run]))
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
        figure, axes = panels(1, "Conical extrusion, dual mortar")
        strain = run.fields.values["equivalent_plastic_strain"].ravel()
        on_mesh(figure, axes[0], run.fields, strain, "equivalent plastic strain", ("r", "z"), lying=True)
        parts.append(html_figure(figure, "Figure 11", "equivalent plastic strain of the billet at the end; means of elements"))
    found = with_rivals("conical_extrusion")
    for figure_name, quantity, name in (("Figure 12", "rear_force", "extrusion force"), ("Figure 13", "friction_force", "friction force")):
        shown = [run for run in found if quantity in run.history]
        if shown:
            figure = against_displacement(shown, quantity, f"{name} / MN", name.capitalize(), 177.8)
            parts.append(html_figure(figure, figure_name, f"{name} of the whole billet over the displacement of its rear face"))
    meganewtons = lambda name: lambda run: 1e-6 * run.quantity(name) if known(run.quantity(name)) else None
    parts.append(comparison(found, [("largest equivalent plastic strain", "peak_equivalent_plastic_strain", 1.39),
                                    ("contact length / mm, whole billet", "contact_length", 257.33),
                                    ("contact length / mm, on the cone", lambda run: length_on_cone(run.fields), 257.33),
                                    ("rear force at the end / MN", meganewtons("rear_force"), None),
                                    ("friction force at the end / MN", meganewtons("friction_force"), None),
                                    ("roughness (RMS of second differences over RMS) of the friction force",
                                     lambda run: roughness(run.history, "friction_force"), None),
                                    ("roughness of the extrusion force", lambda run: roughness(run.history, "rear_force"), None)], "Conical extrusion"))
    parts.append(own_checks(found))
    parts += [paragraph("Node to segment:", how_far(run)) for run in rivals("conical_extrusion") if not run.complete]
    return parts
