#!/usr/bin/env python3
"""Counts what has to know of a phase function, a technique and a learner, and refuses more than CONTRIBUTING.md promises.

usage: check_extensions.py ROOT    exit status 1 and one line per offence

Each has files of its own, and elsewhere in src/wend at most so many lines that name it.
"""

import re
import sys
from pathlib import Path

# What names it, its own files, and where else it may be named in how many lines.
EXTENSIONS = {
    "a phase function": (r"\bDraine\b|\bdraine\b", ["medium/draine.h", "medium/draine.cpp"],
                         {"medium/phase.h": 3, "medium/tabulated_phase.cpp": 1, "io/load/phase_functions.cpp": 6}),
    "a technique": (r"\bInteriorTechnique\b|\binterior_technique\b", ["transport/interior_technique.h"],
                    {"transport/path_technique.h": 5}),
    "a recorder": (r"\bLightRecorder\b|\blight_recorder\b", ["transport/light_recorder.h", "render/light_learner.h"],
                   {"transport/recorders.h": 2}),
    "a learner": (r"\bLightLearner\b|\blight_learner\b", ["render/light_learner.h"],
                  {"render/learners.h": 2, "render/pass.h": 1}),
}


def without_comments(text):
    return re.sub(r"//.*", "", text)


def offences(root):
    source = Path(root) / "src" / "wend"
    files = {path.relative_to(source).as_posix(): without_comments(path.read_text()).splitlines()
             for path in sorted(source.rglob("*")) if path.suffix in (".h", ".hpp", ".cpp")}
    for what, (pattern, own, allowed) in EXTENSIONS.items():
        for missing in (name for name in [*own, *allowed] if name not in files):
            yield f"{what}: there is no {missing}"
        for name, lines in files.items():
            count = sum(1 for line in lines if re.search(pattern, line))
            if name not in own and count > allowed.get(name, 0):
                yield f"{name}: {count} lines name {what} ({pattern}), {allowed.get(name, 0)} are promised"


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
