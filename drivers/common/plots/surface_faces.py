"""Views of the triangles of a run's surfaces."""

import numpy as np


def add_view(axes, corners, values, axis, highest, looks=-1):
    """Triangles that look along an axis, or against it (looks = -1), seen along it or against it [m]."""
    from matplotlib.collections import PolyCollection
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = np.flatnonzero(looks * normals[:, axis] > 0)
    seen = seen[np.argsort(-corners[seen][:, :, axis].mean(axis=1))]  # the near ones last
    plane = [0, 2 if axis == 1 else 1]
    faces = PolyCollection(corners[seen][:, :, plane] * 1e3, array=values[seen], cmap="viridis", linewidth=0.15,
                           edgecolor="#999999")
    faces.set_clim(0, highest)
    axes.add_collection(faces)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.grid(False)
    return faces
