"""The labelled vessels that cases are made from: their truths, and their models, raw, opened or closed."""
import glob
import json
import os

import numpy as np
import vtkmodules.all as vtk

from common import DATA
from ends.orchard.clipping import cut_end, remeasured, rims
from ends.orchard.closing import all_capped, capped
from ends.orchard.meshes import (compact, facing_outward, from_vtk, largest_region, lighter, loops, manifold, through)
from ends.orchard.model import Model, Unfit, place, unit
from ends.orchard.voxels import VOXELS, Grid, read_voxels, stencilled, surface_of

MANY = 40000   # triangles above which a surface is decimated to FEWER
FEWER = 30000
UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0}
SURFACES = {"stl": vtk.vtkSTLReader, "obj": vtk.vtkOBJReader, "vtp": vtk.vtkXMLPolyDataReader}

# Coarse anatomy by words of the sources' own text, and by name in ../shared/data/ends, which has none.
WORDS = (("whole", "whole head"), ("arch ", "arch"), ("carotid bifurcation", "carotid"), ("carotid", "cerebral"),
         ("cerebral", "cerebral"), ("bifurcation aneurysm", "cerebral"), ("popliteal", "popliteal"),
         ("coronary", "coronary"), ("aorta", "aorta"))
ANATOMY = {"coronarytree": "coronary", "cow066whole": "whole head", "frayds": "cerebral", "m_frayds": "cerebral",
           "m_frayds05": "cerebral", "m_neck": "cerebral", "neck_obj": "cerebral", "kt_aorta": "aorta",
           "kt_stlmodel": "aorta", "kt_wall": "aorta", "mov_atrium": "heart", "mov_atrium_mm": "heart", "tsheart": "heart",
           "seqseg6": "aorta", "shawn": "aorta", "tsaorta_ct": "aorta", "tsaorta_mask": "aorta", "vmtkseg2": "aorta"}
PREFIXES = (("cow", "cerebral"), ("hep", "liver"))
# Several of ../shared/data/ends show one patient.
PATIENTS = {"m_frayds": "frayds", "m_frayds05": "frayds", "m_neck": "neck_obj", "mov_atrium_mm": "mov_atrium",
            "cow023_45": "cow023", "hep002_2": "hep002_1", "hep010_2": "hep010_1", "tsaorta_mask": "tsaorta_ct"}


# --- truths ----------------------------------------------------------------------------------------------------------
def anatomy_of(truth):
    """The coarse anatomy, "other" where it is unknown."""
    name, text = truth["name"], truth.get("anatomy")
    if text:
        return next((group for word, group in WORDS if word in text), "other")
    return ANATOMY.get(name) or next((group for start, group in PREFIXES if name.startswith(start)), "other")


def sources():
    """Truths of all sources by name, with `folder`, `patient` and the coarse `anatomy`."""
    found = {}
    for folder in ("anatomy", "ends"):
        for path in sorted(glob.glob(os.path.join(DATA, folder, "truth", "*.json"))):
            with open(path) as file:
                truth = json.load(file)
            name = truth["name"]
            found[name] = dict(truth, folder=os.path.join(DATA, folder), anatomy=anatomy_of(truth),
                               patient=truth.get("patient") or PATIENTS.get(name, name))
            found[name].setdefault("ends", [])
    return found


def suffix(truth):
    """Of the source's file, in small letters and without a dot."""
    return truth["input"].rsplit(".", 1)[1].lower()


def is_surface(truth):
    """Whether the source is a surface, not voxels."""
    return suffix(truth) in SURFACES


def file_of(truth):
    return os.path.join(truth["folder"], truth["input"])


# --- reading ---------------------------------------------------------------------------------------------------------
def read_surface(truth):
    """Points [mm] and triangles of a surface's largest piece, all of them facing outward."""
    reader = SURFACES[suffix(truth)]()
    reader.SetFileName(file_of(truth))
    reader.Update()
    triangulate, facing = vtk.vtkTriangleFilter(), vtk.vtkPolyDataNormals()
    triangulate.PassLinesOff()
    triangulate.PassVertsOff()
    facing.ConsistencyOn()
    facing.SplittingOff()
    steps = triangulate, vtk.vtkCleanPolyData(), facing, largest_region()
    points, triangles = from_vtk(through(reader.GetOutput(), *steps))
    return facing_outward(*compact(points * UNITS[truth.get("units") or "mm"], triangles))


def read_mask(truth):
    """Points [mm] and triangles of a mask's surface."""
    voxels, affine = read_voxels(file_of(truth))
    labels = [a.split("=")[1] for a in truth["arguments"] if "extract-surface.labels=" in a]
    mask = np.isin(voxels, [int(x) for x in labels[0].split(",")]) if labels else voxels > 0
    points, triangles = surface_of(mask)
    points = (points @ affine[:3, :3].T + affine[:3, 3]) * UNITS[truth.get("units") or "mm"]
    return facing_outward(points, triangles)


def remade(points, triangles, ends):
    """A surface [mm] with edges of three triangles made again from its voxels."""
    step = 0.14 * float(np.median([e["diameter_mm"] for e in ends]))
    step = max(step, (np.prod(np.ptp(points, axis=0)) / VOXELS) ** (1 / 3))
    low = points.min(axis=0) - 3 * step
    dims = np.ceil((np.ptp(points, axis=0) + 6 * step) / step).astype(int)
    points, triangles = surface_of(stencilled(points, triangles, Grid(low, np.full(3, step), dims)))
    return facing_outward(points * step + low, triangles)


# --- models ----------------------------------------------------------------------------------------------------------
def loaded(truth):
    """A source as a model; ends that are not on its largest piece are left out where a truth does not list all anyway."""
    points, triangles = read_surface(truth) if is_surface(truth) else read_mask(truth)
    ends = [dict(end) for end in truth["ends"]]
    if is_surface(truth) and not manifold(triangles):
        points, triangles = remade(points, triangles, ends)
    if len(triangles) > MANY and is_surface(truth):
        points, triangles = lighter(points, triangles, FEWER)
    if is_surface(truth) and not manifold(triangles):
        raise Unfit("the source has edges of three triangles")
    kept = [e for e in ends if np.linalg.norm(points - place(e), axis=1).min() < max(1, 0.6 * e["diameter_mm"])]
    if len(kept) < len(ends) and not truth.get("others") and any(e["role"] != "optional" for e in ends if e not in kept):
        raise Unfit("the source has ends on several pieces")
    for end in kept:
        if "outward" not in end:
            near = np.linalg.norm(points - place(end), axis=1) < 1.5 * end["diameter_mm"]
            end["outward"] = unit(place(end) - points[near].mean(axis=0)).tolist() if near.any() else [0, 0, 1]
    return Model(points, triangles, kept)


def cut_open(model, index, rng):
    """An end without a rim cut at the first depth at which that works; optional ones stay as they are where it never does."""
    for depth in (0.3, 0.5, 0.2, 0.75):
        try:
            return cut_end(model, index, depth, 0, rng)[0]
        except Unfit:
            continue
    if model.ends[index]["role"] != "optional":
        raise Unfit("an end cannot be cut open")
    return model


def opened(model):
    """Every end that flow may pass cut open, or its rim measured; other rims are capped."""
    known = rims(model)
    model = remeasured(model)
    listed = {tuple(loop) for loop in known.values()}
    for loop in loops(model.triangles):
        if tuple(loop) not in listed:
            model, _ = capped(model, loop)
    rng = np.random.default_rng(1)
    for index, end in enumerate(model.ends):
        if index not in known and end["role"] != "closed":
            model = cut_open(model, index, rng)
    return model


class Source:
    """A source's models, each made when first asked for."""

    def __init__(self, truth):
        self.truth = truth
        self.models = {}  # or why there is none: an Unfit

    def model(self, state):
        """The model that is "raw", as read; "opened"; or "closed". Unfit if there is none."""
        if state not in self.models:
            try:
                self.models[state] = self.made(state)
            except Unfit as why:
                self.models[state] = why
        if isinstance(self.models[state], Unfit):
            raise self.models[state]
        return self.models[state]

    def made(self, state):
        if state == "raw":
            return loaded(self.truth)
        raw = self.model("raw")
        if state == "opened":
            return opened(raw)
        if not is_surface(self.truth) or not loops(raw.triangles):
            return raw  # what has no rims is as closed as it can be
        return all_capped(self.model("opened"))
