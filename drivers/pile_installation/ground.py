"""One picture of a run as arrays: grains and elements in the plane y = 0, the pile, contacts and fields. Lengths in mm."""

import numpy as np

from picture import numbered_files, read_vtu
from run_data import pictures_of, read_parameters
from slices import chains_near, cut_at, grid_of, segments_of, slice_of


def numbers_of(folder):
    """The numbers of the pictures that are there."""
    return range(len(numbered_files(folder, "stress")))


def distance_to(lines, places):
    """Of places to the nearest of some lines. @param lines [line, end, 2]; @param places [..., 2]"""
    nearest = np.full(places.shape[:-1], np.inf)
    for begin, end in lines:
        way = end - begin
        part = np.clip((places - begin) @ way / max(way @ way, 1e-30), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(places - begin - part[..., None] * way, axis=-1))
    return nearest


class Ground:
    """The ground at one of the run's pictures. What is large is read when it is asked for."""

    def __init__(self, folder, number):
        self.folder, self.number, self.files = folder, number, {}
        for kind in ("grains", "surfaces", "continuum", "solid_fraction", "stress"):
            files = numbered_files(folder, kind)
            if number < len(files):
                self.files[kind] = files[number]
        parameters = read_parameters(folder)
        self.sphere_radius = 1e3 * float(parameters["Fields/sphere radius"])
        self.mean_grain = 2e3 * np.mean([float(axis) for axis in parameters["Sand/mean half-axes"].split(",")])
        self.pile = segments_of(cut_at(self.files["surfaces"], 0))
        self.outlines, fields = slice_of(self.files["grains"],
                                         ["displacement", "sinking", "initial_height", "pressure"])
        self.moved, self.sinking, self.height, self.pressure = (1e3 * fields[0], 1e3 * fields[1], 1e3 * fields[2], fields[3])
        self.centres = np.array([outline.mean(axis=0) for outline in self.outlines])
        self.elements = Elements(self.files["continuum"]) if "continuum" in self.files else None

    def tip(self):
        return self.pile[:, :, 1].min()

    def pile_half_width(self):
        return self.pile[:, :, 0].max()

    def pile_outline(self):
        """The pile's corners in order: its section is convex."""
        corners = self.pile.reshape(-1, 2)
        around = corners - corners.mean(axis=0)
        return corners[np.argsort(np.arctan2(around[:, 1], around[:, 0]))]

    def surface(self):
        """Highest point of any grain in the plane."""
        return max(outline[:, 1].max() for outline in self.outlines)

    def chains(self):
        """Branches of the contacts in a slab three grains thick, and their normal forces in N."""
        return chains_near(pictures_of(self.folder, "contacts")[self.number], 3 * self.mean_grain)

    def solid_fraction(self):
        """Not a number where a sampling sphere is not in grains alone: it reaches into the pile or out of their ground."""
        x, z, values = grid_of(self.files["solid_fraction"], "solid_fraction")
        places = np.stack(np.meshgrid(0.5 * (x[1:] + x[:-1]), 0.5 * (z[1:] + z[:-1])), axis=-1)
        return x, z, np.where(distance_to(self.pile, places) < self.sphere_radius, np.nan, values)

    def stress(self, field="pressure"):
        """Over cells, of grains and elements together, in Pa; not a number where there is no ground."""
        x, z, values = grid_of(self.files["stress"], field)
        ground = grid_of(self.files["stress"], "pressure")[2]
        return x, z, np.where(np.abs(ground) > 1e-6 * np.abs(ground).max(), values, np.nan)


class Elements:
    """Their faces in front, moved along, and means over each: how far they have moved, the height at first, the
    pressure in Pa."""

    def __init__(self, path):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        grid = read_vtu(path)
        start = vtk_to_numpy(grid.GetPoints().GetData()) * 1e3
        shift = vtk_to_numpy(grid.GetPointData().GetArray("displacement")) * 1e3
        pressure = vtk_to_numpy(grid.GetPointData().GetArray("pressure"))
        cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
        front = np.abs(start[:, 1] - start[:, 1].min()) < 1e-6
        self.outlines, moved, rise, height, pressures = [], [], [], [], []
        for cell in cells:
            corners = cell[front[cell]]
            if len(corners) != 4:
                continue
            around = start[corners][:, [0, 2]] - start[corners][:, [0, 2]].mean(axis=0)
            corners = corners[np.argsort(np.arctan2(around[:, 1], around[:, 0]))]
            self.outlines.append((start + shift)[corners][:, [0, 2]])
            moved.append(np.linalg.norm(shift[corners], axis=1).mean())
            rise.append(shift[corners, 2].mean())
            height.append(start[corners, 2].mean())
            pressures.append(pressure[cell].mean())
        self.moved, self.rise, self.height, self.pressure = (np.array(v) for v in (moved, rise, height, pressures))
        self.centres = np.array([outline.mean(axis=0) for outline in self.outlines])
