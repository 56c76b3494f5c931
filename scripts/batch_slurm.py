#!/usr/bin/env python3
"""Runs 40 phantoms as a batch on this machine and as one on a Slurm of its own (scripts/one_node_slurm), kills two tasks
of the job, and compares the tables, byte for byte. One case fails.

  scripts/batch_slurm.py [--cases N] [--out FOLDER]

Exit code 1 if a table differs or a killed task was not run again; 77 if there is no Slurm.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from common import BUILD, PROGRAM, ROOT, parser, run, skip

KILLED = ("c1", "c3")
LONGEST = 900.0  # [s]


def make_cohort(folder, count):
    """Coarse tubes of different radii, and a file that is none."""
    rows = ["case,input,units"]
    for i in range(count - 1):
        radius = 2.0 + 0.05 * i
        phantom = {"name": f"c{i}", "about": "A tube.", "seed": i, "surface_edge": 0.8,
                   "parts": [{"name": "tube", "vessel": {"points": [[0, 0, 0, radius], [0, 0, 20, radius]]}}],
                   "imaging": {"spacing": [1, 1, 1], "margin": 3, "inside": 800, "outside": 100, "blur": 0.1, "noise": 5}}
        file = folder / f"c{i}.json"
        file.write_text(json.dumps(phantom))
        run("phantom", file, "--out", folder / f"c{i}")
        rows.append(f"c{i},c{i}/exact.vtp,mm")
    (folder / "damaged.stl").write_text("solid nothing")
    (folder / "recipe.json").write_text('[{"operation": "repair"}]')
    (folder / "cases.csv").write_text("\n".join([*rows, "damaged,damaged.stl,"]) + "\n")


def command(folder, engine):
    return [PROGRAM, "batch", folder / "cases.csv", "--for", "planning", "--recipe", folder / "recipe.json",
            "--out", folder / engine, "--engine", engine]


def task_of(name, out):
    """The process that runs this case as a task; None: there is none at this moment."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            continue
        if "batch" in words and f"--task={name}" in words and str(out) in words:
            return int(process.name)
    return None


def kill_tasks(batch, out):
    """Each of the tasks once, as soon as it runs."""
    left, until = list(KILLED), time.monotonic() + LONGEST
    while left and batch.poll() is None and time.monotonic() < until:
        for name in left:
            if (task := task_of(name, out)) is not None:
                os.kill(task, signal.SIGKILL)
                left.remove(name)
                break
        time.sleep(0.02)
    return [name for name in KILLED if name not in left]


def run_on_slurm(folder):
    """Exit code, what it said, and which tasks were killed."""
    with open(folder / "slurm.txt", "w") as said:
        batch = subprocess.Popen([os.path.join(ROOT, "scripts", "one_node_slurm"), *command(folder, "slurm")],
                                 stdout=said, stderr=subprocess.STDOUT)
        killed = kill_tasks(batch, folder / "slurm")
        code = batch.wait(LONGEST)
    return code, (folder / "slurm.txt").read_text(), killed


def main():
    options = parser(__doc__)
    options.add_argument("--cases", type=int, default=40)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path(BUILD) / "batch_slurm")
    arguments = options.parse_args()
    folder = arguments.out
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    make_cohort(folder, arguments.cases)
    code, said, killed = run_on_slurm(folder)
    if code == 77:
        skip(said.strip())
        return 77
    subprocess.run([*command(folder, "local"), "--jobs", "2"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   check=False)
    wrong = []
    if code != 1:  # one case fails
        wrong.append(f"exit code {code}: {said}")
    if list(killed) != list(KILLED) or "submitted 2 cases" not in said:
        wrong.append(f"killed {killed}: {said}")
    wrong += [f"{name} differs" for name in ("table.csv", "table.html")
              if (folder / "slurm" / name).read_bytes() != (folder / "local" / name).read_bytes()]
    print(f"batch on slurm: {arguments.cases} cases, {len(killed)} killed, {len(wrong)} findings", *wrong, sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
