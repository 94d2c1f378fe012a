"""Pages of the Python package, of its docstrings."""

import ast
from pathlib import Path

from .layout import Layout

HEAD = """# Python

[Wend in Python](../../guides/python.md) is the way in. Here is each name with its parameters.
"""


def stage_python(layout: Layout) -> None:
    """Writes a page for the package and one for each of its modules that others may import."""
    package = layout.root / "python" / "wend"
    exported = names_in(package / "__init__.py")
    layout.write("api/python/wend.md", module_page("wend", [name for name in exported if name != "guide"], package / "__init__.py"))
    layout.write("api/python/guide.md", module_page("wend.guide", names_in(package / "guide.py"), package / "guide.py"))
    for module in ("usd", "blend"):
        path = package / f"{module}.py"
        layout.write(f"api/python/{module}.md", module_page(f"wend.{module}", public_functions(path), path))
    toctree = ["```{toctree}", "", "wend", "guide", "usd", "blend", "```", ""]
    layout.write("api/python/index.md", "\n".join([HEAD, *toctree]))


def names_in(path: Path) -> list[str]:
    """What a module's __all__ lists."""
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            return ast.literal_eval(node.value)
    raise ValueError(f"{path}: it has no __all__")


def public_functions(path: Path) -> list[str]:
    """The functions of a module but its command line's."""
    names = [node.name for node in ast.parse(path.read_text()).body if isinstance(node, ast.FunctionDef)]
    return [name for name in names if not name.startswith("_") and name != "main"]


def kind_of(name: str) -> str:
    if name.endswith(("Error", "Warning")):
        return "autoexception"
    if name[0].isupper():
        return "autoclass"
    return "autodata" if name.endswith("dtype") else "autofunction"


def module_page(module: str, names: list[str], path: Path) -> str:
    lines = [f"# {module}", "", "```{eval-rst}", f".. automodule:: {module}", "   :no-members:", "", f".. currentmodule:: {module}", ""]
    for name in names:
        kind = kind_of(name)
        lines += [f".. {kind}:: {name}", *(["   :members:"] if kind == "autoclass" else []), ""]
    return "\n".join([*lines, "```", ""])
