"""Lines of each package that the last runs went through: BUILD/lines.md from the counters that a build with --coverage has left in BUILD."""

import json
import pathlib
import subprocess
import sys


def main(build):
    build = pathlib.Path(build).resolve()
    source = pathlib.Path(__file__).resolve().parent.parent
    command = ["gcovr", "--root", source, "--filter", f"{source}/(packages|apps)/", "--json-summary", "-j", "2", build]
    report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)
    packages = {}
    for file in report["files"]:
        package = packages.setdefault("/".join(pathlib.Path(file["filename"]).parts[:2]), {"lines": 0, "run": 0, "missed": []})
        package["lines"] += file["line_total"]
        package["run"] += file["line_covered"]
        package["missed"].append((file["line_total"] - file["line_covered"], pathlib.Path(file["filename"]).name))
    if not packages:
        sys.exit(f"{build}: no counters; ./dev coverage builds with them and runs the tests")
    text = "| package | lines | run | | files with most lines not run |\n|---|---|---|---|---|\n"
    for name, package in sorted(packages.items()):
        most = ", ".join(f"`{file}` {missed}" for missed, file in sorted(package["missed"], reverse=True)[:3] if missed)
        text += f"| {name} | {package['lines']} | {package['run']} | {100 * package['run'] / max(package['lines'], 1):.1f} % | {most} |\n"
    (build / "lines.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main(sys.argv[1])
