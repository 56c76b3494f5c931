#!/usr/bin/python3
"""Measures how wide thin vessels come out of intensities with one threshold and with local ones, on phantoms of known radius.

  scripts/experiments_thin.py [--only SHAPE]... [--slices N]... [--radii R]... [--fall SHARE] [--out FOLDER] [--jobs N]
                             [--program FILE]
                           [--no-page]
  scripts/experiments_thin.py --repeat [--out FOLDER] [--jobs N] [--program FILE]

Oblique and flat tubes, helices, furcations (their thinner branch) and vessels with a sac (vessel and sac apart); radii of 1.5 to
3 voxels of the coarsest axis; slices 1 to 3 times as thick as the voxels of 0.4 mm; blur of 0.5 and 1 voxel along each axis;
noise of 0 and 5 % of the contrast. The error of the volume is that of the mean squared distance of the wall from the vessel's
axis (of a sac, the mean cube), away from ends and furcations. --fall: the contrast varies over the image by that share. Without
--only, --slices, --radii, --fall and --no-page it writes docs/science/experiments-thin.md. Exit code 1 if an error with local
levels is above 3 % for radii of 3 voxels or more, or above 8 % for 2. Needs Debian's python3-numpy, hence /usr/bin/python3.

--repeat measures the row of the tube with a radius of 2 voxels and slices of 1 again, in a folder of its own, and compares it
with the page's, within 5 % of each error or 0.3 points (their last digit is 0.1). Exit code 1 if they differ.
"""
import concurrent.futures
import itertools
import json
import math
import os
import shutil
import subprocess
import sys

import numpy

import common
import page_rows
from common import ROOT

VOXEL = 0.4  # [mm]
INSIDE, OUTSIDE = 600.0, 100.0
SHAPES = ["tube", "flat", "helix", "tree", "sac"]
RADII, SLICES, BLURS, NOISES = [1.5, 2, 3], [1, 2, 3], [0.5, 1.0], [0.0, 0.05]
LEVELS = {"one": "midway", "local": "local"}
GOALS = {2: 0.08, 3: 0.03}  # radius [voxels of the coarsest axis]: largest error of the volume


def straight(start, end, count=200):
    return [tuple(a + (b - a) * i / count for a, b in zip(start, end)) for i in range(count + 1)]


def helix(radius, pitch, turns, count=240):
    angles = [2 * math.pi * turns * i / count for i in range(count + 1)]
    return [(radius * math.cos(a), radius * math.sin(a), pitch * a / (2 * math.pi)) for a in angles]


def scaled(vector, length):
    size = math.hypot(*vector)
    return tuple(length * v / size for v in vector)


def vessel(name, points, radius, blend=0.0):
    part = {"name": name, "vessel": {"points": [[*p, radius] for p in points]}}
    return part | ({"blend": blend} if blend else {})


def shape(name, r):
    """Parts of a phantom, and what is measured: name, axis, radius, and the stretch of it that counts [mm] from both ends."""
    o = (0.0, 0.0, 0.0)
    if name == "tube" or name == "flat":
        line = straight(o, scaled((0.35, 0.2, 0.9) if name == "tube" else (1, 0.3, 0.1), 24 * r))
        return [vessel("tube", line[::20], r)], [("tube", line, r, 4 * r, 4 * r)]
    if name == "helix":
        line = helix(6 * r, 8 * r, 1.2)
        return [vessel("helix", line[::6], r)], [("helix", line, r, 4 * r, 4 * r)]
    if name == "tree":
        trunk = straight(scaled((0.1, 0, -1), 24 * r), o)
        thin = straight(o, scaled((0.8, 0.3, 0.6), 20 * r))
        wide = straight(o, scaled((-0.5, -0.2, 0.9), 20 * r))
        return ([vessel("trunk", trunk[::20], 2.5 * r), vessel("thin", thin[::20], r, 0.5 * r),
                 vessel("wide", wide[::20], 2 * r, 0.5 * r)], [("thin branch", thin, r, 9 * r, 4 * r)])
    line = straight(o, scaled((0.3, 0.9, 0.3), 30 * r))
    side = numpy.cross(scaled((0.3, 0.9, 0.3), 1), scaled((1, 0, 0.2), 1))
    centre = tuple(numpy.array(line[100]) + 3.2 * r * side / numpy.linalg.norm(side))
    return ([vessel("vessel", line[::20], r), {"name": "sac", "sphere": {"centre": list(centre), "radius": 2.5 * r},
                                               "blend": 0.4 * r}],
            [("vessel with a sac", line[:70], r, 4 * r, 0.0), ("sac", [centre], 2.5 * r, side, line)])


def read_stl(path):
    data = numpy.fromfile(path, dtype=numpy.uint8)
    count = int(data[80:84].view(numpy.uint32)[0])
    return data[84:84 + 50 * count].reshape(count, 50)[:, 12:48].copy().view(numpy.float32).reshape(count, 3, 3).astype(float)


def squared_radius(triangles, axis, keep):
    """Mean squared distance of the wall from an axis, over the angle around it; [mm^2]"""
    middle = triangles.mean(axis=1)
    area = 0.5 * numpy.linalg.norm(numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    axis = numpy.array(axis)
    squared = ((middle[:, None, :] - axis[None, ::1, :]) ** 2).sum(axis=2)
    nearest = squared.argmin(axis=1)
    # To the axis, not to its samples.
    if len(axis) > 1:
        tangent = numpy.gradient(axis, axis=0)
        tangent /= numpy.linalg.norm(tangent, axis=1)[:, None]
        offset = middle - axis[nearest]
        along = (offset * tangent[nearest]).sum(axis=1)
        distance = numpy.sqrt(numpy.maximum((offset ** 2).sum(axis=1) - along ** 2, 0))
    else:
        distance = numpy.sqrt(squared[:, 0])
    use = keep(nearest, middle)
    if use.sum() < 20:
        return math.nan
    power = len(axis) > 1 and 1 or 2
    weight = area[use] / distance[use] ** power
    return (weight * distance[use] ** (power + 1)).sum() / weight.sum()


def volume_error(triangles, measured):
    name, axis, radius, *rest = measured
    if name == "sac":  # the half away from the vessel, as the volume of a sphere
        side = rest[0]
        cubed = squared_radius(triangles, axis, lambda n, m: ((m - axis[0]) @ side > 0.2 * radius) &
                               (numpy.linalg.norm(m - axis[0], axis=1) < 1.8 * radius))
        return cubed / radius ** 3 - 1
    step = math.dist(axis[0], axis[1])
    first, last = rest[0] / step, len(axis) - 1 - rest[1] / step
    found = squared_radius(triangles, axis, lambda n, m: (n > first) & (n < last) &
                           (numpy.linalg.norm(m - numpy.array(axis)[n], axis=1) < 2.5 * radius))
    return found / radius ** 2 - 1


def measure(case, options):
    name, radius, slices, blur, noise = case
    parts, wanted = shape(name, radius * slices * VOXEL)
    spacing = [VOXEL, VOXEL, slices * VOXEL]
    folder = os.path.join(options.out, f"{name}-{radius}-{slices}-{blur}-{noise}")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "thin.json"), "w") as file:
        json.dump({"name": "thin", "about": "A vessel of known radius.", "seed": 3, "surface_edge": 1.0, "parts": parts,
                   "imaging": {"spacing": spacing, "margin": 5 * slices * VOXEL, "inside": INSIDE, "outside": OUTSIDE,
                               "blur": [blur * s for s in spacing], "noise": noise * (INSIDE - OUTSIDE),
                               "inhomogeneity": options.fall}}, file)

    def program(*arguments):
        done = subprocess.run([options.program, *arguments], capture_output=True, text=True, cwd=folder)
        return done.stderr if done.returncode else None

    image = os.path.join(folder, "thin", "image.nii.gz")
    failure = program("phantom", "thin.json", "--out", "thin")
    rows = []
    for level in LEVELS:
        errors = [math.nan] * len(wanted)
        for name_of in ("p.vbench", "p.stl"):
            if os.path.exists(os.path.join(folder, name_of)):
                os.remove(os.path.join(folder, name_of))
        failure = failure or program("new", "p.vbench", image)
        said = failure or program("apply", "p.vbench", "extract-surface",
                                  f"threshold={LEVELS[level]}") or program("export", "p.vbench", "p.stl")
        if said:
            print(case, level, said.strip().splitlines()[-1], file=sys.stderr)
        else:
            triangles = read_stl(os.path.join(folder, "p.stl"))
            errors = [volume_error(triangles, w) for w in wanted]
        rows.append((level, errors))
    return case, [w[0] for w in wanted], rows


def row_line(key, errors):
    """A row of the page. key: what, radius, slices; errors: {(blur, noise): (one, local)}."""
    what, radius, slices = key
    cells = ["%+.1f / %+.1f" % tuple(100 * e for e in errors[(b, n)]) for b in BLURS for n in NOISES]
    return f"| {what} | {radius:g} | {slices} | " + " | ".join(cells) + " |"


def page(table, revision):
    """docs/science/experiments-thin.md of {key: errors}, as row_line takes them."""
    lines = ["# Thin vessels: one threshold and local levels", "",
             f"Written by `scripts/experiments_thin.py` with the program of {revision}:",
             "the error of a vessel's volume in phantoms of known radius,",
             "in percent, with one threshold (midway between the medians inside and outside the wall) / with local levels (the "
             "default).",
             "Radii in voxels of the coarsest axis; slices as thick as 1 to 3 voxels of 0.4 mm; blur in voxels of each axis; "
             "noise in percent of",
             "the contrast. The goal is 3 % for 3 voxels, 8 % for 2; where the core does not reach 95 % of the contrast, half "
             "the error.", "",
             "| vessel | radius | slices | " + " | ".join(f"blur {b}, noise {100 * n:.0f} %" for b in BLURS for n in NOISES) +
             " |",
             "|---" * (3 + len(BLURS) * len(NOISES)) + "|"]
    lines += itertools.starmap(row_line, table.items())
    lines += ["", "What the blur takes from a thin vessel it takes from the image's peak, not from the integral: levels that "
                  "follow the blurred shape",
              "keep the volume. Flat vessels under thick, blurred slices keep the largest error, since their sections are no "
              "circles in the image."]
    with open(os.path.join(ROOT, "docs", "science", "experiments-thin.md"), "w") as file:
        file.write("\n".join(lines) + "\n")


def measured_table(shapes, radii, slices, options):
    """The errors of these cases, as page() takes them, and how many are beyond the goal."""
    cases = list(itertools.product(shapes, radii, slices, BLURS, NOISES))
    table, missed = {}, 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for case, names, rows in pool.map(lambda c: measure(c, options), cases):
            _, radius, thick, blur, noise = case
            for n, what in enumerate(names):
                errors = tuple(found[n] for _, found in rows)
                label = "flat tube" if case[0] == "flat" else what
                table.setdefault((label, radius, thick), {})[(blur, noise)] = errors
                goal = max((GOALS[r] for r in GOALS if r <= radius), default=math.inf, key=lambda g: -g)
                missed += not abs(errors[-1]) <= goal and goal < math.inf
                print("%-18s radius %.1f slices %d blur %.1f noise %2.0f %%" % (label, radius, thick, blur, 100 * noise) +
                      "".join("  %s %+6.1f %%" % (level, 100 * e) for level, e in zip(LEVELS, errors)), flush=True)
    return table, missed


def repeat(options):
    """Measures one row of the page again. True if it agrees with the page's."""
    options.out = os.path.join(options.out, "repeat")
    shutil.rmtree(options.out, ignore_errors=True)
    table, _ = measured_table(["tube"], [2], [1], options)
    (key, errors), = table.items()
    return page_rows.repeated("experiments-thin.md", "", row_line(key, errors), relative=0.05, least=0.3, label=3)


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--only", action="append", choices=SHAPES)
    parser.add_argument("--slices", action="append", type=int)
    parser.add_argument("--radii", action="append", type=float)
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "experiments_thin"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "vesselbench"))
    parser.add_argument("--fall", type=float, default=0.0)
    parser.add_argument("--no-page", action="store_true")
    parser.add_argument("--repeat", action="store_true")
    options = parser.parse_args()
    options.out, options.program = os.path.abspath(options.out), os.path.abspath(options.program)
    if options.repeat:
        return 0 if repeat(options) else 1
    revision = page_rows.revision()  # of the files as they are now
    table, missed = measured_table(options.only or SHAPES, options.radii or RADII, options.slices or SLICES, options)
    print(f"{missed} beyond the goal")
    if not (options.only or options.slices or options.radii or options.fall or options.no_page):
        page(table, revision)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
