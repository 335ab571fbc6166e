"""Grains and contacts as tables with commas; a line of names with units above."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..contacts import Contacts
from ..grains import Grains
from .files import write_rows

GRAINS = "id,x_m,y_m,z_m,qx,qy,qz,qw,a_m,b_m,c_m,exponent_1,exponent_2"
CONTACTS = ("first,second,x_m,y_m,z_m,nx,ny,nz,bx_m,by_m,bz_m,normal_force_N,fx_N,fy_N,fz_N,tx_N,ty_N,tz_N,overlap_m")


def write_grains(grains: Grains, path: Path) -> Path:
    """A row a part: plain grains have one, a clump one for each part, under its id. Drivers read the table again
    (Sand/grains file): of a snapshot, the very same grains. The material is left out where the source does not tell it.
    """
    parts = grains.parts
    columns = [grains.id[parts.grain], parts.centre, parts.quaternion, parts.half_axes, parts.exponents]
    head = GRAINS
    if parts.material is not None:
        head += ",material"
        columns.append(parts.material)
    return write_rows(path, head + "\n", columns, ",")


def write_contacts(contacts: Contacts, path: Path) -> Path:
    """A row a contact: ids of the grains (-1: a wall or a surface), place, unit normal from the first body to the second,
    branch, normal force, force and its tangential part on the first grain, overlap; of snapshots also the numbers of wall
    and feature (-1: none) and of the pair of materials.
    """
    head = CONTACTS
    columns = [contacts.first.astype(np.int64), contacts.second.astype(np.int64), contacts.point, contacts.normal,
               contacts.branch, contacts.normal_force, contacts.force, contacts.tangential_force, contacts.overlap]
    for name in ("wall", "feature", "law"):
        if name in contacts.fields:
            head += f",{name}"
            columns.append(contacts[name].astype(np.int64))
    return write_rows(path, head + "\n", columns, ",")
