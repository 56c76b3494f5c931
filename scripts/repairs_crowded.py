#!/usr/bin/env python3
"""Measures separate, stamp and widen where a contact is not alone: a sac, a furcation or a third vessel is beside it.

  scripts/repairs_crowded.py [--quick]

Prints the section of docs/science/repairs.md. --quick: 10 phantoms of each kind. Runs bench_crowded, which scripts/build
bench_crowded makes. Seeds 1-100 are those with which the limits were chosen.
"""
import json
import os
import subprocess

import common

BENCH = os.path.join(common.BUILD, "bench_crowded")
KINDS = {"sac": "sac", "furcation": "furcation", "third": "third vessel"}
FIRST = 101


def lines_of(*arguments):
    printed = subprocess.run([BENCH, *map(str, arguments)], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in printed.splitlines()]


def is_right(line):
    return line.get("wrong") is False and line.get("parted", True) and "guard" not in line


def cells(text, values):
    return "| " + " | ".join([text, *map(str, values)]) + " |"


def table(operation, count):
    measured = [lines_of(operation, kind, FIRST, FIRST + count - 1) for kind in KINDS]

    def counted(test):
        return [sum(bool(test(line)) for line in lines) for lines in measured]

    guarded = zip(counted(lambda line: "guard" in line), counted(lambda line: "guard" in line and line["wrong"]))
    return [cells(f"`{operation}`, {count} of each", KINDS.values()), "|---|---|---|---|",
            cells("right", counted(is_right)),
            cells("refused by its own checks", counted(lambda line: "refused" in line)),
            cells("refused for what the result takes, wrong results among them",
                  [f"{every}, {wrong}" for every, wrong in guarded]),
            cells("wrong", counted(lambda line: line.get("wrong") and "guard" not in line))]


def section(tool, quick):
    """Markdown lines. \\param tool the program (unused: the bench links the library)"""
    count, threads = (10, 10) if quick else (67, 30)
    widened = lines_of("widen", "thread", FIRST, FIRST + threads - 1, 0.25)
    folded = sum("guard" in line for line in widened)
    return ["## What is beside a contact", "",
            f"Seeds from {FIRST} on (tests/support/crowded_contacts.h): what touches is the dome of a sac, a furcation is",
            "0.8 to 3 radii away, or a third vessel passes both. Wrong is a result that loses a sac or an end, cuts a vessel,",
            "or changes the volume by more than 10 %.", "",
            *table("separate", count), "", *table("stamp", min(count, 40)), "",
            f"`widen width=1` on {threads} threads of 0.4 to 0.8 mm between two vessels: {folded} are refused since walls",
            f"beside the thread would be folded over, {threads - folded} become as wide as asked."]


def main():
    options = common.parser(__doc__)
    options.add_argument("--quick", action="store_true")
    print("\n".join(section(common.PROGRAM, options.parse_args().quick)))


if __name__ == "__main__":
    main()
