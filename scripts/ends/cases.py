"""The orchard's cases as `vesselbench ends` measures them, and what each candidate truly is."""
import concurrent.futures
import dataclasses
import glob
import json
import math
import os
import random
import subprocess

import common

FOLDS = 5
LIMIT = 300  # seconds for a case
OPENING, SAC, BUMP = 0, 1, 2
STUB = "stub of a cut branch"  # its note in the orchard's truths


@dataclasses.dataclass
class Case:
    """A case with its candidates."""
    name: str
    truth: dict
    ends: list        # candidates, as `ends --json` prints them
    of: dict          # index of the true end that a candidate is
    labels: list      # of candidates: OPENING, SAC, BUMP, or None where nothing is asked of them
    error: str = ""   # why there are none

    @property
    def patient(self):
        return self.truth["patient"]

    @property
    def anatomy(self):
        return self.truth["anatomy"]

    @property
    def made(self):
        return self.truth["made"]

    def role(self, candidate):
        """Of the true end that a candidate is; None: it is none."""
        return self.truth["ends"][self.of[candidate]]["role"] if candidate in self.of else None


def matched(truth, ends):
    """Index of the true end that each candidate is; the nearest pairs of the most similar width first."""
    edge = truth.get("edge_mm") or 0.0

    def reach(t, e):
        branch = 0.3 * (t.get("branch_mm") or 0.0) if t["role"] != "closed" else 0.0
        return max(1.2 * t["diameter_mm"], 3 * edge, min(e["diameter_mm"], 3 * t["diameter_mm"]), branch)

    pairs = sorted((math.dist(t["place_mm"], e["place_mm"]) / reach(t, e) +
                    0.4 * abs(math.log(max(e["diameter_mm"], 1e-3) / t["diameter_mm"])), i, j)
                   for i, t in enumerate(truth["ends"]) for j, e in enumerate(ends)
                   if math.dist(t["place_mm"], e["place_mm"]) < reach(t, e))
    of = {}
    for _, i, j in pairs:
        if i not in of.values() and j not in of:
            of[j] = i
    return of


def label_of(truth, ends, of, j):
    edge = truth.get("edge_mm") or 0.0
    if j in of:
        end = truth["ends"][of[j]]
        if end["role"] == "closed":
            return BUMP if end.get("note") == STUB else SAC
        return {"inlet": OPENING, "open": OPENING}.get(end["role"])
    if truth.get("others") == "optional" or any(
            math.dist(t["place_mm"], ends[j]["place_mm"]) < max(t["diameter_mm"], 3 * edge) for t in truth["ends"]):
        return None
    return BUMP


def case_of(name, truth, answer):
    ends = [end for end in answer.get("ends", []) if end["odds"]]
    of = matched(truth, ends)
    labels = [label_of(truth, ends, of, j) for j in range(len(ends))]
    return Case(name, truth, ends, of, labels, answer.get("error", ""))


def measured(program, folder, truth, file):
    """What `ends --json` prints of a case; measured once. program: none, if only known answers count."""
    if os.path.exists(file):
        with open(file) as known:
            return json.load(known)
    if program is None:
        return None
    try:
        done = subprocess.run([program, "ends", os.path.join(folder, truth["input"]), *truth["arguments"], "--json"],
                              capture_output=True, text=True, timeout=LIMIT)
        answer = json.loads(done.stdout) if done.stdout else {"error": done.stderr[-300:]}
    except subprocess.TimeoutExpired:
        answer = {"error": f"took more than {LIMIT} s"}
    with open(file, "w") as out:
        json.dump(answer, out)
    return answer


def measured_cases(options):
    os.makedirs(options.measured, exist_ok=True)

    def one(folder):
        with open(os.path.join(folder, "truth.json")) as file:
            truth = json.load(file)
        name = os.path.basename(folder)
        answer = measured(None if options.known else options.program, folder, truth,
                          os.path.join(options.measured, name + ".json"))
        return case_of(name, truth, answer) if answer else None

    folders = [os.path.dirname(file) for file in sorted(glob.glob(os.path.join(options.orchard, "*", "truth.json")))]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return [case for case in pool.map(one, folders) if case and not case.truth.get("acceptable_refusal")]


def made_kinds(options):
    """How each case of the orchard was made."""
    truths = []
    for file in glob.glob(os.path.join(options.orchard, "*", "truth.json")):
        with open(file) as text:
            truths.append(json.load(text))
    return [truth["made"] for truth in truths if not truth.get("acceptable_refusal")]


def taught_cases(options):
    """The synthetic cases of ../shared/data/ends and the bundled aneurysm: for the fit only."""
    ends = os.path.join(common.DATA, "ends")
    kind = {"anatomy": "synthetic", "made": "synthetic"}

    def one(file):
        with open(file) as text:
            truth = json.load(text)
        truth |= {"arguments": truth.get("arguments") or [], "patient": truth["name"], **kind}
        answer = measured(None if options.known else options.program, ends, truth,
                          os.path.join(options.measured, truth["name"] + ".json"))
        return case_of(truth["name"], truth, answer) if answer else None

    files = sorted(glob.glob(os.path.join(ends, "repro", "*.json")))
    taught = [case for case in map(one, files) if case and case.ends]
    known = blind_is_sac(options, "aneurysm", os.path.join(common.ROOT, "cases", "aneurysm"))
    return taught + [known] if known else taught


def blind_is_sac(options, name, path):
    """The bundled aneurysm: what the image's border does not cut is the sac, and all others are open."""
    truth = {"name": name, "input": path, "arguments": [], "patient": name, "anatomy": "synthetic", "made": "known"}
    answer = measured(None if options.known else options.program, "", truth, os.path.join(options.measured, name + ".json"))
    if not answer or "ends" not in answer:
        return None
    ends = sorted((end for end in answer["ends"] if end["odds"]), key=lambda end: end["number"] or math.inf)
    roles = ["open" if end["odds"]["features"]["border"] else "closed" for end in ends]
    truth["ends"] = [{key: end[key] for key in ("place_mm", "diameter_mm")} | {"role": role} for end, role in zip(ends, roles)]
    return case_of(name, truth, answer)


def folds_of(measured_cases):
    """A fold for each patient; in each the same number of cases of an anatomy, as far as it goes."""
    sizes = {}
    for case in measured_cases:
        sizes.setdefault(case.anatomy, {}).setdefault(case.patient, 0)
        sizes[case.anatomy][case.patient] += 1
    folds, dealt = {}, random.Random(1)
    for anatomy in sorted(sizes):
        loads = [0] * FOLDS
        patients = sorted(sizes[anatomy])
        dealt.shuffle(patients)
        for patient in sorted(patients, key=lambda p: -sizes[anatomy][p]):
            if patient not in folds:
                folds[patient] = loads.index(min(loads))
            loads[folds[patient]] += sizes[anatomy][patient]
    return folds
