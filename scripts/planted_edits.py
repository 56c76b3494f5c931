#!/usr/bin/python3
"""Plants a wrong edit among honest ones and reads at which place the review's queue puts it.

  scripts/planted_edits.py [--seeds 1-25] [--out FOLDER] [--honest]

A seed chooses case, honest edits, kind and place of the wrong edit: the lumen thinned by 20 %, a bump added, a branch
lost, a cap tilted by 10 degrees, a wrong inlet. "Place" is that of the edit's first item. "Named" is the place of its
first item that is about what was planted: of a wall or a branch a deviation, of a cap or an inlet a choice. --honest
also reads the queue before planting, and counts the projects in which a choice is among the first three without a
reason. About 10 s of CPU time a seed, and 3 s when --out has its projects already. Needs Debian's python3-numpy, hence
/usr/bin/python3. Exit code 1 if fewer than 90 % are among the first three.
"""
import json
import math
import os
import random
import shutil
import sys

import numpy as np

import common
from common import DATA, ROOT, Project, read_off, run

SURFACES = os.path.join(DATA, "surfaces")
CASES = {"aorta": (os.path.join(SURFACES, "vmtk_aorta_surface.stl"), "mm"),
         "aortofemoral": (os.path.join(SURFACES, "sv_demo_aortofemoral.vtp"), "cm"),
         "siphon": (os.path.join(SURFACES, "vampy_aneurisk_C0015_artery.vtp"), "mm"),
         "carotid": (os.path.join(SURFACES, "jk_carotid_left_lumen_clipped.stl"), "mm"),
         "thoracic": (os.path.join(DATA, "ends", "surfaces", "seqseg_6.vtp"), "cm")}
BUNDLED = {"bundled": (os.path.join(ROOT, "cases", "aneurysm"), None)}
KINDS = ["thinned", "bump", "branch", "tilt", "inlet"]
FIRST = 3            # places of the queue that count
LEAST_EDITS = 12     # before one is planted
THINNED, BUMP, TILT_DEG = 0.2, 0.3, 10.0  # of the radius; height in radii; of a cap
FROM_ENDS = 3.0      # radii between what is done at the wall and the vessels' ends


def recipe():
    """The flow model's, without the volume mesh, which no reviewer looks at and which takes longest."""
    with open(os.path.join(ROOT, "workbench", "prepare", "recipes", "prepare.json")) as file:
        return [edit for edit in json.load(file) if edit["operation"] != "tetrahedralize"]


class Made(Project):
    """A project file that is there already, or is copied from another."""

    def __init__(self, path, source=None):
        self.folder, self.name = os.path.dirname(path), os.path.basename(path)[:-len(".vbench")]
        self.project = path
        if source:
            shutil.copyfile(source, path)

    def edits(self):
        return json.loads(run("log", self.project, "--json"))["edits"]

    def run_pending(self):
        run("export", self.project, os.path.join(self.folder, self.name + "-run.off"))

    def clipping(self):
        """The edit that made the openings, with what it decided."""
        self.run_pending()
        return next(e for e in self.edits() if e["operation"] == "clip-opening")

    def change(self, edit, *arguments):
        run("change", self.project, edit, *arguments)

    def queue(self):
        self.run_pending()
        return json.loads(run("review", self.project, "--json"))["queue"]


def prepared(name, source, units, folder):
    """The prepared project, and the wall before its ends were cut; both are kept in the folder."""
    base, wall = os.path.join(folder, name, "project.vbench"), os.path.join(folder, name, "wall.off")
    if os.path.exists(wall):
        return base, wall
    file = os.path.join(folder, "recipe.json")
    with open(file, "w") as recipe_file:
        json.dump(recipe(), recipe_file)
    shutil.rmtree(os.path.dirname(base), ignore_errors=True)
    # the bundled case has a recipe of its own; without a volume mesh, prepare ends with a remark on it
    with_recipe = ["--units", units, "--recipe", file] if units else []
    try:
        run("prepare", source, "--for", "cfd", *with_recipe, "--out", os.path.dirname(base))
    except RuntimeError as failure:
        if "there is no volume mesh" not in str(failure):
            raise
    before = Made(os.path.join(folder, name, "before.vbench"), base)
    run("undo", before.project, before.clipping()["edit"])
    run("export", before.project, wall)
    return base, wall


class Wall:
    """The wall of a vessel, to find places on it."""

    def __init__(self, path, ends):
        points, triangles = read_off(path)
        self.ends = np.array(ends)
        self.corners = np.array(points)[np.array(triangles)]
        self.middles = self.corners.mean(axis=1)
        crosses = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.areas = np.linalg.norm(crosses, axis=1)
        self.normals = crosses / np.maximum(self.areas, 1e-30)[:, None]

    def hit(self, start, direction):
        """Distance to the wall along a ray (Moeller and Trumbore, 1997); infinity without one."""
        a, b, c = self.corners[:, 0], self.corners[:, 1], self.corners[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            p = np.cross(direction, c - a)
            det = np.einsum("ij,ij->i", b - a, p)
            u = np.einsum("ij,ij->i", start - a, p) / det
            q = np.cross(start - a, b - a)
            v = q @ direction / det
            t = np.einsum("ij,ij->i", c - a, q) / det
        met = t[(u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-6)]
        return met.min() if len(met) else math.inf

    def place(self, chance):
        """Radius and eight points with directions round a vessel, away from its ends, where it is about round."""
        for _ in range(2000):
            i = chance.randrange(len(self.middles))
            radius = self.hit(self.middles[i] - 1e-4 * self.normals[i], -self.normals[i]) / 2
            centre = self.middles[i] - radius * self.normals[i]
            if not math.isfinite(radius) or np.linalg.norm(self.ends - centre, axis=1).min() < FROM_ENDS * radius:
                continue
            near = np.linalg.norm(self.middles - centre, axis=1) < 1.5 * radius
            spread = (self.normals[near] * self.areas[near, None]).T @ self.normals[near]
            _, axes = np.linalg.eigh(spread)  # the first one runs along the vessel
            angles = np.arange(8) * math.pi / 4
            ways = [math.cos(a) * axes[:, 1] + math.sin(a) * axes[:, 2] for a in angles]
            reach = [self.hit(centre, way) for way in ways]
            if max(reach) < 1.5 * min(reach):
                return float(np.mean(reach)), [(centre + r * way, way) for r, way in zip(reach, ways)]
        raise RuntimeError("no stretch of a vessel is long enough for an edit at its wall")


def dabs(places, vessel, radius, strength):
    return "dabs=" + json.dumps([{"point": list(point), "normal": list(normal), "vessel_radius": vessel,
                                  "radius": radius, "strength": strength} for point, normal in places])


def coordinates(point):
    return ",".join("%.6g" % x for x in point)


def planes_and_names(clip):
    return list(zip(clip["resolved"]["planes"], clip["resolved"]["names"]))


def choose_inlet(project, clip, plane):
    """Changes the clipping's inlet; where the program then asks about another end, its likelier fate is taken."""
    for doubts in ([], ["accept_doubts=true"]):
        try:
            project.change(clip["edit"], "inlet=" + coordinates(plane["point"]), *doubts)
            return True
        except RuntimeError:
            continue
    return False


# --- honest edits ----------------------------------------------------------------------------------------------------
def add_honest(project, wall, chance):
    """What an operator does beside the recipe. Those in early steps make later ones run again."""
    for _ in range(3):
        radius, ring = wall.place(chance)
        project.apply("brush-smooth", dabs(ring[:chance.randint(1, 3)], radius, chance.uniform(0.6, 1.0) * radius, 0.5))
    radius, ring = wall.place(chance)
    project.apply("brush-inflate", dabs(ring[:1], radius, 0.5 * radius, chance.uniform(0.2, 0.6)))
    radius, ring = wall.place(chance)
    project.apply("brush-weight", dabs(ring[:2], radius, radius, 0.8))
    if chance.random() < 0.5:  # says what the program chose as well
        clip = project.clipping()
        if own := [p for p, n in planes_and_names(clip) if n["kind"] == "inlet"]:
            choose_inlet(project, clip, own[0])
    project.apply("smooth", "filter=taubin", f"iterations={chance.randint(3, 8)}", "find_caps=false")
    if chance.random() < 0.5:
        project.apply("decimate", f"share={chance.uniform(0.8, 0.95):.3f}")
    else:
        project.apply("repair", "--step", "remeshing")
    place = wall.place(chance)[1][0][0]
    project.apply("brush-smooth", "at=" + coordinates(place), f"radius={0.5 * radius:.3f}", "--step", "smoothing")


# --- wrong edits -----------------------------------------------------------------------------------------------------
def number(project):
    """Of the edit that was made last."""
    return max(edit["edit"] for edit in project.edits())


def plant_thinned(project, wall, chance):
    """Dabs all round; where they overlap, about 1.96 times a dab's depth adds up, which is a tenth of its radius."""
    radius, ring = wall.place(chance)
    brush = 1.5 * radius
    project.apply("brush-inflate", dabs(ring, radius, brush, -THINNED * radius / (1.96 * 0.1 * brush)))
    return number(project)


def plant_bump(project, wall, chance):
    radius, ring = wall.place(chance)
    project.apply("brush-inflate", dabs(ring[:1] * 3, radius, radius, BUMP / 0.3))
    return number(project)


def plant_branch(project, wall, chance):
    """The first outlet, in random order, that can be removed."""
    outlets = [plane for plane, name in planes_and_names(project.clipping()) if name["kind"] == "outlet"]
    for plane in chance.sample(outlets, len(outlets)):
        try:
            project.apply("remove-branch", "tip=" + coordinates(plane["tip"]))
            return number(project)
        except RuntimeError:
            continue
    return None


def plant_tilt(project, wall, chance):
    """The cap's plane is moved half a radius inward, so that it is in the vessel, and turned about a random axis."""
    clip = project.clipping()
    planes = clip["resolved"]["planes"]
    measured = {opening["name"]: opening for opening in clip["report"]["openings"]}
    for k in chance.sample(range(len(planes)), len(planes)):
        if clip["resolved"]["names"][k]["name"] not in measured:
            continue
        radius = measured[clip["resolved"]["names"][k]["name"]]["diameter_mm"] / 2
        normal = np.array(planes[k]["normal"])
        axis = np.cross(normal, [chance.gauss(0, 1) for _ in range(3)])
        axis /= np.linalg.norm(axis)
        turn = math.radians(TILT_DEG)
        turned = math.cos(turn) * normal + math.sin(turn) * np.cross(axis, normal)
        plane = {"tip": planes[k]["tip"], "point": list(np.array(planes[k]["point"]) - 0.5 * radius * normal),
                 "normal": list(turned / np.linalg.norm(turned)), "way": "cut"}
        changed = ["planes=" + json.dumps(planes[:k] + [plane] + planes[k + 1:]),
                   "names=" + json.dumps(clip["resolved"]["names"])]
        if "closings" in clip["resolved"]:
            changed.append("closings=" + json.dumps(clip["resolved"]["closings"]))
        try:
            project.change(clip["edit"], *changed)
            return clip["edit"]
        except RuntimeError:
            continue
    return None


def plant_inlet(project, wall, chance):
    clip = project.clipping()
    outlets = [plane for plane, name in planes_and_names(clip) if name["kind"] == "outlet"]
    for plane in chance.sample(outlets, len(outlets)):
        if choose_inlet(project, clip, plane):
            return clip["edit"]
    return None


PLANTS = dict(zip(KINDS, [plant_thinned, plant_bump, plant_branch, plant_tilt, plant_inlet]))
NAMING = {"thinned": "deviation", "bump": "deviation", "branch": "deviation", "tilt": "choice", "inlet": "choice"}


def planted(seed, cases, folder):
    """Case, kind, projects before and after planting, number of honest edits, the planted edit (none: impossible)."""
    names = list(cases)
    kind, name = KINDS[seed % 5], names[(seed // 5 + seed) % len(names)]
    before, after, note = (os.path.join(folder, f"seed-{seed}{end}") for end in (".vbench", "-planted.vbench", ".json"))
    if os.path.exists(note):
        with open(note) as file:
            return name, kind, before, after, *json.load(file)
    chance = random.Random(seed)
    base, wall_file = prepared(name, *cases[name], folder)
    honest = Made(before, base)
    wall = Wall(wall_file, [plane["tip"] for plane in honest.clipping()["resolved"]["planes"]])
    add_honest(honest, wall, chance)
    honest.queue()
    count = len(honest.edits())
    if count < LEAST_EDITS:
        raise RuntimeError(f"seed {seed} has only {count} honest edits")
    edit = PLANTS[kind](Made(after, before), wall, chance)
    with open(note, "w") as file:
        json.dump([count, edit], file)
    return name, kind, before, after, count, edit


# --- reading the queue -----------------------------------------------------------------------------------------------
def place_in(queue, edit, kind=None):
    """From 1; none where it is not listed."""
    return next((k for k, item in enumerate(queue, 1) if item["edit"] == edit and kind in (None, item["kind"])), None)


def parse():
    options = common.parser(__doc__)
    options.add_argument("--seeds", default="1-25", help="A-B")
    options.add_argument("--out", default="/tmp/planted_edits", help="folder of the projects, which are kept")
    options.add_argument("--honest", action="store_true")
    arguments = options.parse_args()
    first, last = map(int, (arguments.seeds.split("-") * 2)[:2])
    return arguments, range(first, last + 1)


def main():
    arguments, seeds = parse()
    os.makedirs(arguments.out, exist_ok=True)
    cases = {name: case for name, case in CASES.items() if os.path.exists(case[0])}
    if len(cases) < len(CASES):
        common.skip("planted edits into real cases: ../shared/data is not there in full")
        cases = {**cases, **BUNDLED}
    rows, places, false_alarms = [], {kind: [] for kind in KINDS}, 0
    for seed in seeds:
        name, kind, before, after, count, edit = planted(seed, cases, arguments.out)
        if edit is None:
            print(f"seed {seed}: {kind} cannot be planted into {name}", flush=True)
            places[kind].append((None, None))
            continue
        queue = Made(after).queue()
        place, named = place_in(queue, edit), place_in(queue, edit, NAMING[kind])
        places[kind].append((place, named))
        rows.append([seed, name, kind, count, place or "-", named or "-", len(queue)])
        print(common.row_line(rows[-1]), [(q["edit"], q["kind"], round(q["score"], 2)) for q in queue[:4]], flush=True)
        if arguments.honest:
            false_alarms += any(item["kind"] == "choice" for item in Made(before).queue()[:FIRST])
    print("\n" + common.table(["seed", "case", "kind", "honest edits", "place", "named", "items"], rows))
    hits = [[sum(1 for p in found if p[k] and p[k] <= FIRST) for k in (0, 1)] for found in places.values()]
    total = sum(map(len, places.values()))
    lines = [[kind, len(places[kind]), *hit] for kind, hit in zip(KINDS, hits)]
    sums = [sum(hit[k] for hit in hits) for k in (0, 1)]
    lines.append(["all", total, *(f"{hit} ({100 * hit / total:.0f} %)" for hit in sums)])
    print(common.table(["planted", "edits", f"among the first {FIRST}", "named there"], lines))
    if arguments.honest:
        print(f"a choice among the first {FIRST} before planting: {false_alarms} of {total}")
    return 0 if sums[0] >= 0.9 * total else 1


if __name__ == "__main__":
    sys.exit(main())
