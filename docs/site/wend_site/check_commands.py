"""Commands of the program in the site's own pages have subcommands and options that there are."""

import re
import shlex
from collections.abc import Iterator

from .options import option_names

BLOCK = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
PROGRAM = re.compile(r"(?:^|/)wend$")
END = {"|", "&&", "||", ";", ">", "&"}


def offences(text: str, tree: list[dict], page: str) -> Iterator[str]:
    """A line for each command of a page that the program would refuse."""
    known = {command["name"]: option_names(command) for command in tree}
    for block in BLOCK.findall(text):
        for line in block.replace("\\\n", " ").split("\n"):
            yield from line_offences(line, known, page)


def line_offences(line: str, known: dict[str, set[str]], page: str) -> Iterator[str]:
    for said in program_calls(shlex.split(line, comments=True)):
        command = next((word for word in said if word and word in known), "")
        if not command and not (said and set(said) <= known[""]):
            yield f"{page}: {line.strip()}: there is no such subcommand"
            continue
        for word in said:
            name = word.split("=")[0]
            if re.match(r"--?[a-z]", name) and name not in known[command] | known[""]:
                yield f"{page}: {line.strip()}: wend {command} has no option {name}"


def program_calls(words: list[str]) -> Iterator[list[str]]:
    """What is said to the program in a line of a shell: what follows its name where a command begins."""
    command: list[str] = []
    for word in [*words, ";"]:
        if word not in END:
            command.append(word)
            continue
        while command and (re.match(r"\w+=", command[0]) or command[0] == "time"):
            command.pop(0)
        if command and command[0] == "mpirun" and "wend" in command:
            command = command[command.index("wend") :]
        if command and PROGRAM.search(command[0]):
            yield command[1:]
        command = []
