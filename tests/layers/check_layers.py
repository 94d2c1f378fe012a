#!/usr/bin/env python3
"""Refuses an include that goes up: a module of src/wend may include itself and lower modules only (docs/architecture.md).
Open PGL's headers in src/openpgl include nothing of Wend, and only the module of that name includes them. A source
begins with the header of its own name. The tables of files in docs/architecture.md name files that there are.

usage: check_layers.py ROOT    checks ROOT/src; exit status 1 and one line per offence
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
    "guide": 5, "planar": 5, "decision": 5,
    "subsurface": 6, "lab": 6, "scene": 6, "film": 6,
    "capi": 7, "openpgl": 7, "light": 7, "io": 7,
    "transport": 8,
    "render": 9,
    "view": 10,
    "app": 11,
    "library": 12,
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def may_include(module, other):
    """Modules of one level do not see each other: that is what keeps decisions free of any particular supplier of answers."""
    return module == other or LEVEL[other] < LEVEL[module]


def offence_of_line(module, line):
    """What is wrong with one line of a file in the given module, or None."""
    match = INCLUDE.match(line)
    if not match:
        return None
    bracket, path = match.groups()
    if bracket == '"':
        return f'"{path}": the include path is <wend/module/file.h>'
    parts = path.split("/")
    if parts[0] == "openpgl" and module != "openpgl":
        return f"<{path}>: Open PGL's interface is for the module openpgl, and for those outside"
    if parts[0] != "wend":
        return None
    other = parts[1]
    if path == "wend/version.h":
        return None  # CMake writes it
    if other not in LEVEL:
        return f"<{path}>: unknown module '{other}'"
    if not may_include(module, other):
        return f"<{path}>: {module} (level {LEVEL[module]}) must not see {other} (level {LEVEL[other]})"
    return None


def begins_with_another(source, file):
    """What is wrong with the first include of a source that has a header of its own name, or None."""
    own = file.with_suffix(".h")
    if file.suffix != ".cpp" or not own.exists():
        return None
    expected = f"#include <{own.relative_to(source).as_posix()}>"
    first = next((line for line in file.read_text().splitlines() if line.startswith("#include")), None)
    return None if first == expected else f"begins with '{first}', not with its own header: {expected}"


def names_without_file(root):
    page, module = Path(root) / "docs" / "architecture.md", None
    for number, line in enumerate(page.read_text().splitlines() if page.exists() else [], 1):
        if title := re.match(r"Files of `(\w+)`:", line):
            module = title.group(1)
        elif line and not line.startswith("|"):
            module = None
        elif module and line:
            for name in re.findall(r"`(\w+)`", line.split("|")[1]):
                if not list((Path(root) / "src" / "wend" / module).glob(f"{name}.*")):
                    yield f"{page}:{number}: {module} has no file {name}"


def offences(root):
    yield from names_without_file(root)
    for file in sorted((Path(root) / "src" / "openpgl").rglob("*.h")):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if match and (match.group(1) == '"' or match.group(2).startswith("wend/")):
                yield f"{file}:{number}: {line.strip()}: a renderer that includes this has nothing of Wend's"
    source = Path(root) / "src" / "wend"
    for entry in sorted(source.iterdir()):
        if entry.suffix == ".hpp":
            continue  # an umbrella header, which only includes
        if not entry.is_dir():
            yield f"{entry}: every file belongs to a module"
        elif entry.name not in LEVEL:
            yield f"{entry}: unknown module '{entry.name}'; known are {', '.join(LEVEL)}"
        else:
            for file in sorted(p for p in entry.rglob("*") if p.suffix in (".h", ".inl", ".cpp")):
                if offence := begins_with_another(source.parent, file):
                    yield f"{file}: {offence}"
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
