"""The recipes of CONTRIBUTING.md name the files that an extension touches. This holds them to what is there: python3 check_recipes.py SOURCE

A recipe is a heading "### A material: ..." and a table whose first column has paths from the root of the sources. <name> in a path is the name of
the type in lower case with underscores, * any part of a file's name. Every member that there is of a kind is looked for in all packages: its type may
stand in the files of the recipe alone, and each path of the recipe has to exist, those marked (new) for every member."""

import fnmatch
import pathlib
import re
import sys

# Kind: the files where its members are listed, what finds their types there, and what these end with besides the name.
KINDS = {
    "A material": ("packages/material/include/mortise/material/material_options.hpp", r"using Law = std::variant<(.*?)>;", ""),
    "An element": ("packages/solid/include/mortise/solid/element_type.hpp", r"ElementEntry<(\w+)[,>]", ""),
    "A load": ("packages/solid/src/loads/dead_loads.cpp", r"\.add<(\w+)>", "Options"),
    "A load of heat": ("packages/thermal/src/loads/thermal_loads.cpp", r"\.add<(\w+)>", "Options"),
    "A quantity": ("packages/simulation/src/quantities/*.cpp", r"Registry<Quantity>& kinds\) \{\s*kinds\.add<(\w+)>", "Quantity"),
    "A contribution to the residual": ("packages/simulation/src/model/contributions.hpp", r"class (\w+Contribution) final", "Contribution"),
    "An integrand": ("packages/solid/src/elements/*.hpp", r"An integrand, see\s+(?:///\s+)?ElementLoop\.\ntemplate <[^>]*>\n(?:struct|class) (\w+)", ""),
    "A mesh format": ("packages/mesh/src/readers/read_mesh_file.cpp", r"\{MeshFormat::(\w+), \"", ""),
    "A time scheme": ("packages/nonlinear/include/mortise/nonlinear/time_scheme.hpp", r"\nTimeScheme (\w+)\(", ""),
    "How contact is enforced": ("packages/contact/src/laws/formulation.cpp", r"\.add<(\w+)>", ""),
    "What multipliers act through": ("packages/mortar/src/coupling/coupling.cpp", r"coupling_of<(\w+)>", "Coupling"),
    "A boundary condition": ("packages/solid/include/mortise/solid/prescribed_motion.hpp", r"struct (BoundaryConditionOptions)", "Options"),
}


def code_of(path):
    """Without comments and texts."""
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', "", path.read_text(), flags=re.S)


def name_of(kind_type, suffix):
    """ciarlet_neo_hooke of CiarletNeoHooke."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", kind_type.removesuffix(suffix)).lower()


def recipes(text):
    """{kind: [(path, is new)]}"""
    found = {}
    for section in re.split(r"^### ", text, flags=re.M)[1:]:
        rows = [row.split("|") for row in section.splitlines() if row.startswith("| `")]
        found[section.split("\n")[0].split(":")[0]] = [
            (path, row[2].rstrip().endswith("(new)")) for row in rows for path in re.findall(r"`([^`]+)`", row[1])]
    return found


def main(source):
    files = {str(path.relative_to(source)): code_of(path) for path in source.glob("packages/**/*pp") if path.is_file()}
    known = recipes((source / "CONTRIBUTING.md").read_text())
    wrong = []
    for kind, (where, pattern, suffix) in KINDS.items():
        listed = "".join(path.read_text() for path in sorted(source.glob(where)))
        members = sorted({one.strip() for found in re.findall(pattern, listed, flags=re.S) for one in found.split(",")})
        if not members or kind not in known:
            wrong.append(f"{kind}: {len(members)} members in {where}, and {'a' if kind in known else 'no'} recipe")
            continue
        for path, is_new in known[kind]:
            present = [any(source.glob(path.replace("<name>", name_of(member, suffix)))) for member in members]
            if not (all(present) if is_new else any(present)):
                wrong.append(f"{kind}: there is no {path} of {', '.join(m for m, here in zip(members, present) if not here)}")
        for member in members:
            allowed = [path.replace("<name>", name_of(member, suffix)) for path, _ in known[kind]]
            for file, code in files.items():
                if any(fnmatch.fnmatch(file, path) for path in allowed) or re.search(rf"^ *(struct|class) {member} {{", code, flags=re.M):
                    continue  # in a recipe, or another type of this name, which the file has for itself
                if re.search(rf"\b{member}\b", code):
                    wrong.append(f"{kind}: {member} stands in {file}, which the recipe does not name")
        print(f"{kind}: {', '.join(members)}")
    if wrong:
        sys.exit("\n".join(wrong))


main(pathlib.Path(sys.argv[1]))
