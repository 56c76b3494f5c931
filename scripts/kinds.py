#!/usr/bin/env python3
"""What becomes of the kinds of input that people have: docs/science/kinds.md.

  scripts/kinds.py [--out FOLDER] [--only PART] [--jobs N]     prepares the inputs of ../shared/data/strangers and slicer, prints
                                                               a row for each, and exits with 1 if one is not as expected
  scripts/kinds.py page [--out FOLDER]                         writes the page of what FOLDER/results.json has
"""
import concurrent.futures
import dataclasses
import datetime
import glob
import json
import os
import shutil
import subprocess
import sys
import textwrap

import common
import page_rows
from common import DATA, PROGRAM, ROOT, row_line

PAGE = os.path.join(ROOT, "docs", "science", "kinds.md")
ARTERY_ML = 26.3  # of the labels' artery, by its voxels


@dataclasses.dataclass
class Kind:
    """An input, what is expected of it, and what a36b1d73 made of it."""
    name: str
    file: str         # of strangers-made or slicer
    arguments: list   # of prepare, behind the file; "@NAME" is a file beside it
    expected: str
    before: str
    check: object     # of a Made: the figures that were found, and whether they are as expected


@dataclasses.dataclass
class Made:
    code: int
    said: str
    folder: str

    def report(self):
        with open(os.path.join(self.folder, "report.json")) as file:
            return json.load(file)

    def openings(self):
        return sum(end["fate"] in ("opened", "kept") for end in self.report()["ends"])

    def measures(self):
        surface = os.path.join(self.folder, "surface.vtp")
        done = subprocess.run([PROGRAM, "measure", surface, "--json"], capture_output=True, text=True)
        return json.loads(done.stdout)

    def volume(self):
        return self.measures()["volume"] / 1000.0


# --- what is expected --------------------------------------------------------------------------------------------------
def made(made_it):
    return "made", made_it.code == 0


def asked(word):
    def check(made_it):
        return f"asked: {word}", made_it.code == 2 and word in made_it.said
    return check


def openings(count, word=""):
    def check(made_it):
        if made_it.code != 0:
            return "refused", False
        found = made_it.openings()
        return f"{found} openings" + (f", '{word}' said" if word in made_it.said and word else ""), \
            found == count and word in made_it.said
    return check


def distance(name, expected):
    def check(made_it):
        if made_it.code != 0:
            return "refused", False
        found = made_it.report()["neighbours"][name]["distance_mm"]
        return f"{found:.2f} mm away", abs(found - expected) < 0.1
    return check


def artery(within, most_handles=0):
    def check(made_it):
        if made_it.code != 0:
            return "refused", False
        found = made_it.measures()
        volume = found["volume"] / 1000.0
        return (f"{volume:.1f} ml, {found['genus']} handles",
                abs(volume - ARTERY_ML) < within * ARTERY_ML and found["genus"] <= most_handles)
    return check


def stenosis(made_it):
    if made_it.code != 0:
        return "refused", False
    known = "does not say how wide" in made_it.said
    return "made" + (", 'does not say how wide' said" if known else ""), known


KINDS = [
    Kind("a neighbour in RAS axes", "mask.nii.gz", ["--neighbour", "@tumour_ras.stl", "--units", "mm", "--for", "planning"],
         "1.6 mm beside the vessel", "RAS ignored: 78 mm away, exit 0", distance("tumour_ras", 1.6)),
    Kind("the same in LPS axes", "mask.nii.gz", ["--neighbour", "@tumour_lps.stl", "--units", "mm", "--for", "planning"],
         "1.6 mm beside the vessel", "not noted", distance("tumour_lps", 1.6)),
    Kind("a stenosis one voxel wide", "string.nii.gz", ["--for", "cfd"],
         "as wide as a voxel, and said that the mask says no more", "0.08 to 0.2 mm wide; 'misses 1 thin vessel'", stenosis),
    Kind("trunk and branch as bodies that overlap", "overlap.stl", ["--units", "mm", "--for", "cfd"], "united: 3 openings",
         "the branch is dropped", openings(3)),
    Kind("vessels on a base plate", "plate.stl", ["--units", "mm", "--for", "rp"], "the plate is asked about",
         "the plate is taken for the vessel", asked("cannot be a vessel")),
    Kind("triangles as an unstructured grid", "ugrid.vtk", ["--units", "mm", "--for", "cfd"], "read", "'not a VTK image'", made),
    Kind("a mask with missing voxels", "salt_mask.nii.gz", ["--for", "cfd"], "closed as far as needed, said: 2 openings",
         "'no vessel in it; add a mask'", openings(2, "full of holes")),
    Kind("a segment cropped to its own box", "tight_box.nii.gz", ["--for", "cfd"], "its sides are wall: 2 openings",
         "its sides become openings", openings(2, "touches the image's border")),
    Kind("a segment by its name", "two.seg.nrrd", ["--label", "artery", "--for", "rp"], "the artery, 26.3 ml",
         "no `--label`", artery(0.03)),
    Kind("several segments, none chosen", "two.seg.nrrd", ["--for", "rp"], "the list of segments, nothing made",
         "the spine, exit 0", asked("artery")),
    Kind("segments cropped as 3D Slicer saves them", "cropped.seg.nrrd", ["--label", "artery", "--for", "rp"],
         "the artery, 26.3 ml", "no `--label`", artery(0.03)),
    Kind("the same voxels on a flipped axis", "flipped.seg.nrrd", ["--label", "artery", "--for", "rp"], "the artery, 26.3 ml",
         "no `--label`", artery(0.03)),
    Kind("segments that overlap, in layers", "overlap.seg.nrrd", ["--label", "artery", "--for", "rp"], "one of them is taken",
         "a clear refusal", artery(0.03)),
    Kind("one segment", "plain.seg.nrrd", ["--for", "rp"], "no question", "not noted", artery(0.03)),
    Kind("a drawn mask beside its image", "ct.nrrd", ["--mask", "@cropped.seg.nrrd", "--label", "artery", "--for", "rp"],
         "the mask's wall, moved by at most a voxel", "31.0 ml, 4 handles", artery(0.05)),
]


# --- the inputs --------------------------------------------------------------------------------------------------------
def made_inputs(out):
    """The files that the scripts of strangers write, by name, and those of slicer."""
    folder = os.path.join(out, "strangers-made")
    os.makedirs(folder, exist_ok=True)
    for script in sorted(glob.glob(os.path.join(DATA, "strangers", "*.py"))):
        subprocess.run(["/usr/bin/python3", script], cwd=folder, capture_output=True)
    paths = [*glob.glob(os.path.join(folder, "*")), *glob.glob(os.path.join(DATA, "slicer", "*"))]
    return {os.path.basename(path): path for path in paths}


def tried(kind, paths, out):
    folder = os.path.join(out, kind.name.replace(" ", "-"))
    shutil.rmtree(folder, ignore_errors=True)
    words = [paths[word[1:]] if word.startswith("@") else word for word in kind.arguments]
    done = subprocess.run([PROGRAM, "prepare", paths[kind.file], *words, "--out", folder], capture_output=True, text=True)
    found, met = kind.check(Made(done.returncode, done.stdout + done.stderr, folder))
    shutil.rmtree(folder, ignore_errors=True)
    command = " ".join([kind.file, *(word.lstrip("@") for word in kind.arguments)])
    print(f"{'as expected' if met else 'NOT AS EXPECTED':15} {kind.name}: {found}", flush=True)
    return {"kind": kind.name, "command": command, "expected": kind.expected, "before": kind.before, "now": found, "met": met}


# --- the page ------------------------------------------------------------------------------------------------------------
ABOUT = """# Kinds of input that people have

{written}

The inputs are small and made up; the kind of fault is real. *Before* is what revision a36b1d73 made of them, as the notes beside
the inputs and the report of that trial have it. tests/workbench/strangers_test.cpp and
label_choice_test.cpp expect the same of most.

"""


def write_page(out):
    with open(os.path.join(out, "results.json")) as file:
        run = json.load(file)
    rows = [row_line([r["kind"], f"`{r['command']}`", r["expected"], r["before"], r["now"] if r["met"] else f"**{r['now']}**"])
            for r in run["rows"]]
    met = sum(r["met"] for r in run["rows"])
    written = textwrap.fill(f"Written by `scripts/kinds.py page` with the program of {run['revision']}, run on {run['date']}: "
                            f"{met} of {len(run['rows'])} as expected; others are in bold.", 130)
    with open(PAGE, "w") as file:
        file.write(ABOUT.format(written=written) +
                   common.table(["kind", "`prepare`", "expected", "before", "now"], rows).rstrip() + "\n")


def main():
    parser = common.parser(__doc__)
    parser.add_argument("page", nargs="?", choices=["page"])
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "kinds"))
    parser.add_argument("--only", default="", help="part of a kind's name")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    if options.page:
        return write_page(options.out)
    if not os.path.isdir(DATA):
        common.skip("no ../shared/data")
        return 77
    os.makedirs(options.out, exist_ok=True)
    run = {"revision": page_rows.revision(), "date": str(datetime.date.today())}
    paths = made_inputs(options.out)
    kinds = [kind for kind in KINDS if options.only in kind.name]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda kind: tried(kind, paths, options.out), kinds))
    with open(os.path.join(options.out, "results.json"), "w") as file:
        json.dump({**run, "rows": rows}, file, indent=1)
    return 0 if all(row["met"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
