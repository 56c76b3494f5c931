#!/usr/bin/env python3
"""Does what the program advises where it refuses an input, and judges what comes of it.

  scripts/remedies.py [--from GROUP,...] [--only PART] [--goal cfd|rp] [--sample N] [--seeds A-B] [--out FOLDER]
                      [--jobs N] [--timeout S] [--table FILE]
  scripts/remedies.py page [--out FOLDER]            writes docs/science/remedies.md of what FOLDER/results.json has

Groups: surfaces, images, nasty, slicer, strangers, ends, anatomy of ../shared/data, and forest, random vessel trees of seeds
that no other script uses. Each input is prepared as it is. Where `prepare` refuses it, the first remedy of report.json that has
commands is executed as it stands there, and where it refuses again the next one, up to three in a row. A refusal then

  helped             a model was made, and it is right
  wrong              a model was made, and it is wrong: by the truth where the input has one (whether its ends are right), else by
                     the limits of scripts/acceptance.py (closed, manifold, no crossings, flat openings)
  led on             the last refusal is another one than the first
  did not help       the program refuses for the same reason at the same place, or a command failed by itself
  outside            no command is offered: the text says what to do elsewhere, or what the input is
  slow               over --timeout of CPU time

A question, which only the user can answer (which label, which unit, which ends where the program is in doubt), is no refusal: it
is counted apart, with what the answer makes that is proposed.
"""
import collections
import concurrent.futures
import dataclasses
import datetime
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import textwrap

import acceptance
import common
import forest
import page_rows
from common import DATA, PROGRAM, ROOT, row_line

IN_A_ROW = 3
JUDGE = os.path.join(DATA, "ends", "judge_ends.py")
GROUPS = ("surfaces", "images", "nasty", "slicer", "strangers", "ends", "anatomy", "forest")
OUTCOMES = ("helped", "wrong", "led on", "did not help", "outside", "slow")
QUESTIONS = {"unit-in-doubt", "label-unchosen", "body-no-vessel", "wall-has-two-sides", "end-in-doubt", "vessel-unstated"}
PAGE = os.path.join(ROOT, "docs", "science", "remedies.md")


@dataclasses.dataclass
class Input:
    """What is prepared, for what, and how its product is judged."""
    group: str
    name: str
    goal: str
    arguments: list   # of prepare: the file first
    truth: str = ""   # file or folder; empty: none


# --- the inputs --------------------------------------------------------------------------------------------------------
def goals(options):
    return (options.goal,) if options.goal else ("cfd", "rp")


def plain_files(group, options):
    for path in sorted(glob.glob(os.path.join(DATA, group, "*"))):
        if not path.endswith(".md"):
            for goal in goals(options):
                yield Input(group, os.path.basename(path), goal, [path])


def strangers(options):
    folder = os.path.join(options.out, "strangers-made")
    os.makedirs(folder, exist_ok=True)
    for script in sorted(glob.glob(os.path.join(DATA, "strangers", "*.py"))):
        subprocess.run(["/usr/bin/python3", script], cwd=folder, capture_output=True)
    for path in sorted(glob.glob(os.path.join(folder, "*"))):
        for goal in goals(options):
            yield Input("strangers", os.path.basename(path), goal, [path])


def labelled(group, options):
    """With the true ends of a flow model."""
    for path in sorted(glob.glob(os.path.join(DATA, group, "truth", "*.json"))):
        with open(path) as file:
            truth = json.load(file)
        words = [os.path.join(DATA, group, word) if "/" in word and "=" not in word else word
                 for word in [truth["input"], *(truth.get("arguments") or [])]]
        if options.goal in (None, "cfd"):
            yield Input(group, truth["name"], "cfd", words, path)


def grown(options):
    first, last = map(int, options.seeds.split("-"))
    for seed in range(first, last + 1):
        case = os.path.join(options.out, "forest", str(seed))
        truth = forest.plant(seed, case)
        for goal in goals(options):
            yield Input("forest", str(seed), goal, [os.path.join(case, truth["file"]), *truth["arguments"]], case)


def inputs(options):
    for group in options.groups.split(","):
        found = {"strangers": strangers, "forest": grown}.get(group)
        cases = list(found(options) if found else labelled(group, options) if group in ("ends", "anatomy") else
                     plain_files(group, options))
        cases = [case for case in cases if not options.only or options.only in case.name]
        yield from cases[::max(1, len(cases) // options.sample)] if options.sample else cases


# --- following what is advised -----------------------------------------------------------------------------------------
@dataclasses.dataclass
class Refusal:
    text: str
    code: str         # of its first diagnostic; empty: it has none
    place: list
    commands: list    # of the first remedy that has some, one after the other
    remedies: int     # how many there are with commands


def refusal_of(out, err):
    """What the document says that --json prints."""
    document = json.loads(out) if out else {}
    diagnostics = document.get("diagnostics", [])
    offered = [r["commands"] for d in diagnostics for r in d.get("remedies", []) if r.get("commands")]
    first = diagnostics[0] if diagnostics else {}
    return Refusal(document.get("error") or forest.failed_step(err), first.get("code", ""), first.get("place_mm"),
                   offered[0] if offered else [], len(offered))


def words_of(command):
    return [PROGRAM, *command[1:], "--json"]


def judged(case, folder):
    """Why a product is wrong; empty: it is right."""
    if case.group == "forest":
        return forest.failures_text(forest.judged(case.truth, folder, case.goal)["failures"])
    if case.truth:
        done = subprocess.run(["/usr/bin/python3", JUDGE, case.truth, folder, "--exit", "0"], capture_output=True, text=True)
        said = done.stdout.strip()
        return "" if said.startswith("right") else said
    return "; ".join(acceptance.surface_failures({"name": case.name}, folder))


def tried(case, options):
    """One row: what became of an input and of the advice about it."""
    folder = os.path.join(options.out, re.sub(r"[^\w.-]", "_", f"{case.group}-{case.name}-{case.goal}"))
    shutil.rmtree(folder, ignore_errors=True)
    command = [PROGRAM, "prepare", *case.arguments, "--for", case.goal, "--out", folder, "--json"]
    row = {"group": case.group, "name": case.name, "goal": case.goal, "steps": [], "outcome": "none"}
    code, _, out, err = forest.run(command, options.timeout)
    first = None
    for _ in range(IN_A_ROW):
        if code is None:
            row["outcome"] = "slow"
            break
        if code == 0:
            break
        refusal = refusal_of(out, err)
        row["steps"].append(dataclasses.asdict(refusal))
        first = first or refusal
        if not refusal.commands:
            row["outcome"] = "outside" if refusal is first else "led on"
            break
        for command in refusal.commands:
            code, _, out, err = forest.run(words_of(command), options.timeout)
            if code != 0:
                break
        if code not in (0, None) and command is not refusal.commands[-1]:
            row.update(outcome="did not help", failure=forest.failed_step(err))
            break
    if first and row["outcome"] == "none":
        if code == 0:
            row["failure"] = judged(case, folder)
            row["outcome"] = "wrong" if row["failure"] else "helped"
        else:
            last = refusal_of(out, err)
            row["steps"].append(dataclasses.asdict(last))
            row["outcome"] = "did not help" if (last.code, last.place) == (first.code, first.place) else "led on"
    shutil.rmtree(folder, ignore_errors=True)
    return row


# --- what is printed ---------------------------------------------------------------------------------------------------
def given(commands):
    """What the commands of a remedy give, without the paths."""
    words = [word for command in commands for word in command[2:] if "=" in word and "/" not in word]
    return " ".join(words) or " ".join(command[1] for command in commands)


def say(row):
    print(f"{row['outcome']:13} {row['group']}/{row['name']} {row['goal']}", flush=True)
    for step in row["steps"]:
        print(f"    {step['code'] or '-'}: {step['text'][:260]}")
        if step["commands"]:
            print(f"    -> {given(step['commands'])}")
    if row.get("failure"):
        print(f"    {row['failure'][:300]}")


def counted(rows, key):
    groups = collections.defaultdict(collections.Counter)
    for row in rows:
        groups[key(row)][row["outcome"]] += 1
        groups["all"][row["outcome"]] += 1
    return [row_line([name, sum(counts.values()), *(counts[o] for o in OUTCOMES)])
            for name, counts in sorted(groups.items(), key=lambda g: (g[0] == "all", g[0]))]


def tables(rows):
    refused = [row for row in rows if row["steps"] or row["outcome"] == "slow"]
    asked = [row for row in refused if row["steps"] and row["steps"][0]["code"] in QUESTIONS]
    others = [row for row in refused if row not in asked]
    text = (f"{len(rows)} inputs prepared, {len(asked)} asked about, {len(others)} refused or slow. Refused:\n\n" +
            common.table(["inputs", "refused", *OUTCOMES], counted(others, lambda r: f"{r['group']}, {r['goal']}")) + "\n" +
            common.table(["first refusal", "count", *OUTCOMES],
                         counted([r for r in others if r["steps"]], lambda r: r["steps"][0]["code"] or "without a code")))
    return text + "\nAsked, and what the proposed answer makes:\n\n" + common.table(
        ["question", "count", *OUTCOMES], counted(asked, lambda r: r["steps"][0]["code"]))


# --- the page ------------------------------------------------------------------------------------------------------------
ABOUT = """# Does what a refusal advises help?

{written}

Where `prepare` refuses an input, it names what would go on, and `--json` has that as lists of arguments. The script does what is
named first, as it stands there, up to three times in a row, and judges the product: by the true ends or the true tree where the
input has one, else by whether it is closed and manifold, without crossings, with flat openings. Nothing else is claimed of a
product that *helped*. *Outside*: no command is offered, and the text says what to do elsewhere, or that there is no vessel. *Led
on*: the last refusal is another one than the first. *Slow*: over {timeout:g} s of processor time.

"""
TAIL = """
## What did not help

{rows}
"""


def part_text(options):
    """Which inputs a run takes."""
    return (f"groups {options.groups.replace(',', ', ')}" + (f", names with '{options.only}'" if options.only else "") +
            (f", for {options.goal}" if options.goal else ", for cfd and rp") +
            (f", {options.sample} of each group" if options.sample else ""))


def write_page(out):
    with open(os.path.join(out, "results.json")) as file:
        run = json.load(file)
    rows = run["rows"]
    unhelped = [row_line([f"{r['group']}/{r['name']}", r["goal"], r["outcome"], r["steps"][0]["code"] if r["steps"] else "",
                          r["steps"][-1]["code"] if r["steps"] else ""])
                for r in rows if r["outcome"] not in ("none", "helped", "outside")]
    written = (f"Written by `scripts/remedies.py page` with the program of {run['revision']}, run on {run['date']}: "
               f"{run['part']}; {len(rows)} inputs. The other groups that the script knows were not part of it: "
               f"{', '.join(run['left_out']) or 'there are none'}.")
    head = ABOUT.format(written=textwrap.fill(written, 130), timeout=run["timeout"])
    tail = TAIL.format(rows=common.table(["input", "for", "outcome", "first refusal", "last refusal"], unhelped).strip())
    with open(PAGE, "w") as file:
        file.write(head + tables(rows) + tail)


def main():
    if sys.argv[1:2] == ["page"]:
        parser = common.parser(__doc__)
        parser.add_argument("page")
        parser.add_argument("--out", default=os.path.join(ROOT, "out", "remedies"))
        return write_page(parser.parse_args().out)
    parser = common.parser(__doc__)
    parser.add_argument("--from", dest="groups", default=",".join(GROUPS))
    parser.add_argument("--only", help="part of a name")
    parser.add_argument("--goal", choices=("cfd", "rp"))
    parser.add_argument("--sample", type=int, help="so many of each group, spread over it")
    parser.add_argument("--seeds", default="701-740")
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "remedies"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--table", help="writes the tables there")
    options = parser.parse_args()
    if not os.path.isdir(DATA):
        common.skip("no ../shared/data")
        return 77
    os.makedirs(options.out, exist_ok=True)
    run = {"revision": page_rows.revision(), "date": str(datetime.date.today()), "part": part_text(options),
           "left_out": [group for group in GROUPS if group not in options.groups.split(",")],
           "timeout": options.timeout}  # of the files as they are now
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for row in pool.map(lambda case: tried(case, options), list(inputs(options))):
            rows.append(row)
            say(row)
            with open(os.path.join(options.out, "results.json"), "w") as file:
                json.dump({**run, "rows": rows}, file, indent=1)
    text = tables(rows)
    print("\n" + text)
    if options.table:
        with open(options.table, "w") as file:
            file.write(text)
    wrong = [row for row in rows if row["outcome"] == "wrong" and row["steps"][0]["code"] not in QUESTIONS]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
