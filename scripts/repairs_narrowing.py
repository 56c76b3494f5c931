#!/usr/bin/env python3
"""Measures correct-narrowing on images of random vessel trees with known lumens.

Prints the section of docs/science/repairs.md.

  scripts/repairs_narrowing.py [--quick] [--seeds A-B] [--baseline] [--jobs N]

A seed makes one tree three times: with dips of the contrast (the lumen keeps its width), with stenoses, and with neither
(tests/bench/narrowing_phantoms.h says how). Seeds 1-100 are to build with; 101-200 are reported. --quick: 101-105.
--baseline: what a surface at one threshold, local levels and `widen` make of the places, without correct-narrowing.
Needs the target bench_narrowing.
"""
import concurrent.futures
import json
import os
import statistics
import subprocess
import sys

import common
from common import BUILD, table

BENCH = os.path.join(BUILD, "bench_narrowing")
FAULTS = ["dip", "stenosis", "clean"]
RIGHT = {"dip": "contrast-falls", "stenosis": "image-agrees"}
LEAST_SHARE, LEAST_VOXELS = 0.2, 1.0
CURVE = [0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 99.0]  # depth [voxels]
GOALS = {"recall": 0.9, "false_per_tree": 0.1, "right": 0.85, "labelled": 0.7, "error": 0.5}


def measure(fault, first, last, jobs, *options):
    """The bench's lines of these seeds."""
    def seeds(start):
        done = subprocess.run([BENCH, fault, str(start), str(min(start + 4, last)), *options], capture_output=True, text=True,
                              check=True)
        return [json.loads(line) for line in done.stdout.splitlines()]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return [line for lines in pool.map(seeds, range(first, last + 1, 5)) for line in lines]


def places(lines):
    return [place | {"seed": line["seed"]} for line in lines for place in line.get("planted", [])]


def is_whole(place):
    """The vessel is not broken there: then it is no narrowing."""
    return place["share"] < 0.95


def is_deep(place):
    return is_whole(place) and place["share"] >= LEAST_SHARE and place["depth_voxels"] >= LEAST_VOXELS


def share(part, whole):
    return part / whole if whole else float("nan")


def percent(part, whole):
    return f"{100 * share(part, whole):.0f} % ({part} of {whole})"


def verdict(place):
    return (place.get("image") or {}).get("verdict", "cannot-tell")


def row(what, goal, value, met):
    return [what, goal, value, "" if goal == "-" else "met" if met else "not met"]


def found_rows(lines, rows):
    for fault in ("dip", "stenosis"):
        deep = [p for p in places(lines[fault]) if is_deep(p)]
        found = sum(p["found"] for p in deep)
        rows.append(row(f"recall, {fault}", ">= 90 %", percent(found, len(deep)), share(found, len(deep)) >= GOALS["recall"]))
    clean = lines["clean"]
    false = sum(len(line.get("others", [])) for line in clean)
    rows.append(row("proposals in clean trees", "<= 1 in 10 trees", f"{false} in {len(clean)}",
                    share(false, len(clean)) <= GOALS["false_per_tree"]))


def label_rows(lines, rows):
    found = [(fault, p) for fault in ("dip", "stenosis") for p in places(lines[fault]) if is_deep(p) and p["found"]]
    labelled = [(fault, verdict(p)) for fault, p in found if verdict(p) != "cannot-tell"]
    right = sum(RIGHT[fault] == said for fault, said in labelled)
    rows.append(row("found ones that the image labels", ">= 70 %", percent(len(labelled), len(found)),
                    share(len(labelled), len(found)) >= GOALS["labelled"]))
    rows.append(row("labels that are right", ">= 85 %", percent(right, len(labelled)),
                    share(right, len(labelled)) >= GOALS["right"]))


def correction_rows(lines, rows):
    found = [p for p in places(lines["dip"]) if is_deep(p) and p["found"]]
    done = [p["correction"] for p in found if "corrected_error_mm" in p["correction"]]
    ratios = [c["corrected_error_mm"] / c["raw_error_mm"] for c in done]
    halved = sum(r <= GOALS["error"] for r in ratios)
    middle = statistics.median(ratios) if ratios else float("nan")
    rows.append(row("radius error of corrected dips over the raw one, median", "<= 0.5", f"{middle:.2f}", middle <= 0.5))
    rows.append(row("corrected dips whose error is at most half", "-", percent(halved, len(done)), halved == len(done)))
    rows.append(row("refused, surface untouched", "-", percent(len(found) - len(done), len(found)), True))
    outside = sum(c["outside_moved"] for c in done)
    rows.append(row("vertices moved beyond stretch and blends", "0", str(outside), outside == 0))


def curve(lines):
    """Recall by depth, without a goal."""
    rows = []
    for low, high in zip([0.0] + CURVE, CURVE):
        cells = [f"{low:g} to {high:g}" if high < 99 else f"over {low:g}"]
        for fault in ("dip", "stenosis"):
            here = [p for p in places(lines[fault]) if is_whole(p) and low <= p["depth_voxels"] < high]
            cells.append(f"{sum(p['found'] for p in here)} of {len(here)}")
        rows.append(cells)
    return table(["depth [voxels]", "dips found", "stenoses found"], rows)


def section(tool, quick, first=101, last=200, jobs=2):
    """Markdown lines. \\param tool not used: the bench has the library in it"""
    if quick:
        first, last = 101, 105
    lines = {fault: measure(fault, first, last, jobs) for fault in FAULTS}
    errors = [line for kind in lines.values() for line in kind if "error" in line]
    rows = []
    found_rows(lines, rows)
    label_rows(lines, rows)
    correction_rows(lines, rows)
    return ["## Narrowings (`correct-narrowing`)", "",
            f"Seeds {first} to {last}, each as a tree with dips of the contrast, with stenoses, and with neither, imaged with",
            "blur, noise, partial volume and uneven contrast, and extracted at one threshold. The vessels are at least 6 voxels",
            "wide. The depth of a place is the part of the healthy radius that the surface lacks there, beside its own bias;",
            f"goals are for places deeper than 1 voxel and 20 %. {len(errors)} seeds could not be measured.", "",
            table(["", "goal", "measured", ""], rows), "", curve(lines)]


def baseline(first, last, jobs):
    """What there is without the operation."""
    lines = ["| | deep places | called narrow by `widen` | median share missing, one threshold | local levels |",
             "|---" * 5 + "|"]
    for fault in ("dip", "stenosis"):
        deep = [p for line in measure(fault, first, last, jobs, "baseline") for p in line.get("places", []) if is_deep(p)]
        shares = [statistics.median([p[key] for p in deep]) if deep else float("nan") for key in ("share", "local_share")]
        lines.append(f"| {fault} | {len(deep)} | {sum(p['called'] for p in deep)} | {shares[0]:.2f} | {shares[1]:.2f} |")
    return lines


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--seeds", default="101-200")
    parser.add_argument("--baseline", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    first, last = map(int, options.seeds.split("-"))
    if options.baseline:
        print("\n".join(baseline(first, last, options.jobs)))
    else:
        print("\n".join(section(common.PROGRAM, options.quick, first, last, options.jobs)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
