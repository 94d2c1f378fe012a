#!/usr/bin/env python3
"""Refuses a header that does not compile alone.

usage: check_headers.py ROOT BUILD    checks ROOT/src/wend as BUILD/compile_commands.json has sources compiled;
                                      exit status 1 and the compiler's first error for each offence
"""

import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# Has all the definitions that any header needs.
MODEL = "scene/ray_caster.cpp"
TAKES_VALUE = ("-isystem", "-include", "-D", "-I", "-U")


def command_of(entry):
    """A compiler's call without its input, output and warnings."""
    words = shlex.split(entry["command"])
    while Path(words[0]).name == "ccache":
        words.pop(0)
    kept = [words[0]]
    for word, following in zip(words[1:], words[2:] + [""]):
        if word in TAKES_VALUE:
            kept += [word, following]
        elif word.startswith(("-I", "-D", "-U", "-std=", "-f")):
            kept.append(word)
    return kept


def error_of(header, command, folder):
    """The first error of a source that includes nothing but this header, or None."""
    result = subprocess.run([*command, "-fsyntax-only", "-x", "c++", "-include", str(header), os.devnull], cwd=folder,
                            capture_output=True, text=True)
    if result.returncode == 0:
        return None
    return next((line for line in result.stderr.splitlines() if "error" in line), result.stderr)


def offences(root, build):
    sources = Path(root).resolve() / "src" / "wend"
    entries = json.loads((Path(build) / "compile_commands.json").read_text())
    entry = next(e for e in entries if e["file"].endswith(MODEL))
    command = command_of(entry)
    headers = sorted(sources.rglob("*.h"))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        errors = pool.map(lambda header: error_of(header, command, entry["directory"]), headers)
    return [error for error in errors if error]


def main():
    found = offences(sys.argv[1], sys.argv[2])
    print(*found, sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
