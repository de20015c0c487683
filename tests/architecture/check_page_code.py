"""The C++ code of docs/embedding.md is that of the application in tests/install/consumer, which is compiled and run: python3 check_page_code.py SOURCE

Indentation and the word "inline" may differ. A line of three dots on the page stands for any code."""

import pathlib
import re
import sys


def normalised(code):
    return " ".join(re.sub(r"\binline ", "", code).split())


source = pathlib.Path(sys.argv[1])
page = (source / "docs/embedding.md").read_text()
sources = [normalised(path.read_text()) for path in sorted((source / "tests/install/consumer").glob("*.[hc]pp"))]
blocks = re.findall(r"```cpp\n(.*?)```", page, flags=re.S)
if len(blocks) < 2:
    sys.exit(f"only {len(blocks)} blocks of code were found on docs/embedding.md")
for block in blocks:
    parts = [normalised(part) for part in re.split(r"\n\s*\.\.\.\n", block)]
    if not any(all(part in text for part in parts) for text in sources):
        sys.exit(f"this code of docs/embedding.md is in no source of tests/install/consumer:\n{block}")
print(f"{len(blocks)} blocks of code on docs/embedding.md are compiled")
