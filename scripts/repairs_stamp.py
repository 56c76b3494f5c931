#!/usr/bin/env python3
"""Measures stamps: random tools on random vessels, and their times.

  scripts/repairs_stamp.py [--quick] [--build]

Prints the section of docs/science/repairs.md. --quick: 20 placements in place of 100. --build: seeds 1-100, with which
the operation was built, in place of 101-200, on which it is reported. Runs bench_stamp
(scripts/build bench_stamp).
"""
import collections
import json
import os
import subprocess

import common

BENCH = os.path.join(common.BUILD, "bench_stamp")
SOUND_GOAL, SECONDS_GOAL = 0.99, 5.0


def lines_of(*arguments):
    printed = subprocess.run([BENCH, *map(str, arguments)], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in printed.splitlines()]


def percent(part, whole):
    return f"{100 * part / whole:.0f} %" if whole else "-"


def placements(first, last):
    lines = lines_of("placements", first, last)
    done = [line for line in lines if "sound" in line]
    refused = collections.Counter(line["refused"] for line in lines if "refused" in line)
    errors = [line for line in lines if "error" in line]
    sound = [line for line in done if line["sound"]]
    apart = [line for line in done if line["kind"] == "separation"]
    parted = [line for line in apart if line["components"][1] == line["components"][0] + 1 and line["genus"][1] == 0]
    reasons = ", ".join(f"{code}: {count}" for code, count in sorted(refused.items())) or "none"
    return [
        f"| result closed, manifold, free of crossings, else untouched with the reason, {len(lines)} placements | "
        f">= {SOUND_GOAL:.0%} | {percent(len(sound) + sum(refused.values()), len(lines))} |",
        f"| of these, refused ({reasons}) | - | {sum(refused.values())} |",
        f"| failed without a diagnosed reason | 0 | {len(errors)} |",
        f"| vertices beyond the influence keep their bits | all | {percent(sum(l['bits_kept'] for l in done), len(done))} |",
        f"| a slab at a contact leaves two walls of genus 0, {len(apart)} contacts | - | {percent(len(parted), len(apart))} |",
    ]


def times():
    lines = [line for line in lines_of("times") if "cpu_seconds" in line]
    if not lines:
        return ["| a stamp on 100,000 triangles | 5 s | not measured |"]
    slowest = max(line["cpu_seconds"] for line in lines)
    fewest = min(line["triangles"] for line in lines)
    load = os.getloadavg()[0]
    return [f"| slowest of {len(lines)} stamps on {fewest:,} triangles or more, processor time of all threads "
            f"(load of the machine {load:.1f}) | {SECONDS_GOAL:.0f} s | {slowest:.2f} s |"]


def section(tool, quick, first=101):
    """Markdown lines. \\param tool the program (unused: the bench links the library)"""
    last = first + (19 if quick else 99)
    return ["## stamp", "",
            f"Seeds {first}-{last}: two vessels of 1.5 to 2.5 mm radius that cross, joined by a bridge of 0.2 to 0.6 of the",
            "thinner one's radius, as raw iso-surfaces (cells of 0.3 mm) or remeshed. Half of the placements are a slab",
            "aligned by the contact; the others are boxes, capsules and swept polygons at random places and angles, subtracted",
            "or added, with random blends. `tests/bench/stamp_bench.cpp` checks each result.", "",
            "| | goal | measured |", "|---|---|---|", *placements(first, last), *times(), ""]


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--build", action="store_true")
    given = parser.parse_args()
    print("\n".join(section(common.PROGRAM, given.quick, 1 if given.build else 101)))


if __name__ == "__main__":
    main()
