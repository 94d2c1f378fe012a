#!/usr/bin/env python3
"""Runs the commands of the tutorials as they stand there, from the repository, and prints what they print.

usage: run_tutorials.py [NAME...]    NAME such as researcher; without names, all of them

Wend has to be built in build/release with its Python package, and `./run build` to have made its environments of Python.
What the commands write goes to out/. A page ends at its first command that fails.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BLOCK = re.compile(r"^```(sh|python)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def script_of(text: str) -> str:
    """The commands of a page as a script of bash that says each before it runs."""
    parts = ["set -ev"]
    for language, code in BLOCK.findall(text):
        parts.append(code if language == "sh" else f"build/python/bin/python - <<'END'\n{code}END")
    return "\n".join(parts) + "\n"


def run(page: Path) -> int:
    build = ROOT / "build" / "release"
    environment = {**os.environ, "PATH": f"{build / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": str(build / "python")}
    (ROOT / "out").mkdir(exist_ok=True)
    return subprocess.run(["bash", "-c", script_of(page.read_text())], cwd=ROOT, env=environment, check=False).returncode


def main(names: list[str]) -> None:
    pages = {page.stem: page for page in sorted((HERE / "tutorials").glob("*.md"))}
    unknown = sorted(set(names) - set(pages))
    if unknown:
        sys.exit(f"run_tutorials.py: no tutorials: {', '.join(unknown)}; there are {', '.join(pages)}")
    failed = [name for name in names or pages if run(pages[name]) != 0]
    if failed:
        sys.exit(f"run_tutorials.py: failed: {', '.join(failed)}")


if __name__ == "__main__":
    if sys.argv[1:2] and sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main(sys.argv[1:])
