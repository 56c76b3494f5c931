#!/usr/bin/env python3
"""Solves the developed flow in a tube and compares the shear stress on its wall with the exact one, without and with wall layers;
writes docs/science/experiments-tube.md.

  scripts/experiments_tube.py [--rows N,..] [--out FOLDER] [--no-page] [--repeat]

The tube has a radius of 2 mm, its wall's vertices lie on the circle; triangles are nearly equilateral. `tetrahedralize` fills it,
simpleFoam solves the exported case with the developed profile at the inlet. Figures are of the faces of the wall between 0.4
and 0.8 of the length. FOLDER keeps what was solved: a second run goes on there. --repeat solves the row of 4 layers again, in a
folder of its own, and compares with the page, within 5 % of each figure or 0.5 points; exit code 1 if it differs.
"""
import json
import math
import os
import re
import sys
from statistics import fmean

import common
import page_rows
from common import ROOT, new_project, run, table

PAGE = os.path.join(ROOT, "docs", "science", "experiments-tube.md")
RADIUS, LENGTH = 2.0, 16.0  # [mm]
FLOW, VISCOSITY, DENSITY = 1.2, 0.004, 1000.0  # [cm^3/s], [Pa s], [kg/m^3]
SHEAR = 4e3 * VISCOSITY * FLOW / (math.pi * RADIUS**3)  # [Pa], of Hagen and Poiseuille's flow
DEVELOPED = (0.4, 0.8)  # of the length
LAYERS = {"layers": 4}
ROWS = [  # edge by radius, arguments of tetrahedralize
    (0.30, {}), (0.20, {}), (0.14, {}), (0.20, {"improve": 0}),
    (0.20, LAYERS), (0.20, {"layers": 2}), (0.20, {"layers": 8}), (0.20, {"layers": 4, "layer_thickness": 0.1}),
    (0.20, {"layers": 4, "layer_thickness": 0.4}), (0.30, LAYERS), (0.14, LAYERS)]
REPEATED = (0.20, LAYERS)
HEAD = ["edge / R", "arguments", "cells", "prisms", "mean [%]", "standard deviation [%]", "99th percentile [%]", "iterations"]


# --- the tube --------------------------------------------------------------------------------------------------------
def on_ring(radius, turn, z, count):
    return [(radius * math.cos(2 * math.pi * (i + turn) / count), radius * math.sin(2 * math.pi * (i + turn) / count), z)
            for i in range(count)]


def wall_triangles(around, rows):
    rings = [on_ring(RADIUS, 0.5 * (row % 2), LENGTH * row / rows, around) for row in range(rows + 1)]
    for row in range(rows):
        low, high = rings[row], rings[row + 1]
        for i in range(around):
            j = (i + 1) % around
            if row % 2 == 0:
                yield from ((low[i], low[j], high[i]), (low[j], high[j], high[i]))
            else:
                yield from ((low[i], high[j], high[i]), (low[i], low[j], high[j]))


def disc_triangles(around, turn, z, upwards):
    """Rings of 6, 12, ... vertices around the middle, the last one the rim."""
    last = around // 6
    rings = [[(0.0, 0.0, z)]] + [on_ring(RADIUS * k / last, turn * k / last, z, 6 * k) for k in range(1, last + 1)]
    for k in range(1, last + 1):
        inner, outer = rings[k - 1], rings[k]
        for sector in range(6):
            for step in range(k):
                a, b = outer[sector * k + step], outer[(sector * k + step + 1) % (6 * k)]
                c = inner[(sector * (k - 1) + step) % len(inner)]
                yield (a, b, c) if upwards else (b, a, c)
                if step:
                    d = inner[(sector * (k - 1) + step - 1) % len(inner)]
                    yield (a, c, d) if upwards else (a, d, c)


def write_tube(file, edge):
    """A text STL file of three solids; the edge is by the radius."""
    around = 6 * round(2 * math.pi / edge / 6)
    rows = round(LENGTH / (edge * RADIUS * math.sqrt(0.75)))
    parts = {"wall": wall_triangles(around, rows),
             "inlet": disc_triangles(around, 0.0, 0.0, False),
             "outlet": disc_triangles(around, 0.5 * (rows % 2), LENGTH, True)}
    with open(file, "w") as stl:
        for name, triangles in parts.items():
            print("solid", name, file=stl)
            for triangle in triangles:
                print("facet normal 0 0 0\nouter loop", file=stl)
                for corner in triangle:
                    print("vertex", *(f"{x:.12g}" for x in corner), file=stl)
                print("endloop\nendfacet", file=stl)
            print("endsolid", name, file=stl)


# --- the flow --------------------------------------------------------------------------------------------------------
def read_list(text):
    """The rows of numbers of an OpenFOAM list of vectors or faces."""
    return [[float(x) for x in row.split()] for row in re.findall(r"\(([-+\d.eE ]+)\)", text)]


def wall_errors(case):
    """Errors of the shear stress at the wall's faces of the developed part [-], and the number of iterations."""
    times = [name for name in os.listdir(case) if re.fullmatch(r"[1-9]\d*", name)]
    last = max(times, key=int)

    def text(*place):
        with open(os.path.join(case, *place)) as file:
            return file.read()

    points, faces = (read_list(text("constant", "polyMesh", name)) for name in ("points", "faces"))
    first, count = (int(re.search(r"wall\s*\{[^}]*" + key + r"\s+(\d+);", text("constant", "polyMesh", "boundary")).group(1))
                    for key in ("startFace", "nFaces"))
    stresses = text(last, "wallShearStress")
    stresses = read_list(stresses[stresses.index("wall\n"):])[:count]
    errors = []
    for face, stress in zip(faces[first:first + count], stresses):
        z = 1e3 * fmean(points[int(v)][2] for v in face) / LENGTH
        if DEVELOPED[0] < z < DEVELOPED[1]:
            errors.append(math.hypot(*stress) * DENSITY / SHEAR - 1)
    return errors, int(last)


def solve(folder, edge, arguments):
    """A row's figures."""
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, "figures.json")
    if not os.path.exists(file):
        tube, project, case = (os.path.join(folder, name) for name in ("tube.stl", "tube.vbench", "openfoam"))
        write_tube(tube, edge)
        new_project(project, tube, "--units", "mm")
        run("apply", project, "tetrahedralize", *(f"{name}={value}" for name, value in arguments.items()))
        quality = json.loads(run("log", project, "--json"))["edits"][-1]["report"]["quality"]
        run("export", project, case, "--set", f"openfoam.flow={FLOW}", "--set", f"openfoam.viscosity={VISCOSITY}", "--set",
            f"openfoam.density={DENSITY}")
        run(program="./Allrun", folder=case)
        errors, iterations = wall_errors(case)
        mean = fmean(errors)
        figures = {"cells": quality["cells"],
                   "prisms": quality.get("prisms", 0),
                   "mean": mean,
                   "deviation": math.sqrt(fmean((error - mean)**2 for error in errors)),
                   "p99": sorted(map(abs, errors))[round(0.99 * (len(errors) - 1))],
                   "iterations": iterations}
        with open(file, "w") as out:
            json.dump(figures, out)
    with open(file) as figures:
        return json.load(figures)


def row_of(edge, arguments, figures):
    named = " ".join(f"`{name}={value}`" for name, value in arguments.items()) or "-"
    return [f"{edge:.2f}", named, f"{figures['cells']:,}", f"{figures['prisms']:,}", f"{100 * figures['mean']:+.1f}",
            f"{100 * figures['deviation']:.1f}", f"{100 * figures['p99']:.1f}", figures["iterations"]]


def solved(folder, edge, arguments):
    name = "-".join([f"{edge:.2f}", *(f"{key}{value}" for key, value in arguments.items())])
    row = row_of(edge, arguments, solve(os.path.join(folder, name), edge, arguments))
    print(common.row_line(row), flush=True)
    return row


def page(rows):
    reynolds = 2e-3 * DENSITY * FLOW / (math.pi * RADIUS * VISCOSITY)
    return f"""# Wall shear stress in a tube, with and without wall layers

`scripts/experiments_tube.py` wrote this page with {page_rows.revision()}. Developed flow (Hagen and Poiseuille) of
{FLOW} cm³/s in a tube of radius R = {RADIUS:g} mm, Reynolds number {reynolds:.0f}; the exact shear stress on the wall is
{SHEAR:.3f} Pa. Errors are relative to it, over all faces of the wall between {DEVELOPED[0]:g} and {DEVELOPED[1]:g} of the
length; the 99th percentile is of their magnitude. Arguments are those of `tetrahedralize`; solved by OpenFOAM's simpleFoam
with the case that `export` writes.

{table(HEAD, rows)}
Without layers the mean is right to half a percent from edges of 0.2 R on, but single places of the wall are not: how a
tetrahedron happens to lie there decides. The centres of prisms have one distance from the wall. How thick the layers are
counts for more than how many.
"""


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--rows", help="numbers of rows, from 0")
    parser.add_argument("--out", default=os.path.join(common.BUILD, "experiments-tube"))
    parser.add_argument("--no-page", action="store_true")
    parser.add_argument("--repeat", action="store_true")
    options = parser.parse_args()
    if options.repeat:
        edge, arguments = REPEATED
        row = solved(os.path.join(options.out, "repeat"), edge, arguments)
        agrees = page_rows.repeated("experiments-tube.md", "", common.row_line(row), relative=0.05, least=0.5, label=2)
        return 0 if agrees else 1
    chosen = [ROWS[int(i)] for i in options.rows.split(",")] if options.rows else ROWS
    rows = [solved(options.out, edge, arguments) for edge, arguments in chosen]
    if not options.no_page and not options.rows:
        with open(PAGE, "w") as file:
            file.write(page(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
