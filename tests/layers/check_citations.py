#!/usr/bin/env python3
"""Every citation key has an entry in docs/references.bib, and no two entries share a key.

A citation is the first author's name and the year, such as duff2017 (and duff2017b for the next of that year): in any comment of the sources, and in backticks or
brackets in the documents.

usage: check_citations.py ROOT    exit status 1 and one line per offence
"""

import re
import sys
from collections import Counter
from pathlib import Path

KEY = r"[a-z]+(?:19[0-9]{2}|20[0-4][0-9])[a-z]?"
NOT_CITATIONS = {"rec2020"}  # a colour space that scene files name
IN_COMMENT = re.compile(rf"(?<![\w./-])({KEY})(?![\w/-])(?!\.\w)")
IN_DOCUMENT = re.compile(rf"[`(\[]({KEY})(?=[`)\],;:. ])")
COMMENT = re.compile(r"//.*")
ENTRY = re.compile(rf"^@\w+\{{\s*({KEY})\s*,", re.MULTILINE)
FOLDERS = ("src", "tests", "bench", "fuzz", "examples")


def citations(path, text):
    """Pairs of line number and key in one file."""
    for number, line in enumerate(text.splitlines(), 1):
        if path.suffix == ".md":
            keys = IN_DOCUMENT.findall(line)
        else:
            keys = [key for comment in COMMENT.findall(line) for key in IN_COMMENT.findall(comment)]
        for key in keys:
            if key not in NOT_CITATIONS:
                yield number, key


def files(root):
    for folder in FOLDERS:
        yield from (p for p in sorted((root / folder).rglob("*")) if p.suffix in (".h", ".inl", ".cpp"))
    yield from sorted(root.glob("*.md"))
    yield from sorted((root / "docs").rglob("*.md"))


def offences(root):
    bibliography = root / "docs" / "references.bib"
    entries = Counter(ENTRY.findall(bibliography.read_text()))
    for key, count in entries.items():
        if count > 1:
            yield f"{bibliography}: {key} has {count} entries"
    for path in files(root):
        for number, key in citations(path, path.read_text()):
            if key not in entries:
                yield f"{path}:{number}: {key} is not in {bibliography}"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(offences(Path(sys.argv[1])))
    print("\n".join(found) or "every citation has its entry")
    sys.exit(1 if found else 0)
