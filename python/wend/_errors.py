"""What can go wrong with what a user gave."""

from __future__ import annotations


class InputError(ValueError):
    """Bad input: the message says what is wrong, where, and what would be right.

    Attributes:
        file: the file that it is in; empty where there is none.
        line: of the file, from 1; 0 where the whole file is meant.
        column: of the line, in bytes from 1; 0 where the whole line is meant.
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.column = column

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, int, int]]:
        return InputError, (str(self), self.file, self.line, self.column)


class SceneWarning(UserWarning):
    """Something that a scene file asks for and that is done otherwise; the message names the place."""
