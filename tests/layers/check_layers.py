#!/usr/bin/env python3
"""Refuses an include that goes up: a room of src/wend may include itself and lower rooms only (docs/architecture.md).

usage: check_layers.py ROOT    checks ROOT/src/wend; exit status 1 and one line per offence
"""

import re
import sys
from pathlib import Path

LEVEL = {
    "core": 0,
    "numeric": 1, "stats": 1,
    "sampling": 2,
    "medium": 3,
    "adjoint": 4,
    "theory": 5, "guide": 5, "decision": 5,
    "capi": 6, "scene": 6, "film": 6,
    "integrator": 7,
    "io": 8,
    "app": 9,
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def may_include(room, other):
    """Rooms of one level do not see each other: that is what keeps decisions free of any particular supplier of answers."""
    return room == other or LEVEL[other] < LEVEL[room]


def offence_of_line(room, line):
    """What is wrong with one line of a file in the given room, or None."""
    match = INCLUDE.match(line)
    if not match:
        return None
    bracket, path = match.groups()
    if bracket == '"':
        return f'"{path}": the include path is <wend/room/file.h>'
    parts = path.split("/")
    if parts[0] != "wend":
        return None
    other = parts[1]
    if other not in LEVEL:
        return f"<{path}>: unknown room '{other}'"
    if not may_include(room, other):
        return f"<{path}>: {room} (level {LEVEL[room]}) must not see {other} (level {LEVEL[other]})"
    return None


def offences(root):
    source = Path(root) / "src" / "wend"
    for entry in sorted(source.iterdir()):
        if not entry.is_dir():
            yield f"{entry}: every file belongs to a room"
        elif entry.name not in LEVEL:
            yield f"{entry}: unknown room '{entry.name}'; known are {', '.join(LEVEL)}"
        else:
            for file in sorted(p for p in entry.rglob("*") if p.suffix in (".h", ".inl", ".cpp")):
                for number, line in enumerate(file.read_text().splitlines(), 1):
                    offence = offence_of_line(entry.name, line)
                    if offence:
                        yield f"{file}:{number}: {offence}"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(offences(sys.argv[1]))
    print("\n".join(found) or "no include goes up")
    sys.exit(1 if found else 0)
