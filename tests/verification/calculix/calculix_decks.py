"""Decks of CalculiX: their lines, with other requests for results, or with each hexahedron split into eight."""
import gzip
import os
import re


def deck_lines(examples, name):
    path = os.path.join(examples, name + ".inp")
    opener, path = (open, path) if os.path.exists(path) else (gzip.open, path + ".gz")
    with opener(path, "rt", encoding="utf-8", errors="replace") as file:
        return file.read().splitlines()


def with_requests(lines, requests):
    """The deck with these requests for results in place of its own."""
    result, skipped = [], False
    for line in lines:
        key = line.upper().replace(" ", "")
        if key.startswith("*") and not key.startswith("**"):
            skipped = bool(re.match(r"\*(NODE|EL|CONTACT)(PRINT|FILE)", key))
        if key.startswith("*ENDSTEP"):
            result += [line for request in requests for line in request]
        if not skipped:
            result.append(line)
    return result


CORNERS = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
PLACES = CORNERS + [tuple((a + b) // 2 for a, b in zip(CORNERS[i], CORNERS[j])) for i, j in EDGES]
KEYWORDS = [("node", r"\*NODE(,|$)"), ("element", r"\*ELEMENT,"), ("set", r"\*NSET"), ("elements", r"\*ELSET"), ("faces", r"\*(SURFACE,(?!.*TYPE=NODE)|DLOAD)")]
CHILDREN = {"1": (0, 1, 2, 3), "2": (4, 5, 6, 7), "3": (0, 1, 4, 5), "4": (1, 2, 5, 6), "5": (2, 3, 6, 7), "6": (3, 0, 7, 4)}  # at a face


def shape_functions(count, x):
    if count == 8:
        return [(1 + a * x[0]) * (1 + b * x[1]) * (1 + c * x[2]) / 8 for a, b, c in CORNERS]
    values = []
    for place in PLACES:
        factors = [(1 - t * t) if p == 0 else (1 + p * t) for p, t in zip(place, x)]
        value = factors[0] * factors[1] * factors[2]
        values.append(value / 4 if 0 in place else value * (sum(p * t for p, t in zip(place, x)) - 2) / 8)
    return values


def refined(lines):
    """Each C3D8 and C3D20 split into eight; sets, surfaces and pressures go with their elements. New nodes are in a set if all corners around them are."""
    nodes, cells, kind, words = {}, {}, None, []
    keys = [line.strip().upper().replace(" ", "") for line in lines]
    for key in keys:
        if key.startswith("*") or not key:
            if key.startswith("*") and not key.startswith("**"):
                match = re.match(r"\*ELEMENT,.*TYPE=C3D(8|20)", key)
                kind, words = "node" if re.match(r"\*NODE(,|$)", key) else int(match.group(1)) if match else None, []
        elif kind == "node":
            number, *place = key.split(",")[:4]
            nodes[int(number)] = tuple(float(x) for x in place)
        elif kind:
            words += [int(word) for word in key.split(",") if word]
            if len(words) > kind:
                cells[words[0]] = words[1:]
                words = []
    places, around, made, children, number = dict(nodes), {}, {}, {}, max(nodes)
    for cell, mine in cells.items():
        for corner in CORNERS:
            child = []
            for place in PLACES[:len(mine)]:
                x = tuple((c + p) / 2 for c, p in zip(corner, place))
                if x in PLACES[:len(mine)]:
                    child.append(mine[PLACES.index(x)])
                    continue
                corners = frozenset(mine[i] for i in range(8) if all(abs(t) < 1 or t == c for t, c in zip(x, CORNERS[i])))
                at = tuple(sum(n * nodes[node][i] for n, node in zip(shape_functions(len(mine), x), mine)) for i in range(3))
                key = (corners, tuple(round(t, 7) for t in at))
                if key not in made:
                    number += 1
                    made[key], places[number], around[number] = number, at, corners
                child.append(made[key])
            children.setdefault(cell, []).append(child)
    first = {cell: 1 + 8 * i for i, cell in enumerate(cells)}

    def at_face(cell, face):
        return [first[cell] + i for i in (CHILDREN[face] if face else range(8))]

    result, kind, members, written = [], None, set(), False
    for line, key in list(zip(lines, keys)) + [("", "*")]:
        values = [word for word in key.split(",") if word]
        if key.startswith("**") or not key:
            continue
        if key.startswith("*"):
            if kind == "set":
                members |= {node for node, corners in around.items() if corners <= members}
                result += [f"{node}," for node in sorted(members)]
            kind, members = next((what for what, begin in KEYWORDS if re.match(begin, key)), None), set()
            result.append(line)
            if kind == "node" and not written:
                result += [f"{node}, " + ", ".join(f"{x:.12g}" for x in at) for node, at in places.items()]
                written = True
            words = []
        elif kind == "node":
            continue
        elif kind == "element":
            words += [int(value) for value in values]
            if len(words) > len(cells[words[0]]):
                for i, child in enumerate(children[words[0]]):
                    row = [first[words[0]] + i] + child
                    result += [", ".join(map(str, row[j:j + 10])) + ("," if j + 10 < len(row) else "") for j in range(0, len(row), 10)]
                words = []
        elif kind == "set":
            members |= {int(value) for value in values}
        elif kind == "elements":
            result += [f"{child}," for value in values for child in at_face(int(value), None)]
        elif kind == "faces":
            result += [", ".join([str(child)] + values[1:]) for child in at_face(int(values[0]), values[1][1])]
        else:
            result.append(line)
    return [line for line in result if line]
