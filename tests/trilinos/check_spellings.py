"""Looks for members that later versions of Trilinos do not have: they are taken by functions of mortise/core/trilinos_versions.hpp.

    check_spellings.py SOURCE
"""

import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
old = re.compile(r"\bgetNode(NumElements|ElementList|NumRows|NumCols|NumEntries|MaxNumRowEntries|AllocationSize)\b")
new = re.compile(r"\bgetLocal(NumElements|ElementList|NumRows|NumCols|NumEntries|MaxNumRowEntries|AllocationSize)\b")
allowed = source / "packages/core/include/mortise/core/trilinos_versions.hpp"
found, seen = [], 0
for room in ("packages", "apps", "benchmarks", "tests", "docs"):
    for file in sorted((source / room).rglob("*")):
        if file.suffix not in (".hpp", ".cpp", ".md") or file == allowed:
            continue
        seen += 1
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if old.search(line) or new.search(line):
                found.append(f"{file.relative_to(source)}:{number}: {line.strip()}")
if seen < 500:
    sys.exit(f"only {seen} files were found below {source}")
if found:
    sys.exit("members whose names depend on the version of Trilinos; see mortise/core/trilinos_versions.hpp:\n" + "\n".join(found))
