#!/usr/bin/env python3
"""Lists headers of src, one a line: compiled alone, they and the sources compile every header alone.

usage: headers_alone.py ROOT MODULE...    of src/wend/MODULE; openpgl brings src/openpgl, and all of them the umbrella headers
"""

import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def first_include(path):
    found = INCLUDE.search(path.read_text())
    return found and found[1]


def headers_of(source, modules):
    folders = [source / "wend" / module for module in modules] + ([source / "openpgl"] if "openpgl" in modules else [])
    headers = [path for folder in folders for path in sorted(folder.rglob("*.h"))]
    headers += [path for path in sorted((source / "wend").glob("*.hpp"))]
    return {path.relative_to(source).as_posix(): path for path in headers}


def to_compile(root, modules):
    headers = headers_of(root / "src", modules)
    first = {header: first_include(path) for header, path in headers.items()}
    covered = set()

    def cover(header):
        # What is compiled alone begins with what it includes first.
        while header in headers and header not in covered:
            covered.add(header)
            header = first[header]

    for folder in ("src/wend", "tests"):
        for module in modules:
            for source in (root / folder / module).rglob("*.cpp"):
                cover(first_include(source))
    rest = [header for header in headers if header not in covered]
    begun_with = {first[header] for header in rest}
    return [header for header in rest if header not in begun_with]


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    print("\n".join(to_compile(Path(sys.argv[1]), sys.argv[2:])))
