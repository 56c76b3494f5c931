#!/usr/bin/env python3
"""Puts wall layers into prepared flow models; writes docs/science/layers.md.

  scripts/experiments_layers.py FOLDER... [--only NAME] [--no-page]
  scripts/experiments_layers.py --repeat [--out FOLDER]

Every project.vbench below the folders that has a volume mesh is taken: those that `scripts/acceptance.py --goal cfd` and
`scripts/forest.py --goal cfd --keep` leave. Each is meshed without layers and with those of the page's rows, at the
operation's usual settings otherwise. --repeat prepares the bundled aneurysm in FOLDER and compares its row with the page, within
5 % of each figure; exit code 1 if it differs.
"""
import json
import os
import shutil
import sys
import tempfile
from statistics import median

import common
import page_rows
from common import ROOT, row_line, run, table

PAGE = os.path.join(ROOT, "docs", "science", "layers.md")
USUAL = {"layers": 4, "layer_thickness": 0.2}
SETTINGS = [{"layers": 4, "layer_thickness": 0.1}, {"layers": 2, "layer_thickness": 0.2}, USUAL,
            {"layers": 8, "layer_thickness": 0.2}, {"layers": 4, "layer_thickness": 0.25},
            {"layers": 4, "layer_thickness": 0.4}]
CASE_HEAD = ["case", "cells without", "cells", "prisms", "scaled Jacobian", "thinner [%]", "below half [%]",
             "non-orthogonality [deg]", "skewness"]
REPEATED = "bundled-aneurysm-cfd"


# --- the cases -------------------------------------------------------------------------------------------------------
def projects(folders):
    """Name and project of each prepared case."""
    for top in folders:
        for folder, _, files in sorted(os.walk(top)):
            if "project.vbench" in files:
                yield os.path.basename(folder), os.path.join(folder, "project.vbench")


def meshing(project):
    """The edit that made the volume mesh; none."""
    edits = json.loads(run("log", project, "--json"))["edits"]
    return next((edit for edit in reversed(edits) if edit["status"] == "done" and "tetgen_switches" in (edit["report"] or {})),
                None)


def meshed(project, settings):
    """The meshing edit after a change; its reason where it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copy(project, folder)
        words = [f"{name}={value}" for name, value in settings.items()]
        try:
            run("change", copy, str(meshing(copy)["edit"]), *words)
        except RuntimeError as refusal:
            return {"refused": str(refusal).strip().splitlines()[-1].removeprefix("vesselbench: ")}
        return meshing(copy)


def figures(name, plain, edit, settings):
    if "refused" in edit:
        return {"case": name, **settings, "refused": edit["refused"]}
    layers, quality = edit["report"]["layers"], edit["report"]["quality"]
    return {"case": name, **settings, "cells_without": plain["report"]["cells"], "cells": quality["cells"],
            "prisms": quality["prisms"], "jacobian": quality["smallest_scaled_jacobian"], "covered": layers["covered_percent"],
            "limited": layers["limited_percent"], "half": layers["below_half_percent"], "steep": layers["steep_percent"],
            "orthogonality": quality["largest_non_orthogonality_deg"], "skewness": quality["largest_skewness"],
            "time": edit["duration_s"] / plain["duration_s"]}


def measured(name, project, settings_list):
    if meshing(project) is None:
        return
    plain = meshed(project, {"layers": 0, "improve": 4})
    if "refused" in plain:
        return
    for settings in settings_list:
        row = figures(name, plain, meshed(project, settings), settings)
        print(json.dumps(row), flush=True)
        yield row


# --- the page --------------------------------------------------------------------------------------------------------
def summary(settings, rows):
    rows = [row for row in rows if all(row[key] == value for key, value in settings.items())]
    made = [row for row in rows if "refused" not in row]
    return [settings["layers"], settings["layer_thickness"], len(rows), len(rows) - len(made),
            f"{min(row['jacobian'] for row in made):.2f}", f"{median(row['limited'] for row in made):.1f}",
            f"{max(row['half'] for row in made):.1f}", f"{max(row['orthogonality'] for row in made):.0f}",
            f"{max(row['skewness'] for row in made):.1f}", f"{median(row['cells'] / row['cells_without'] for row in made):.2f}",
            f"{median(row['time'] for row in made):.1f}"]


def case_row(row):
    if "refused" in row:
        return [row["case"]] + ["-"] * (len(CASE_HEAD) - 2) + ["refused"]
    return [row["case"], row["cells_without"], row["cells"], row["prisms"], f"{row['jacobian']:.2f}", f"{row['limited']:.1f}",
            f"{row['half']:.1f}", f"{row['orthogonality']:.0f}", f"{row['skewness']:.1f}"]


def page(rows):
    usual = [row for row in rows if all(row[key] == value for key, value in USUAL.items())]
    head = ["layers", "thickness / R", "cases", "refused", "scaled Jacobian, least", "thinner, median [%]",
            "below half, most [%]", "non-orthogonality, most [deg]", "skewness, most", "cells, median", "time, median"]
    usual_refusals = "".join(f"- {row['case']}: {row['refused']}\n" for row in usual if "refused" in row)
    return f"""# Layers of prisms on the walls of prepared models

`scripts/experiments_layers.py` wrote this page with {page_rows.revision()}. Each row meshes the flow models of
[acceptance](acceptance.md) again, with layers on the wall. [In a tube](experiments-tube.md) they are compared with the exact
shear stress. *Thinner* is the share of the wall's area whose layers have less than 98 % of the thickness asked for, since
other walls are near or the wall is curved, *below half* that with less than half of it. Cells and time are relative to the
same model without layers.

{table(head, [summary(settings, rows) for settings in SETTINGS])}
## Four layers of 0.2 radii, by case

These are what the recipes for flow make; where they are refused, `prepare` makes none, with a warning.

{usual_refusals}

{table(CASE_HEAD, [case_row(row) for row in usual])}"""


def repeat(out):
    folder = os.path.join(out, REPEATED)
    run("prepare", os.path.join(ROOT, "cases", "aneurysm"), "--for", "cfd", "--out", folder)
    row = next(measured(REPEATED, os.path.join(folder, "project.vbench"), [USUAL]))
    return page_rows.repeated("layers.md", "by case", row_line(case_row(row)), 0.05, 0.1)


def main():
    parser = common.parser(__doc__)
    parser.add_argument("folders", nargs="*", metavar="FOLDER")
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "layers"))
    parser.add_argument("--only", help="part of a case's name")
    parser.add_argument("--no-page", action="store_true")
    parser.add_argument("--repeat", action="store_true")
    options = parser.parse_args()
    if options.repeat:
        return 0 if repeat(options.out) else 1
    rows = [row for name, project in projects(options.folders) if (options.only or "") in name
            for row in measured(name, project, SETTINGS)]
    if not options.no_page:
        with open(PAGE, "w") as file:
            file.write(page(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
