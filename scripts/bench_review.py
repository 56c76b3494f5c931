#!/usr/bin/env python3
"""Times the review page of a model of about 100,000 triangles with 12 edits: how long `review --out` takes to write it (the
whole program, each of three runs), its size, and in Chromium when the first picture and the next edits are bound.

  scripts/bench_review.py [--out FOLDER]

The goals are 5 s, 25 MB, 3 s and 0.1 s on an idle machine with 2 cores. Drawing is by software there, so that frames are
left out of the browser's times.
"""
import os
import subprocess
import sys
import time

import common
from common import ROOT, Project, read_off, run

EDITS = 12
DABS = 7
EDGE = 0.166  # [mm]; gives about 100,000 triangles
PAGE = os.path.join(ROOT, "workbench", "review", "page")


def at(points, k):
    """The k-th of so many places spread over the surface."""
    return "at=" + ",".join("%.6g" % x for x in points[(2 * k + 1) * len(points) // (2 * DABS)])


def make_project(folder):
    """The bundled phantom's exact surface, with openings, of small triangles, edited at places all over the wall."""
    run("phantom", "aneurysm", "--out", folder)
    project = Project(folder, "bench", os.path.join(folder, "exact.vtp"))
    project.apply("repair").apply("clip-opening", "accept_doubts=true")
    project.apply("remesh", "mode=uniform", f"edge={EDGE}", "--step", "openings")
    start = os.path.join(folder, "start.off")
    run("export", project.project, start)
    points, triangles = read_off(start)
    print(f"{len(triangles)} triangles")
    for k in range(DABS):
        brush = ["brush-inflate", "brush-smooth"][k % 2]
        project.apply(brush, at(points, k), "radius=1.5", "--step", "openings")
    project.apply("smooth", "filter=laplace-hc", "iterations=5", "find_caps=false")
    edits = len(common.json.loads(run("log", project.project, "--json"))["edits"])
    assert edits == EDITS, f"{edits} edits"
    return project.project


def main():
    options = common.parser(__doc__)
    options.add_argument("--out", default="/tmp/bench_review", help="folder of the project and the page")
    out = options.parse_args().out
    os.makedirs(out, exist_ok=True)
    project, page = make_project(out), os.path.join(out, "page.html")
    for _ in range(3):
        start = time.monotonic()
        run("review", project, "--out", page)
        print(f"written in {time.monotonic() - start:.2f} s", flush=True)
    return subprocess.run(["node", "bench.mjs", page], cwd=PAGE).returncode


if __name__ == "__main__":
    sys.exit(main())
