"""A project file (.vbench), and what `prepare` returns."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .arguments import Argument, Option, option_words, parameter_words, setting_words
from .program import PathLike, Program, answer
from .reading import Result, read
from .results import Audit, Diagnostic, Edit, Exported, Finding, Findings, Log, Measures, Replay, Review, State


class Project:
    """A project file. Every method runs the command of its name, and raises VesselbenchError, or one of its classes.

    Further keywords are the command's options: variant="rp", author="me", note="why".
    """

    def __init__(self, path: PathLike, *, program: Program = None) -> None:
        self.path = Path(path).absolute()
        self._program = program

    def __repr__(self) -> str:
        return f"Project({str(self.path)!r})"

    @classmethod
    def new(cls, path: PathLike, input: PathLike, *, program: Program = None, **options: Option) -> Project:
        """Makes a project from a surface, an image, a folder of DICOM slices or a case. options: mask, units ..."""
        answer("new", option_words(options), [os.fspath(path), os.fspath(input)], program)
        return cls(path, program=program)

    def _answer(self, command: str, options: Mapping[str, Option], *words: str) -> dict[str, Any]:
        return answer(command, option_words(options), [str(self.path), *words], self._program)

    # --- edits -------------------------------------------------------------------------------------------------------
    def apply(self, operation: str, /, *, variant: str | None = None, step: str | None = None, author: str | None = None,
              note: str | None = None, **parameters: Argument) -> Edit:
        """Runs an operation as an edit: apply("smooth", filter="taubin", lambda_=0.5)

        `vesselbench.operation(name)` lists the parameters with units and ranges; lengths in mm, places are (x, y, z).
        """
        options = {"variant": variant, "step": step, "author": author, "note": note}
        return read(Edit, self._answer("apply", options, operation, *parameter_words(parameters)), "apply")

    def change(self, edit: Edit | int, /, *, author: str | None = None, note: str | None = None, anew: bool = False,
               **parameters: Argument) -> Edit:
        """Runs an earlier edit with other arguments; the others stay. Later edits run again when they are needed.

        anew: these also choose again what they chose automatically
        """
        options = {"author": author, "note": note, "anew": anew}
        words = [_number(edit), *parameter_words(parameters)]
        return read(Edit, self._answer("change", options, *words), "change")

    def remove(self, edit: Edit | int, /) -> State:
        """Leaves an edit out."""
        return read(State, self._answer("remove", {}, _number(edit)), "remove")

    def note(self, edit: Edit | int, words: str = "", /) -> None:
        """Writes a note on an edit, or removes it."""
        self._answer("note", {}, _number(edit), *([words] if words else []))

    def undo(self, edit: Edit | int | None = None, /) -> State:
        """Returns to the state before an edit; None: the last one."""
        return read(State, self._answer("undo", {}, *([] if edit is None else [_number(edit)])), "undo")

    def redo(self, edit: Edit | int | None = None, /) -> State:
        """Redoes what was undone, up to an edit; None: one state."""
        return read(State, self._answer("redo", {}, *([] if edit is None else [_number(edit)])), "redo")

    def log(self) -> Log:
        """The edits in their order, with what each changed."""
        return read(Log, self._answer("log", {}), "log")

    def replay(self) -> Replay:
        """Runs every edit again, and compares with the stored results."""
        return read(Replay, self._answer("replay", {}), "replay")

    # --- the model ---------------------------------------------------------------------------------------------------
    def export(self, file: PathLike, *, settings: Mapping[str, Argument] | None = None, **options: Option) -> Exported:
        """Writes the model: a surface or volume mesh by the file's suffix, or an OpenFOAM case into a folder.

        settings  of the flow, for an OpenFOAM case: {"openfoam.flow": 1.5}
        options   variant, require, colour, title ...
        """
        words = [*option_words(options), *setting_words(settings)]
        return read(Exported, answer("export", words, [str(self.path), os.fspath(file)], self._program), "export")

    def measure(self, reference: PathLike | None = None, *, variant: str | None = None, **options: Option) -> Measures:
        """Measures the model's surface, and the sac whose neck is marked. `vesselbench.measure` measures files."""
        words = [] if reference is None else [os.fspath(reference)]
        return read(Measures, self._answer("measure", {"variant": variant, **options}, *words), "measure")

    # --- judging it --------------------------------------------------------------------------------------------------
    def findings(self, *, variant: str | None = None) -> Findings:
        """What looks like an artefact, with evidence, certainty and the operation that would treat it."""
        return read(Findings, self._answer("findings", {"variant": variant}), "findings")

    def treat(self, finding: Finding | str, /, *, taken_as: str | None = None, variant: str | None = None) -> Edit:
        """Runs the operation that treats a finding.

        taken_as  key of the reading, of a finding that may be anatomy
        """
        options = {"apply": _id(finding), "as": taken_as, "variant": variant}
        return read(Edit, self._answer("findings", options), "findings")

    def keep(self, finding: Finding | str, reason: str | None = None, /, *, variant: str | None = None) -> Findings:
        """Leaves what was found as it is, and returns the others. A question needs no reason."""
        options = {"keep": _id(finding), "reason": reason, "variant": variant}
        return read(Findings, self._answer("findings", options), "findings")

    def dismiss(self, finding: Finding | str, reason: str, /, *, variant: str | None = None) -> Findings:
        """The same, with a reason."""
        return self.keep(finding, reason, variant=variant)

    def review(self, *, out: PathLike | None = None, verdicts: PathLike | list[PathLike] | None = None,
               **options: Option) -> Review:
        """How the edits were judged, and what to look at first.

        out       writes the page (.html) on which experts judge the edits
        verdicts  enters the files that reviewers saved
        options   images, variant, signers, retire_key, reason
        """
        return read(Review, self._answer("review", {"out": out, "import": verdicts, **options}), "review")

    def audit(self, **options: Option) -> Audit:
        """Verifies the project against its record. options: against, signers, replay, html"""
        return read(Audit, self._answer("audit", options), "audit")


def _number(edit: Edit | int) -> str:
    return str(edit.edit if isinstance(edit, Edit) else edit)


def _id(finding: Finding | str) -> str:
    return finding.id if isinstance(finding, Finding) else finding


@dataclass(frozen=True)
class _PreparedDocument(Result):
    purpose: str
    project: str
    reports: tuple[str, ...]
    products: tuple[str, ...]
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    diagnostics: tuple[Diagnostic, ...]


@dataclass(frozen=True)
class Prepared(Result):
    """A model that was made, and its files."""

    purpose: str
    folder: Path
    project: Project
    products: tuple[str, ...]  #: names of files in the folder
    warnings: tuple[str, ...]
    notes: tuple[str, ...]  #: what needs nobody to look at it
    diagnostics: tuple[Diagnostic, ...] = field(repr=False)  #: warnings and notes in parts

    @classmethod
    def of(cls, document: Mapping[str, Any], folder: Path, program: Program) -> Prepared:
        """From the JSON document of `prepare`."""
        made = read(_PreparedDocument, document, "prepare")
        return cls(made.purpose, folder, Project(folder / made.project, program=program), made.products,
                   made.warnings, made.notes, made.diagnostics, document=document)

    @property
    def surface(self) -> Path:
        """The surface with its patches, in double precision."""
        return self.folder / "surface.vtp"

    @property
    def report(self) -> dict[str, Any]:
        """report.json: what was done, the quality reached, and what was found."""
        report: dict[str, Any] = json.loads((self.folder / "report.json").read_text("utf-8"))
        return report
