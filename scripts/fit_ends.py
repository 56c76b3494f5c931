#!/usr/bin/env python3
"""Fits the weights by which vessel ends and inlets are judged (geometry/vessel/ends/*_weights.csv) to the orchard's cases.

  scripts/fit_ends.py [--orchard FOLDER] [--measured FOLDER] [--known] [--program FILE] [--jobs N] [--page FILE]
                      [--ridge R] [--write | --write-inlet RIDGE]

The orchard (scripts/orchard.py) has cases with true ends; `vesselbench ends` measures the features of every candidate, which
stay in the folder of measurements and are used again; with --known only cases that are there. An opening is a true end that has
to be open; a sac, an aneurysm that stays closed; a bump, a candidate that is no true end, or the stub of a cut branch. Optional
ends and candidates beside a true end are left out. Patients are dealt to five folds; every figure that is printed is of patients
that the fit did not see. The synthetic cases beside the real ones and the bundled aneurysm take part in every fit and in no
figure. The tables are fitted to all. --page writes the figures as a page, --write the tables. --write-inlet is for a part of the
orchard, and writes that of the inlet alone: this ridge draws to the present weights, not to 0. Needs python3-numpy.
"""
import os
import sys

import common
from ends import cases, choice, models, page
from common import ROOT

FOLDER = os.path.join(ROOT, "geometry", "vessel", "ends")
INLETS = "inlet_weights.csv"


def known_inlets(options):
    """Where the ridge of the inlet's table draws to."""
    return models.present_inlets(os.path.join(FOLDER, INLETS)) if options.write_inlet else 0.0


def write_tables(options, fitted, origin):
    for name, table in fitted.tables().items():
        if options.write or name == INLETS:
            with open(os.path.join(FOLDER, name), "w") as file:
                file.write("".join(f"# {line}\n" for line in origin) + table)


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--orchard", default=os.path.join(ROOT, "out", "orchard"))
    parser.add_argument("--measured", default=os.path.join(ROOT, "out", "measured-ends"))
    parser.add_argument("--known", action="store_true")
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "vesselbench"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--ridge", type=float, help="of both models; default: those with the least loss on patients left out")
    parser.add_argument("--page")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--write-inlet", type=float)
    options = parser.parse_args()
    measured = cases.measured_cases(options)
    if not measured:
        sys.exit("fit_ends: no cases: make them with scripts/orchard.py make")
    folds = cases.folds_of(measured)
    taught = cases.taught_cases(options)
    ridges = dict.fromkeys(("ends", "inlets"), options.ridge) if options.ridge else models.best_ridges(measured, folds, taught)
    judged = []  # each case with models that did not see its patient
    for fold in range(cases.FOLDS):
        blind = models.Models(taught + [case for case in measured if folds[case.patient] != fold], ridges)
        judged += [(case, blind) for case in measured if folds[case.patient] == fold]
    results = choice.results_of(judged)
    text = page.page_text(results, ridges, choice.curves(judged), cases.made_kinds(options))
    print(text)
    if options.page:
        with open(options.page, "w") as file:
            file.write(text)
    if options.write or options.write_inlet:
        origin = page.origin_lines(results, ridges)
        if options.write_inlet:
            ridges["inlets"] = options.write_inlet
            origin.append("Those are of fits that begin at 0; here a ridge of "
                          f"{options.write_inlet:g} draws to the weights before.")
        write_tables(options, models.Models(taught + measured, ridges, known_inlets(options)), origin)


if __name__ == "__main__":
    main()
