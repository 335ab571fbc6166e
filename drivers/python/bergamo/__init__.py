"""Reads runs of Bergamo: parameters, history, figures, pictures and snapshots, as NumPy arrays.

    import bergamo
    run = bergamo.open("results/two_scale_triaxial")
    run.history["stress_3_Pa"]                 # (n_rows,) [Pa], by the file's names
    run.parameters["Grains/friction"], run.summary["particles"], run.state
    grains = run.pictures["grains"][-1]        # Grains: position (n, 3), half_axes (n, 3), quaternion (n, 4), ...
    state = run.snapshot()                     # to the last bit: state.grains, state.contacts, state.walls
    bergamo.stress(state.contacts, volume)     # (3, 3) [Pa]; see bergamo.measure for all of its kind

SI units, tension positive, global frame, quaternions in the order (x, y, z, w). Needs NumPy; pictures need VTK's Python
(python3-vtk9), snapshots h5py, diagrams matplotlib: each is imported when it is first needed.
`python3 -m bergamo` shows, watches, compares and exports runs in a terminal. docs/python.md has examples.
"""

try:
    import numpy as _numpy  # noqa: F401
except ModuleNotFoundError as _missing:
    import sys as _sys
    if _missing.name != "numpy":
        raise
    raise ModuleNotFoundError(f"bergamo needs NumPy, which {_sys.executable} has not; take Debian's /usr/bin/python3 with "
                              "python3-numpy, or install NumPy for this one", name="numpy") from None

from .archive import Archive
from .contacts import Contacts
from .continuum import Continuum
from .errors import BadArgument, DamagedFile, Error, MissingData, MissingFile, UnknownName
from .grains import Grains
from .measure import (Box, Coordination, ForceChains, Profile, Sphere, anisotropy, coordination_numbers,
                      deviatoric_stress, fabric_tensor, force_chains, force_moment, is_rattler, pressure,
                      principal_stresses, profile, sampled_solid_fraction, solid_fraction, solid_fraction_in, stress,
                      stress_in_box, stress_profile)
from .mesh import Mesh, read_grid, read_vtu
from .parameters import Parameter, Section, read_parameters
from .pictures import Pictures, Series
from .run import Run, Tables, open_run
from .shapes import Parts
from .snapshot import Snapshot, Wall
from .summary import Summary, read_summary
from .surfaces import Surfaces
from .table import Table, read_table
from .units import unit_of

open = open_run

__all__ = [  # but for open, which would hide Python's own
    "Archive", "BadArgument", "Box", "Contacts", "Continuum", "Coordination", "DamagedFile", "Error", "ForceChains",
    "Grains", "Mesh", "MissingData", "MissingFile", "Parameter", "Parts", "Pictures", "Profile", "Run", "Section",
    "Series", "Snapshot", "Sphere", "Summary", "Surfaces", "Table", "Tables", "UnknownName", "Wall", "anisotropy",
    "coordination_numbers", "deviatoric_stress", "fabric_tensor", "force_chains", "force_moment", "is_rattler",
    "open_run", "pressure", "principal_stresses", "profile", "read_grid", "read_parameters", "read_summary", "read_table",
    "read_vtu", "sampled_solid_fraction", "solid_fraction", "solid_fraction_in", "stress", "stress_in_box",
    "stress_profile", "unit_of",
]
