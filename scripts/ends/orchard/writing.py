"""Files of cases: surfaces, images and truths."""
import gzip
import json
import os
import zlib

import numpy as np
import vtkmodules.all as vtk

from ends.orchard.meshes import to_vtk


def write_surface(folder, model, way, scale):
    """As "stl" or "vtp", in a unit of so many mm. Returns the file's name."""
    name = "input." + way
    writer = vtk.vtkSTLWriter() if way == "stl" else vtk.vtkXMLPolyDataWriter()
    if way == "stl":
        writer.SetFileTypeToBinary()
    writer.SetFileName(os.path.join(folder, name))
    writer.SetInputData(to_vtk(model.points / scale, model.triangles))
    writer.Write()
    return name


# --- images: all of a file, of uint8 or int16 voxels [z, y, x] on a grid -----------------------------------------------
def spelled(values, between=" "):
    return between.join("%.9g" % x for x in values)


def metaimage(voxels, grid):
    packed = zlib.compress(voxels.tobytes(), 1)
    return ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"CompressedData = True\nCompressedDataSize = {len(packed)}\n"
            f"TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = {spelled(grid.low + grid.spacing / 2)}\n"
            f"ElementSpacing = {spelled(grid.spacing)}\nDimSize = {spelled(voxels.shape[::-1])}\n"
            f"ElementType = {'MET_SHORT' if voxels.dtype == np.int16 else 'MET_UCHAR'}\n"
            "ElementDataFile = LOCAL\n").encode() + packed


def nrrd(voxels, grid):
    x, y, z = ("%.9g" % s for s in grid.spacing)
    return (f"NRRD0004\ntype: {'short' if voxels.dtype == np.int16 else 'unsigned char'}\ndimension: 3\n"
            f"space: left-posterior-superior\nsizes: {spelled(voxels.shape[::-1])}\n"
            f"space directions: ({x},0,0) (0,{y},0) (0,0,{z})\nkinds: domain domain domain\nendian: little\n"
            f"encoding: gzip\nspace origin: ({spelled(grid.low + grid.spacing / 2, ',')})\n\n").encode() + gzip.compress(
                voxels.tobytes(), 1, mtime=0)


def nifti(voxels, grid):
    """The same place as the others' LPS in NIfTI's RAS."""
    short = voxels.dtype == np.int16
    header = bytearray(352)
    header[0:4] = np.int32(348).tobytes()
    header[40:56] = np.array([3, *voxels.shape[::-1], 1, 1, 1, 1], np.int16).tobytes()
    header[70:74] = np.array([4 if short else 2, 16 if short else 8], np.int16).tobytes()
    header[76:92] = np.array([1, *grid.spacing], np.float32).tobytes()
    header[108:120] = np.array([352, 1, 0], np.float32).tobytes()
    header[123] = 2  # mm
    header[254:256] = np.int16(1).tobytes()
    origin = (grid.low + grid.spacing / 2) * [-1, -1, 1]
    rows = np.column_stack([np.diag([-1.0, -1, 1]) * grid.spacing, origin])
    header[280:328] = rows.astype(np.float32).tobytes()
    header[344:348] = b"n+1\0"
    return gzip.compress(bytes(header) + voxels.tobytes(), 1, mtime=0)


IMAGES = {"mha": metaimage, "nrrd": nrrd, "nii.gz": nifti}


def write_image(folder, voxels, grid, way):
    """As one of IMAGES. Returns the file's name."""
    name = "input." + way
    with open(os.path.join(folder, name), "wb") as file:
        file.write(IMAGES[way](voxels, grid))
    return name


# --- truths ----------------------------------------------------------------------------------------------------------
def write_truth(folder, truth, **fields):
    """A case's truth.json: the source's truth with the fields that differ from it. It is there as a whole or not at all."""
    made = {k: v for k, v in truth.items() if k not in ("folder", "bytes")}
    made.update(fields)
    path = os.path.join(folder, "truth.json")
    with open(path + ".new", "w") as file:
        json.dump(made, file, indent=1)
    os.replace(path + ".new", path)
