#!/usr/bin/env python3
"""Kills a batch at random moments, goes on, and compares its tables with those of one that ran through.

  scripts/batch_kills.py [--kills N] [--seed S] [--out FOLDER]

Exit code 1 if a table differs, a case is missing, or a process of a killed batch lives on.
"""
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

from common import BUILD, PROGRAM, parser

CASES = 12
RECIPE = '[{"operation": "repair"}]'


def make_cohort(folder):
    """Surfaces of phantoms in several sizes, one damaged file, and their manifest."""
    for name in ("tube", "y", "torus"):
        subprocess.run([PROGRAM, "phantom", name, "--out", folder / name], check=True, stdout=subprocess.DEVNULL)
    (folder / "damaged.stl").write_text("solid nothing")
    (folder / "recipe.json").write_text(RECIPE)
    rows = ["case,input,units"]
    rows += [f"c{i},{('tube', 'y', 'torus')[i % 3]}/exact.vtp,{('mm', 'cm')[i % 2]}" for i in range(CASES - 1)]
    (folder / "cases.csv").write_text("\n".join(rows + ["damaged,damaged.stl,"]) + "\n")


def command(folder, out):
    return [PROGRAM, "batch", folder / "cases.csv", "--for", "planning", "--recipe", folder / "recipe.json",
            "--out", folder / out, "--jobs", "2"]


def run_through(folder, out):
    return subprocess.run(command(folder, out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


def processes_of(out):
    """Ids of processes that work in the folder."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if str(out).encode() in (process / "cmdline").read_bytes():
                found.append(process.name)
        except OSError:
            pass
    return found


def kill_at_random(folder, out, longest, randoms):
    batch = subprocess.Popen(command(folder, out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(randoms.uniform(0.0, longest))
    batch.send_signal(signal.SIGKILL)
    batch.wait()
    for _ in range(50):
        if not processes_of(folder / out):
            return 0
        time.sleep(0.1)
    print(f"processes live on: {processes_of(folder / out)}")
    return 1


def forget_some(out, randoms):
    """So that kills find work to do, when all is finished."""
    records = sorted(out.glob("cases/*/batch.json"))
    if len(records) >= CASES:
        for record in randoms.sample(records, CASES // 2):
            shutil.rmtree(record.parent)


def main():
    options = parser(__doc__)
    options.add_argument("--kills", type=int, default=100)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path(BUILD) / "batch_kills")
    arguments = options.parse_args()
    shutil.rmtree(arguments.out, ignore_errors=True)
    arguments.out.mkdir(parents=True)
    make_cohort(arguments.out)
    start = time.monotonic()
    run_through(arguments.out, "whole")
    longest = min(6.0, (time.monotonic() - start) / 2.0)
    randoms, wrong = random.Random(arguments.seed), 0
    for _ in range(arguments.kills):
        wrong += kill_at_random(arguments.out, "killed", longest, randoms)
        forget_some(arguments.out / "killed", randoms)
    run_through(arguments.out, "killed")
    for name in ("table.csv", "table.html"):
        if (arguments.out / "killed" / name).read_bytes() != (arguments.out / "whole" / name).read_bytes():
            print(f"{name} differs")
            wrong += 1
    print(f"batch: {arguments.kills} kills, {CASES} cases, {wrong} findings")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
