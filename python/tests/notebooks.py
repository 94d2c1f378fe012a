"""Executes the notebooks of a folder, each in a kernel of its own. A cell that fails ends it with that cell's error.

usage: notebooks.py FOLDER [NAME...]
"""

import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient


def main() -> None:
    folder, names = Path(sys.argv[1]), sys.argv[2:]
    for file in sorted(folder.glob("*.ipynb")):
        if names and file.stem not in names:
            continue
        start = time.monotonic()
        notebook = nbformat.read(file, as_version=4)
        assert not any(cell.get("outputs") for cell in notebook.cells), f"{file.name} was saved with its outputs"
        NotebookClient(notebook, timeout=300, kernel_name="python3",
                       resources={"metadata": {"path": str(folder)}}).execute()
        print(f"{file.name}: {time.monotonic() - start:.0f} s", flush=True)


if __name__ == "__main__":
    main()
