"""Grains and force chains for ParaView: true surfaces, glyphs of a shape each, and scripts that it loads as states."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..contacts import Contacts
from ..errors import BadArgument, MissingFile
from ..grains import Grains
from ..shapes import Parts
from .files import whole
from .tessellation import COARSEST, FINEST, globe, steps_by_size, surface_points, tessellated

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkPolyData

STATES = Path(__file__).parent / "states"
GRID = 0.1  # between the exponents that have a glyph of their own: a grain's differ from them by half of it at most
MANY = 10000  # grains above which the largest have 128 faces, not 288
GLYPH_STEPS = 4  # a quarter turn: 128 faces a grain


def write_surfaces(grains: Grains, path: Path, finest: int | None = None) -> Path:
    """All grains by their surfaces, small ones more coarsely, see steps_by_size(). Faces carry id, velocity and what the
    source has of one number a grain. @param finest steps a quarter turn of the largest, even; none: by the number of grains
    """
    parts = grains.parts
    finest = checked(finest or (FINEST if len(parts) <= MANY else FINEST - 2))
    steps = steps_by_size(parts.half_axes, finest)
    points, corners, sizes, carrier = [], [], [], []
    n_points = 0
    for step in np.unique(steps):
        some = np.flatnonzero(steps == step)
        surface, faces = tessellated(rows_of(parts, some), int(step))
        is_triangle = (faces[:, 0] == faces[:, 3]) | (faces[:, 1] == faces[:, 2])
        used = np.ones(faces.shape, dtype=bool)
        used[faces[:, 0] == faces[:, 3], 3] = False
        used[faces[:, 1] == faces[:, 2], 2] = False
        first = n_points + surface.shape[1] * np.arange(len(some), dtype=np.int64)
        corners.append((first[:, None] + faces[used]).ravel())
        sizes.append(np.tile(np.where(is_triangle, 3, 4), len(some)))
        points.append(surface.reshape(-1, 3))
        carrier.append(np.repeat(parts.grain[some], len(faces)))
        n_points += points[-1].shape[0]
    row = np.concatenate(carrier)
    data = poly_data(np.concatenate(points), (np.concatenate(corners), np.concatenate(sizes)))
    for name, values in shown(grains).items():
        add(data.GetCellData(), name, values[row])
    return write_poly_data(data, path)


def write_glyphs(grains: Grains, folder: Path, steps: int | None = None) -> list[Path]:
    """A point a part with half-axes, quaternion (w, x, y, z) and number of its shape, and the shapes: one for each pair of
    exponents, rounded to GRID; and the script that draws one by the other. @param steps a quarter turn of the shapes
    """
    parts = grains.parts
    rounded = np.clip(np.round(parts.exponents / GRID), 1, round(2 / GRID) - 1).astype(int)
    kinds, shape = np.unique(rounded, axis=0, return_inverse=True)
    points = poly_data(parts.centre.astype(np.float32))
    arrays = {"half_axes": parts.half_axes, "quaternion": parts.quaternion[:, [3, 0, 1, 2]], "exponents": parts.exponents}
    for name, values in arrays.items():
        add(points.GetPointData(), name, values)
    add(points.GetPointData(), "shape", shape.reshape(-1).astype(np.int32))
    for name, values in shown(grains).items():
        add(points.GetPointData(), name, values[parts.grain])
    files = [write_poly_data(points, folder / "glyphs.vtp"),
             write_shapes(kinds * GRID, folder / "shapes.vtm", checked(steps or GLYPH_STEPS))]
    return [*files, write_state("glyphs", folder / "show_glyphs.py", POINTS=str(files[0].resolve()),
                                SHAPES=str(files[1].resolve()))]


def write_shapes(exponents: np.ndarray, path: Path, steps: int) -> Path:
    """Superquadrics of half-axes one as blocks of one file. @param exponents (k, 2)"""
    from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter
    angles, faces = globe(steps)
    blocks = vtkMultiBlockDataSet()
    for number, surface in enumerate(surface_points(angles, np.ones((len(exponents), 3)), exponents)):
        cells = [list(dict.fromkeys(face)) for face in faces.tolist()]
        sizes = np.array([len(cell) for cell in cells])
        blocks.SetBlock(number, poly_data(surface.astype(np.float32), (np.concatenate(cells), sizes)))
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(blocks)
    if not writer.Write():
        raise OSError(f"cannot write {path}")
    return path


def write_chains(contacts: Contacts | None, files: list[Path], path: Path) -> Path:
    """A script that shows the contacts of a run as tubes, as thick as their force, and those above the mean alone."""
    if contacts is None or not files:
        raise MissingFile(f"{path}: there is no contacts.pvd for it to show; give the folder of a run that draws contacts")
    force, length = contacts.normal_force, np.linalg.norm(contacts.branch, axis=1)
    return write_state("force_chains", path, CONTACTS=str(files[0].resolve()), MEAN_FORCE=float(force.mean()),
                       MEAN_LENGTH=float(length.mean()))


def write_state(name: str, path: Path, **settings: Any) -> Path:
    """A script for ParaView's Load State. @param settings by the names that stand in its lines NAME = None"""
    text = (STATES / f"{name}.py").read_text()
    for setting, value in settings.items():
        text = text.replace(f"{setting} = None", f"{setting} = {value!r}")
    with whole(path) as part:
        part.write_text(text)
    return path


def checked(steps: int) -> int:
    if steps < COARSEST or steps % 2:
        raise BadArgument(f"the steps of a quarter turn are {steps}; give an even number, at least {COARSEST}")
    return steps


def shown(grains: Grains) -> dict[str, np.ndarray]:
    """What pictures carry: id, velocity, and figures of one number a grain."""
    scalars = {name: values for name, values in grains.fields.items()
               if np.ndim(values) == 1 and np.isfinite(values).all() and name != "turned"}
    return {"id": grains.id.astype(np.int32 if len(grains) == 0 or grains.id.max() < 2 ** 31 else np.int64),
            "velocity": grains.velocity, **scalars}


def rows_of(parts: Parts, rows: np.ndarray) -> Parts:
    return Parts(parts.grain[rows], parts.centre[rows], parts.quaternion[rows], parts.half_axes[rows], parts.exponents[rows])


def poly_data(points: np.ndarray, faces: tuple[np.ndarray, np.ndarray] | None = None) -> vtkPolyData:
    """@param points (p, 3); @param faces their corners one after the other, and how many each has; without, points alone"""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    data, places, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(places)
    corners, sizes = faces or (np.arange(len(points)), np.ones(len(points)))
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    whole_numbers = np.int32 if max(offsets[-1], len(points)) < 2 ** 31 else np.int64
    cells.SetData(*(numpy_to_vtk(np.ascontiguousarray(array, dtype=whole_numbers), deep=True)
                    for array in (offsets, corners)))
    (data.SetPolys if faces else data.SetVerts)(cells)
    return data


def add(where: Any, name: str, values: np.ndarray) -> None:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    if values.dtype.kind == "f":
        values = values.astype(np.float32)
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    where.AddArray(array)


def write_poly_data(data: vtkPolyData, path: Path) -> Path:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
    writer = vtkXMLPolyDataWriter()
    writer.SetCompressorTypeToLZ4()  # a third of the bytes, and read as fast as without
    writer.EncodeAppendedDataOff()
    writer.SetHeaderTypeToUInt64()
    writer.SetInputData(data)
    with whole(path) as part:
        writer.SetFileName(str(part))
        if not writer.Write():
            raise OSError(f"cannot write {path}")
    return path
