#!/usr/bin/env python3
"""Writes docs/science/repairs.md: what the repairs of vessels achieve where the truth is known.

  scripts/repairs.py [--only NAME]... [--quick] [--out FILE]

Each section is measured by scripts/repairs_NAME.py. --only renews these sections and keeps the others as they are on the page.
--quick measures a few seeds, and prints the sections. Needs the targets bench_stamp, bench_separate, bench_crowded,
bench_narrowing and bench_posing.
"""
import importlib
import os

import common
import page_rows

SECTIONS = ["stamp", "separate", "crowded", "narrowing", "findings", "deform"]
PAGE = os.path.join(common.ROOT, "docs", "science", "repairs.md")
HEAD = """# Repairs

What the repairs of vessels achieve on phantoms whose truth is known, by `scripts/repairs.py`. Seeds 1 to 100 are there to build
with; the seeds that are reported here are others. [operations.md](../user/operations.md) lists the operations' parameters,
[findings.md](findings.md) the finder of artefacts.
"""


def known():
    return [name for name in SECTIONS if os.path.exists(os.path.join(common.ROOT, "scripts", f"repairs_{name}.py"))]


def measured(name, quick):
    lines = importlib.import_module(f"repairs_{name}").section(common.PROGRAM, quick)
    return [lines[0], "", f"Measured with {page_rows.revision()}.", *lines[1:]]


def kept():
    """The sections that are on the page, by heading."""
    if not os.path.exists(PAGE):
        return {}
    with open(PAGE) as file:
        parts = file.read().split("\n## ")[1:]
    return {part.splitlines()[0]: ("## " + part).rstrip().splitlines() for part in parts}


def main():
    options = common.parser(__doc__)
    options.add_argument("--only", action="append", choices=known())
    options.add_argument("--quick", action="store_true")
    options.add_argument("--out", default=PAGE)
    given = options.parse_args()
    sections = {} if given.quick else kept()
    for name in given.only or known():
        lines = measured(name, given.quick)
        sections[lines[0].removeprefix("## ")] = lines
    text = HEAD + "\n" + "\n\n".join("\n".join(lines).rstrip() for lines in sections.values()) + "\n"
    if given.quick:
        print(text)
        return
    with open(given.out, "w") as file:
        file.write(text)


if __name__ == "__main__":
    main()
