"""Pages that show what documents link to: sources, folders of them, and notebooks."""

import json
import os
from pathlib import PurePosixPath

from .layout import INDEXED, Layout, source_page

LANGUAGES = {
    ".cpp": "cpp", ".h": "cpp", ".hpp": "cpp", ".c": "c", ".py": "python", ".sh": "bash", ".txt": "text", ".cmake": "cmake",
    ".json": "json", ".toml": "toml", ".usda": "text", ".pbrt": "text",
}
NAMES = {"CMakeLists.txt": "cmake", "Dockerfile": "docker"}


def stage_sources(layout: Layout) -> None:
    """Writes a page for each file and folder that is linked to and has none; those of folders link to their files."""
    files = set()
    for path in sorted(layout.linked_sources):
        if (layout.root / path).is_dir():
            inside = [p for p in sorted((layout.root / path).iterdir()) if p.is_file()]
            names = [p.relative_to(layout.root).as_posix() for p in inside]
            files.update(name for name in names if layout.page_of(name) is None)
            layout.write(source_page(path), folder_page(layout, path, names))
        else:
            files.add(path)
    for path in sorted(files):
        layout.write(source_page(path), file_page(layout, path))


def folder_page(layout: Layout, path: str, names: list[str]) -> str:
    here = layout.pages / source_page(path)
    lines = ["---", "orphan: true", "---", "", f"# {path}", ""]
    for name in names:
        page = layout.page_of(name) or source_page(name)
        lines.append(f"- [{PurePosixPath(name).name}]({os.path.relpath(layout.pages / page, here.parent)})")
    return "\n".join(lines) + "\n"


def file_page(layout: Layout, path: str) -> str:
    here = layout.pages / source_page(path)
    name = PurePosixPath(path)
    language = NAMES.get(name.name) or LANGUAGES.get(name.suffix, "text")
    file = os.path.relpath(layout.root / path, here.parent)
    return f"---\norphan: true\n---\n\n# {path}\n\n```{{literalinclude}} {file}\n:language: {language}\n```\n"


def stage_notebooks(layout: Layout) -> None:
    """Writes a page for each notebook: what it says and does, as it is stored, without results."""
    folder = "examples/notebooks"
    titles = []
    for path in sorted((layout.root / folder).glob("*.ipynb")):
        name = path.relative_to(layout.root).as_posix()
        layout.write(layout.page_of(name) or name, layout.rewritten(notebook_text(json.loads(path.read_text())), name))
        titles.append(path.stem)
    lines = ["# Notebooks", "", "They are in `examples/notebooks`; the tests execute them.", "", "```{toctree}", *titles, "```"]
    layout.write(INDEXED[folder], "\n".join(lines) + "\n")


def notebook_text(notebook: dict) -> str:
    parts = []
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        parts.append(source if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
    return "\n\n".join(parts) + "\n"
