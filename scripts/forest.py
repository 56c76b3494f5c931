#!/usr/bin/env python3
"""Grows random vessel trees with known truth, prepares them, and judges the products by the truth (docs/science/forest.md).

  scripts/forest.py [--seeds A-B|A,B,...] [--goal cfd|rp|both] [--out FOLDER] [--jobs N] [--timeout S] [--coarse]
                 [--at-least N] [--at-most-wrong N] [--keep] [--table FILE] [--resume]

The forest is seeds 1-200. A result is right, failed (prepare says so with exit code 1 to 3), slow (over --timeout of CPU
time, so that a loaded machine gives the same table), or wrong: prepare ended with exit code 0, but the product is not what
the truth asks for. Where the truth expects no product (too few ends can be opened), a failure is right.
Results go to FOLDER/results.json; cases and products are removed unless --keep. Exit code 1 if fewer than --at-least results
are right, if more than --at-most-wrong are wrong, or if a case cannot be grown.
"""
import collections
import concurrent.futures
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import common
from common import BUILD, ROOT, row_line

# The fast test: of each kind the two smallest cases, as `forest list 1 200` prints their sizes.
QUICK = [17, 47, 85, 107, 122, 126, 152, 171, 181, 191]


def cpu_seconds(group):
    """CPU time of the processes of a group, with what they waited for."""
    ticks = 0
    for name in os.listdir("/proc"):
        try:
            with open(f"/proc/{name}/stat") as file:
                fields = file.read().rpartition(")")[2].split()
        except OSError:
            continue
        if fields[2] == str(group):
            ticks += sum(map(int, fields[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


def run(command, limit=math.inf):
    """Exit code (None: over the limit of CPU time), CPU seconds, stdout, stderr."""
    with tempfile.TemporaryFile("w+", errors="replace") as out, tempfile.TemporaryFile("w+", errors="replace") as err:
        process = subprocess.Popen(command, stdout=out, stderr=err, start_new_session=True)
        used = 0.0
        while process.poll() is None:
            used = max(used, cpu_seconds(process.pid))
            if used > limit:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                return None, used, "", ""
            time.sleep(0.2)
        out.seek(0)
        err.seek(0)
        return process.returncode, used, out.read(), err.read()


def plant(seed, folder):
    shutil.rmtree(folder, ignore_errors=True)
    code, _, _, err = run([os.path.join(BUILD, "forest"), "plant", str(seed), folder])
    if code != 0:
        raise RuntimeError(f"seed {seed} cannot be grown: {err.strip()}")
    return json.load(open(os.path.join(folder, "truth.json")))


def without_numbers(text):
    """The text of an error without what differs from case to case, so that equal causes count together."""
    text = re.sub(r"\((-?[\d.e+-]+, )+-?[\d.e+-]+\)( mm)?", "(...)", text)
    text = re.sub(r"'[^']*'", "'...'", text)
    return re.sub(r"-?\d[\d.e+-]*", "#", text)


def failed_step(err):
    """Step and text of prepare's error."""
    said = [line for line in err.splitlines() if line.startswith("vesselbench:")]
    text = (said or err.strip().splitlines()[-1:] or ["no text"])[-1]
    text = re.sub(r"^vesselbench: *", "", text)
    return text


def typical_radius(truth):
    """Median over the wall's area [mm]."""
    parts = sorted((b["diameter_mm"] / 2, b["diameter_mm"] * b["length_mm"]) for b in truth["branches"])
    half = sum(area for _, area in parts) / 2
    for radius, area in parts:
        half -= area
        if half <= 0:
            return radius
    return parts[-1][0]


def judged(case, result, goal):
    """What is right or wrong with a result: `right` and `failures`, and where it can be read openings and triangles."""
    code, _, out, err = run([os.path.join(BUILD, "forest"), "judge", case, result, goal])
    if code != 0:
        return {"right": False, "failures": [{"what": "unreadable", "text": err.strip()}]}
    verdict = json.loads(out)
    return {key: verdict[key] for key in ("right", "failures", "openings", "triangles")}


def failures_text(failures):
    return "; ".join(f"{f['what']}: {f['text']}" for f in failures)


def prepare_and_judge(seed, truth, goal, options):
    case = os.path.join(options.out, f"{seed:03d}")
    result = f"{case}-{goal}"
    shutil.rmtree(result, ignore_errors=True)
    row = {"seed": seed, "goal": goal, "kind": truth["kind"], "features": truth["features"],
           "ends": len(truth["ends"]), "expected": truth["expected"][goal]}
    command = [options.program, "prepare", os.path.join(case, truth["file"]), "--for", goal, "--out", result]
    command += truth["arguments"]
    if options.coarse:
        command += ["--set", f"remesh.edge={0.56 * typical_radius(truth):.3g}"]
    code, seconds, _, err = run(command, options.timeout)
    row.update(code=code, seconds=round(seconds, 1), failures=[], error="")
    if code is None:
        row.update(verdict="slow", error=f"over {options.timeout} s")
    elif code != 0:
        refused = "failed" if row["expected"] else "right"
        row.update(verdict=refused if 1 <= code <= 3 else "crashed", error=failed_step(err))
    else:
        verdict = judged(case, result, goal)
        right = verdict.pop("right")
        row.update(verdict, verdict="right" if right else "wrong")
    if not options.keep:
        shutil.rmtree(result, ignore_errors=True)
    return row


def run_seed(seed, goals, options):
    case = os.path.join(options.out, f"{seed:03d}")
    truth = plant(seed, case)
    rows = [prepare_and_judge(seed, truth, goal, options) for goal in goals]
    if not options.keep:
        shutil.rmtree(case, ignore_errors=True)
    return rows


# --- the tables --------------------------------------------------------------------------------------------------------
def reason(row):
    if row["verdict"] == "wrong":
        return failures_text(row["failures"])
    return row["error"]


def say(row):
    print(f"{row['seconds']:6.1f} s  seed {row['seed']:3d} {row['goal']:3} {row['kind']:15} {row['ends']:2d} ends  "
          f"{row['verdict']}{': ' + reason(row)[:300] if row['verdict'] != 'right' else ''}", flush=True)


VERDICTS = ("right", "wrong", "failed", "crashed", "slow")


# Failures that are counted apart if a result has no other: of angles alone, of tubes that nobody asked for.
LESSER = {"cap tilted", "tubes"}


def only_lesser(row):
    return row["verdict"] == "wrong" and all(f["what"] in LESSER for f in row["failures"])


def counts_table(rows, goal, name, key):
    groups = collections.defaultdict(collections.Counter)
    for row in rows:
        if row["goal"] == goal:
            for group in key(row):
                groups[group][row["verdict"]] += 1
                groups[group]["lesser"] += only_lesser(row)
    lines = [f"| {goal}: {name} | cases | right | wrong with exit 0 | of these only by caps' angles or tubes | failed | crashed "
             f"| slow |",
             "|" + "---|" * 8]
    for group, counts in sorted(groups.items(), key=lambda g: (g[0] == "all", g[0])):
        total = sum(counts[v] for v in VERDICTS)
        cells = [f"{counts[v]} ({100 * counts[v] / total:.0f} %)" for v in VERDICTS[:2]]
        cells += [str(counts[v]) for v in ("lesser",) + VERDICTS[2:]]
        lines.append(row_line([group, total] + cells))
    return lines


def size_class(row):
    return next(f"{low} to {high} ends" for low, high in ((3, 9), (10, 24), (25, 60)) if row["ends"] <= high)


def causes_table(rows, goal):
    causes = collections.defaultdict(set)
    for row in rows:
        if row["goal"] != goal or row["verdict"] == "right":
            continue
        found = {f["what"] for f in row["failures"]} if row["verdict"] == "wrong" else {without_numbers(row["error"])}
        for cause in found:
            causes[(row["verdict"], cause)].add(row["seed"])
    lines = [f"| {goal}: cause | how | cases | seeds |", "|---|---|---|---|"]
    for (verdict, cause), seeds in sorted(causes.items(), key=lambda c: (VERDICTS.index(c[0][0]), -len(c[1]), c[0])):
        shown = ", ".join(map(str, sorted(seeds)[:12])) + (" ..." if len(seeds) > 12 else "")
        lines.append(f"| {cause} | {verdict} | {len(seeds)} | {shown} |")
    return lines


# A direction's standard deviation [deg] above which prepare warns of the cap.
WARNED = 2.0


def caps_table(rows):
    """Angles of the caps at ends that have to be open, and how many of the tilted ones prepare warned of."""
    kinds = collections.defaultdict(list)
    for row in rows:
        caps = [o for o in row.get("openings", []) if o["end"] is not None and not o["optional"]]
        if row["goal"] == "cfd":
            kinds[row["kind"]] += caps
            kinds["all"] += caps
    lines = ["| caps at ends that have to be open | caps | within 2 degrees | within 5 | beyond 2: warned of | not warned of |",
             "|" + "---|" * 6]
    for kind, caps in sorted(kinds.items(), key=lambda k: (k[0] == "all", k[0])):
        tilted = [o for o in caps if o["tilt_deg"] > 2]
        warned = sum(o["told_sd_deg"] > WARNED for o in tilted)
        counts = (len(caps), len(caps) - len(tilted), sum(o["tilt_deg"] <= 5 for o in caps), warned, len(tilted) - warned)
        lines.append(row_line([kind, *counts]))
    return lines


def tables(rows):
    lines = []
    for goal in sorted({row["goal"] for row in rows}):
        lines += counts_table(rows, goal, "kind", lambda row: (row["kind"], "all")) + [""]
        lines += counts_table(rows, goal, "feature", lambda row: (row["features"] or "plain").split()
                              + [size_class(row)]) + [""]
        lines += causes_table(rows, goal) + [""]
    if any(row["goal"] == "cfd" for row in rows):
        lines += caps_table(rows) + [""]
    return "\n".join(lines)


# --- the run -----------------------------------------------------------------------------------------------------------
def seeds_of(text):
    if text == "quick":
        return QUICK
    seeds = []
    for part in text.split(","):
        low, _, high = part.partition("-")
        seeds += range(int(low), int(high or low) + 1)
    return seeds


def parsed():
    parser = common.parser(__doc__)
    parser.add_argument("--seeds", default="1-200", help="as 1-200 or 3,7,20-30; quick: the ten of the fast test")
    parser.add_argument("--goal", choices=("cfd", "rp", "both"), default="both")
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "forest"))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=240.0,
                        help="CPU time of one prepare [s]; the default is two minutes on two cores")
    parser.add_argument("--coarse", action="store_true",
                        help="remesh with twice the default edge: faster; ends and vessels are found before remeshing")
    parser.add_argument("--at-least", type=int, default=0, help="right results")
    parser.add_argument("--at-most-wrong", type=int, default=sys.maxsize, help="results wrong with exit code 0")
    parser.add_argument("--keep", action="store_true", help="keep cases and products")
    parser.add_argument("--table", help="write the tables to this file")
    parser.add_argument("--resume", action="store_true", help="go on after the results in FOLDER/results.json")
    parser.add_argument("--program", default=os.path.join(BUILD, "vesselbench"))
    return parser.parse_args()


def main():
    options = parsed()
    os.makedirs(options.out, exist_ok=True)
    stored = os.path.join(options.out, "results.json")
    rows = json.load(open(stored)) if options.resume and os.path.exists(stored) else []
    goals = ("cfd", "rp") if options.goal == "both" else (options.goal,)
    left = [(seed, [g for g in goals if not any(r["seed"] == seed and r["goal"] == g for r in rows)])
            for seed in seeds_of(options.seeds)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for made in pool.map(lambda item: run_seed(*item, options) if item[1] else [], left):
            for row in made:
                say(row)
            rows += made
            with open(stored + ".new", "w") as file:
                json.dump(sorted(rows, key=lambda r: (r["seed"], r["goal"])), file, indent=1)
            os.replace(stored + ".new", stored)
    print("\n" + tables(rows))
    if options.table:
        with open(options.table, "w") as file:
            file.write(tables(rows))
    counts = collections.Counter(row["verdict"] for row in rows)
    print(", ".join(f"{counts[v]} {v}" for v in VERDICTS))
    return 1 if counts["right"] < options.at_least or counts["wrong"] > options.at_most_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
