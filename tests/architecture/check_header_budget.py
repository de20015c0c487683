"""Cost of the public headers, by the number of lines that a source gets with one of them after the preprocessor, without blank ones.

Tpetra's own header of matrices, which each host includes anyway, is the measure. Headers of contact may cost a tenth more: nothing but our own lines
and the standard library. Eigen, fmt, Sacado, Boost or nlohmann json in a header is felt by each source of every user. A header that needs Eigen and
not Tpetra is cheaper than Tpetra.

    check_header_budget.py COMPILER SOURCE INCLUDE_DIRECTORY...
"""

import pathlib
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

compiler, source, *directories = sys.argv[1:]
flags = ["-std=c++17", "-DOMPI_SKIP_MPICXX", "-x", "c++", "-E", "-P"]
# The compiler's own are in an order that its headers rely on.
for directory in directories:
    if directory and directory != "/usr/include":
        flags += ["-isystem", directory]


def lines(text):
    """Of a source."""
    run = subprocess.run([compiler, *flags, "-"], input=text.encode(), capture_output=True, check=False)
    if run.returncode != 0:
        sys.exit(f"the preprocessor fails on {text}:\n{run.stderr.decode()}")
    return sum(1 for line in run.stdout.splitlines() if line.strip())


root = pathlib.Path(source) / "packages"
headers = [h.relative_to(root / package / "include") for package in ("core", "contact") for h in sorted((root / package / "include").rglob("*.hpp"))]
if len(headers) < 20:
    sys.exit(f"only {len(headers)} headers were found below {root}")
with ThreadPoolExecutor(2) as pool:
    counts = list(pool.map(lines, ["#include <Tpetra_CrsMatrix.hpp>\n"] + [f"#include <{header}>\n" for header in headers]))
tpetra, counts = counts[0], counts[1:]
print(f"{tpetra} Tpetra_CrsMatrix.hpp")
wrong = False
for header, count in zip(headers, counts):
    print(f"{count} {header}")
    if count > 1.1 * tpetra:
        wrong = True
        print(f"{header} costs {count / tpetra:.2f} times Tpetra_CrsMatrix.hpp, allowed is 1.1: move bodies and heavy headers into a source")
sys.exit(1 if wrong else 0)
