"""Values in the results of CalculiX: each is the request for a deck that prints them, and a function of the blocks of numbers and the time of the end."""
import re


def blocks_of(text):
    """Blocks of numbers below a headline: kind, set, time, rows."""
    headline = re.compile(r"^ *(displacements|total force|contact stress|statistics)\b.*?(?:set ([^ ,]+))?(?:, master set [^ ]+)? and time +([-+.\dE]+)")
    blocks, rows = [], None
    for line in text.splitlines():
        match = headline.match(line)
        words = line.split()
        if match:
            rows = []
            blocks.append((match.group(1), (match.group(2) or "").upper(), float(match.group(3)), rows))
        elif words and rows is not None:
            try:
                rows.append([float(word) for word in words])
            except ValueError:
                rows = rows if blocks[-1][0] == "statistics" else None
    return blocks


def last(blocks, kind, name, end):
    return [rows for block, of, time, rows in blocks if block == kind and of == name.upper() and time <= end + 1e-9][-1]


def mean(name, component, nodes=None):
    """Mean of a displacement over the nodes of a set."""
    def value(blocks, end):
        rows = [row for row in last(blocks, "displacements", name, end) if nodes is None or int(row[0]) in nodes]
        return sum(row[1 + component] for row in rows) / len(rows)
    return (f"*NODE PRINT,NSET={name}", "U"), value


def largest(name, component, nodes=None):
    """Largest absolute displacement of the nodes of a set."""
    def value(blocks, end):
        return max(abs(row[1 + component]) for row in last(blocks, "displacements", name, end) if nodes is None or int(row[0]) in nodes)
    return (f"*NODE PRINT,NSET={name}", "U"), value


def reaction(name, component, share=1.0):
    """Sum of the reactions on a set. A set that the deck gives twice has each node twice: then the share is 0.5."""
    return (f"*NODE PRINT,NSET={name},TOTALS=ONLY", "RF"), lambda blocks, end: share * last(blocks, "total force", name, end)[0][component]


def force(slave, master, component):
    """Contact force on the slave; pairs of surfaces alone have it."""
    return (f"*CONTACT PRINT,SLAVE={slave},MASTER={master}", "CF"), lambda blocks, end: last(blocks, "statistics", slave, end)[0][component]


def pressure(slave, master):
    """Normal force over the area that is closed."""
    def value(blocks, end):
        area, normal, _ = last(blocks, "statistics", slave, end)[3]
        return -normal / area
    return (f"*CONTACT PRINT,SLAVE={slave},MASTER={master}", "CF"), value


def peak():
    """Largest pressure of a slave node, or of an integration point between two surfaces."""
    return ("*CONTACT PRINT", "CSTR"), lambda blocks, end: max(row[-3] for row in last(blocks, "contact stress", "", end))


def times(factor, measure):
    request, value = measure
    return request, lambda blocks, end: factor * value(blocks, end)
