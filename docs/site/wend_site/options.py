"""Pages of the program's options: one for each subcommand, as the program itself lists them."""

import json
import re
import subprocess
from pathlib import Path

from .layout import Layout

SPECIAL = re.compile(r"([\\`*_{}\[\]<>#|$~])")
OPTION = re.compile(r"(?<![\w-])--?[a-z][a-z-]*")


def command_tree(program: Path) -> list[dict]:
    """What the program's command line takes: the program itself, then its subcommands."""
    printed = subprocess.run([program, "man-page", "--format", "json"], check=True, capture_output=True, text=True)
    return json.loads(printed.stdout)


def stage_options(layout: Layout, tree: list[dict]) -> None:
    """Writes the page of each subcommand, and one that lists them."""
    program, *commands = tree
    names = {command["name"]: option_names(command) for command in tree}
    for command in commands:
        layout.write(f"options/{command['name']}.md", command_page(command, names[command["name"]]))
    layout.write("options/index.md", index_page(program, commands, names[""]))


def option_names(command: dict) -> set[str]:
    """All names of a command's options."""
    return {name for option in command["options"] for name in option["names"]}


def program_name(command: dict) -> str:
    return f"wend {command['name']}".strip()


def words(text: str, command: dict, known: set[str]) -> str:
    """A description as Markdown: nothing in it is markup, and options are links."""
    parts = []
    end = 0
    for match in OPTION.finditer(text):
        parts.append(SPECIAL.sub(r"\\\1", text[end : match.start()]))
        name = match[0]
        parts.append(f"{{option}}`{name} <{program_name(command)} {name}>`" if name in known else f"`{name}`")
        end = match.end()
    parts.append(SPECIAL.sub(r"\\\1", text[end:]))
    return "".join(parts)


def value_of(option: dict) -> str:
    text = "|".join(option["choices"]) or option["value"]
    return text + (" ..." if option["is_repeated"] and text else "")


def facts_of(option: dict, command: dict, known: set[str]) -> list[str]:
    """What is to be said of an option beside its description."""
    facts = []
    if option["is_required"]:
        facts.append("Required.")
    if option["default_value"] and "default" not in option["description"]:
        facts.append(f"Default: `{option['default_value']}`.")
    if option["range"]:
        facts.append(f"Values: {words(option['range'], command, known)}.")
    if option["needs"]:
        facts.append("Only with " + words(" and ".join(option["needs"]), command, known) + ".")
    if option["excludes"]:
        facts.append("Not with " + words(" or ".join(option["excludes"]), command, known) + ".")
    return facts


def entry(option: dict, command: dict, known: set[str]) -> list[str]:
    value = value_of(option)
    signature = ", ".join(name + (f" {value}" if value and name.startswith("-") else "") for name in option["names"])
    lines = [f"::::{{option}} {signature}", words(option["description"], command, known)]
    facts = facts_of(option, command, known)
    if facts:
        lines += ["", " ".join(facts)]
    return [*lines, "::::", ""]


def usage(command: dict) -> str:
    places = [argument["names"][0] + (" ..." if argument["is_repeated"] else "") for argument in command["arguments"]]
    return " ".join([program_name(command), "[OPTIONS]", *places])


def entries(command: dict, known: set[str]) -> list[str]:
    lines = [f"```{{program}} {program_name(command)}", "```", ""]
    if command["arguments"]:
        lines += ["## Arguments", ""]
        for argument in command["arguments"]:
            lines += entry(argument, command, known)
    group = None
    for option in command["options"]:
        if option["group"] != group:
            group = option["group"]
            lines += [f"## {group}", ""]
        lines += entry(option, command, known)
    return lines


def command_page(command: dict, known: set[str]) -> str:
    description = words(command["description"], command, known)
    lines = [f"# {program_name(command)}", "", description[0].upper() + description[1:] + ".", "", "```text", usage(command), "```", ""]
    lines += entries(command, known)
    if command["footer"]:
        lines += ["## Examples", "", "```text", command["footer"].strip(), "```", ""]
    return "\n".join(lines)


def index_page(program: dict, commands: list[dict], known: set[str]) -> str:
    lines = [
        "# Options",
        "",
        "These pages are what `wend COMMAND --help` says, written by the program itself when the site was built.",
        "",
        "| command | does |",
        "| --- | --- |",
    ]
    for command in commands:
        lines.append(f"| [`wend {command['name']}`]({command['name']}.md) | {words(command['description'], command, set())} |")
    lines += ["", *entries(program, known), "```{toctree}", ":hidden:", ""]
    lines += [command["name"] for command in commands]
    return "\n".join([*lines, "```", ""])
