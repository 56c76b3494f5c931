#!/usr/bin/env python3
"""Measures deform-branch and part-branches on random vessels.

  scripts/repairs_deform.py [--quick]

Needs the target bench_posing. Seeds 1-100 are those the operations were built with; 101-200 are others. --quick takes 1-8
and 101-108. Exit code 1 if a goal is missed.
"""
import json
import subprocess
import sys

import common

BENCH = common.os.path.join(common.BUILD, "bench_posing")


def trials(tool, what, first, last):
    """One dictionary for each seed."""
    done = subprocess.run([tool, what, str(first), str(last)], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


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
        ["largest distance of a cap from its plane", "flat", largest(done, "cap_bulge_mm", 1.0, "%.1e mm")],
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
        ["vertices moved on the root's side of what bends", "0", sum(row["strayed"] for row in done)],
        ["time without centerlines, largest", "5 s", largest(asked, "seconds", 1.0, "%.1f s")],
    ]


def gap_rows(rows):
    done = [row for row in rows if row["done"]]
    narrow = [row for row in rows if row["print_gap_before_mm"] < 1.0]
    before = [row["print_gap_before_mm"] for row in narrow]
    return [
        ["smallest gap without the operation (baseline)", "", f"{min(before, default=0.0):.2f} to {max(before, default=0.0):.2f} mm"],
        ["every gap 1 mm, or a clear no with its place", "all",
         f"{share(rows, lambda row: row['done'] and row['gap_after_mm'] >= 1.0)} reached, {share(rows, refused_clearly)} refused"],
        ["the print check agrees", "", share(done, lambda row: row["print_gap_mm"] >= 1.0)],
        *common_rows(done),
        ["largest shift of a wall", "", largest(done, "largest_shift_mm", 1.0, "%.2f mm")],
        ["time without centerlines, largest", "5 s", largest(rows, "seconds", 1.0, "%.1f s")],
    ]


def met(rows):
    done = [row for row in rows if row["done"]]
    sound = sum(row["sound"] for row in done) >= 0.99 * len(done)
    return sound and all(row["done"] or row["placed"] for row in rows) and all(
        row["radius_error"] <= 0.01 and row["volume_error"] <= 0.01 and row.get("strayed", 0) == 0 and
        row.get("gap_after_mm", 1.0) >= 1.0 for row in done)


def measured(tool, quick):
    count = 8 if quick else 100
    return {(what, first): trials(tool, what, first, first + count - 1) for what in ("deform", "gap") for first in (1, 101)}


def lines_of(results):
    lines = ["## Branch deformation and gaps", "",
             "Random vessels of 1 to 2.5 mm radius with triangles of a quarter of it. `deform-branch`: curved tubes and trees of "
             "which a place is moved by 0.5 to 3 radii, bows to be straightened, loops that must be refused. `part-branches gap=1`: "
             "two branches that approach each other, one that winds around another, two side by side, and two that join again, "
             "which cannot be parted. Radii are those of circles of the sections' areas, each section across the axis before and "
             "after.", ""]
    for what, title, rows in (("deform", "deform-branch", deform_rows), ("gap", "part-branches gap=1", gap_rows)):
        built, other = (rows(results[what, first]) for first in (1, 101))
        lines += [f"### {title}", "", *common.table(["", "goal", "seeds from 1", "seeds from 101"],
                                                  [[*a, b[2]] for a, b in zip(built, other)]).splitlines(), ""]
    return lines


def section(tool=BENCH, quick=False):
    """Lines of Markdown. \\param tool the program bench_posing"""
    return lines_of(measured(tool, quick))


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--quick", action="store_true")
    results = measured(BENCH, parser.parse_args().quick)
    print("\n".join(lines_of(results)))
    return 0 if all(met(rows) for rows in results.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
