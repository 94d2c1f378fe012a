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
    words = shlex.split(line, comments=True)
    for at, word in enumerate(words):
        if not PROGRAM.search(word):
            continue
        said = [*words[at + 1 :], ";"]
        said = said[: next(i for i, other in enumerate(said) if other in END)]
        command = next((other for other in said if other in known), "")
        if not command and not (said and set(said) <= known[""]):
            yield f"{page}: {line.strip()}: there is no such subcommand"
            return
        for option in said:
            name = option.split("=")[0]
            if re.match(r"--?[a-z]", name) and name not in known[command] | known[""]:
                yield f"{page}: {line.strip()}: wend {command} has no option {name}"
        return
