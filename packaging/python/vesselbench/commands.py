"""The program's commands that are not about one project: vesselbench.project has the others.

Further keywords are the command's options, `vesselbench COMMAND --help`: accept_doubts=True is --accept-doubts, a list repeats
an option, a place is (x, y, z) in mm. All functions raise VesselbenchError, or one of its classes.
"""
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .arguments import Argument, Option, option_words, parameter_words, setting_words
from .errors import ModelRefused, UnexpectedAnswer, VesselbenchError
from .program import PathLike, Program, answer, output_of
from .project import Prepared
from .reading import read, read_all
from .results import Batch, Centerlines, Check, End, FlowResults, Measures, Operation, Phantom

REPORT, PROJECT = "report.json", "project.vbench"


def prepare(input: PathLike, purpose: str, out: PathLike, *, settings: Mapping[str, Argument] | None = None,
            program: Program = None, **options: Option) -> Prepared:
    """Makes a model of a surface, an image, a folder of DICOM slices, a case folder or a bundled case ("aneurysm").

    purpose   cfd, rp, planning or simulation
    out       folder of the results; created if missing
    settings  arguments of the recipe's operations: {"remesh.edge": 0.2}; lengths in mm
    options   mask, units, neighbour, recipe, inlet, open, close, accept_doubts, author, name, resume ...

    ModelRefused if the model would not be fit, or a decision about it is yours.
    """
    words = [*option_words({"for": purpose, "out": out, **options}), *setting_words(settings)]
    report = Path(out).absolute() / REPORT
    before = _stamp(report)
    try:
        document = answer("prepare", words, [os.fspath(input)], program)
    except VesselbenchError as error:
        if type(error) is VesselbenchError and _stamp(report) not in (None, before) and _stopped(report):
            raise _refusal(error, report) from None
        raise
    return Prepared.of(document, Path(out).absolute(), program)


def _stamp(file: Path) -> tuple[int, int] | None:
    """Another one each time that the file is written; None: there is none."""
    try:
        found = file.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_ino


def _stopped(report: Path) -> bool:
    """Whether it is that of a model which was refused."""
    try:
        return bool(json.loads(report.read_text("utf-8")).get("stopped"))
    except (OSError, ValueError, AttributeError):
        return False


def _refusal(error: VesselbenchError, report: Path) -> ModelRefused:
    refused = ModelRefused(error.message, exit_code=error.exit_code, diagnostics=error.diagnostics, edit=error.edit,
                           command=error.command)
    refused.report, refused.project = report, report.with_name(PROJECT)
    return refused


def ends(input: PathLike, *, settings: Mapping[str, Argument] | None = None, program: Program = None,
         **options: Option) -> tuple[End, ...]:
    """The vessel ends, and what `prepare` for cfd would make of each with these arguments."""
    words = [*option_words(options), *setting_words(settings)]
    return read_all(End, answer("ends", words, [os.fspath(input)], program).get("ends"), "ends")


def batch(cases: PathLike, purpose: str, out: PathLike, *, settings: Mapping[str, Argument] | None = None,
          program: Program = None, **options: Option) -> Batch:
    """Prepares the cases of a manifest (.csv) or folder; those that are finished in `out` are not run again.

    Cases that failed are in the result's `failures`.
    options: jobs, time_limit [s], memory_limit [GiB], retry, answers, engine ...
    """
    words = [*option_words({"for": purpose, "out": out, **options}), *setting_words(settings)]
    return read(Batch, answer("batch", words, [os.fspath(cases)], program), "batch")


def run_flow(folder: PathLike, *, program: Program = None, **options: Option) -> FlowResults:
    """The command `run`: solves the flow of a folder that `prepare` for cfd made, or of an exported OpenFOAM case.

    A flow that has not converged is an answer too: see `converged`.
    options: processes, out: folder that gets the results
    """
    return read(FlowResults, answer("run", option_words(options), [os.fspath(folder)], program), "run")


def flow_results(folder: PathLike, *, program: Program = None, **options: Option) -> FlowResults:
    """The command `results`: reads what was solved there. options: out: folder that gets files"""
    return read(FlowResults, answer("results", option_words(options), [os.fspath(folder)], program), "results")


def measure(surface: PathLike, reference: PathLike | None = None, *, program: Program = None,
            **options: Option) -> Measures:
    """Measures a surface file, and its distance from another one.

    options: units of the files (mm), histogram: width of its bins [mm]
    """
    files = [os.fspath(file) for file in (surface, reference) if file is not None]
    return read(Measures, answer("measure", option_words(options), files, program), "measure")


def centerlines(surface: PathLike, out: PathLike, *, program: Program = None, **options: Option) -> Centerlines:
    """Writes the centerlines of a surface file as polylines (.vtp), and returns their graph."""
    files = [os.fspath(surface), os.fspath(out)]
    return read(Centerlines, answer("centerlines", option_words(options), files, program), "centerlines")


def picture(surface: PathLike, out: PathLike, *, program: Program = None, **options: Option) -> Path:
    """Draws a surface file or a project (.png). options: reference, colour, range, full_colour [mm], view, size [pixels] ..."""
    answer("picture", option_words(options), [os.fspath(surface), os.fspath(out)], program)
    return Path(out)


def phantom(name: PathLike, out: PathLike, *, program: Program = None, **options: Option) -> Phantom:
    """Writes a phantom's image, mask and exact surface into the folder `out`, which is then an input as well."""
    return read(Phantom, answer("phantom", option_words({"out": out, **options}), [os.fspath(name)], program), "phantom")


def operations(*, program: Program = None) -> tuple[Operation, ...]:
    """All operations that `Project.apply` runs, with their parameters."""
    return read_all(Operation, answer("operations", [], [], program).get("operations"), "operations")


def operation(name: str, *, program: Program = None) -> Operation:
    """One of them."""
    return read(Operation, answer("operations", [], [name], program), "operations")


def doctor(*, program: Program = None) -> tuple[Check, ...]:
    """What the program finds on this machine, and what is missing."""
    return read_all(Check, answer("doctor", [], [], program).get("checks"), "doctor")


def version(*, program: Program = None) -> str:
    """Of the program."""
    done = output_of(["--version"], program)
    words = done.stdout.split()
    if done.returncode != 0 or not words:
        raise UnexpectedAnswer(f"{done.args[0]} printed no version", command=tuple(done.args))
    return words[-1]


def run(command: str, *positionals: PathLike, parameters: Mapping[str, Argument] | None = None, program: Program = None,
        **options: Option) -> dict[str, Any]:
    """The JSON document of any command: run("suggest", "aorta.stl", parameters={"filter": "laplace"}, tau=0.4)

    parameters are written after the positionals as name=value.
    """
    words = [os.fspath(word) for word in positionals] + parameter_words(parameters or {})
    return answer(command, option_words(options), words, program)
