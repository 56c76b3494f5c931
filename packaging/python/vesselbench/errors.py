"""What is raised. Catch VesselbenchError for all of it."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .results import Diagnostic, Remedy


class VesselbenchError(Exception):
    """A command could not be done: exit code 1, unless it is one of the classes below."""

    def __init__(self, message: str, *, exit_code: int | None = None, diagnostics: tuple[Diagnostic, ...] = (),
                 edit: int | None = None, command: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.message = message  #: what is wrong, and what to try
        self.exit_code = exit_code  #: of the program; None: it did not end by itself, or did not start
        self.diagnostics = diagnostics  #: the same in parts, if the program has it: code, place, figures, remedies
        self.edit = edit  #: the number that the command was given, if any
        self.command = command  #: the words of the command line

    @property
    def code(self) -> str | None:
        """What is wrong, as a name such as 'edges-too-coarse'."""
        return self.diagnostics[0].code if self.diagnostics else None

    @property
    def place_mm(self) -> tuple[float, float, float] | None:
        """Where [mm]."""
        return self.diagnostics[0].place_mm if self.diagnostics else None

    @property
    def remedies(self) -> tuple[Remedy, ...]:
        """Operations with arguments that may help, of all diagnostics."""
        return tuple(remedy for diagnostic in self.diagnostics for remedy in diagnostic.remedies)


class UsageError(VesselbenchError):
    """An option, operation, parameter or value that the program does not take; exit code 2."""


class BadInput(VesselbenchError):
    """A file that cannot be used; exit code 3."""


class Cancelled(VesselbenchError):
    """The program was stopped by a signal that others sent. (Ctrl-C raises KeyboardInterrupt.)"""


class ModelRefused(VesselbenchError):
    """`prepare` stopped: the model would not be fit for its purpose, or a decision is left to you.

    What was done is kept: mend it in `Project(error.project)`, or give other arguments, and prepare with resume=True.
    """

    report: Path  #: report.json: what was found, with commands that may help
    project: Path  #: project.vbench: the edits that are done


class ProgramNotFound(VesselbenchError):
    """There is no program to run."""


class UnexpectedAnswer(VesselbenchError):
    """The program printed what this package does not understand: another program, or one of another version."""
