#!/usr/bin/env python3
"""Measures deform-branch and part-branches on random vessels.

  scripts/repairs_deform.py [--quick] [--build]

Prints the section of docs/science/repairs.md. --quick: 8 seeds of each in place of 100. --build: seeds from 1, with which the
operations
were built, in place of those from 101, on which they are reported. Runs bench_posing
(scripts/build bench_posing). Exit code 1 if a goal is missed.
"""
import json
import os
import subprocess
import sys

import common

BENCH = os.path.join(common.BUILD, "bench_posing")


def trials(what, first, last):
    """One dictionary for each seed whose vessel is sound."""
    done = subprocess.run([BENCH, what, str(first), str(last)], capture_output=True, text=True, check=True)
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    return [row for row in rows if row["crossings_before"] == 0]


def share(rows, holds):
    return f"{sum(map(holds, rows))} of {len(rows)}"


def largest(rows, key, scale=1.0, form="%.2f"):
    return form % (scale * max((row[key] for row in rows), default=0.0))


def refused_clearly(row):
    return not row["done"] and row["placed"]


def common_rows(done):
    return [
        ["largest change of a section's radius", "1 %", largest(done, "radius_error", 100.0, "%.3f %%")],
        ["largest change of the volume", "1 %", largest(done, "volume_error", 100.0, "%.3f %%")],
        ["closed, manifold, without crossings", "99 %", share(done, lambda row: row["sound"])],
        ["largest growth of a cap's distance from its plane", "0", largest(done, "cap_bulge_mm", 1.0, "%.1e mm")],
    ]


def deform_rows(rows):
    asked = [row for row in rows if not row["to_refuse"]]
    done = [row for row in asked if row["done"]]
    return [
        ["moved or straightened, else refused with the place", "all",
         f"{share(asked, lambda row: row['done'])} done, {share(asked, refused_clearly)} refused"],
        ["loops refused with the place", "all", share([row for row in rows if row["to_refuse"]], refused_clearly)],
        *common_rows(done),
        ["largest distance from where the place was to go, across the vessel", "", largest(done, "miss_mm", 1.0, "%.3f mm")],
        ["vertices before the reach that moved", "0",
         f"{sum(row['strayed'] for row in done)} of {sum(row['root_side'] for row in done):,}"],
        ["processor time of all threads without centerlines, largest", "5 s", largest(asked, "cpu_seconds", 1.0, "%.2f s")],
    ]


def gap_rows(rows):
    done = [row for row in rows if row["done"]]
    narrow = [row for row in rows if row["print_gap_before_mm"] < 1.0]
    before = [row["print_gap_before_mm"] for row in narrow]
    return [
        ["smallest gap without the operation (baseline)", "",
         f"{min(before, default=0.0):.2f} to {max(before, default=0.0):.2f} mm"],
        ["every gap 1 mm by the print check, or a clear no with its place", "all",
         f"{share(rows, lambda row: row['done'] and row['print_gap_mm'] >= 1.0)} reached, "
         f"{share(rows, refused_clearly)} refused"],
        *common_rows(done),
        ["largest shift of a wall", "", largest(done, "largest_shift_mm", 1.0, "%.2f mm")],
        ["processor time of all threads without centerlines, largest", "5 s", largest(rows, "cpu_seconds", 1.0, "%.2f s")],
    ]


def met(rows):
    done = [row for row in rows if row["done"]]
    sound = sum(row["sound"] for row in done) >= 0.99 * len(done)
    return sound and all(row["done"] or row["placed"] for row in rows) and all(
        row["radius_error"] <= 0.01 and row["volume_error"] <= 0.01 and row.get("strayed", 0) == 0 and
        row.get("print_gap_mm", 1.0) >= 1.0 for row in done)


PARTS = [
    ("deform", "`deform-branch`",
     "![An outlet of the bundled case, as it was and moved](../pictures/deform-branch.png)", deform_rows),
    ("gap", "`part-branches` with a gap of 1 mm",
     "![The branches of the bundled case, as they were and 1 mm apart](../pictures/part-branches.png)", gap_rows),
]


def measured(quick, first):
    last = first + (7 if quick else 99)
    return {what: trials(what, first, last) for what, *_ in PARTS}


def lines_of(results, first):
    lines = ["## Branches that are moved (`deform-branch`, `part-branches`)", "",
             f"Seeds from {first}; vessels whose own walls cross are left out, {len(results['deform'])} and "
             f"{len(results['gap'])} are left.",
             "The vessels have radii of 1 to 2.5 mm, and triangles of a quarter of that. `deform-branch` moves a place of a",
             "curved tube or of a branch by 0.5 to 3 radii, straightens bows, and must refuse loops. `part-branches` finds two",
             "branches that approach each other, one that winds around another, two side by side, or two that join again,",
             "which cannot be parted.",
             "A section's radius is that of the circle of its area, across the axis before and after.", ""]
    for what, title, picture, rows in PARTS:
        lines += [f"### {title}", "", picture, "",
                  *common.table(["", "goal", "measured"], rows(results[what])).splitlines(), ""]
    return lines


def section(tool, quick, first=101):
    """Markdown lines. \\param tool the program (unused: the bench links the library)"""
    return lines_of(measured(quick, first), first)


def main():
    options = common.parser(__doc__)
    options.add_argument("--quick", action="store_true")
    options.add_argument("--build", action="store_true")
    given = options.parse_args()
    first = 1 if given.build else 101
    results = measured(given.quick, first)
    print("\n".join(lines_of(results, first)))
    return 0 if all(met(rows) for rows in results.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
