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


def kinds_in(package: Path) -> dict[str, str]:
    """The directive for each class and function of a package; of other names there is none."""
    kinds = {}
    for path in package.glob("*.py"):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef):
                kinds[node.name] = "autoexception" if node.name.endswith(("Error", "Warning")) else "autoclass"
            elif isinstance(node, ast.FunctionDef):
                kinds[node.name] = "autofunction"
    return kinds


def module_page(module: str, names: list[str], path: Path) -> str:
    lines = [f"# {module}", "", "```{eval-rst}", f".. automodule:: {module}", "   :no-members:", "```", ""]
    kinds = kinds_in(path.parent)
    for name in names:
        kind = kinds.get(name, "autodata")
        lines += [f"## {name}", "", "```{eval-rst}", f".. {kind}:: {module}.{name}"]
        lines += [*(["   :members:"] if kind == "autoclass" else []), "```", ""]
    return "\n".join(lines)
