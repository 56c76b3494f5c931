#!/usr/bin/env python3
"""Compares the proposed necks of aneurysms with those that experts drew; writes docs/science/sacs.md.

  scripts/experiments_sacs.py [--only NAME]... [--no-page] [--repeat]

Cases are the segments of ../shared/data/anatomy whose truth notes a sac's height and its neck's width. `scripts/build sacs` makes
the program that proposes and measures. --repeat measures the row of intra_AN2 again and compares it with the page's, within 2 %
or 0.1 mm; exit code 1 if they differ.
"""
import json
import os
import re
import sys
from statistics import median

import common
import page_rows
from common import DATA, ROOT, run, table

PAGE = os.path.join(ROOT, "docs", "science", "sacs.md")
PROGRAM = os.path.join(common.BUILD, "sacs")
NOTED = re.compile(r"([\d.]+) mm high, neck ([\d.]+) mm wide")
REPEATED = "intra_AN2"
HEAD = ["case", "neck drawn [mm]", "neck [mm]", "height drawn [mm]", "length [mm]", "height [mm]", "verdict"]


# --- the cases -------------------------------------------------------------------------------------------------------
def sacs(only):
    """Name, file, dome, height and neck of each sac."""
    folder = os.path.join(DATA, "anatomy")
    for file in sorted(os.listdir(os.path.join(folder, "truth"))):
        with open(os.path.join(folder, "truth", file)) as text:
            case = json.load(text)
        if only and case["name"] not in only:
            continue
        for end in case["ends"]:
            if noted := NOTED.search(end.get("note", "")):
                yield (case["name"], os.path.join(folder, case["input"]), end["place_mm"], *map(float, noted.groups()))


def measured(name, file, dome, height, neck):
    found = json.loads(run(file, *dome, program=PROGRAM))
    found.update(name=name, drawn_height=height, drawn_neck=neck)
    print(json.dumps(found), flush=True)
    return found


# --- the page --------------------------------------------------------------------------------------------------------
def errors(found, figure, drawn):
    return sorted(abs(sac[figure] / sac[drawn] - 1) for sac in found)


def summary(name, found):
    cells = [name, len(found)]
    for figure, drawn in (("neck_diameter_mm", "drawn_neck"), ("length_mm", "drawn_height"), ("height_mm", "drawn_height")):
        off = errors(found, figure, drawn)
        cells += [f"{100 * median(off):.1f}", f"{100 * off[int(0.8 * len(off))]:.1f}"]
    return cells


def row_of(sac):
    if "reason" in sac:
        return [sac["name"], sac["drawn_neck"], "-", sac["drawn_height"], "-", "-", "no neck"]
    return [sac["name"], sac["drawn_neck"], f"{sac['neck_diameter_mm']:.1f}", sac["drawn_height"], f"{sac['length_mm']:.1f}",
            f"{sac['height_mm']:.1f}", "in doubt" if sac["in_doubt"] else "sure"]


def page(found):
    proposed = [sac for sac in found if "reason" not in sac]
    sure = [sac for sac in proposed if not sac["in_doubt"]]
    summed = table(["necks", "sacs", "neck, median [%]", "80th percentile [%]", "length, median [%]", "80th percentile [%]",
                    "height, median [%]", "80th percentile [%]"], [summary("all proposed", proposed), summary("sure", sure)])
    return f"""# Necks of aneurysms, beside those that experts drew

`scripts/experiments_sacs.py` wrote this page with {page_rows.revision()}. {len(found)} sacs of the IntrA data set, whose experts
marked the sac's points; the surface and a point in the dome are given, the plane of the neck is proposed
(`geometry/vessel/sac/neck_plane.h`). Errors are relative to the drawn figures, without their sign. The neck is its mean diameter;
the length is the largest distance of the wall from the neck's middle, the height that from its plane
(`geometry/vessel/sac/sac_measures.h` has definitions and sources).

{summed}
For {len(found) - len(proposed)} sacs no neck is proposed, since no line leads to the dome or no plane separates it;
{len(proposed) - len(sure)} proposals are in doubt by themselves: their outline is not round, or wall lies far beside it.
Both limits, and the cost that the plane minimises, were chosen on these cases.

{table(HEAD, [row_of(sac) for sac in found])}"""


def repeat():
    sac, = sacs([REPEATED])
    return page_rows.repeated("sacs.md", "", common.row_line(row_of(measured(*sac))), relative=0.02, least=0.1)


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--only", action="append", default=[])
    parser.add_argument("--no-page", action="store_true")
    parser.add_argument("--repeat", action="store_true")
    options = parser.parse_args()
    if not os.path.isdir(os.path.join(DATA, "anatomy")):
        common.skip("../shared/data/anatomy is not there")
        return 77
    if options.repeat:
        return 0 if repeat() else 1
    found = [measured(*sac) for sac in sacs(options.only)]
    if not options.no_page and not options.only:
        with open(PAGE, "w") as file:
            file.write(page(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
