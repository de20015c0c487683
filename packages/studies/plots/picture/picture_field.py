# Choice of the field that is drawn, and its name.
import numpy as np

PREFERRED = ("von_mises", "displacement", "contact_pressure")
NAMES = {"von_mises": "von Mises stress", "body": "body"}


def finite(run, name, step, center, values):
    """The values, which have to be numbers to be drawn."""
    wrong = np.flatnonzero(~np.isfinite(values.reshape(len(values), -1)).all(axis=1))
    if len(wrong):
        raise mortise_results.FileProblem(f"{run.directory}: {name} of step {step} is no number at {len(wrong)} {center}s; the first is {center} {wrong[0]}")
    return values


class DrawnField:
    """A field of a run by the name that the user gave: of a vector without a part its length, of a stress von Mises'."""

    def __init__(self, run, name, steps):
        self.run = run
        self.name = self._whole_name(name or self._default(steps[-1]), steps[-1])
        self.is_whole = self.name in ("body", "contact_state")
        self.is_contact = self.name.partition(".")[0] in ("contact_traction", "contact_pressure", "contact_shear", "contact_state", "gap", "slip")
        kind, part = self.name.partition(".")[::2]
        if part == "von_mises":
            self.label = "von Mises stress" if kind == "cauchy_stress" else f"von Mises, {kind.replace('_', ' ')}"
        elif part == "magnitude":
            self.label = f"{kind.replace('_', ' ')}, magnitude"
        else:
            self.label = NAMES.get(kind, kind.replace("_", " ")) + (f" {part}" if part else "")

    def _default(self, step):
        fields = self.run.fields(step)
        if "cauchy_stress" in fields:
            return "von_mises"
        return next((one for one in PREFERRED if one in fields), next(iter(fields), "body"))

    def _whole_name(self, name, step):
        if name == "body":
            return name
        values = self.run.field(name, step)
        if values.ndim == 1:
            return name
        if values.shape[1] == 3:
            return name + ".magnitude"
        if name.endswith("stress"):
            return name + ".von_mises"
        raise mortise_results.UnknownName(f'the field "{name}" has the components {", ".join(mortise_results.TENSOR)}; please name one, as in "{name}.xx"')

    def at(self, step):
        """"node" or "cell", and values, which are numbers."""
        if self.name == "body":
            return "cell", self.run.mesh.body.astype(float)
        center, values = self.run.center_and_values(self.name, step)
        return center, finite(self.run, self.name, step, center, values.astype(float))

    def colours(self, all_values, drawn):
        """Colours of the values that are drawn, over all steps. drawn: (center, values) -> those of bodies that deform."""
        used = [drawn(center, values) for center, values in all_values]
        if self.is_whole:
            names = self.run.mesh.bodies if self.name == "body" else STATES.get(self.name, [])
            return WholeColours(np.unique(np.concatenate(used)), names)
        return Colours(min(one.min(initial=np.inf) for one in used), max(one.max(initial=-np.inf) for one in used))
