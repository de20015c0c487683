"""Results of CalculiX for an ordinary part: blocks of its .dat file, and the way its increments went."""
import os
import re


def blocks(path):
    """Kind, set, time and rows of each block of numbers."""
    headline = re.compile(r"^ *(displacements|total force|contact stress|stresses|equivalent plastic strain)\b(.*?)and time +([-+.\dE]+)")
    found, rows = [], None
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            match = headline.match(line)
            if match:
                name = re.search(r"set ([^ ,]+)", match.group(2))
                rows = []
                found.append((match.group(1), name.group(1).upper() if name else "", float(match.group(3)), rows))
            elif rows is not None and line.strip():
                try:
                    rows.append([float(word) for word in line.split()])
                except ValueError:
                    rows = None
    return found


def mises(s):
    xx, yy, zz, xy, xz, yz = s
    return (0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy * xy + xz * xz + yz * yz)) ** 0.5


def history(found, kind, name, column, mean=False):
    """(time, value) of a set's displacement or force in every increment."""
    values = []
    for block, of, time, rows in found:
        if block == kind and of == name.upper() and rows:
            values.append((time, sum(row[1 + column] for row in rows) / len(rows) if mean else rows[0][column]))
    return values


def largest(found, kind, value):
    rows = [rows for block, _, _, rows in found if block == kind and rows]
    return max(value(row) for row in rows[-1]) if rows else float("nan")


def increments(job):
    """Time reached, increments, iterations, and increments that were cut back."""
    reached, count, iterations, cut = 0.0, 0, 0, 0
    if os.path.exists(job + ".sta"):
        with open(job + ".sta", encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if len(words) >= 7 and words[0].isdigit():
                    count, reached = count + 1, float(words[4])
                    cut += int(re.sub(r"\D", "", words[2])) - 1
    if os.path.exists(job + ".cvg"):
        with open(job + ".cvg", encoding="utf-8") as file:
            iterations = sum(1 for line in file if line.split() and line.split()[0].isdigit())
    return reached, count, iterations, cut
