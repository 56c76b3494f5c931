"""Finding and running the program."""
from __future__ import annotations

import contextlib
import json
import logging
import os
import shlex
import shutil
import signal
import subprocess
import threading
from collections.abc import Iterator, Mapping, Sequence
from types import FrameType
from typing import Any, Union

from .errors import BadInput, Cancelled, ProgramNotFound, UnexpectedAnswer, UsageError, VesselbenchError
from .reading import read_all
from .results import Diagnostic

PathLike = Union[str, "os.PathLike[str]"]
#: Where the program is; None: the environment variable VESSELBENCH, else the `vesselbench` of the PATH.
Program = Union[PathLike, None]

_KINDS = {2: UsageError, 3: BadInput}  # by exit code
STOP_SECONDS = 5.0  # for what it does between a signal and its end: it stops an operation within 0.3 s


def find_program(program: Program = None) -> str:
    """The program's path. ProgramNotFound if there is none."""
    asked = os.fspath(program) if program else os.environ.get("VESSELBENCH")
    found = shutil.which(asked or "vesselbench")
    if found:
        return found
    if asked:
        whence = "the argument program" if program else "the environment variable VESSELBENCH"
        raise ProgramNotFound(f"'{asked}', as {whence} says, is no program")
    raise ProgramNotFound("there is no vesselbench in the PATH: install it, or set the environment variable VESSELBENCH "
                          "or the argument program to its path")


def output_of(words: Sequence[str], program: Program = None) -> subprocess.CompletedProcess[str]:
    """Runs the program to its end. An exception that comes meanwhile, such as KeyboardInterrupt, ends it first."""
    command = [find_program(program), *words]
    logging.getLogger("vesselbench").debug(shlex.join(command))
    process = None
    try:
        with _interrupts_later():
            process = _started(command)
        output, errors = process.communicate()
    except BaseException:
        if process:
            _stop(process)
        raise
    return subprocess.CompletedProcess(command, process.returncode, output, errors)


def _started(command: list[str]) -> subprocess.Popen[str]:
    try:
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                encoding="utf-8", errors="replace")
    except OSError as error:
        raise ProgramNotFound(f"{command[0]} cannot be run: {error.strerror}", command=tuple(command)) from error


@contextlib.contextmanager
def _interrupts_later() -> Iterator[None]:
    """Holds a Ctrl-C back to the end: while a program starts, it would leave the program running that nobody knows yet."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield  # another thread gets no signals
        return
    came: list[tuple[int, FrameType | None]] = []
    signal.signal(signal.SIGINT, lambda number, frame: came.append((number, frame)))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        if came:
            handler(*came[0])


def _stop(process: subprocess.Popen[str]) -> None:
    with process:  # which closes its pipes and waits for its end
        process.terminate()  # it ends its workers and keeps what is finished
        try:
            process.wait(STOP_SECONDS)
        except BaseException as error:  # a second Ctrl-C, too
            process.kill()
            if not isinstance(error, subprocess.TimeoutExpired):
                raise


def answer(command: str, options: Sequence[str], positionals: Sequence[str], program: Program = None) -> dict[str, Any]:
    """The JSON document that a command prints. VesselbenchError, or one of its classes, if it failed.

    A document with an exit code of 1 is an answer too: a batch in which a case failed, a replay with differences.
    """
    done = output_of([command, "--json", *options, "--", *positionals], program)
    try:
        document = json.loads(done.stdout)
    except ValueError:
        document = None
    if not isinstance(document, dict):
        raise _no_answer(done)
    if "error" in document:
        raise _failure(document, done)
    if done.returncode not in (0, 1):
        raise _no_answer(done)
    return document


def _failure(document: Mapping[str, Any], done: subprocess.CompletedProcess[str]) -> VesselbenchError:
    kind = VesselbenchError
    if document.get("cancelled"):
        kind = Cancelled
    elif done.returncode in _KINDS:
        kind = _KINDS[done.returncode]
    return kind(str(document["error"]), exit_code=done.returncode, edit=document.get("edit"), command=tuple(done.args),
                diagnostics=read_all(Diagnostic, document.get("diagnostics", []), "diagnostics"))


def _no_answer(done: subprocess.CompletedProcess[str]) -> VesselbenchError:
    said = (done.stderr.strip() or done.stdout.strip())[-500:]
    if done.returncode < 0:
        return VesselbenchError(f"the program was ended by signal {-done.returncode}" + (f": {said}" if said else ""),
                                command=tuple(done.args))
    return UnexpectedAnswer(f"{done.args[0]} printed no JSON document" + (f": {said}" if said else ""),
                            exit_code=done.returncode, command=tuple(done.args))
