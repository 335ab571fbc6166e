"""VTU files as arrays, by VTK's own reader."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import DamagedFile, MissingFile, unknown_name

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

VERTEX, LINE, TRIANGLE, QUADRILATERAL, HEXAHEDRON, HEXAHEDRON_27 = 1, 3, 5, 9, 12, 72  # cell types of VTK


@dataclass(frozen=True)
class Mesh:
    """Points and cells with their data, as a VTU file has them; np points, nc cells."""

    path: Path
    points: np.ndarray  # (np, 3) [m]
    types: np.ndarray  # (nc,) VTK's cell types
    connectivity: np.ndarray  # points of all cells, one cell after the other
    offsets: np.ndarray  # (nc + 1,) where each cell begins in the connectivity
    point_data: dict[str, np.ndarray]  # (np,) or (np, components)
    cell_data: dict[str, np.ndarray]  # (nc,) or (nc, components)

    def __getitem__(self, name: str) -> np.ndarray:
        """Data of the points or, where they have none of this name, of the cells; UnknownName with the nearest names."""
        for data in (self.point_data, self.cell_data):
            if name in data:
                return data[name]
        raise unknown_name(f"{self.path} has no data", name, [*self.point_data, *self.cell_data])

    @property
    def names(self) -> list[str]:
        """Of all data, of points and of cells."""
        return [*self.point_data, *self.cell_data]

    @cached_property
    def cells(self) -> np.ndarray:
        """Points of each cell, (nc, corners), in VTK's order; DamagedFile where cells differ in their number."""
        sizes = np.diff(self.offsets)
        if len(sizes) and (sizes != sizes[0]).any():
            raise DamagedFile(f"{self.path} has cells of {sizes.min()} to {sizes.max()} points; see connectivity and "
                              "offsets")
        return self.connectivity.reshape(len(sizes), -1)


def read_grid(path: Path | str) -> vtkUnstructuredGrid:
    """A VTU file as VTK's own object. MissingFile where there is none, DamagedFile where VTK cannot read it."""
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    path = Path(path)
    check_ends(path)
    reader = vtkXMLUnstructuredGridReader()
    errors: list[str] = []
    for speaker in (reader, reader.GetExecutive()):  # who is listened to prints nothing
        speaker.AddObserver("ErrorEvent", lambda *_: errors.append("VTK cannot read it"))
    reader.SetFileName(str(path))
    reader.Update()
    if errors or reader.GetErrorCode():
        raise DamagedFile(f"{path} is damaged: {errors[0] if errors else 'VTK cannot read it'}")
    return reader.GetOutput()


def check_ends(path: Path) -> None:
    """VTK would print what is wrong with a file that is no XML, or fill arrays of one that ends early with anything."""
    try:
        with open(path, "rb") as file:
            begin, size = file.read(80), file.seek(0, 2)
            file.seek(max(size - 80, 0))
            end = file.read()
    except OSError as error:
        raise MissingFile(f"{path}: {error.strerror}") from None
    if not begin.lstrip().startswith((b"<?xml", b"<VTKFile")):
        raise DamagedFile(f"{path} is no file of VTK: it does not begin as XML")
    if not end.rstrip().endswith(b"</VTKFile>"):
        raise DamagedFile(f"{path} is damaged: it does not end with </VTKFile>")


def read_vtu(path: Path | str) -> Mesh:
    """A VTU file as arrays; errors as read_grid()."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    grid = read_grid(path)

    def arrays(data: Any) -> dict[str, np.ndarray]:
        return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}

    cells, n = grid.GetCells(), grid.GetNumberOfCells()
    empty = np.zeros(0, dtype=np.int64)
    has_points = grid.GetNumberOfPoints() > 0
    return Mesh(Path(path), vtk_to_numpy(grid.GetPoints().GetData()) if has_points else np.zeros((0, 3)),
                vtk_to_numpy(grid.GetCellTypesArray()) if n else empty.astype(np.uint8),
                vtk_to_numpy(cells.GetConnectivityArray()) if n else empty,
                vtk_to_numpy(cells.GetOffsetsArray()) if n else np.zeros(1, dtype=np.int64),
                arrays(grid.GetPointData()), arrays(grid.GetCellData()))
