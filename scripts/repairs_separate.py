#!/usr/bin/env python3
"""Measures separate: images of vessels that touch, whose truth is known.

  scripts/repairs_separate.py [--quick] [--build]

Prints the section of docs/science/repairs.md. --quick: 20 phantoms in place of 100. --build: seeds 1-100, with which the
operation was built, in place of 101-200, on which it is reported. Runs bench_separate, which scripts/build bench_separate makes.
"""
import collections
import json
import os
import subprocess

import common

BENCH = os.path.join(common.BUILD, "bench_separate")
NARROW, WIDE = 0.6, 0.9  # waists [diameters of the thinner vessel]
NARROW_GOAL, WIDE_GOAL = 0.95, 0.75
# What says that the contact cannot be told, and changes nothing.
UNDECIDED = {"contact-pairing-unclear", "contact-joins", "contact-without-arms", "contact-not-parted"}


def lines_of(*arguments):
    printed = subprocess.run([BENCH, *map(str, arguments)], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in printed.splitlines()]


def share(part, whole):
    return f"{100 * len(part) / len(whole):.0f} % ({len(part)} of {len(whole)})" if whole else "-"


def right(lines):
    return [line for line in lines if line.get("right") and line["sound"]]


def row(text, goal, *measured):
    return "| " + " | ".join([text, goal, *measured]) + " |"


def rows(lines, stamped):
    """Of both operations, side by side."""
    narrow, wide, beyond = ([line for line in lines if low < line["waist"] <= high]
                            for low, high in ((0.0, NARROW), (NARROW, WIDE), (WIDE, 9.0)))
    done = [line for line in lines if "sound" in line]
    by_stamp = {line["seed"]: line for line in stamped}

    def beside(part):
        return [by_stamp[line["seed"]] for line in part]

    told = [line for line in beyond if line in right(beyond) or line.get("refused") in UNDECIDED]
    sound = [line for line in lines if line.get("sound") or "refused" in line]
    gaps = [line for line in done if line["gap_voxels"] >= 1.0]
    errors = [max((line["error_voxels"] for line in right(part)), default=0.0)
              for part in (narrow, beside(narrow), wide, beside(wide))]
    refused = collections.Counter(line["refused"] for line in lines if "refused" in line)
    return [
        row(f"genus and components as the truth's, waist up to {NARROW}", f">= {NARROW_GOAL:.0%}",
            share(right(narrow), narrow), share(right(beside(narrow)), narrow)),
        row(f"the same, waist {NARROW} to {WIDE}", f">= {WIDE_GOAL:.0%}",
            share(right(wide), wide), share(right(beside(wide)), wide)),
        row(f"right, or refused as undecided, waist above {WIDE}", "-", share(told, beyond), "-"),
        row("largest distance of the new wall from the truth, waist up to 0.6 [voxels]", "<= 1",
            f"{errors[0]:.2f}", f"{errors[1]:.2f}"),
        row(f"the same, waist {NARROW} to {WIDE} [voxels]", "-", f"{errors[2]:.2f}", f"{errors[3]:.2f}"),
        row("gap as asked (1 voxel)", "all", share(gaps, done), "-"),
        row("closed, manifold, free of crossings, else untouched with the reason", ">= 99 %", share(sound, lines), "-"),
        row("outside the stated ball bit for bit", "all", share([x for x in done if x["bits_kept"]], done), "-"),
        row("refused (" + (", ".join(f"{code}: {count}" for code, count in sorted(refused.items())) or "none") + ")",
            "-", str(sum(refused.values())), str(sum("refused" in line for line in stamped))),
        row("slowest, processor time [s]", "5", f"{max(line['cpu_seconds'] for line in lines):.2f}", "-")]


def section(tool, quick, first=101):
    """Markdown lines. \\param tool the program (unused: the bench links the library)"""
    last = first + (19 if quick else 99)
    lines = [line for line in lines_of(first, last) if line["waist"] > 0.0]
    stamped = [line for line in lines_of("stamp", first, last) if line["waist"] > 0.0]
    long_ones = sum(line["diameters"] > 0.0 for line in lines)
    rings = sum(line["ring"] for line in lines)
    return ["## separate", "",
            "![The bundled case's outlets from its image at a threshold of 400, as extracted and separated]"
            "(../pictures/separate.png)",
            "",
            f"Seeds {first}-{last}: images of two vessels with radii of 3 to 6 voxels that pass each other at 0.1 to 1.6 voxels,",
            "with blur, noise, and contrast between them, extracted at one threshold (tests/bench/touching_phantoms.h). In",
            f"{len(lines)} of them the vessels are one surface; {long_ones} contacts are 2 to 5 diameters long, and in {rings}",
            "the vessels are joined elsewhere as well, so that the contact makes a handle. The waist is the contact's width over",
            "the thinner vessel's diameter. Beside it, what a slab by `stamp` at the same place achieves.", "",
            "| | goal | separate | stamp |", "|---|---|---|---|", *rows(lines, stamped), "",
            "The phantoms' sections are circular, as the tubes suppose; vessels' need not be. No furcation is near the contacts;",
            "the next section has them.",
            ""]


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--build", action="store_true")
    given = parser.parse_args()
    print("\n".join(section(common.PROGRAM, given.quick, 1 if given.build else 101)))


if __name__ == "__main__":
    main()
