"""Reads each deck of CalculiX' own examples as a mesh file, and writes what came of it as a page.

usage: calculix_meshes.py MORTISE EXAMPLES DIRECTORY PAGE

EXAMPLES is the folder of the decks (Debian: calculix-ccx-test). Each deck becomes a scene with a body for each of its pieces: the elements that nodes
connect. Pieces are found here from the deck's lines, and given to the program by a point each. The program counts their elements, and so does this
script. A deck that is read with other counts is wrong, and the exit code is 1. Pieces that shells join stay one body, as shells have no stiffness in a
scene; the program refuses them.
"""
import glob
import gzip
import os
import re
import subprocess
import sys

SOLIDS = {"C3D4": 4, "C3D6": 6, "C3D8": 8, "C3D8R": 8, "C3D8I": 8, "C3D10": 10, "C3D10T": 10, "C3D10M": 10,
          "C3D15": 15, "C3D20": 20, "C3D20R": 20, "C3D20RI": 20,
          "DC3D4": 4, "DC3D6": 6, "DC3D8": 8, "DC3D10": 10, "DC3D15": 15, "DC3D20": 20}
PLANE = {f"{kind}{nodes}{variant}": nodes for kind in ("CPE", "CPS", "CAX", "DC2D", "DCAX") for nodes in (3, 4, 6, 8) for variant in ("", "R")}
SHELLS = {f"{kind}{variant}": nodes for kind, nodes in (("S3", 3), ("S4", 4), ("S6", 6), ("S8", 8), ("M3D4", 4), ("M3D8", 8)) for variant in ("", "R")}
SCENE = """<ParameterList name="deck"><Parameter name="kinematics" type="string" value="{kinematics}"/>
<ParameterList name="materials"><ParameterList name="m"><Parameter name="type" type="string" value="small strain linear"/>
<Parameter name="young's modulus" type="double" value="1"/><Parameter name="poisson's ratio" type="double" value="0.3"/></ParameterList></ParameterList>
<ParameterList name="bodies">{bodies}</ParameterList>
<ParameterList name="boundary conditions">{fixed}</ParameterList>
</ParameterList>
"""
BODY = """<ParameterList name="{name}"><Parameter name="material" type="string" value="m"/><ParameterList name="mesh">
<Parameter name="type" type="string" value="file"/><Parameter name="file" type="string" value="{file}"/>{piece}</ParameterList></ParameterList>
"""
PIECE = '<Parameter name="piece" type="string" value="{}"/>'
FIXED = '<ParameterList name="{name}"><Parameter name="set" type="string" value="{name}"/>{components}</ParameterList>\n'


def lines_of(path):
    opener = gzip.open if path.endswith(".gz") else open
    with opener(path, "rt", encoding="utf-8", errors="replace") as file:
        return file.read().splitlines()


def cells_of(lines):
    """The nodes' places, the elements of types whose number of nodes is known, and how many there are of each type, by the numbers of their data."""
    places, cells, counts, kind, words = {}, [], {}, None, []
    for line in lines:
        text = line.strip().upper().replace(" ", "")
        if not text or text.startswith("**"):
            continue
        if text.startswith("*STEP"):
            break
        if text.startswith("*"):
            match = re.search(r"TYPE=([A-Z0-9]+)", text) if text.startswith("*ELEMENT,") else None
            kind, words = match.group(1) if match else "*NODE" if re.match(r"\*NODE(,|$)", text) else None, []
            continue
        if kind is None:
            continue
        words += [word for word in text.split(",") if word]
        if kind == "*NODE":
            places[words[0]] = tuple(float(word) for word in (words[1:4] + ["0", "0", "0"])[:3])
            words = []
            continue
        size = SOLIDS.get(kind, PLANE.get(kind, SHELLS.get(kind)))
        if size is None or len(words) > size:
            counts[kind] = counts.get(kind, 0) + 1
            if size is not None:
                cells.append((kind, words[1:size + 1]))
            words = []
    return places, cells, counts


def pieces_of(cells):
    """Elements in groups that nodes connect, the largest groups first."""
    parent = {}

    def root(node):
        while parent[node] != node:
            parent[node] = parent[parent[node]]
            node = parent[node]
        return node

    for _, nodes in cells:
        for node in nodes:
            parent.setdefault(node, node)
            parent[root(node)] = root(nodes[0])
    groups = {}
    for cell in cells:
        groups.setdefault(root(cell[1][0]), []).append(cell)
    return sorted(groups.values(), key=len, reverse=True)


def point_of(piece, pieces, places):
    """The place of a node of the piece at which no other piece has a node; nothing if there is none."""
    def key(node):
        return tuple(round(x, 6) for x in places[node])

    others = {key(node) for other in pieces if other is not piece for _, nodes in other for node in nodes if node in places}
    mine = sorted({node for _, nodes in piece for node in nodes if node in places}, key=int)
    return next((", ".join(repr(x) for x in places[node]) for node in mine if key(node) not in others), None)


def main():
    program, examples, directory, page = sys.argv[1:5]
    os.makedirs(directory, exist_ok=True)
    rows, wrong, read, several = [], 0, 0, 0
    for path in sorted(glob.glob(os.path.join(examples, "*.inp*"))):
        name = os.path.basename(path).split(".inp")[0]
        lines = lines_of(path)
        places, cells, counts = cells_of(lines)
        deck = os.path.join(directory, name + ".inp")
        with open(deck, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        plane = bool(counts) and all(kind in PLANE for kind in counts)
        kinematics = "three dimensional" if not plane else "axisymmetric" if any(kind.startswith("CAX") for kind in counts) else "plane strain"
        components = "".join(f'<Parameter name="{i}" type="double" value="0"/>' for i in ("xy" if plane else "xyz"))
        pieces = pieces_of([cell for cell in cells if cell[0] not in SHELLS])
        joined = len(pieces_of(cells)) < len(pieces)
        points = [point_of(piece, pieces, places) for piece in pieces]
        if len(pieces) < 2 or joined or None in points:
            bodies = {"deck": ("", sum(count for kind, count in counts.items() if kind in SOLIDS or kind in PLANE))}
        else:
            bodies = {f"deck{i + 1}": (PIECE.format(point), len(piece)) for i, (piece, point) in enumerate(zip(pieces, points))}
        scene = os.path.join(directory, name + ".xml")
        with open(scene, "w", encoding="utf-8") as file:
            written = "".join(BODY.format(name=body, file=name + ".inp", piece=piece) for body, (piece, _) in bodies.items())
            file.write(SCENE.format(kinematics=kinematics, bodies=written,
                                    fixed="".join(FIXED.format(name=body, components=components) for body in bodies)))
        try:
            done = subprocess.run([program, "check", scene], capture_output=True, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            rows.append((name, counts, "**hangs**"))
            wrong += 1
            continue
        text = done.stdout + done.stderr
        if done.returncode == 0:
            found = {body: int(number) for body, number in re.findall(r"body (deck\d*)[^:]*: (\d+) elements", text)}
            expected = {body: number for body, (_, number) in bodies.items()}  # shells are surfaces without stiffness
            read += 1
            several += len(bodies) > 1
            wrong += found != expected
            result = "read" if len(bodies) == 1 else f"read, {len(bodies)} bodies"
            rows.append((name, counts, result if found == expected else f"**wrong**: {found} elements of {expected}"))
        elif done.returncode == 2:
            reason = re.sub(r"^\S+?: error: (bodies/\S+: )?", "", text.strip().splitlines()[0]) if text.strip() else ""
            rows.append((name, counts, "refused: " + reason.replace(directory + "/", "").replace("|", "\\|")[:220]))
        else:
            rows.append((name, counts, f"**ends with {done.returncode}**"))
            wrong += 1
    with open(page, "w", encoding="utf-8") as file:
        file.write("# The decks of CalculiX' examples\n\nThis page says which decks of CalculiX' own examples (Debian: `calculix-ccx-test`) are read as [mesh "
                   "files](../mesh_files.md).\n`tests/verification/calculix/calculix_meshes.py` writes it. Each piece of a deck, the elements that nodes connect, is a body of "
                   "its own.\nElements of each body are counted by the program and from the lines of the deck. Decks with contact and ties are [computed\n"
                   "too](calculix_examples.md).\n\n"
                   f"{read} of {len(rows)} decks are read, {several} of them as several bodies; {wrong} are wrong.\n\n"
                   "| deck | elements | what comes of it |\n|---|---|---|\n")
        for name, counts, result in rows:
            file.write(f"| {name} | {', '.join(f'{count} {kind}' for kind, count in sorted(counts.items())) or '-'} | {result} |\n")
    print(f"{read} of {len(rows)} decks are read, {several} as several bodies, {wrong} are wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
