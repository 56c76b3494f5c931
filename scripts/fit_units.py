#!/usr/bin/env python3
"""Fits how large vessels are and where they lie, by which the unit of a file that states none is told.

  scripts/fit_units.py [--out FILE]

Prints the constants of geometry/formats/vessel_size.cpp: Gaussians of three kinds of vessels (thin, medium, wide) in the natural
logarithms of typical radius, extent and mean edge [mm], and one of the distance from the origin; and what they would decide of
each surface of ../shared/data/anatomy and ends, stored in mm, cm and m, whose patient was left out. --out writes the page
docs/science/units.md. Needs python3-vtk9 and python3-numpy.
"""
import collections
import concurrent.futures
import json
import math
import os
import sys

import common
import page_rows

try:
    import numpy
    from ends.orchard.sources import file_of, is_surface, sources
except ModuleNotFoundError as missing:
    if missing.name.split(".")[0] not in ("numpy", "vtkmodules"):
        raise
    sys.exit("fit_units: needs python3-vtk9 and python3-numpy")

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0}
SHARES = {"mm": 0.85, "cm": 0.10, "m": 0.05}  # of the files in such a unit
KINDS = {"thin": (0.0, 1.9), "medium": (1.9, 4.5), "wide": (4.5, math.inf)}  # by typical radius [mm]
# Added to the variances: few patients are known, and a surface may have been remeshed.
SPREAD = numpy.diag([0.02, 0.05, 0.35])
OUTLIER = 1e-4        # density of what is none of the kinds
CENTRED = 0.75        # of its extent: a model this near to the origin may have been moved there
PLACES = {"patient": 0.7, "centred": 0.25 * 0.3, "anywhere": 0.05 / 12}
CERTAIN = 0.95


def figures(truth):
    """Logarithms of radius, extent, edge and distance from the origin [mm]; None: not measurable."""
    try:
        measure = json.loads(common.run("measure", file_of(truth), "--units", truth.get("units") or "mm", "--json"))
    except RuntimeError:
        return None
    low, high = numpy.array(measure["bounds"][:3]), numpy.array(measure["bounds"][3:])
    extent, radius = numpy.linalg.norm(high - low), 2 * abs(measure["volume"]) / measure["area"]
    if extent > 400 * radius:
        return None
    off = numpy.linalg.norm(low + high) / 2
    size = numpy.log([radius, extent, measure["edge_length"]["mean"]])
    return {"name": truth["name"], "patient": truth["patient"], "stored": truth.get("units") or "mm", "size": size,
            "place": math.log(max(off, 1e-9)), "centred": off < CENTRED * extent,
            "kind": next(k for k, (least, most) in KINDS.items() if least <= radius < most)}


def fitted(cases):
    """Means and covariances of the kinds, mean and deviation of the distance."""
    kinds = []
    for kind in KINDS:
        points = numpy.array([case["size"] for case in cases if case["kind"] == kind])
        kinds.append((points.mean(0), numpy.cov(points.T) + SPREAD))
    counts = collections.Counter(case["kind"] for case in cases)
    elsewhere = [case for case in cases if not case["centred"]]
    weights = numpy.array([1 / counts[case["kind"]] for case in elsewhere])
    places = numpy.array([case["place"] for case in elsewhere])
    mean = numpy.average(places, weights=weights)
    return kinds, (mean, math.sqrt(numpy.average((places - mean) ** 2, weights=weights)))


def gaussian(x, mean, covariance):
    off = x - mean
    return math.exp(-0.5 * off @ numpy.linalg.solve(covariance, off)) / math.sqrt(
        (2 * math.pi) ** len(x) * numpy.linalg.det(covariance))


def odds(case, stored, model):
    """Of each unit, were the case stored in one."""
    kinds, (mean, deviation) = model
    odds = {}
    for unit, share in SHARES.items():
        turned = math.log(MILLIMETRES[unit] / MILLIMETRES[stored])
        shape = sum(gaussian(case["size"] + turned, *kind) for kind in kinds) / len(kinds) + OUTLIER
        z = (case["place"] + turned - mean) / deviation
        place = (PLACES["patient"] * math.exp(-0.5 * z * z) / (deviation * math.sqrt(2 * math.pi)) +
                 case["centred"] * PLACES["centred"] + PLACES["anywhere"])
        odds[unit] = share * shape * place
    return {unit: odd / sum(odds.values()) for unit, odd in odds.items()}


def verdict(case, stored, model):
    found = odds(case, stored, model)
    best = max(found, key=found.get)
    return "asked" if found[best] < CERTAIN else "right" if best == stored else "wrong"


def models_without(cases):
    """By patient, the model that was fitted to all others."""
    return {patient: fitted([case for case in cases if case["patient"] != patient])
            for patient in {case["patient"] for case in cases}}


def tables(cases, models):
    """What is decided of cases whose patient was left out."""
    rows = []
    for stored in MILLIMETRES:
        for kind in KINDS:
            counts = collections.Counter(verdict(case, stored, models[case["patient"]]) for case in cases
                                         if case["kind"] == kind)
            rows.append([stored, kind, sum(counts.values()), *(counts[v] for v in ("right", "asked", "wrong"))])
    own = []
    for case in cases:
        if case["stored"] != "mm":
            found = odds(case, case["stored"], models[case["patient"]])
            own.append([case["name"], case["stored"], f"{100 * found[case['stored']]:.1f} %",
                        verdict(case, case["stored"], models[case["patient"]])])
    return (common.table(["stored in", "vessels", "surfaces", "right", "asked", "wrong"], rows),
            common.table(["surface", "its unit", "odds of it", "decided"], own))


PAGE = """# The unit of a file that states none

Written by `scripts/fit_units.py` with the program of {revision}, from {count} surfaces of {patients} patients.

A surface file rarely states its unit. What it can be is weighed by four figures that change with the unit: the typical radius
(twice the volume over the area), the extent, the mean edge, which a segmentation has from its voxels, and the distance of the
model from the origin, since most keep the scanner's coordinates. Before that, {mm:.0f} % of such files are taken to be in mm,
{cm:.0f} % in cm and {m:.0f} % in m; a file of SimVascular's is in cm as the others are in mm. What is more likely than
{certain:.0f} % is taken and said; else `prepare` asks. Openings, areas and lengths that no vessel has count against a reading.

Below, every surface was stored in each unit, and the fit did not know its patient. Of the surfaces stored in mm, as most are,
{asked:.1f} % are asked about.

{by_kind}
Vessels are thin to a typical radius of 1.9 mm, wide from 4.5 mm on. The surfaces that are in another unit as they come:

{own}"""


def written(page, cases, models, revision):
    by_kind, own = tables(cases, models)
    asked = sum(verdict(c, "mm", models[c["patient"]]) == "asked" for c in cases)
    with open(page, "w") as file:
        file.write(PAGE.format(revision=revision, count=len(cases), patients=len(models), by_kind=by_kind, own=own,
                               asked=100 * asked / len(cases), certain=100 * CERTAIN,
                               **{unit: 100 * share for unit, share in SHARES.items()}))


def main():
    parser = common.parser(__doc__)
    parser.add_argument("--out", help="the page")
    options = parser.parse_args()
    if not os.path.isdir(common.DATA):
        common.skip("no ../shared/data")
        return 77
    truths = [truth for _, truth in sorted(sources().items()) if is_surface(truth)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        cases = [case for case in pool.map(figures, truths) if case]
    kinds, place = fitted(cases)
    for mean, covariance in kinds:
        print("mean", [round(float(x), 2) for x in mean], "covariance", [[round(float(x), 2) for x in row] for row in covariance])
    print("distance from the origin: mean %.2f, deviation %.2f" % place)
    models = models_without(cases)
    print("\n".join(tables(cases, models)))
    if options.out:
        written(options.out, cases, models, page_rows.revision())
    return 0


if __name__ == "__main__":
    sys.exit(main())
