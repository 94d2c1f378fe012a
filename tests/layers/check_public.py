#!/usr/bin/env python3
"""Refuses a difference between the headers that are installed and those that the promised ones include.

usage: check_public.py ROOT    reads cmake/public-headers.txt; exit status 1 and one line per offence

Promised are the umbrella headers src/wend/*.hpp and those of capi. What they include comes with them, and nothing else.
wend/version.h, which CMake writes, is not counted.
"""

import re
import sys
from pathlib import Path

INCLUDE = re.compile(r"^\s*#\s*include\s*<(wend/[^>]+)>", re.MULTILINE)
MADE = "wend/version.h"
MOST = 40


def closure(source, headers):
    found, todo = set(), list(headers)
    while todo:
        header = todo.pop()
        if header not in found and header != MADE:
            found.add(header)
            todo += INCLUDE.findall((source / header).read_text())
    return found


def offences(root):
    source = Path(root) / "src"
    promised = [f"wend/{path.name}" for path in (source / "wend").glob("*.hpp")] + ["wend/capi/guide.h"]
    needed = closure(source, promised)
    listed = set((Path(root) / "cmake" / "public-headers.txt").read_text().split())
    yield from (f"cmake/public-headers.txt lacks {header}" for header in sorted(needed - listed))
    yield from (f"cmake/public-headers.txt: no promised header includes {header}" for header in sorted(listed - needed))
    if len(needed) > MOST:
        yield f"{len(needed)} headers are promised; {MOST} are as many as one can keep"


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    found = list(offences(arguments[1]))
    for offence in found:
        print(offence)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
