#!/usr/bin/env python3
"""Fits the weights by which vessel ends are judged (geometry/vessel/ends/end_weights.csv) to labelled ends.

  scripts/fit_ends.py [--cases FOLDER] [--forest A-B[/STEP]] [--out FOLDER] [--program FILE] [--jobs N] [--ridge R] [--write]

Labelled are real and synthetic cases with true ends (FOLDER/truth and FOLDER/repro; default ../shared/data/ends) and trees
of the forest; `vesselbench ends` measures the features of every candidate. An opening is a true end that has to be open; a
sac, one that stays closed; a bump, a candidate that is no true end. Optional ends, and candidates beside a true end, are
left out. Trunks that a dome closes, the bundled aneurysm, whose largest end is its sac, and an aorta whose largest end is
round, count twice. An end with at most 5 % of the flow counts less than one that decides over a model. Multinomial logistic
regression, cases and forest with the same weight in sum. Without --ridge, the one with the least log loss on patients left out is
taken; a smaller one makes odds that decide more often. Prints the errors on patients left out. --write replaces the table.
Needs python3-numpy; results of `vesselbench ends` stay in FOLDER (default out/fit_ends) and are used again.
"""
import concurrent.futures
import glob
import json
import math
import os
import re
import subprocess
import sys

import common
from common import ROOT

TABLE = os.path.join(ROOT, "geometry", "vessel", "ends", "end_weights.csv")
CLASSES = ("opening", "sac", "bump")
RIDGES = (3e-3, 1e-3, 5e-4, 2e-4, 1e-4)
# Of the inlet's flow: kLeastShare of end_choice.h; and the weight of an end with less.
LEAST_SHARE, SMALL_WEIGHT = 0.05, 0.3
DOMED = (2.0, 2.5)  # [mm], of a trunk of 2 mm radius
# Several cases show one patient.
PATIENTS = {"m_frayds": "frayds", "m_frayds05": "frayds", "m_neck": "neck_obj", "mov_atrium_mm": "mov_atrium",
            "cow023_45": "cow023", "hep002_2": "hep002_1", "hep010_2": "hep010_1", "tsaorta_mask": "tsaorta_ct"}


def measured(command, file):
    """The candidates of a case; measured once."""
    if not os.path.exists(file):
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            print(f"{os.path.basename(file)}: {result.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
            return []
        with open(file, "w") as out:
            out.write(result.stdout)
    return [end for end in json.load(open(file))["ends"] if end["odds"]]


def matched(truths, ends, reach):
    """Index of the true end that each candidate is; the nearest pairs first."""
    pairs = sorted((math.dist(t["place_mm"], e["place_mm"]) / reach(t, e) +
                    0.4 * abs(math.log(max(e["diameter_mm"], 1e-3) / t["diameter_mm"])), i, j)
                   for i, t in enumerate(truths) for j, e in enumerate(ends)
                   if math.dist(t["place_mm"], e["place_mm"]) < reach(t, e))
    of = {}
    for _, i, j in pairs:
        if i not in of.values() and j not in of:
            of[j] = i
    return of


def row(end, label):
    """Features, what it is, and its weight among the ends of its case."""
    return (list(end["odds"]["features"].values()), label,
            1.0 if end["flow_share"] > LEAST_SHARE else SMALL_WEIGHT)


def case_rows(truth, ends):
    edge = truth.get("edge_mm") or 0.0

    def reach(t, e):
        branch = 0.3 * (t.get("branch_mm") or 0.0) if t["role"] != "closed" else 0.0
        return max(1.2 * t["diameter_mm"], 3 * edge, min(e["diameter_mm"], 3 * t["diameter_mm"]), branch)

    of = matched(truth["ends"], ends, reach)
    rows = []
    for j, end in enumerate(ends):
        if j in of:
            label = {"inlet": 0, "open": 0, "closed": 1}.get(truth["ends"][of[j]]["role"])
        elif truth.get("others") == "optional" or any(
                math.dist(t["place_mm"], end["place_mm"]) < max(t["diameter_mm"], 3 * edge) for t in truth["ends"]):
            label = None
        else:
            label = 2
        if label is not None:
            rows.append(row(end, label))
    return rows


def forest_rows(truth, ends):
    of = matched(truth["ends"], ends, lambda t, e: 1.2 * t["diameter_mm"] + 2 * truth["resolution_mm"])
    rows = []
    for j, end in enumerate(ends):
        near = [t for t in truth["ends"] if math.dist(t["place_mm"], end["place_mm"]) < 1.5 * t["diameter_mm"]]
        if j in of:
            label = 0 if truth["ends"][of[j]]["openable"] == "yes" else None
        elif near:
            label = None
        else:
            label = 1 if any(math.dist(s["centre_mm"], end["place_mm"]) < 1.3 * s["radius_mm"]
                             for s in truth.get("sacs", [])) else 2
        if label is not None:
            rows.append(row(end, label))
    return rows


def real_groups(options):
    """(patient, rows) of each case with a truth."""
    files = sorted(glob.glob(os.path.join(options.cases, "truth", "*.json")) +
                   glob.glob(os.path.join(options.cases, "repro", "*.json")))
    truths = [t for t in (json.load(open(f)) for f in files) if "ends" in t and not t.get("acceptable_refusal")]

    def rows(truth):
        arguments = [os.path.join(options.cases, a) if "/" in a else a for a in truth.get("arguments") or []]
        command = [options.program, "ends", os.path.join(options.cases, truth["input"]), *arguments, "--json"]
        ends = measured(command, os.path.join(options.out, truth["name"] + ".json"))
        return PATIENTS.get(truth["name"], truth["name"]), case_rows(truth, ends)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        groups = [group for group in pool.map(rows, truths) if group[1]]
    command = [options.program, "ends", os.path.join(ROOT, "cases", "aneurysm"), "--json"]
    bundled = measured(command, os.path.join(options.out, "aneurysm.json"))
    labels = [row(end, 1 if end["number"] == 1 else 0) for end in bundled]
    # A trunk whose ends are round: all of its ends have to be open.
    aorta = os.path.join(options.cases, "..", "surfaces", "vmtk_aorta_exact.vtp")
    command = [options.program, "ends", aorta, "--set", "repair.caps=false", "--json"]
    trunk = measured(command, os.path.join(options.out, "vmtk_aorta.json"))
    groups += 2 * [("domed", domed_trunks(options))]
    return groups + 2 * [("bundled", labels + [row(end, 0) for end in trunk])]


def domed_trunks(options):
    """Trunks that a dome closes just above their furcation: an aneurysm there looks the same, so each counts as half of both."""
    rows = []
    for length in DOMED:
        case = os.path.join(options.out, f"domed{length}")
        os.makedirs(case, exist_ok=True)
        daughters = [{"name": name, "blend": 0.3,
                      "vessel": {"points": [[0, 0, 0, 1.6], [x, 0, -12, 1.6]], "flat_ends": True}}
                     for name, x in (("left", -12), ("right", 12))]
        trunk = {"name": "trunk", "vessel": {"points": [[0, 0, 0, 2], [0, 0, length, 2]]}}
        with open(os.path.join(case, "phantom.json"), "w") as file:
            json.dump({"name": "domed", "about": "A trunk closed by a dome.", "seed": 1, "surface_edge": 0.3,
                       "parts": [trunk, *daughters]}, file)
        if not os.path.exists(os.path.join(case, "exact.vtp")):
            subprocess.run([options.program, "phantom", os.path.join(case, "phantom.json"), "--out", case], check=True,
                           capture_output=True)
        ends = measured([options.program, "ends", os.path.join(case, "exact.vtp"), "--json"], case + ".json")
        for end in ends:
            if end["place_mm"][2] > 0:
                features, _, weight = row(end, 0)
                rows += [(features, label, 0.5 * weight) for label in (0, 1)]
            else:
                rows.append(row(end, 0))
    return rows


def forest_groups(options):
    seeds, _, step = options.forest.partition("/")
    first, last = map(int, seeds.split("-"))
    forest = os.path.join(os.path.dirname(options.program), "forest")

    def rows(seed):
        case = os.path.join(options.out, f"forest{seed:03d}")
        if not os.path.exists(os.path.join(case, "truth.json")):
            subprocess.run([forest, "plant", str(seed), case], check=True, capture_output=True)
        truth = json.load(open(os.path.join(case, "truth.json")))
        command = [options.program, "ends", os.path.join(case, truth["file"]), *truth["arguments"], "--json"]
        return seed, forest_rows(truth, measured(command, case + ".json"))

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return [group for group in pool.map(rows, range(first, last + 1, int(step or 1))) if group[1]]


# --- the model -------------------------------------------------------------------------------------------------------
def stacked(groups):
    """Features, labels, weights (a group counts by the root of its size; 1 in sum) and group names."""
    import numpy as np
    x, y, w, g = [], [], [], []
    for name, rows in groups:
        size = sum(weight for _, _, weight in rows)
        for features, label, weight in rows:
            x.append(features)
            y.append(label)
            w.append(weight / math.sqrt(size))
            g.append(name)
    w = np.array(w)
    return np.array(x), np.array(y), w / w.sum(), np.array(g)


def probabilities(x, weights):
    import numpy as np
    score = x @ weights
    p = np.exp(score - score.max(axis=1, keepdims=True))
    return p / p.sum(axis=1, keepdims=True)


def fitted(x, y, w, ridge):
    """Newton's method on the weighted log-likelihood with a ridge, none on the constant."""
    import numpy as np
    n, k = x.shape
    c = len(CLASSES)
    weights, w = np.zeros((k, c)), w / w.sum()
    penalty = np.full((k, c), ridge)
    penalty[0] = 1e-4
    truth = np.zeros((n, c))
    truth[np.arange(n), y] = 1.0
    for _ in range(60):
        p = probabilities(x, weights)
        slope = x.T @ ((p - truth) * w[:, None]) + penalty * weights
        curvature = np.diag(penalty.T.reshape(-1) + 1e-9)
        for a in range(c):
            for b in range(c):
                of_pair = w * p[:, a] * ((a == b) - p[:, b])
                curvature[a * k:(a + 1) * k, b * k:(b + 1) * k] += (x * of_pair[:, None]).T @ x
        step = np.linalg.solve(curvature, slope.T.reshape(-1)).reshape(c, k).T
        weights -= step
        if abs(step).max() < 1e-6:
            break
    return weights


def left_out(real, forest, ridge):
    """Mean log loss, and wrong decisions, on patients that the fit did not see."""
    import numpy as np
    x, y, w, g = real
    loss, wrong = 0.0, 0
    for patient in sorted(set(g)):
        seen = g != patient
        weights = fitted(np.vstack([x[seen], forest[0]]), np.concatenate([y[seen], forest[1]]),
                         np.concatenate([w[seen] / w[seen].sum(), forest[2]]), ridge)
        p = probabilities(x[~seen], weights)
        of_truth = p[np.arange(len(p)), y[~seen]]
        loss -= (w[~seen] * np.log(np.maximum(of_truth, 1e-9))).sum()
        wrong += int(((p[:, 0] > 0.5) != (y[~seen] == 0)).sum())
    return loss, wrong


def feature_names():
    header = open(os.path.join(ROOT, "geometry", "vessel", "ends", "end_profile.h")).read()
    return re.findall(r'"(\w+)"', header[header.index("kEndFeatures = {"):header.index("using EndFeatures")])


def table_text(weights, origin):
    lines = [f"# {line}" for line in origin] + ["feature," + ",".join(CLASSES)]
    for name, row in zip(feature_names(), weights):
        lines.append(name + "," + ",".join(f"{value:.4f}" for value in row))
    return "\n".join(lines) + "\n"


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--cases", default=os.path.join(ROOT, "..", "shared", "data", "ends"))
    parser.add_argument("--forest", default="1-200")
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "fit_ends"))
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "vesselbench"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--ridge", type=float)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    try:
        import numpy as np
    except ImportError:
        sys.exit("fit_ends: needs python3-numpy")
    os.makedirs(options.out, exist_ok=True)
    real, forest = stacked(real_groups(options)), stacked(forest_groups(options))
    best = None
    for ridge in [options.ridge] if options.ridge else RIDGES:
        loss, wrong = left_out(real, forest, ridge)
        print(f"ridge {ridge:g}: on patients left out, log loss {loss:.3f}, {wrong} of {len(real[1])} ends wrong")
        if best is None or loss < best[0]:
            best = (loss, wrong, ridge)
    weights = fitted(np.vstack([real[0], forest[0]]), np.concatenate([real[1], forest[1]]),
                     np.concatenate([real[2], forest[2]]), best[2])
    seen = {name: int(((probabilities(d[0], weights)[:, 0] > 0.5) != (d[1] == 0)).sum())
            for name, d in (("cases", real), ("forest", forest))}
    origin = ["Weights of odds_of (end_odds.h): a multinomial logistic model of a candidate for a vessel's end.",
              f"Made by scripts/fit_ends.py --forest {options.forest} --ridge {best[2]:g}; not to be edited by hand.",
              f"Ends of real, synthetic and bundled cases {len(real[1])}, of the forest {len(forest[1])}; wrong: {seen['cases']} "
              f"and "
              f"{seen['forest']} of these, and {best[1]} of patients left out."]
    text = table_text(weights, origin)
    print(text)
    if options.write:
        with open(TABLE, "w") as table:
            table.write(text)


if __name__ == "__main__":
    main()
