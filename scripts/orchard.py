#!/usr/bin/env python3
"""Makes test cases with true ends from labelled vessels: closed, torn, cropped, voxelised, dilated and others.

  scripts/orchard.py make [--out FOLDER] [--only KIND,KIND] [--limit N] [--jobs N]
  scripts/orchard.py mix [--out FOLDER]

Sources are ../shared/data/anatomy and ../shared/data/ends. `make` writes FOLDER/CASE/truth.json (default out/orchard) in the
sources' format, with `patient`, a coarse `anatomy`, `made` (the kind), `source`, `input` and `arguments`, and the input where
it is new. Cases depend on their names only; those already made stay. What is no proper case is dropped and counted by reason.
`mix` counts the cases by kind and anatomy. Nothing of the sources may be committed, so nothing made of them may be either.
Needs python3-vtk9 and python3-numpy. scripts/ends/orchard has the parts. The kinds:

  as-is                                       the source's own file
  closed-flat, -domed, -ragged, -oblique      every end cut and capped
  mixed-closed                                some ends capped, the others open
  oblique-open, torn                          open ends, cut obliquely or with notched rims
  scaled, decimated, noisy, turned            open ends, the surface changed
  stub                                        a branch cut off beside its furcation, the stub closed by a dome
  not-widest                                  an outlet dilated or the inlet narrowed until the inlet is not the widest end
  mask, image                                 the whole vessel in voxels or intensities
  box-mask, box-image                         a part of it, which vessels leave through the border
"""
import collections
import concurrent.futures
import glob
import json
import os
import sys

import common
from common import ROOT

try:
    from ends.orchard.making import make_source
    from ends.orchard.plan import QUOTAS, plan
    from ends.orchard.sources import sources
except ModuleNotFoundError as missing:
    if missing.name.split(".")[0] not in ("numpy", "vtkmodules"):
        raise
    sys.exit("orchard: needs python3-vtk9 and python3-numpy")


def wanted(truths, only, limit):
    """The planned cases by source, of these kinds (none: all) and from so many sources (None: all)."""
    kinds = only.split(",") if only else None
    work = {name: [c for c in cases if not kinds or c[0] in kinds] for name, cases in plan(truths).items()}
    work = {name: cases for name, cases in sorted(work.items()) if cases}
    if limit:  # spread over all sources
        work = dict(list(work.items())[::max(1, len(work) // limit)][:limit])
    return work


def make(options):
    truths = sources()
    work = wanted(truths, options.only, options.limit)
    os.makedirs(options.out, exist_ok=True)
    made, dropped = collections.Counter(), collections.defaultdict(collections.Counter)
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(make_source, truths[name], cases, options.out) for name, cases in work.items()]
        for job in concurrent.futures.as_completed(jobs):
            name, done = job.result()
            for kind, reason, new in done:
                if reason is None:
                    made[kind] += new
                else:
                    dropped[kind][reason] += 1
            print(f"{name}: {sum(r is None for _, r, _ in done)} of {len(done)}", flush=True)
    print(f"{sum(made.values())} cases made; dropped:")
    for kind, reasons in sorted(dropped.items()):
        for reason, count in reasons.most_common():
            print(f"  {kind}: {count} {reason}")


def mix(options):
    counts, patients = collections.defaultdict(collections.Counter), set()
    for path in sorted(glob.glob(os.path.join(options.out, "*", "truth.json"))):
        with open(path) as file:
            truth = json.load(file)
        counts[truth["made"]][truth["anatomy"]] += 1
        patients.add(truth["patient"])
    groups = sorted({group for row in counts.values() for group in row})
    rows = [[kind, *(counts[kind][g] for g in groups), sum(counts[kind].values())] for kind in ("as-is", *QUOTAS)]
    rows.append(["all", *(sum(column) for column in zip(*(row[1:] for row in rows)))])
    print(common.table(["made", *groups, "all"], rows) + f"\n{len(patients)} patients")


def main():
    parser = common.parser(__doc__)
    parser.add_argument("what", choices=("make", "mix"))
    parser.add_argument("--out", default=os.path.join(ROOT, "out", "orchard"))
    parser.add_argument("--only", help="kinds, separated by commas")
    parser.add_argument("--limit", type=int, help="of so many sources")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    (make if options.what == "make" else mix)(options)


if __name__ == "__main__":
    main()
