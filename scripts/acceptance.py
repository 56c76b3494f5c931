#!/usr/bin/env python3
"""Prepares the bundled case and every surface and image of ../shared/data for flow simulation and for printing, checks
the products itself and with OpenFOAM and PrusaSlicer, and writes the table docs/science/acceptance.md, with the forest's
results from docs/science/forest.md beside it. A run of every case ends with one row of every page of figures measured again
(`scripts/experiments.py --repeat` and so on), so that no page goes stale unseen, with the review page's tests in Firefox
(`scripts/firefox`), with the package in a bare Debian 12 (`scripts/try_package`) and its container (`scripts/try_container`),
and with batches that are killed at random (`scripts/batch_kills.py`) and run on Slurm (`scripts/batch_slurm.py`).

  scripts/acceptance.py [--only NAME]... [--goal cfd|rp] [--out FOLDER] [--no-table] [--quick] [--no-solve]
  scripts/acceptance.py --forest       only renews the forest's part of docs/science/acceptance.md
  scripts/acceptance.py --rows         only measures the pages' rows again

--quick runs the bundled case and three small ones, and solves the bundled case's flow; without it, every case is run and
the flow is solved on the bundled case's full mesh (minutes; --no-solve leaves that row out). Exit code 1 if a case that
must succeed misses a limit or a row differs from its page; else 77 if something was skipped for lack of ../shared/data.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import time

import common
import page_rows
from common import DATA, PROGRAM, ROOT, cross, dot, length, row_line, skip, sub, table


# name, input, more arguments of prepare, goals, must succeed.
CASES = [
    ("bundled aneurysm", "cases/aneurysm", [], ("cfd", "rp"), True),
    ("v4a aneurysm", "surfaces/v4a_ideal_bifurcation_aneurysm.stl", ["--units", "mm"], ("cfd", "rp"), True),
    ("v4a healthy", "surfaces/v4a_ideal_bifurcation_healthy.stl", ["--units", "mm"], ("cfd", "rp"), True),
    ("aneurisk C0015", "surfaces/vampy_aneurisk_C0015_artery.vtp", [], ("cfd", "rp"), True),
    ("artery bifurcation", "surfaces/vampy_artery_bifurcation.stl", ["--units", "mm"], ("cfd", "rp"), True),
    ("vein", "surfaces/vampy_vein.stl", ["--units", "mm", "--vessel", "vein"], ("cfd", "rp"), True),
    ("aorta closed, inside out", "surfaces/vmtk_aorta_surface.stl", [], ("cfd", "rp"), True),
    ("aorta open ends", "surfaces/vmtk_aorta_surface_open_ends.stl", [], ("cfd", "rp"), True),
    ("aortofemoral (cm)", "surfaces/sv_demo_aortofemoral.vtp", ["--units", "cm"], ("cfd", "rp"), True),
    ("aortofemoral rom (cm)", "surfaces/sv_rom_model_surface.vtp", ["--units", "cm"], ("cfd", "rp"), True),
    ("aortic arch (cm)", "surfaces/gmsh_aorta2_open.stl", ["--units", "cm"], ("cfd", "rp"), True),
    ("small aneurysm (m)", "surfaces/vasp_small_aneurysm_fluidboundary.vtp", ["--close", "1"], ("cfd", "rp"), True),
    ("aorta level set", "images/vmtk_aorta_final_levelset.mha", [], ("cfd", "rp"), True),
    ("aorta MRA, masked", "images/vmtk_aorta.mha",
     ["--mask", "images/vmtk_aorta_final_levelset.mha", "--set", "load-image.mask_iso=0",
      "--set", "load-image.mask_inside=below", "--set", "extract-surface.threshold=700"], ("cfd", "rp"), True),
    ("aorta, two lumens", "images/totalseg_aorta_true_false_lumen.nii.gz", ["--label", "all"], ("cfd", "rp"), True),
    ("cerebral aneurysm (m)", "surfaces/openlb_cerebral_aneurysm3d.stl", [], ("cfd", "rp"), False),
    ("left atrium", "surfaces/vampy_left_atrium.vtp", [], ("cfd", "rp"), False),
    ("carotid raw", "surfaces/jk_carotid_left_lumen_raw.stl", [], ("cfd", "rp"), False),
    ("carotid clipped", "surfaces/jk_carotid_left_lumen_clipped.stl", [], ("cfd", "rp"), False),
    ("carotid capped", "surfaces/jk_carotid_left_lumen_capped.stl", [], ("cfd", "rp"), False),
    ("circle of Willis MR", "images/topcow_mr_roi_003_labels.nii.gz", ["--label", "all"], ("cfd", "rp"), False),
    ("circle of Willis CT", "images/topcow_ct_roi_023_labels.nii.gz", ["--label", "all"], ("cfd", "rp"), False),
    ("aorta of a label map", "images/totalseg_example_labels_117.nii.gz",
     ["--set", "extract-surface.labels=52"], ("cfd", "rp"), False),
    ("liver of a label map", "images/totalseg_example_labels_117.nii.gz",
     ["--set", "extract-surface.labels=5"], ("rp",), False),
    ("TOF MRA", "images/niivue_tof_mra.nii.gz", ["--set", "extract-surface.threshold=60"], ("cfd", "rp"), False),
]


# Number of openings, where it is evident.
OPENINGS = {"bundled aneurysm": 3, "v4a aneurysm": 3, "v4a healthy": 3, "aneurisk C0015": 3, "artery bifurcation": 3,
            "vein": 2, "aorta closed, inside out": 3, "aorta open ends": 3, "aortofemoral (cm)": 3,
            "aortofemoral rom (cm)": 3, "aortic arch (cm)": 5, "small aneurysm (m)": 3, "aorta level set": 3,
            "aorta MRA, masked": 3, "aorta, two lumens": 2, "left atrium": 5, "carotid raw": 3, "carotid clipped": 3,
            "carotid capped": 3}
QUICK = ("bundled aneurysm", "artery bifurcation", "vein", "small aneurysm (m)")
# The scripts that write pages of figures and repeat one of their rows.
REPEATS = [f"{name}.py --repeat" for name in ("experiments", "experiments_decimate", "experiments_flow", "experiments_layers",
                                              "experiments_sacs", "experiments_suggest", "experiments_thin", "experiments_truth",
                                              "experiments_tube")]
# The scripts that try the product as a whole.
WHOLE = ["firefox", "try_package", "try_container", "batch_kills.py", "batch_slurm.py"]
# The bundled case's mesh for a flow to be interpreted, not only to converge.
FULL_MESH = ["--set", "remesh.edge=0.3", "--set", "tetrahedralize.cells=320000"]


# --- reading the exported files ----------------------------------------------------------------------------------------
def read_msh(path):
    """Points, triangles by physical number, halves of quadrilaterals by it, physical names of a Gmsh 2.2 text file."""
    points, triangles, halves, names = {}, {}, {}, {}
    with open(path) as file:
        lines = iter(file)
        for line in lines:
            section = line.strip()
            if section == "$PhysicalNames":
                for _ in range(int(next(lines))):
                    _, number, name = next(lines).split(None, 2)
                    names[int(number)] = name.strip().strip('"')
            elif section == "$Nodes":
                for _ in range(int(next(lines))):
                    number, x, y, z = next(lines).split()
                    points[int(number)] = (float(x), float(y), float(z))
            elif section == "$Elements":
                for _ in range(int(next(lines))):
                    fields = next(lines).split()
                    corners = tuple(map(int, fields[3 + int(fields[2]):]))
                    if fields[1] == "2":
                        triangles.setdefault(int(fields[3]), []).append(corners)
                    elif fields[1] == "3":
                        halves.setdefault(int(fields[3]), []).extend((corners[:3], (corners[0],) + corners[2:]))
    return points, triangles, halves, names


# --- quality ---------------------------------------------------------------------------------------------------------
def triangle_quality(a, b, c):
    """Equiangle skewness and radius ratio 2 r_in / r_out."""
    la, lb, lc = length(sub(b, c)), length(sub(c, a)), length(sub(a, b))
    area = 0.5 * length(cross(sub(b, a), sub(c, a)))
    if area == 0.0 or min(la, lb, lc) == 0.0:
        return 1.0, 0.0

    def angle(opposite, x, y):
        return math.degrees(math.acos(max(-1.0, min(1.0, (x * x + y * y - opposite * opposite) / (2 * x * y)))))

    angles = (angle(la, lb, lc), angle(lb, lc, la), angle(lc, la, lb))
    skewness = max(max((t - 60) / 120, (60 - t) / 60) for t in angles)
    half = 0.5 * (la + lb + lc)
    return skewness, 2 * (area / half) / (la * lb * lc / (4 * area))


def quality(points, triangles):
    pairs = [triangle_quality(*(points[v] for v in t)) for t in triangles]
    skews, ratios = [p[0] for p in pairs], [p[1] for p in pairs]
    return {"skew_mean": sum(skews) / len(skews), "skew_max": max(skews),
            "ratio_mean": sum(ratios) / len(ratios), "ratio_min": min(ratios)}


def cap_frame(points, triangles):
    area, centre, normal = 0.0, [0.0] * 3, [0.0] * 3
    for t in triangles:
        a, b, c = (points[v] for v in t)
        n = cross(sub(b, a), sub(c, a))
        w = 0.5 * length(n)
        area += w
        for k in range(3):
            centre[k] += w * (a[k] + b[k] + c[k]) / 3
            normal[k] += n[k]
    size = length(normal)
    return area, tuple(x / area for x in centre), tuple(x / size for x in normal)


def section_centroid(points, triangles, origin, normal, near):
    """Centroid (by length) of the section curve of the plane that lies nearest to `near`."""
    side = {}
    for v in {v for t in triangles for v in t}:
        side[v] = dot(sub(points[v], origin), normal)
    parent = {}

    def find(x):
        while parent.setdefault(x, x) != x:
            parent[x] = parent[parent[x]]
            x = parent[x]
        return x

    def crossing(u, v):
        key = (min(u, v), max(u, v))
        s = side[u] / (side[u] - side[v])
        return key, tuple(points[u][k] + s * (points[v][k] - points[u][k]) for k in range(3))

    segments = []
    for t in triangles:
        ends = [crossing(t[k], t[(k + 1) % 3]) for k in range(3) if (side[t[k]] < 0) != (side[t[(k + 1) % 3]] < 0)]
        if len(ends) == 2:
            parent[find(ends[0][0])] = find(ends[1][0])
            segments.append(ends)
    sums = {}
    for (key, a), (_, b) in segments:
        w = length(sub(a, b))
        total = sums.setdefault(find(key), [0.0, 0.0, 0.0, 0.0])
        total[0] += w
        for k in range(3):
            total[1 + k] += w * 0.5 * (a[k] + b[k])
    centroids = [tuple(x / s[0] for x in s[1:]) for s in sums.values() if s[0] > 0]
    return min(centroids, key=lambda c: length(sub(c, near)), default=None)


def tilt(points, wall, cap):
    """Angle [deg] between the cap's normal and the line through the section centroids 0.25 to 1 diameter inward."""
    area, centre, normal = cap_frame(points, cap)
    diameter = 2 * math.sqrt(area / math.pi)
    centroids, at = [], centre
    for k in range(7):
        depth = diameter * (0.25 + 0.125 * k)
        origin = tuple(centre[i] - depth * normal[i] for i in range(3))
        at = section_centroid(points, wall, origin, normal, tuple(at[i] for i in range(3)))
        if at is None:
            return None
        centroids.append(at)
    mean = tuple(sum(c[k] for c in centroids) / len(centroids) for k in range(3))
    axis = sub(centroids[0], centroids[-1])
    for _ in range(50):  # power iteration: principal direction of the centroids
        new = [0.0] * 3
        for c in centroids:
            d = sub(c, mean)
            w = dot(d, axis)
            for k in range(3):
                new[k] += w * d[k]
        axis = tuple(x / length(new) for x in new)
    return math.degrees(math.acos(min(1.0, abs(dot(axis, normal)))))


# --- external checkers -----------------------------------------------------------------------------------------------
def number(pattern, text, default=None):
    found = re.search(pattern, text)
    return float(found.group(1)) if found else default


def check_mesh(folder):
    """Figures of OpenFOAM's plain checkMesh."""
    environment = dict(os.environ, WM_PROJECT_DIR="/usr/share/openfoam")
    text = subprocess.run(["checkMesh", "-case", folder], env=environment, capture_output=True, text=True).stdout
    faces = number(r"\n\s+faces:\s+(\d+)", text, 0)
    severe = number(r"Number of severely non-orthogonal \(> 70 degrees\) faces: (\d+)", text, 0)
    return {"ok": "Mesh OK" in text, "cells": int(number(r"\n\s+cells:\s+(\d+)", text, 0)),
            "over_70_percent": 100.0 * severe / faces if faces else 100.0,
            "non_orthogonality_mean": number(r"average: ([\d.]+)", text, 99.0),
            "skewness": number(r"Max skewness = ([\d.e+-]+)", text, 99.0),
            "aspect": number(r"Max aspect ratio = ([\d.e+-]+)", text, 99.0)}


def check_print(path):
    text = subprocess.run(["prusa-slicer", "--info", path], capture_output=True, text=True).stdout
    sizes = [number(rf"size_{axis} = ([\d.]+)", text) for axis in "xyz"]
    return "manifold = yes" in text, sizes


# --- one case --------------------------------------------------------------------------------------------------------
def located(argument):
    for base in (ROOT, DATA):
        if "=" not in argument and os.path.exists(os.path.join(base, argument)):
            return os.path.join(base, argument)
    return argument


def prepare(case, goal, folder, more):
    _, source, arguments, _, _ = case
    shutil.rmtree(folder, ignore_errors=True)
    command = [PROGRAM, "prepare", located(source), "--for", goal, "--out", folder]
    command += [located(a) for a in arguments] + more
    start = time.time()
    done = subprocess.run(command, capture_output=True, text=True)
    error = [line for line in done.stderr.splitlines() if line.startswith("vesselbench:")]
    return done.returncode, time.time() - start, (error or done.stderr.strip().splitlines()[-1:] or [""])[-1]


def measured(path):
    done = subprocess.run([PROGRAM, "measure", path, "--json"], capture_output=True, text=True)
    return json.loads(done.stdout)


def surface_failures(row, folder):
    """Checks the exported surface; fills the row's figures, returns the limits missed."""
    measure = row["measure"] = measured(os.path.join(folder, "surface.vtp"))
    report = json.load(open(os.path.join(folder, "report.json")))
    failures = [name for name, bad in (("not closed", not measure["closed"]), ("not manifold", not measure["manifold"]),
                                       ("self-intersections", measure["self_intersections"] > 0)) if bad]
    bounds = measure["bounds"]
    diagonal = math.dist(bounds[:3], bounds[3:])
    step = max(abs(x) for x in bounds) * 2.0 ** -23
    for patch in measure["patches"]:
        if patch["kind"] != "wall" and patch["flatness"] > 1e-6 * diagonal + step:
            failures.append(f"{patch['name']} not planar ({patch['flatness']:.2g} mm)")
    distance = report.get("distance_to_source", {})
    row["distance"] = distance.get("mean_mm")
    row["source_edge"] = distance.get("source_mean_edge_mm")
    if row["distance"] is not None and row["distance"] > 0.5 * row["source_edge"]:
        failures.append(f"mean distance to the source {row['distance']:.3g} mm")
    row["warnings"] = report.get("warnings", [])
    return failures


def wall_failures(row, folder):
    points, triangles, halves, names = read_msh(os.path.join(folder, "volume.msh"))
    wall_id = next(i for i, n in names.items() if n == "wall")
    wall = triangles[wall_id]
    row["wall"] = quality(points, wall)
    caps = {names[i]: t for i, t in triangles.items() if i != wall_id}
    row["caps"] = max((quality(points, t)["skew_mean"] for t in caps.values()), default=0.0)
    row["tilts"] = {names[i]: tilt(points, wall, t + halves.get(i, [])) for i, t in triangles.items() if i != wall_id}
    limits = (("skew_mean", 0.12, 1), ("skew_max", 0.65, 1), ("ratio_mean", 0.97, -1), ("ratio_min", 0.35, -1))
    failures = [f"wall {key} {row['wall'][key]:.3f}" for key, limit, sign in limits
                if sign * (row["wall"][key] - limit) > 0]
    expected = OPENINGS.get(row["name"], len(caps))
    if len(caps) != expected:
        failures.append(f"{len(caps)} openings, not {expected}")
    if row["caps"] > 0.2:
        failures.append(f"caps' mean skewness {row['caps']:.3f}")
    bends = " ".join(row["warnings"])
    for name, angle in row["tilts"].items():
        if angle is not None and angle > 10 and not (("bend" in bends or "tilted against" in bends) and name in bends):
            failures.append(f"{name} tilted by {angle:.1f} deg")
    return failures


def foam_failures(row, folder):
    foam = row["foam"] = check_mesh(os.path.join(folder, "openfoam"))
    limits = (("over_70_percent", 0.02), ("non_orthogonality_mean", 25), ("skewness", 4), ("aspect", 20))
    failures = [f"checkMesh {key} {foam[key]:.3g}" for key, limit in limits if foam[key] > limit]
    return failures if foam["ok"] else failures + ["checkMesh reports failed checks"]


def solved(folder, *arguments):
    """Runs the flow of a prepared folder. Returns its results (None if there are none), and the seconds it took."""
    start = time.time()
    done = subprocess.run([PROGRAM, "run", folder, "--json", *arguments], capture_output=True, text=True)
    results = json.loads(done.stdout or "{}")
    return results if "figures" in results else None, time.time() - start, done.stderr.strip().splitlines()[-1:]


def flow_failures(row, folder):
    """Runs the exported case unchanged: its figures have to rest within 200 iterations, and its mass to balance."""
    results, seconds, error = solved(folder)
    if results is None:
        row["iterations"] = None
        return [f"the flow cannot be solved: {error}"]
    solution, figures = results["solution"], results["figures"]
    row["iterations"] = solution["iterations"]
    print(f"        flow on {row['foam']['cells']} cells: ended by {solution['ended_by']} after {row['iterations']} iterations, "
          f"{seconds:.0f} s; pressure drop {figures['pressure_drop_pa']:.4g} Pa, mean wall shear stress "
          f"{figures['wall_shear_mean_pa']:.3g} Pa, imbalance {figures['mass_imbalance_percent']:.2g} %", flush=True)
    return [text for text, bad in (("the flow does not converge", not solution["converged"]),
                                   (f"{row['iterations']} iterations", row["iterations"] > 200),
                                   ("mass is not in balance", figures["mass_imbalance_percent"] > 0.1)) if bad]


def tube_failures(out):
    """Hagen-Poiseuille on the tube phantom, from image to results, at the described radius of 2 mm and at the exported lumen's
    mean radius.
    """
    phantom, folder = os.path.join(out, "tube-phantom"), os.path.join(out, "tube-cfd")
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([PROGRAM, "phantom", "tube", "--out", phantom], check=True, capture_output=True)
    subprocess.run([PROGRAM, "prepare", phantom, "--for", "cfd", "--out", folder], check=True, capture_output=True)
    results, _, error = solved(folder)
    if results is None:
        return [f"the tube's flow cannot be solved: {error}"]
    points, triangles, halves, names = read_msh(os.path.join(folder, "volume.msh"))
    caps = [cap_frame(points, t + halves.get(i, [])) for i, t in triangles.items() if names[i] != "wall"]
    run = 1e-3 * length(sub(caps[0][1], caps[1][1]))
    volume = json.load(open(os.path.join(folder, "report.json")))["volume_mesh"]["volume_mm3"]
    failures = []
    for name, radius in (("described", 2e-3), ("exported", math.sqrt(1e-9 * volume / (math.pi * run)))):
        exact = {"pressure_drop_pa": 8 * 4e-3 * run * 1.2e-6 / (math.pi * radius ** 4),
                 "wall_shear_mean_pa": 4 * 4e-3 * 1.2e-6 / (math.pi * radius ** 3)}
        for figure, expected in exact.items():
            error = 100 * (results["figures"][figure] / expected - 1)
            print(f"        tube: {figure} {results['figures'][figure]:.4g}, Hagen-Poiseuille at the {name} radius "
                  f"{1e3 * radius:.3f} mm {expected:.4g}: {error:+.2f} %", flush=True)
            if abs(error) > 3:
                failures.append(f"{figure} {error:+.1f} % off at the {name} radius")
    return failures


def print_failures(row, folder):
    failures = []
    bounds = row["measure"]["bounds"]
    wanted = [bounds[3 + k] - bounds[k] for k in range(3)]
    for name in ("print.stl", "print.3mf"):
        manifold, sizes = check_print(os.path.join(folder, name))
        if not manifold:
            failures.append(f"{name} not manifold")
        if any(s is None or abs(s - w) > 1e-3 * w + 1e-3 for s, w in zip(sizes, wanted)):
            failures.append(f"{name} has a different size")
    return failures


def run_case(case, goal, out, more=(), solve=False):
    folder = os.path.join(out, re.sub(r"[^a-z0-9]+", "-", case[0].lower()) + "-" + goal)
    row = {"name": case[0], "goal": goal, "must": case[4]}
    row["code"], row["seconds"], row["error"] = prepare(case, goal, folder, list(more))
    row["failures"] = []
    if row["code"] == 0:
        row["failures"] = surface_failures(row, folder)
        row["failures"] += wall_failures(row, folder) + foam_failures(row, folder) if goal == "cfd" \
            else print_failures(row, folder)
        if solve:
            row["failures"] += flow_failures(row, folder)
    return row


# --- the table -------------------------------------------------------------------------------------------------------
def verdict(row):
    if row["code"] != 0:
        return f"exit {row['code']}: {row['error']}"
    return "all met" if not row["failures"] else "not met: " + "; ".join(row["failures"])


def table_line(row):
    cells = [row["name"], row["goal"]]
    if row["code"] == 0:
        m = row["measure"]
        cells += [str(m["triangles"])]
        if row["goal"] == "cfd":
            w, f = row["wall"], row["foam"]
            known = [t for t in row["tilts"].values() if t is not None]
            cells += [str(f["cells"]), f"{w['skew_mean']:.3f} / {w['skew_max']:.2f}",
                      f"{w['ratio_mean']:.3f} / {w['ratio_min']:.2f}", f"{max(known, default=0):.1f}",
                      f"{f['skewness']:.2f} / {f['non_orthogonality_mean']:.1f} / {f['over_70_percent']:.3f}"]
        else:
            cells += ["", "", "", "", ""]
        cells += [f"{row['distance']:.3f} / {row['source_edge']:.2f}" if row["distance"] is not None else ""]
    else:
        cells += [""] * 7
    return row_line(cells + [verdict(row)])


FOREST_TITLE = "## The forest\n"


def forest_results():
    """The section "Results" of docs/science/forest.md, without its subsections."""
    with open(os.path.join(ROOT, "docs", "science", "forest.md")) as file:
        text = file.read()
    results = text.split("\n## Results\n", 1)[1].split("\n## ", 1)[0].split("\n### ", 1)[0]
    return (FOREST_TITLE + "\nRandom vessel trees whose truth is known, from the results in [forest.md](forest.md), "
            "which says what is in them and how they are judged.\n\n" + results.strip() + "\n")


def renew_forest(path):
    with open(path) as file:
        kept = file.read().split("\n" + FOREST_TITLE, 1)[0].rstrip("\n")
    with open(path, "w") as file:
        file.write(kept + "\n\n" + forest_results())


def write_table(rows, path, revision):
    head = ["case", "goal", "triangles", "cells", "wall skewness mean / max", "wall radius ratio mean / min",
            "worst tilt [deg]", "checkMesh skewness / mean non-orth. / % over 70", "to source mean / edge [mm]", "verdict"]
    with open(path, "w") as file:
        file.write(f"# Acceptance\n\nWritten by `scripts/acceptance.py` with the program of {revision}: the bundled case and "
                   "real data, prepared with the default recipe, checked by the script itself, OpenFOAM's `checkMesh` and "
                   "PrusaSlicer. The limits are in the script.\n\n")
        file.write(table(head, map(table_line, rows)))
    renew_forest(path)


def chosen(options):
    for case in CASES:
        here = case[1].startswith("cases/") or os.path.isdir(DATA)
        wanted = not options.only or any(part in case[0] for part in options.only)
        if here and wanted and (not options.quick or case[0] in QUICK):
            yield from ((case, goal) for goal in case[3] if options.goal in (None, goal))


def say(row):
    print(f"{row['seconds']:6.1f} s  {row['name']} {row['goal']}: {verdict(row)}", flush=True)


# --- the pages of figures --------------------------------------------------------------------------------------------
def worst_code(scripts):
    """Runs them with their arguments. Exit code: 1 if one fails, else 77 if one was skipped, else 0."""
    codes = []
    for script in scripts:
        print(f"scripts/{script}", flush=True)
        name, *arguments = script.split()
        codes.append(subprocess.run([os.path.join(ROOT, "scripts", name), *arguments]).returncode)
    if any(code not in (0, 77) for code in codes):
        return 1
    return 77 if 77 in codes else 0


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--only", action="append", default=[], help="part of a case's name")
    parser.add_argument("--goal", choices=("cfd", "rp"))
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "acceptance"))
    parser.add_argument("--no-table", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--no-solve", action="store_true")
    parser.add_argument("--forest", action="store_true")
    parser.add_argument("--rows", action="store_true")
    options = parser.parse_args()
    if options.forest:
        return renew_forest(os.path.join(ROOT, "docs", "science", "acceptance.md"))
    if options.rows:
        return worst_code(REPEATS)
    revision = page_rows.revision()  # of the files as they are now
    if not os.path.isdir(DATA):
        skip("no ../shared/data; only the bundled case is run")
    rows, tube = [], []
    if not options.only and options.goal != "rp":
        tube = tube_failures(options.out)
    for case, goal in chosen(options):
        bundled = case[1].startswith("cases/") and goal == "cfd"
        rows.append(run_case(case, goal, options.out, solve=bundled and options.quick))
        say(rows[-1])
        if bundled and not options.quick and not options.no_solve:
            full = ("bundled aneurysm, full mesh",) + case[1:]
            rows.append(run_case(full, goal, options.out, FULL_MESH, solve=True))
            say(rows[-1])
    tilts = sorted(t for r in rows for t in r.get("tilts", {}).values() if t is not None)
    if tilts:
        print(f"tilt of {len(tilts)} openings: median {tilts[len(tilts) // 2]:.2f}, worst {tilts[-1]:.2f} deg")
    whole = not (options.quick or options.only or options.goal)
    if whole and not options.no_table:
        write_table(rows, os.path.join(ROOT, "docs", "science", "acceptance.md"), revision)
    repeated = worst_code([*REPEATS, *WHOLE]) if whole else 0
    if repeated == 1 or tube or any(r["must"] and (r["code"] != 0 or r["failures"]) for r in rows):
        return 1
    return repeated if os.path.isdir(DATA) else 77


if __name__ == "__main__":
    sys.exit(main())
