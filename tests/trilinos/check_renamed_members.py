"""Compiles what a host uses against headers of Trilinos whose members have the names of later versions.

Debian 12 has Trilinos 13.2, where members of maps, graphs and matrices have names that are gone since 14. Code takes them by the functions of
mortise/core/trilinos_versions.hpp. Here the installed headers are copied with the new names, the version 17.0 and without what 13.2 calls deprecated.
Public headers and sources are checked against the copy, without code that runs. An old spelling does not compile.

    check_renamed_members.py COMPILER SOURCE SCRATCH INCLUDE_DIRECTORY...
"""

import pathlib
import re
import shutil
import subprocess
import sys

NOT_NEEDED = 77
NAMES = {
    "getNodeNumElements": "getLocalNumElements",
    "getNodeElementList": "getLocalElementList",
    "getNodeNumRows": "getLocalNumRows",
    "getNodeNumCols": "getLocalNumCols",
    "getNodeNumEntries": "getLocalNumEntries",
    "getNodeMaxNumRowEntries": "getLocalMaxNumRowEntries",
    "getNodeAllocationSize": "getLocalAllocationSize",
}
OLD = re.compile("|".join(NAMES))

compiler, source, scratch, *directories = sys.argv[1:]
source, scratch = pathlib.Path(source), pathlib.Path(scratch)
installed = next((pathlib.Path(d) for d in directories if (pathlib.Path(d) / "Trilinos_version.h").exists()), None)
if installed is None:
    sys.exit(f"Trilinos_version.h is in none of {directories}")
version = int(re.search(r"TRILINOS_MAJOR_MINOR_VERSION\s+(\d+)", (installed / "Trilinos_version.h").read_text()).group(1))
if version >= 130400:
    print(f"Trilinos {version} has the new names itself")
    sys.exit(NOT_NEEDED)


def renamed(name, text):
    """A header as later versions have it."""
    if name == "Trilinos_version.h":
        return re.sub(r"(TRILINOS_MAJOR_MINOR_VERSION\s+)\d+", r"\g<1>170000", text)
    if name.endswith("_config.h"):
        return re.sub(r"#define \w+_ENABLE_DEPRECATED_CODE\b.*", "", text)
    return OLD.sub(lambda old: NAMES[old.group()], text)


def copy_renamed():
    """All of them: of a link a compiler may take what stands beside the file itself."""
    target = scratch / "include"
    shutil.rmtree(target, ignore_errors=True)
    changed = 0
    for header in installed.rglob("*"):
        if header.is_dir():
            continue
        at = target / header.relative_to(installed)
        at.parent.mkdir(parents=True, exist_ok=True)
        text = header.read_text(errors="surrogateescape")
        new = renamed(header.name, text)
        at.write_text(new, errors="surrogateescape")
        changed += new != text
    if changed < 20:
        sys.exit(f"only {changed} headers of {installed} have names to change")
    return target


def package(name):
    return source / "packages" / name


def check(name, files, private=()):
    """One source that includes them all."""
    all_in_one = scratch / f"{name}.cpp"
    all_in_one.write_text("".join(f'#include "{file}"\n' for file in files))
    flags = ["-std=c++17", "-DOMPI_SKIP_MPICXX", "-fsyntax-only"]
    flags += [f"-I{directory}" for directory in private]
    known = {pathlib.Path("/usr/include"), installed.resolve()}
    own = [str(one) for one in sorted((source / "packages").glob("*/include"))]
    for directory in [str(include), *own] + [d for d in directories if pathlib.Path(d).resolve() not in known]:
        flags += ["-isystem", directory]
    run = subprocess.run([compiler, *flags, str(all_in_one)], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{name} does not compile with the names of later versions:\n" + run.stderr[:4000])
    print(f"{len(files)} files of {name}")


include = copy_renamed()
check("headers", [header for name in ["core", "shape", "contact", "thermal_contact", "plain", "nonlinear", "thyra"] for header in sorted((package(name) / "include").rglob("*.hpp"))])
for name in ["core", "contact", "thermal_contact", "plain", "nonlinear", "thyra"]:
    # The adapter of Amesos2 13.2 for MUMPS uses itself what 13.2 calls deprecated.
    check(name, [file for file in sorted((package(name) / "src").rglob("*.cpp")) if file.name != "mumps_adapter.cpp"], [package(name) / "src"])
# Sources of mortar have names in common and cannot be one; few of them ask maps and matrices.
asking = [file for file in sorted((package("mortar") / "src").rglob("*.cpp")) if "trilinos_versions.hpp" in file.read_text()]
check("mortar", asking, [package("mortar") / "src"])
