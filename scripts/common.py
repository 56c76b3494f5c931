"""Shared by the scripts: where files are, running the program, projects, Markdown tables, limits, vectors, surface files."""
import argparse
import json
import math
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = os.path.join(ROOT, "build", "release")
PROGRAM = os.environ.get("VESSELBENCH") or os.path.join(BUILD, "vesselbench")
DATA = os.path.join(os.path.dirname(ROOT), "shared", "data")

skipped = []  # reasons, filled by skip()


def parser(about):
    """For a script's own docstring, which is printed as it is."""
    return argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)


def skip(reason):
    """Reports what was skipped; the exit code is then 77, which ctest counts as skipped, unless a check fails."""
    print("skipped: " + reason, flush=True)
    skipped.append(reason)
    if file := os.environ.get("VESSELBENCH_SKIPS"):
        with open(file, "a") as lines:
            lines.write(f"scripts/{os.path.basename(sys.argv[0])}: {reason}\n")


# --- the program -----------------------------------------------------------------------------------------------------
def run(*arguments, program=None, folder=None):
    """What the program (none: PROGRAM) prints; RuntimeError with its errors if its exit code is not 0."""
    done = subprocess.run([program or PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=folder)
    if done.returncode != 0:
        command = " ".join([os.path.basename(program or PROGRAM), *map(str, arguments)])
        raise RuntimeError(f"{command}\n{done.stdout[-500:]}{done.stderr[-2000:]}")
    return done.stdout


def new_project(path, *source):
    """Replaces a project of this name."""
    for suffix in ("", "-wal", "-shm"):
        if os.path.exists(path + suffix):
            os.remove(path + suffix)
    run("new", path, *source)


class Project:
    """A new project in a folder."""

    def __init__(self, folder, name, *source):
        self.folder, self.name = folder, name
        self.project = os.path.join(folder, name + ".vbench")
        new_project(self.project, *source)

    def apply(self, operation, *arguments):
        run("apply", self.project, operation, *arguments)
        return self

    def undo(self):
        run("undo", self.project)

    def newest(self):
        """The newest edit, as `log --json` prints it."""
        return json.loads(run("log", self.project, "--json"))["edits"][-1]

    def surface(self, name):
        """Exports the surface. Returns its file."""
        file = os.path.join(self.folder, f"{self.name}-{name}.vtp")
        run("export", self.project, file)
        return file


# --- Markdown and limits ---------------------------------------------------------------------------------------------
def row_line(row):
    return "| " + " | ".join(map(str, row)) + " |"


def table(head, rows):
    """Rows are lists of cells, or lines made of them."""
    lines = [row if isinstance(row, str) else row_line(row) for row in rows]
    return "\n".join([row_line(head), "|" + "---|" * len(head), *lines]) + "\n"


class Checks:
    """Limits and whether they hold, printed as they are met."""

    def __init__(self):
        self.failed, self.explained = [], []

    def expect(self, holds, text, unless=None):
        """`unless`: the reason if it is known not to hold; then it is listed on the page and not counted as a failure."""
        if not holds and unless:
            self.explained.append(f"{text}. {unless}")
        elif not holds:
            self.failed.append(text)
        print(("  met:     " if holds else "  not met, as known: " if unless else "  NOT MET: ") + text, flush=True)
        return holds


# --- vectors ---------------------------------------------------------------------------------------------------------
def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def scaled(a, by):
    return tuple(x * by for x in a)


# --- surface files ---------------------------------------------------------------------------------------------------
def read_off(path):
    """Points and triangles."""
    with open(path) as file:
        words = [line.split() for line in file if line.strip() and not line.startswith("#")]
    first = 1 if len(words[0]) == 1 else 0
    vertices, faces = int(words[first][0]), int(words[first][1])
    points = [tuple(map(float, w[:3])) for w in words[first + 1:first + 1 + vertices]]
    return points, [tuple(map(int, w[1:4])) for w in words[first + 1 + vertices:first + 1 + vertices + faces]]


def write_off(path, points, triangles):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines("%.9g %.9g %.9g\n" % tuple(p) for p in points)
        file.writelines("3 %d %d %d\n" % tuple(t) for t in triangles)
    return path
