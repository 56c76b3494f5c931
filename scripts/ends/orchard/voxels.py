"""Voxels as arrays [z, y, x]: masks of surfaces and surfaces of masks."""
import dataclasses
import math

import numpy as np
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ends.orchard.meshes import compact, from_vtk, largest_region, through, to_vtk

VOXELS = 4e6  # of a grid; finer ones are coarsened to it


@dataclasses.dataclass
class Grid:
    """Where voxels are, along the axes x, y, z."""
    low: np.ndarray      # outer corner of the first voxel [mm]
    spacing: np.ndarray  # [mm]
    dims: np.ndarray     # counts

    def middles(self, mask):
        """The middles of a mask's voxels [mm], #N x 3."""
        return self.low + (np.argwhere(mask > 0)[:, ::-1] + 0.5) * self.spacing


def to_image(voxels):
    """Voxels as vtkImageData, the middle of the first at 0, the others at their indices."""
    image = vtk.vtkImageData()
    image.SetDimensions(*voxels.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(voxels).ravel(), deep=True))
    return image


def stencilled(points, triangles, grid):
    """A mask: the grid's voxels whose middles are in a closed surface [mm] are 1."""
    make, paint = vtk.vtkPolyDataToImageStencil(), vtk.vtkImageStencilToImage()
    make.SetInputData(to_vtk(points, triangles))
    make.SetOutputOrigin(*map(float, grid.low + grid.spacing / 2))
    make.SetOutputSpacing(*map(float, grid.spacing))
    x, y, z = (int(count) for count in grid.dims)
    make.SetOutputWholeExtent(0, x - 1, 0, y - 1, 0, z - 1)
    make.SetTolerance(0)
    paint.SetInputConnection(make.GetOutputPort())
    paint.SetInsideValue(1)
    paint.SetOutsideValue(0)
    paint.SetOutputScalarTypeToUnsignedChar()
    paint.Update()
    return vtk_to_numpy(paint.GetOutput().GetPointData().GetScalars()).reshape(z, y, x).copy()


def largest_piece(mask):
    """The mask of its largest piece."""
    keep = vtk.vtkImageConnectivityFilter()
    keep.SetScalarRange(1, 255)
    keep.SetExtractionModeToLargestRegion()
    keep.SetLabelModeToConstantValue()
    keep.SetLabelConstantValue(1)
    image = through(to_image(mask.astype(np.uint8)), keep)
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(mask.shape).astype(np.uint8)


def blurred(values, sigma):
    """Voxels blurred by a Gaussian of sigma [voxels]; at the border the image goes on as it ends."""
    reach = max(1, math.ceil(3 * sigma))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    for axis in range(3):
        wide = np.pad(values, [(reach, reach) if i == axis else (0, 0) for i in range(3)], mode="edge")
        size = values.shape[axis]
        values = sum(w * np.take(wide, range(i, i + size), axis=axis) for i, w in enumerate(weights / weights.sum()))
    return values.astype(np.float32)


def surface_of(mask):
    """Points by indices (x, y, z) and triangles of a mask's largest piece, its stairs blurred away."""
    first = np.array([np.flatnonzero(mask.any(axis=tuple(j for j in range(3) if j != i)))[[0, -1]] for i in range(3)])
    mask = mask[tuple(slice(a, b + 1) for a, b in first)]
    values = np.pad(blurred(np.pad(mask.astype(np.float32), 2), 0.6), 1)
    extract = vtk.vtkFlyingEdges3D()
    extract.SetValue(0, 0.5)
    extract.ComputeNormalsOff()
    steps = extract, vtk.vtkTriangleFilter(), vtk.vtkCleanPolyData(), largest_region()
    points, triangles = compact(*from_vtk(through(to_image(values), *steps)))
    return points - 3 + first[::-1, 0], triangles


# --- files -----------------------------------------------------------------------------------------------------------
def nifti_affine(reader):
    """The matrix, 4 x 4, of a vtkNIFTIImageReader's file from indices (x, y, z) to LPS."""
    form = reader.GetSFormMatrix() or reader.GetQFormMatrix()
    affine = np.array([[form.GetElement(i, j) for j in range(4)] for i in range(4)])
    spacing = np.array(reader.GetOutput().GetSpacing())
    affine[:3, :3] = affine[:3, :3] / np.linalg.norm(affine[:3, :3], axis=0) * spacing
    return np.diag([-1.0, -1, 1, 1]) @ affine


def metaimage_affine(path, spacing):
    """The same of a MetaImage, of which VTK's reader leaves out the directions: one axis of the grid in each row."""
    with open(path, "rb") as file:
        header = file.read(2000).split(b"ElementDataFile")[0].decode()
    fields = dict(line.split(" = ") for line in header.splitlines())
    affine = np.eye(4)
    affine[:3, :3] = np.array(fields.get("TransformMatrix", "1 0 0 0 1 0 0 0 1").split(), float).reshape(3, 3).T
    affine[:3, :3] *= spacing
    affine[:3, 3] = np.array(fields.get("Offset", "0 0 0").split(), float)
    return affine


def read_voxels(path):
    """Voxels of a NIfTI file or a MetaImage, and the matrix, 4 x 4, from indices (x, y, z) to LPS, in the file's unit."""
    nifti = path.endswith((".nii.gz", ".nii"))
    reader = vtk.vtkNIFTIImageReader() if nifti else vtk.vtkMetaImageReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()  # whose scalars the reader may free with it, hence the copy
    voxels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1]).copy()
    return voxels, nifti_affine(reader) if nifti else metaimage_affine(path, image.GetSpacing())
