"""Triangle meshes as arrays: points [mm], #V x 3, and triangles, #F x 3 indices, counter-clockwise from outside."""
import numpy as np
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from ends.orchard.model import Unfit

# Ways to decimate, and the count of triangles to aim at beside the one asked for, in the order they are tried.
DECIMATIONS = ((vtk.vtkQuadricDecimation, 1), (vtk.vtkDecimatePro, 1), (vtk.vtkQuadricDecimation, 1.15),
               (vtk.vtkDecimatePro, 1.15), (vtk.vtkQuadricDecimation, 1.3))


# --- VTK -------------------------------------------------------------------------------------------------------------
def to_vtk(points, triangles):
    """A mesh as vtkPolyData, which has its own copy."""
    surface, cells, vtk_points = vtk.vtkPolyData(), vtk.vtkCellArray(), vtk.vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    flat = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.int64).ravel()
    cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(flat, deep=True))
    surface.SetPoints(vtk_points)
    surface.SetPolys(cells)
    return surface


def from_vtk(surface):
    """Points and triangles of vtkPolyData that has triangles only."""
    return (vtk_to_numpy(surface.GetPoints().GetData()).astype(float),
            vtk_to_numpy(surface.GetPolys().GetData()).reshape(-1, 4)[:, 1:].astype(np.int64))


def through(data, *filters):
    """What the last of the filters makes of the data."""
    for step in filters:
        step.SetInputData(data)
        step.Update()
        data = step.GetOutput()
    return data


def largest_region():
    """A filter that keeps the largest piece of a surface."""
    piece = vtk.vtkPolyDataConnectivityFilter()
    piece.SetExtractionModeToLargestRegion()
    return piece


# --- connectivity ----------------------------------------------------------------------------------------------------
def compact(points, triangles):
    """The mesh without points that no triangle has."""
    used, triangles = np.unique(triangles, return_inverse=True)
    return points[used], triangles.reshape(-1, 3)


def half_edges(triangles):
    """The edges of triangles in their direction, 3 #F x 2: first all of the first corner, then of the second, of the third."""
    return np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def manifold(triangles):
    """Whether each edge has at most two triangles, which agree on the side that is outside."""
    edges = half_edges(triangles)
    return len(np.unique(edges[:, 0] * (triangles.max() + 1) + edges[:, 1])) == len(edges)


def rim_edges(triangles):
    """The half edges without a triangle across, #E x 2."""
    edges, size = half_edges(triangles), triangles.max() + 1
    return edges[~np.isin(edges[:, 0] * size + edges[:, 1], edges[:, 1] * size + edges[:, 0])]


def loops(triangles):
    """The rims, each the indices of its vertices in the order of its triangles' edges. Unfit if they touch."""
    edges = rim_edges(triangles)
    following = dict(edges.tolist())
    if len(following) != len(edges):
        raise Unfit("rims touch")
    found = []
    while following:
        start, vertex = next(iter(following.items()))
        loop = [start]
        del following[start]
        while vertex != start:
            loop.append(vertex)
            vertex = following.pop(vertex)
        found.append(np.array(loop))
    return found


def connected(triangles, inside, seeds):
    """Which vertices can be reached from the seeds along edges between vertices inside. `inside` and the result: #V booleans."""
    reached = np.zeros(len(inside), bool)
    reached[seeds] = inside[seeds]
    edges = half_edges(triangles)
    edges = edges[inside[edges].all(axis=1)]
    while len(edges):
        at_ends = reached[edges]
        new = edges[at_ends[:, 0] != at_ends[:, 1]]
        if not len(new):
            break
        reached[new] = True
        edges = edges[~at_ends.all(axis=1)]
    return reached


# --- measures --------------------------------------------------------------------------------------------------------
def volume(points, triangles):
    """Enclosed volume [mm3], below 0 where the triangles face inward."""
    a, b, c = (points[triangles[:, i]] - points.mean(axis=0) for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def facing_outward(points, triangles):
    """The mesh with its triangles turned over if they face inward."""
    return points, triangles if volume(points, triangles) > 0 else triangles[:, ::-1]


def normals(points, triangles):
    """Of triangles, as long as twice their areas, #F x 3."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def edge_near(points, triangles, centre, reach):
    """Median edge [mm] near a place, or of all triangles where few are near."""
    near = np.linalg.norm(points[triangles[:, 0]] - centre, axis=1) < reach
    some = half_edges(triangles[near] if near.sum() > 5 else triangles)
    return float(np.median(np.linalg.norm(points[some[:, 0]] - points[some[:, 1]], axis=1)))


def thickness(points, triangles):
    """Distance [mm] from each vertex to the wall across, at most a fifth of the whole's size, and a twentieth of it where there
    is no wall."""
    of_vertex = np.zeros_like(points)
    for i in range(3):
        np.add.at(of_vertex, triangles[:, i], normals(points, triangles))
    inward = -of_vertex / np.maximum(np.linalg.norm(of_vertex, axis=1), 1e-12)[:, None]
    locator, size = vtk.vtkStaticCellLocator(), np.ptp(points, axis=0).max()
    locator.SetDataSet(to_vtk(points, triangles))
    locator.BuildLocator()
    at, hit, local, sub, cell = vtk.reference(0.0), [0.0] * 3, [0.0] * 3, vtk.reference(0), vtk.reference(0)
    across = np.full(len(points), size / 20)
    for i, (a, b) in enumerate(zip(points + 1e-3 * size * inward, points + 0.5 * size * inward)):
        if locator.IntersectWithLine(a, b, 0.0, at, hit, local, sub, cell):
            across[i] = min(float(at) * 0.5 * size, size / 5)
    return across


# --- decimation ------------------------------------------------------------------------------------------------------
def lighter(points, triangles, count):
    """The mesh with about so many triangles. Every way to decimate may join what is close into edges of three triangles; then
    the next is tried. Unfit if all do."""
    for decimation, aim in DECIMATIONS:
        decimate = decimation()
        decimate.SetTargetReduction(max(0.0, 1 - aim * count / len(triangles)))
        if isinstance(decimate, vtk.vtkDecimatePro):
            decimate.PreserveTopologyOn()
            decimate.SplittingOff()
        made = compact(*from_vtk(through(to_vtk(points, triangles), decimate)))
        if manifold(made[1]):
            return made
    raise Unfit("decimation makes edges of three triangles")
