#!/usr/bin/env python3
"""Calls faults planted into phantoms, and whatever the forest's cases have, and compares the calls with the truth.

  scripts/repairs_findings.py [--seeds A-B] [--clean] [--forest A,B,...] [--quick] [--out FOLDER] [--program FILE]

A seed makes a furcation with voxels of 0.4 mm, noise and blur, and plants one fault, or none: steps of thick slices, a
bump, a dent, a stub, a bridge between two vessels, two walls nearly in contact, a piece apart, threads in place of an end,
a hole, a wall that passes through itself, an oblique end. `vesselbench findings` then lists what it finds. A call is right
if it names the fault planted there (of a bump, that a stub is there is right as well, and so for a bridge and a contact).
Seeds 1-100 are to build with; of 101-200 the first 60 are reported, and surfaces of the forest's second half. Of the
forest's surfaces, a call is right if truth.json has such a thing there.
"""
import json
import math
import os
import random
import subprocess
import sys

import common
from common import BUILD, Project, cross, length, read_off, run, scaled, sub, write_off

VOXEL = 0.4  # [mm]
KINDS = ["none", "staircases", "bump", "dent", "stub", "handle", "contact", "detached", "frayed-end", "hole",
         "self-intersection", "oblique-end"]
# Kinds that describe the same fault.
SAME = {"bump": {"bump", "stub"}, "stub": {"stub", "bump"}, "handle": {"handle", "contact"},
        "contact": {"contact", "handle"}, "frayed-end": {"frayed-end", "stub"}}
BINS = [(0.0, 0.3), (0.3, 0.5), (0.5, 0.8), (0.8, 1.01)]
SURE = 0.8
LISTED = 0.5  # less is folded
QUICK = range(1, 13)
REPORTED = range(101, 161)
FOREST = [101, 103, 105, 106, 108, 110, 116, 121, 130, 135, 136, 140, 149, 150]  # surfaces of its second half


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def unit(a):
    return scaled(a, 1 / length(a))


def vessel(name, points, blend=0.0):
    part = {"name": name, "vessel": {"points": [list(point) for point in points]}}
    return part | ({"blend": blend} if blend else {})


class Tree:
    """A trunk and two daughters in a random direction, as parts of a phantom."""

    def __init__(self, chance):
        self.chance = chance
        self.trunk = chance.uniform(1.7, 2.1)
        self.radii = [self.trunk * chance.uniform(0.72, 0.85) for _ in range(2)]
        axes = unit([chance.gauss(0, 1) for _ in range(3)])
        side = unit(cross(axes, unit([chance.gauss(0, 1) for _ in range(3)])))
        self.up, self.side, self.across = axes, side, cross(axes, side)
        angle = math.radians(chance.uniform(28, 40))
        self.ways = [add(scaled(self.up, math.cos(angle)), scaled(self.side, sign * math.sin(angle))) for sign in (1, -1)]
        self.lengths = [15.0, 14.0, 14.0]
        start = scaled(self.up, -self.lengths[0])
        self.parts = [vessel("trunk", [(*start, self.trunk), (0, 0, 0, self.trunk)])]
        for k in range(2):
            end = scaled(self.ways[k], self.lengths[k + 1])
            self.parts.append(vessel(f"daughter {k}", [(0, 0, 0, self.radii[k]), (*end, self.radii[k])], 0.6))
        self.spacing, self.blur, self.arguments = [VOXEL] * 3, 0.5, []

    def at_trunk(self, share=None):
        """A place of the wall: the line's point, radius, outward direction."""
        share = self.chance.uniform(0.4, 0.6) if share is None else share
        turn = self.chance.uniform(0, 2 * math.pi)
        way = add(scaled(self.side, math.cos(turn)), scaled(self.across, math.sin(turn)))
        return scaled(self.up, -share * self.lengths[0]), self.trunk, way


# --- faults of the image: each adds to the tree, and says where ------------------------------------------------------
def plant_staircases(tree, chance):
    tree.spacing = [VOXEL, VOXEL, VOXEL * chance.choice([2, 3, 4])]
    tree.blur = 0.0
    if chance.random() < 0.5:
        tree.arguments = ["method=labels", "mask_surface=midway"]
    return None, 0.0


def plant_bump(tree, chance):
    middle, radius, way = tree.at_trunk()
    size = chance.uniform(0.45, 0.65) * radius
    height = chance.uniform(0.1, 0.45) * radius
    centre = add(middle, scaled(way, radius + height - size))
    tree.parts.append({"name": "bump", "sphere": {"centre": list(centre), "radius": size}, "blend": 0.3})
    return add(middle, scaled(way, radius + height)), size


def plant_stub(tree, chance):
    middle, radius, way = tree.at_trunk()
    size = chance.uniform(0.4, 0.55) * radius
    reach = radius + chance.uniform(0.8, 2.2) * size
    tip = add(middle, scaled(way, reach))
    tree.parts.append(vessel("stub", [(*middle, size), (*tip, size)], 0.3))
    return add(middle, scaled(way, reach + size)), 2.5 * size


def plant_handle(tree, chance):
    """The daughters bend towards each other until they touch."""
    apart = sum(tree.radii) - chance.uniform(0.1, 0.4)
    along = chance.uniform(10.0, 11.5)
    for k, sign in enumerate((1, -1)):
        radius = tree.radii[k]
        line = [(0, 0, 0), scaled(tree.ways[k], 6.5), add(scaled(tree.up, along), scaled(tree.side, sign * apart / 2)),
                add(scaled(tree.up, along + 6), scaled(tree.side, sign * (apart / 2 + 3)))]
        tree.parts[1 + k] = vessel(f"daughter {k}", [(*point, radius) for point in line], 0.6 if k == 0 else 0.0)
    return scaled(tree.up, along), 2.5


def plant_contact(tree, chance):
    """A branch of the trunk that turns back along it, less than a voxel away."""
    middle, radius, way = tree.at_trunk(0.8)
    thin = 0.9
    apart = radius + thin + chance.uniform(0.7, 1.3) * VOXEL
    out, along = scaled(way, radius + 5.0), tree.up
    line = [middle, add(out, scaled(along, -0.5)), add(out, scaled(along, 3.0)), add(scaled(way, apart), scaled(along, -2.5)),
            add(scaled(way, apart), scaled(along, -1.0))]
    line[2] = add(middle, add(scaled(way, radius + 4.5), scaled(along, 3.5)))
    line[1] = add(middle, add(scaled(way, radius + 3.5), scaled(along, 0.8)))
    line[3] = add(middle, add(scaled(way, apart), scaled(along, 5.5)))
    line[4] = add(middle, add(scaled(way, apart), scaled(along, 7.5)))
    tree.parts.append(vessel("back", [(*point, thin) for point in line], 0.3))
    return add(middle, add(scaled(way, radius), scaled(along, 6.5))), 2.5


def plant_detached(tree, chance):
    middle, radius, way = tree.at_trunk()
    centre = add(middle, scaled(way, radius + 4.0))
    size = chance.uniform(0.5, 1.4)
    tree.parts.append({"name": "apart", "sphere": {"centre": list(centre), "radius": size}})
    tree.arguments = ["component=all"]
    return centre, size


def plant_frayed(tree, chance):
    end, thin = scaled(tree.up, -tree.lengths[0]), 0.4
    tree.trunk *= 1.4
    tree.parts[0] = vessel("trunk", [(*end, tree.trunk), (0, 0, 0, tree.trunk)])
    for k in range(3):
        turn = k * 2 * math.pi / 3 + chance.uniform(-0.2, 0.2)
        way = add(scaled(tree.side, math.cos(turn)), scaled(tree.across, math.sin(turn)))
        first = add(end, scaled(way, 0.55 * tree.trunk))
        last = add(first, add(scaled(tree.up, -chance.uniform(2.6, 3.2) * tree.trunk), scaled(way, 0.3)))
        tree.parts.append(vessel(f"thread {k}", [(*first, thin), (*last, thin)]))
    return add(end, scaled(tree.up, -2 * tree.trunk)), 3 * tree.trunk


IMAGED = {"staircases": plant_staircases, "bump": plant_bump, "stub": plant_stub, "handle": plant_handle,
          "contact": plant_contact, "detached": plant_detached, "frayed-end": plant_frayed}


# --- faults of the surface: each changes a project, and says where ---------------------------------------------------
def plant_dent(project, tree, chance):
    middle, radius, way = tree.at_trunk()
    place = add(middle, scaled(way, radius))
    dab = {"point": place, "normal": way, "vessel_radius": radius, "radius": 0.75 * radius, "strength": -1.0}
    project.apply("brush-inflate", "dabs=" + json.dumps([dab] * chance.randint(2, 7)))
    return place, 0.8 * radius


def reloaded(project, change):
    """Replaces the project by one of its surface, changed by the function of points and triangles."""
    file = os.path.join(project.folder, project.name + ".off")
    run("export", project.project, file)
    write_off(file, *change(*read_off(file)))
    project.project = os.path.join(project.folder, project.name + "-changed.vbench")
    common.new_project(project.project, file, "--units", "mm")


def plant_hole(project, tree, chance):
    middle, radius, way = tree.at_trunk()
    place = add(middle, scaled(way, radius))
    size = chance.uniform(0.12, 0.35) * radius

    def opened(points, triangles):
        return points, [t for t in triangles if min(length(sub(points[v], place)) for v in t) > size]
    reloaded(project, opened)
    return place, 1.5 * size


def plant_crossing(project, tree, chance):
    middle, radius, way = tree.at_trunk()
    place = add(middle, scaled(way, radius))
    size = chance.uniform(0.5, 0.7) * radius

    def pushed(points, triangles):
        def moved(point):
            share = max(0.0, 1 - (length(sub(point, place)) / size) ** 2)
            return sub(point, scaled(way, 2.6 * radius * share))
        return [moved(p) for p in points], triangles
    reloaded(project, pushed)
    return add(middle, scaled(way, -radius)), radius


def plant_oblique(project, tree, chance):
    project.apply("clip-opening", "check=none")
    clip = project.newest()
    planes = clip["resolved"]["planes"]
    k = chance.randrange(len(planes))
    normal, turn = planes[k]["normal"], math.radians(chance.uniform(8, 40))
    axis = unit(cross(normal, [chance.gauss(0, 1) for _ in range(3)]))
    turned = unit(add(scaled(normal, math.cos(turn)), scaled(cross(axis, normal), math.sin(turn))))
    point = sub(planes[k]["point"], scaled(normal, 1.6 * tree.trunk))
    plane = {"tip": planes[k]["tip"], "point": list(point), "normal": list(turned), "way": "cut"}
    arguments = ["planes=" + json.dumps(planes[:k] + [plane] + planes[k + 1:]), "names=" + json.dumps(clip["resolved"]["names"])]
    if "closings" in clip["resolved"]:
        arguments.append("closings=" + json.dumps(clip["resolved"]["closings"]))
    run("change", project.project, clip["edit"], *arguments)
    return point, tree.trunk


PROCESSED = {"dent": plant_dent, "hole": plant_hole, "self-intersection": plant_crossing, "oblique-end": plant_oblique}


# --- calls and their truth ------------------------------------------------------------------------------------------
def findings_of(project):
    return json.loads(run("findings", project, "--json"))["findings"]


def called(seed, folder):
    """Kind and place of the planted fault, and what was found."""
    chance = random.Random(seed)
    kind = KINDS[(seed - 1) % len(KINDS)]
    tree = Tree(chance)
    if kind == "none" and seed % 24 == 1:  # slices twice as thick, whose steps the blur hides
        tree.spacing = [VOXEL, VOXEL, 2 * VOXEL]
    place, size = IMAGED[kind](tree, chance) if kind in IMAGED else (None, 0.0)
    name = f"seed{seed}"
    phantom = {"name": name, "about": "A furcation with a planted fault.", "seed": seed, "surface_edge": 1.0, "parts": tree.parts,
               "imaging": {"spacing": tree.spacing, "margin": 2.0, "inside": 1000, "outside": 0,
                           "blur": [tree.blur * s for s in tree.spacing], "noise": 30}}
    with open(os.path.join(folder, name + ".json"), "w") as file:
        json.dump(phantom, file)
    made = os.path.join(folder, name)
    run("phantom", name + ".json", "--out", made, folder=folder)
    source = [os.path.join(made, "image.nii.gz")]
    if "method=labels" in tree.arguments:
        source += ["--mask", os.path.join(made, "mask.nii.gz")]
    project = Project(folder, name, *source).apply("extract-surface", *tree.arguments)
    if kind in PROCESSED:
        place, size = PROCESSED[kind](project, tree, chance)
    return kind, place, size, findings_of(project.project)


def is_right(finding, kind, place, size):
    if finding["kind"] not in SAME.get(kind, {kind}):
        return False
    return place is None or length(sub(finding["place_mm"], place)) <= size + finding["size_mm"] + 2 * VOXEL


def forest_truth(truth):
    """(kinds, place, size) of all that a case's truth has."""
    things = [({"stub", "bump"}, sac["centre_mm"], sac["radius_mm"]) for sac in truth["sacs"]]
    things += [({"contact", "handle"}, kiss["place_mm"], truth["resolution_mm"] * 8) for kiss in truth["kisses"]]
    for end in truth["ends"]:
        if end["kind"] == "oblique":
            things.append(({"oblique-end"}, end["place_mm"], end["diameter_mm"]))
        branch = truth["branches"][end["branch"]]
        free = length_of(branch["points_mm"]) - branch["free_from_mm"]
        if end["kind"] == "rounded" and free < 2.0 * end["diameter_mm"]:
            things.append(({"stub", "bump"}, end["place_mm"], 2 * end["diameter_mm"]))
    if truth["kind"].startswith("voxel"):
        things.append(({"staircases"}, None, 0.0))
    return things


def length_of(line):
    return sum(length(sub(a[:3], b[:3])) for a, b in zip(line, line[1:]))


def forest_calls(seed, folder):
    """[(certainty, right, kind)] of a case that is a surface; empty for images."""
    case = os.path.join(folder, f"forest{seed}")
    subprocess.run([os.path.join(BUILD, "forest"), "plant", str(seed), case], check=True, capture_output=True)
    with open(os.path.join(case, "truth.json")) as file:
        truth = json.load(file)
    if "image" in truth["kind"] or "mask" == truth["kind"]:
        return []
    project = Project(folder, f"forest{seed}", os.path.join(case, truth["file"])).apply("repair")
    things = forest_truth(truth)
    calls = []
    for found in findings_of(project.project):
        right = any(found["kind"] in kinds and (place is None or length(sub(found["place_mm"], place)) <= size + found["size_mm"])
                    for kinds, place, size in things)
        calls.append((found["certainty"], right, found["kind"]))
    return calls


# --- tables ---------------------------------------------------------------------------------------------------------
def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.0f} %)" if whole else "-"


def calibration(calls):
    rows = []
    for low, high in BINS:
        inside = [call for call in calls if low <= call[0] < high]
        mean = sum(call[0] for call in inside) / len(inside) if inside else 0.0
        rows.append([f"{100 * low:.0f} to {100 * min(high, 1):.0f} %", len(inside), f"{100 * mean:.0f} %" if inside else "-",
                     share(sum(call[1] for call in inside), len(inside))])
    return common.table(["called", "findings", "mean of the calls", "right"], rows)


def by_kind(planted, calls):
    rows = []
    for kind in KINDS:
        mine = [sure for what, sure in planted if what == kind]
        named = [call for call in calls if call[2] == kind and call[0] >= SURE]
        rows.append([kind, share(sum(mine), len(mine)) if kind != "none" else f"{len(mine)} clean",
                     share(sum(call[1] for call in named), len(named))])
    return common.table(["planted", "called at least 80 % sure", "of calls of this kind at least 80 % sure, right"], rows)


def clean_rates(clean):
    """What is found on models without a fault, by kind; `clean` has (certainty, kind) of the calls on each."""
    rows = []
    for kind in sorted({kind for calls in clean for _, kind in calls}):
        mine = [[c for c, k in calls if k == kind] for calls in clean]
        rows.append([kind, sum(map(len, mine)), sum(c >= LISTED for calls in mine for c in calls),
                     sum(c >= SURE for calls in mine for c in calls),
                     share(sum(any(c >= LISTED for c in calls) for calls in mine), len(clean))])
    rows.append(["all", sum(map(len, clean)), sum(c >= LISTED for calls in clean for c, _ in calls),
                 sum(c >= SURE for calls in clean for c, _ in calls),
                 share(sum(any(c >= LISTED for c, _ in calls) for calls in clean), len(clean))])
    return common.table([f"on {len(clean)} clean models", "findings", "50 % certain or more: listed", "80 % or more",
                         "models with one that is listed"], rows)


def measured(seeds, forest, folder):
    """Planted faults and whether they were called sure; calls on the phantoms; calls on the forest; failures; calls on the
    clean phantoms."""
    planted, calls, failures, clean = [], [], [], []
    for seed in seeds:
        try:
            kind, place, size, found = called(seed, folder)
        except RuntimeError as failure:
            failures.append(f"seed {seed}: {str(failure).strip().splitlines()[-1]}")
            print(failures[-1], flush=True)
            continue
        right = [(f["certainty"], is_right(f, kind, place, size), f["kind"]) for f in found]
        calls += right
        if kind == "none":
            clean.append([(f["certainty"], f["kind"]) for f in found])
        planted.append((kind, any(c >= SURE and r for c, r, _ in right)))
        calls_here = [(f"{f['kind']} {f['certainty']:.2f}", r[1]) for f, r in zip(found, right)]
        print(seed, kind, planted[-1][1], calls_here[:8], flush=True)
    trees = []
    for seed in forest:
        found = forest_calls(seed, folder)
        trees += found
        print("forest", seed, [(kind, round(c, 2), r) for c, r, kind in found if c >= 0.5][:12], flush=True)
    return planted, calls, trees, failures, clean


def section(tool, quick):
    """The part of docs/science/repairs.md on findings, as lines. `tool` is the program; quick: a few seeds."""
    common.PROGRAM = tool or common.PROGRAM
    folder = os.path.join(common.ROOT, "out", "repairs_findings")
    os.makedirs(folder, exist_ok=True)
    return lines_of(*measured(QUICK if quick else REPORTED, FOREST[:2] if quick else FOREST, folder))


def lines_of(planted, calls, trees, failures, clean):
    faults = [sure for kind, sure in planted if kind != "none"]
    sure = [call for call in calls + trees if call[0] >= SURE]
    goals = common.table(["goal", "measured"],
                         [["of findings called at least 80 % sure, at least 80 % right",
                           share(sum(c[1] for c in sure), len(sure))],
                          ["at least half of the planted faults called at least 80 % sure", share(sum(faults), len(faults))]])
    lines = ["## Findings", "",
             "Furcations with voxels of 0.4 mm, blur of half a voxel and noise of 3 % of the contrast, each with one planted",
             "fault or none, and surfaces of the forest. A call is right if it names what was planted, or what the tree has, at",
             "that place.", "", *goals.splitlines(), "", *by_kind(planted, calls).splitlines(), "", "Phantoms:", "",
             *calibration(calls).splitlines(), "", "Forest:", "", *calibration(trees).splitlines()]
    if clean:
        lines += ["", "Clean phantoms:", "", *clean_rates(clean).splitlines()]
    return lines + (["", f"{len(failures)} could not be made: " + "; ".join(failures)] if failures else [])


def main():
    options = common.parser(__doc__)
    options.add_argument("--seeds", default="", help="A-B")
    options.add_argument("--forest", default="", help="A,B,...; none: no case of it")
    options.add_argument("--clean", action="store_true", help="only those of the seeds that plant no fault")
    options.add_argument("--quick", action="store_true")
    options.add_argument("--out", default=os.path.join(common.ROOT, "out", "repairs_findings"))
    options.add_argument("--program", default=common.PROGRAM)
    arguments = options.parse_args()
    if not arguments.seeds:
        print("\n".join(section(arguments.program, arguments.quick)))
        return 0
    os.makedirs(arguments.out, exist_ok=True)
    first, last = map(int, (arguments.seeds.split("-") * 2)[:2])
    forest = [int(seed) for seed in arguments.forest.split(",") if seed]
    common.PROGRAM = os.path.abspath(arguments.program)
    seeds = [s for s in range(first, last + 1) if not arguments.clean or KINDS[(s - 1) % len(KINDS)] == "none"]
    print("\n".join(lines_of(*measured(seeds, forest, arguments.out))))
    return 0


if __name__ == "__main__":
    sys.exit(main())
