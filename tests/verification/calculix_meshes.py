"""Reads each deck of CalculiX' own examples as a mesh file, and writes what came of it as a page.

usage: calculix_meshes.py MORTISE EXAMPLES DIRECTORY PAGE

EXAMPLES is the folder of the decks (Debian: calculix-ccx-test). Each deck becomes a scene of one body, whose nodes and elements are counted: by the
program, and here from the deck's lines. A deck that is read with other counts is wrong, and the exit code is 1.
"""
import glob
import gzip
import os
import re
import subprocess
import sys

SOLIDS = {"C3D4": 4, "C3D6": 6, "C3D8": 8, "C3D8R": 8, "C3D8I": 8, "C3D10": 10, "C3D10T": 10, "C3D10M": 10, "C3D15": 15, "C3D20": 20, "C3D20R": 20, "C3D20RI": 20}
PLANE = {f"{kind}{nodes}{variant}": nodes for kind in ("CPE", "CPS", "CAX") for nodes in (3, 4, 6, 8) for variant in ("", "R")}
SCENE = """<ParameterList name="deck"><Parameter name="kinematics" type="string" value="{kinematics}"/>
<ParameterList name="materials"><ParameterList name="m"><Parameter name="type" type="string" value="small strain linear"/>
<Parameter name="young's modulus" type="double" value="1"/><Parameter name="poisson's ratio" type="double" value="0.3"/></ParameterList></ParameterList>
<ParameterList name="bodies"><ParameterList name="deck"><Parameter name="material" type="string" value="m"/><ParameterList name="mesh">
<Parameter name="type" type="string" value="file"/><Parameter name="file" type="string" value="{file}"/></ParameterList></ParameterList></ParameterList>
<ParameterList name="boundary conditions"><ParameterList name="all"><Parameter name="set" type="string" value="deck"/>{fixed}</ParameterList></ParameterList>
</ParameterList>
"""


def lines_of(path):
    opener = gzip.open if path.endswith(".gz") else open
    with opener(path, "rt", encoding="utf-8", errors="replace") as file:
        return file.read().splitlines()


def elements_of(lines):
    """How many elements of each type the lines have, by the numbers of their data."""
    counts, kind, words = {}, None, 0
    for line in lines:
        text = line.strip().upper().replace(" ", "")
        if not text or text.startswith("**"):
            continue
        if text.startswith("*STEP"):
            break
        if text.startswith("*"):
            match = re.search(r"TYPE=([A-Z0-9]+)", text) if text.startswith("*ELEMENT,") else None
            kind, words = (match.group(1) if match else None), 0
            continue
        if kind is None:
            continue
        words += len([word for word in text.split(",") if word])
        size = SOLIDS.get(kind, PLANE.get(kind))
        if size is None:
            counts[kind] = counts.get(kind, 0) + 1
        elif words >= size + 1:
            counts[kind] = counts.get(kind, 0) + 1
            words = 0
    return counts


def main():
    program, examples, directory, page = sys.argv[1:5]
    os.makedirs(directory, exist_ok=True)
    rows, wrong, read = [], 0, 0
    for path in sorted(glob.glob(os.path.join(examples, "*.inp*"))):
        name = os.path.basename(path).split(".inp")[0]
        lines = lines_of(path)
        counts = elements_of(lines)
        deck = os.path.join(directory, name + ".inp")
        with open(deck, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        plane = bool(counts) and all(kind in PLANE for kind in counts)
        kinematics = "three dimensional" if not plane else "axisymmetric" if any(kind.startswith("CAX") for kind in counts) else "plane strain"
        fixed = "".join(f'<Parameter name="{i}" type="double" value="0"/>' for i in ("xy" if plane else "xyz"))
        scene = os.path.join(directory, name + ".xml")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(SCENE.format(kinematics=kinematics, file=name + ".inp", fixed=fixed))
        try:
            done = subprocess.run([program, "check", scene], capture_output=True, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            rows.append((name, counts, "**hangs**"))
            wrong += 1
            continue
        text = done.stdout + done.stderr
        if done.returncode == 0:
            found = sum(int(number) for number in re.findall(r"body deck[^:]*: (\d+) elements", text))
            expected = sum(count for kind, count in counts.items() if kind in SOLIDS or kind in PLANE)  # shells are surfaces without stiffness
            read += 1
            wrong += found != expected
            rows.append((name, counts, "read" if found == expected else f"**wrong**: {found} elements of {expected}"))
        elif done.returncode == 2:
            reason = re.sub(r"^\S+?: error: (bodies/\S+: )?", "", text.strip().splitlines()[0]) if text.strip() else ""
            rows.append((name, counts, "refused: " + reason.replace(directory + "/", "").replace("|", "\\|")[:220]))
        else:
            rows.append((name, counts, f"**ends with {done.returncode}**"))
            wrong += 1
    with open(page, "w", encoding="utf-8") as file:
        file.write("# The decks of CalculiX' examples\n\nThis page says which decks of CalculiX' own examples (Debian: `calculix-ccx-test`) are read as [mesh files](../mesh_files.md). "
                   "`tests/verification/calculix_meshes.py` writes it.\nEach deck is one body, so parts that are not connected are refused here: in a scene each of them is a body "
                   f"of its own. Elements are counted by the program\nand from the lines of the deck.\n\n{read} of {len(rows)} decks are read; {wrong} are wrong.\n\n"
                   "| deck | elements | what comes of it |\n|---|---|---|\n")
        for name, counts, result in rows:
            file.write(f"| {name} | {', '.join(f'{count} {kind}' for kind, count in sorted(counts.items())) or '-'} | {result} |\n")
    print(f"{read} of {len(rows)} decks are read, {wrong} are wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
