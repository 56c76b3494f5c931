#!/usr/bin/env python3
"""Shows the gain of staircase- and distance-weighted decimation (thesis 5.6, 7.2) from the reports of `vesselbench apply P
decimate`, which include an unweighted run to the same number of triangles, checks their limits, and writes
docs/science/experiments-decimate.md.

  scripts/experiments_decimate.py [--out FOLDER] [--no-page] [--repeat]

Exit code 1 if a limit is not met. --repeat measures the first row of the ball at 10 % of its triangles again, in a folder of its
own, and compares it with the page's, within 5 % of each figure or 0.02; the second is for the skewness, whose last digit is 0.01.
Exit code 1 if they differ.
"""
import gzip
import math
import os
import shutil
import struct
import sys

import common
import page_rows
from common import DATA, ROOT, Project, row_line, run, table

SHARES = [0.5, 0.25, 0.1]
LEAST_CHECKED = 0.1  # share: below it, the freed part is too small to pay for the kept one
SLICE = 3.0  # of the half-sliced ball [mm]


class Model(Project):
    """A project whose surface is decimated in different ways, each time from the same state."""

    def decimated(self, *arguments):
        self.apply("decimate", *arguments)
        edit = self.newest()
        self.undo()
        return {"triangles": edit["change"]["triangles_after"], **edit["report"]}


def half_sliced_ball(path):
    """A ball's signed distances as an image: above the equator, each slice of 3 mm is constant along z;
    below, the ball is smooth.
    """
    size, spacing, radius = 64, 0.71, 20.03
    start = -0.5 * (size - 1) * spacing
    values = []
    for k in range(size):
        z = start + k * spacing
        z = SLICE * math.floor(z / SLICE) + 0.5 * SLICE if z > 0 else z
        for j in range(size):
            for i in range(size):
                values.append(radius - math.sqrt((start + i * spacing) ** 2 + (start + j * spacing) ** 2 + z * z))
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, size, size, size, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 16, 32)
    struct.pack_into("<8f", header, 76, 1, spacing, spacing, spacing, 1, 1, 1, 1)
    struct.pack_into("<2f", header, 108, 352, 1)
    header[123] = 2  # millimetres
    struct.pack_into("<2h", header, 252, 0, 1)
    for row in range(3):
        struct.pack_into("<4f", header, 280 + 16 * row, *(spacing if column == row else 0.0 for column in range(3)), start)
    header[344:348] = b"n+1\0"
    with gzip.open(path, "wb") as file:
        file.write(bytes(header) + struct.pack("<%df" % len(values), *values))
    return path


def um(figures, part):
    """Mean distance of a part [um]: `inside` is the freed one, `outside` the kept one."""
    return f"{1000 * figures['distance_' + part]['mean_mm']:.1f}"


def cells_of(share, way, report):
    plain = report["unweighted"]
    return (f"{100 * share:g} %", report["triangles"], " ".join(way), um(report, "outside"), um(plain, "outside"),
            um(report, "inside"), um(plain, "inside"), f"{report['shape_after']['equiangle_skewness']['mean']:.2f}")


class Page:
    def __init__(self):
        self.text, self.failed = "", []

    def add(self, title, words, model, ways, shares=SHARES):
        rows = []
        for share in shares:
            for way in ways:
                report = model.decimated(f"share={share}", *way)
                rows.append(cells_of(share, way, report))
                holds = report["distance_outside"]["mean_mm"] < report["unweighted"]["distance_outside"]["mean_mm"]
                text = f"{title}, {share}, {' '.join(way)}: the kept part is closer than without weights"
                checked = share >= LEAST_CHECKED
                print(("  met:     " if holds else "  NOT MET: " if checked else "  (not met): ") + text, flush=True)
                if checked and not holds:
                    self.failed.append(text)
        self.text += f"\n## {title}\n\n{words}\n\n" + table(("triangles", "number", "weights", "kept part: mean distance [um]",
                                                             "unweighted", "freed part [um]", "unweighted", "mean skewness"),
                                                            rows)


BALL_TITLE = "Staircases: a ball of 20 mm, in slices of 3 mm above its equator, smooth below"
# The image's own slices, from which tau_max is taken by default, are thinner than the steps.
BALL_WAYS = [["staircase=true", "tau_theta=0.5", f"tau_max={SLICE:g}", f"beta_min={beta}"] for beta in (0.1, 0.3)]


def ball_model(folder):
    os.makedirs(folder, exist_ok=True)
    ball = Model(folder, "ball", half_sliced_ball(os.path.join(folder, "ball.nii.gz")))
    return ball.apply("extract-surface", "method=threshold", "threshold=0")


def repeat(options):
    """Measures one row of the ball's table again. True if it agrees with the page's."""
    folder = os.path.join(options.out, "repeat")
    shutil.rmtree(folder, ignore_errors=True)
    share, way = 0.1, BALL_WAYS[0]
    row = row_line(cells_of(share, way, ball_model(folder).decimated(f"share={share}", *way)))
    return page_rows.repeated("experiments-decimate.md", BALL_TITLE, row, relative=0.05, least=0.02)


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "experiments-decimate"))
    parser.add_argument("--no-page", action="store_true")
    parser.add_argument("--repeat", action="store_true")
    options = parser.parse_args()
    if options.repeat:
        sys.exit(0 if repeat(options) else 1)
    revision = page_rows.revision()  # of the files as they are now
    page = Page()
    page.add(BALL_TITLE, "Staircases and everything within half of tau_max of them are freed, whatever beta_min is; "
             "the rest is kept.", ball_model(options.out), BALL_WAYS)
    tumour = os.path.join(options.out, "tumour")
    run("phantom", "tumour", "--out", tumour)
    near = Model(options.out, "tumour", os.path.join(tumour, "image.nii.gz")).apply("extract-surface", "method=threshold",
                                                                                    "threshold=500")
    near.apply("load-neighbour", "name=neighbour", "file=" + os.path.join(tumour, "neighbour.vtp"))
    ways = [["distance=linear"], ["distance=margin", "margin=5"], ["distance=exponential"]]
    page.add("Neighbours: the phantom of thesis Table 5.1", "The kept part is where the weight is at most one half: near the "
                                                            "neighbour.", near, ways)
    labels = os.path.join(DATA, "images", "totalseg_example_labels_117.nii.gz")
    if os.path.exists(labels):
        liver = Model(options.out, "liver", labels).apply("extract-surface", "method=labels", "mask_surface=midway", "labels=5")
        liver.apply("load-neighbour", "name=near", "labels=52,7")
        few = liver.decimated("share=0.05", "distance=exponential")
        idle = liver.decimated("share=0.25", "distance=exponential")
        page.add("Neighbours: a liver beside aorta and pancreas", "totalseg_example_labels_117.nii.gz, label 5 beside 52 and 7. "
                                                                  "Three in four of its triangles lie in flat faces of voxels "
                                                                  "and can be removed at no distance, with or without weights: "
                 "only counts below a quarter show the effect of weights. Above that, weights can cost without a gain: at 25 % "
                 "distance=exponential leaves the kept part at "
                 f"{um(idle, 'outside')} um ({um(idle['unweighted'], 'outside')} without weights), and the freed part at "
                 f"{um(idle, 'inside')} um ({um(idle['unweighted'], 'inside')}). "
                 f"At 5 %, which is not checked any more, it leaves the kept part at {um(few, 'outside')} um "
                 f"({um(few['unweighted'], 'outside')}): "
                 "the freed part is too small to pay for it.", liver, ways, [0.15, 0.1, 0.05])
    else:
        print("skipped: no ../shared/data")
    if not options.no_page:
        with open(os.path.join(ROOT, "docs", "science", "experiments-decimate.md"), "w") as file:
            file.write(f"# Context-aware decimation\n\nWritten by `scripts/experiments_decimate.py` with the program of "
                       f"{revision}; "
                       "every row is a report of `vesselbench apply P decimate ...`, "
                       "which also decimates to the same number of triangles without weights. Distances are two-sided, to the "
                       "surface before decimation. At 10 % of the triangles and more, the script fails unless the kept part is "
                       "closer than without weights. "
                       "`tests/bench/bench --only decimation` prints the decimations of CGAL, OpenMesh and VTK beside ours.\n" +
                       page.text)
    for text in page.failed:
        print("NOT MET: " + text)
    sys.exit(1 if page.failed else 0)


if __name__ == "__main__":
    main()
