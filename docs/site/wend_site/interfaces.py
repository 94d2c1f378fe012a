"""Pages of the interfaces for C++ and C, of what Doxygen reads in the promised headers."""

import re
import subprocess
import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from pathlib import Path

from .layout import Layout
from .options import SPECIAL

# The folder of headers for C; all others are for C++.
C_FOLDER = "wend/capi"
SENTENCE_END = re.compile(r"(?<=\w)\. +(?=[A-Z])")

CPP_HEAD = """# C++

What `<wend/guide.hpp>`, `<wend/subsurface.hpp>` and `<wend/render.hpp>` include is promised, and is here by header. All names are in the namespace `wend`, but for those with a longer one. [A learned field in your renderer](../../guides/embedding.md) and [walks inside dense media](../../guides/subsurface_in_your_renderer.md) show how they go together; [the tutorial](../../tutorials/renderer_author.md) is the shortest way in.
"""

C_HEAD = """# C

`<wend/capi/guide.h>` includes all of it. The [tutorial](../../tutorials/renderer_author.md) builds a program with it.

```{doxygengroup} wend_c
:desc-only:
```
"""


def run_doxygen(doxyfile: Path, output: Path) -> Path:
    """Reads the promised headers; the folder of its XML, fit for Breathe."""
    output.mkdir(parents=True, exist_ok=True)
    settings = doxyfile.read_text() + (
        f'\nOUTPUT_DIRECTORY = "{output}"\nGENERATE_XML = YES\nGENERATE_HTML = NO\nXML_PROGRAMLISTING = NO\n'
    )
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)
    make_fit_for_breathe(output / "xml")
    return output / "xml"


def make_fit_for_breathe(folder: Path) -> None:
    """Files are known by their whole paths, for names such as field.h come twice; what is in a namespace is a file's own, for
    a namespace of many files would be declared on each of their pages; and what is private is left out."""
    index = ElementTree.parse(folder / "index.xml")
    for compound in index.getroot().iter("compound"):
        path = folder / f"{compound.get('refid')}.xml"
        tree = ElementTree.parse(path)
        for definition in tree.getroot().iter("compounddef"):
            if definition.get("kind") == "file":
                find(compound, "name").text = find(definition, "location").get("file")
                for namespace in definition.findall("innernamespace"):
                    definition.remove(namespace)
            for section in definition.findall("sectiondef"):
                if section.get("kind", "").startswith("private"):
                    definition.remove(section)
        tree.write(path, encoding="utf-8", xml_declaration=True)
    index.write(folder / "index.xml", encoding="utf-8", xml_declaration=True)


def find(element: ElementTree.Element, name: str) -> ElementTree.Element:
    found = element.find(name)
    if found is None:
        raise ValueError(f"Doxygen's XML: a <{element.tag}> lacks its <{name}>")
    return found


def stage_interfaces(layout: Layout) -> None:
    """Writes a page for each promised header, and one for each folder of them."""
    modules = defaultdict(list)
    for line in (layout.root / "cmake" / "public-headers.txt").read_text().split():
        header = Path(line)
        # The umbrella headers declare nothing of their own.
        if len(header.parts) > 2:
            modules[header.parent.as_posix()].append(header)
    for module, headers in modules.items():
        for header in headers:
            layout.write(f"{folder_of(module)}/{header.stem}.md", header_page(layout, header))
        if module != C_FOLDER:
            layout.write(f"{folder_of(module)}/index.md", module_page(layout, f"# {module}\n", headers))
    layout.write("api/c/index.md", module_page(layout, C_HEAD, modules.pop(C_FOLDER)))
    layout.write("api/cpp/index.md", cpp_page(layout, modules))


def cpp_page(layout: Layout, modules: dict[str, list[Path]]) -> str:
    lines = [CPP_HEAD]
    for module, headers in modules.items():
        lines += [f"## {module}", "", *table(layout, headers, f"{Path(module).name}/"), ""]
    lines += ["```{toctree}", ":hidden:", "", *(f"{Path(module).name}/index" for module in modules), "```", ""]
    return "\n".join(lines)


def folder_of(module: str) -> str:
    return "api/c" if module == C_FOLDER else f"api/cpp/{Path(module).name}"


def header_page(layout: Layout, header: Path) -> str:
    about = SPECIAL.sub(r"\\\1", header_comment(layout.root / "src" / header))
    return f"# {header.name}\n\n`#include <{header}>`\n\n{about}\n\n```{{doxygenfile}} {header}\n```\n"


def header_comment(path: Path) -> str:
    """The comment that a header begins with; where there is none, the first of what it declares."""
    text = path.read_text()
    if text.startswith("/*"):
        lines = text[2 : text.index("*/")].strip("*").split("\n")
        return " ".join(line.strip(" *") for line in lines)
    if not text.startswith("//"):
        text = text[max(text.find("\n///") + 1, 0) :]
    lines = []
    for line in text.split("\n"):
        if not line.startswith("//"):
            break
        lines.append(line.lstrip("/").strip())
    return " ".join(lines)


def module_page(layout: Layout, head: str, headers: list[Path]) -> str:
    lines = [head, *table(layout, headers, ""), "", "```{toctree}", ":hidden:", "", *(header.stem for header in headers), "```", ""]
    return "\n".join(lines)


def table(layout: Layout, headers: list[Path], folder: str) -> list[str]:
    """What each header is about, in its own first sentence."""
    lines = ["| header | about |", "| --- | --- |"]
    for header in headers:
        about = SPECIAL.sub(r"\\\1", SENTENCE_END.split(header_comment(layout.root / "src" / header))[0].rstrip("."))
        lines.append(f"| [{header.name}]({folder}{header.stem}.md) | {about} |")
    return lines
