"""Snapshots: the state of a run to the last bit, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from . import rotation
from .archive import Archive
from .contacts import NO_GRAIN, Contacts
from .errors import MissingData
from .grains import Grains
from .parameters import Section, parse_parameters
from .periodic import cell_of_edges
from .shapes import Parts
from .surfaces import Surfaces

# What a touching contact remembers (dem/force/contact_state.h): names and lengths, in the order of the file.
STATE = (("normal", 3), ("axis", 3), ("point", 3), ("tangential", 2), ("normal_force", 1), ("overlap", 1),
         ("stiffness", 3), ("reduced_mass", 1), ("weight", 1), ("radii", 6), ("wear", 5), ("budget", 1))
SURFACE_STATE = (*STATE, ("friction_work", 1))
SPHERE_STATE = (("tangential_force", 3), ("normal_force", 1), ("root_overlap", 1), ("stiffness", 2), ("reduced_mass", 1),
                ("weight", 1), ("radius_sum", 1), ("radius_difference", 1))
# Arrays of the particles that are empty where a simulation has no use for them.
UNUSED = ("external_force", "external_torque", "transfer_force", "transfer_torque")
KINDS = {"grain_grain": STATE, "sphere_sphere": SPHERE_STATE, "grain_plane": STATE, "grain_surface": SURFACE_STATE}


@dataclass(frozen=True)
class Wall:
    """A plane wall; grains are on the side that the normal points to."""

    point: np.ndarray  # (3,) [m]
    normal: np.ndarray  # (3,) unit
    velocity: np.ndarray  # (3,) [m/s]
    force: np.ndarray  # (3,) of the grains on it [N]


class Snapshot(Archive):
    """The state of a run between two steps, from snapshot.h5. All that a restart needs is there; `names` lists it, and
    `snapshot["loop/step"]` reads what has no array of its own here.
    """

    @cached_property
    def parameters(self) -> Section:
        """Of the run that wrote it."""
        return parse_parameters(str(self["parameters"]), self.path)

    @property
    def time(self) -> float:
        """Of the grains [s]."""
        return float(self._of_grains("time"))

    @property
    def cell(self) -> np.ndarray | None:
        """Edges of the periodic cell now, (3,) [m], from the origin, infinite along axes where nothing repeats itself; none
        where nothing does. That of the contacts is one step back as they are.
        """
        return cell_of_edges(self._of_grains("particles/cell/edges"))

    @cached_property
    def grains(self) -> Grains:
        """The grains, in the engine's order; MissingData where the run has none, or none yet."""
        self._of_grains("time")
        data = {name: rows_of(name, values) for name, values in self.arrays("dem/particles").items()
                if name not in UNUSED or values.size}
        data.pop("first_part")
        part = self.arrays("dem/particles/parts")
        carrier, shape = part["particle"], part["shape"].reshape(-1, 5)
        of_carrier = rotation.matrices(data["orientation"])[carrier]
        centre = data["position"][carrier] + np.einsum("kij,kj->ki", of_carrier, part["place"].reshape(-1, 3))
        turn = rotation.products(data["orientation"][carrier], part["turn"].reshape(-1, 4))
        parts = Parts(carrier, centre, turn, shape[:, :3], shape[:, 3:], part["material"].astype(np.int64))
        number, position, velocity, volume = (data.pop(name) for name in ("id", "position", "velocity", "volume"))
        return Grains(self.time, number, position, velocity, volume, data, parts, self.path)

    @property
    def walls(self) -> list[Wall]:
        """Plane walls, as the contacts' field wall numbers them."""
        numbers = range(int(self._of_grains("walls/size")))
        of_walls = (self.arrays(f"dem/walls/{k}") for k in numbers)
        return [Wall(wall["point"], wall["normal"], wall["velocity"], wall["force"]) for wall in of_walls]

    @property
    def surfaces(self) -> Surfaces:
        """All surfaces, their nodes and triangles one after the other."""
        each = [self.arrays(f"dem/surfaces/{k}") for k in range(int(self._of_grains("surfaces/size")))]
        node = [one["node"].reshape(-1, 3) for one in each]
        first = np.cumsum([0, *map(len, node)])
        triangle = [one["triangles"].reshape(-1, 3) + begin for one, begin in zip(each, first)]
        number = [np.full(len(rows), k) for k, rows in enumerate(triangle)]

        def of_nodes(name: str) -> np.ndarray:  # zero where the surface rests
            rows = (one[name].reshape(-1, 3) for one in each)
            return joined([values if len(values) else np.zeros_like(there) for values, there in zip(rows, node)], 3)

        return Surfaces(self.time, joined(node, 3), joined(triangle, 3).astype(int), joined(number).astype(int),
                        of_nodes("drift_velocity"), {"force": of_nodes("force")}, self.path)

    @cached_property
    def contacts(self) -> Contacts:
        """All touching contacts, kind by kind. A snapshot lies between the motion of a step and the forces of the next:
        contacts are those of the last forces, and their places are where the grains were then, one step back.
        """
        grains = self.grains
        back = 0. if self._of_grains("forces_are_known") else float(self._of_grains("last_step"))
        place = grains.position - back * grains["drift_velocity"]
        edges = self._of_grains("particles/cell/edges") - back * self._of_grains("particles/cell/drift_rate")
        found = [self._contacts_of(kind, law, place, np.where(np.isfinite(edges), edges, 0.))
                 for kind in KINDS for law in self._of_grains(f"contacts/{kind}_laws")]
        rows = {name: joined([kind[name] for kind in found], *shape) for name, shape in
                (("first", ()), ("second", ()), ("start", (3,)), ("branch", (3,)), ("normal_force", ()),
                 ("tangential_force", (3,)), ("overlap", ()), ("direction", (3,)), ("place", (3,)))}
        fields = {name: joined([kind[name] for kind in found]) for name in ("weight", "wall", "feature", "law", "kind")}
        for name in ("first", "second"):
            row = rows[name].astype(np.int64)
            rows[name] = np.where(row == NO_GRAIN, NO_GRAIN, grains.id[row])
        return Contacts(self.time - back, **rows, cell=cell_of_edges(edges), fields=fields, source=self.path)

    @property
    def continuum(self) -> dict[str, np.ndarray]:
        """What changes of the continuum's nodes, in the mesh's order, nn nodes: displacement (nn, 3) [m], velocity
        (nn, 3) [m/s], internal_force, external_force, reaction_force (nn, 3) [N]. Where the nodes are and stresses stand
        in the pictures. MissingData where there is no continuum.
        """
        arrays = self.arrays("continuum")
        if not arrays:
            raise MissingData(f"{self.path} holds no continuum")
        wanted = ("displacement", "velocity", "internal_force", "external_force", "reaction_force")
        return {name: arrays[name].reshape(-1, 3) for name in wanted if name in arrays}

    def _of_grains(self, name: str) -> Any:
        if "dem/time" not in self:
            raise MissingData(f"{self.path} holds no grains: it is the state of a run ({self.kind}) before there are any")
        return self[f"dem/{name}"]

    def _contacts_of(self, kind: str, law: int, position: np.ndarray, edges: np.ndarray) -> dict[str, np.ndarray]:
        """Contacts of one kind and pair of materials, in rows of grains. @param position (n, 3), edges (3,) [m]"""
        group = self.arrays(f"dem/contacts/{kind}_{law}/touching")
        used = group["pair"] >= 0  # other slots are free
        length = sum(size for _, size in KINDS[kind])
        state = named(KINDS[kind], group["state"].reshape(len(used), length)[used])
        first, second, image = (group[name][used] for name in ("first", "second", "image"))
        weight, start = state["weight"], position[first]
        is_pair = kind in ("grain_grain", "sphere_sphere")
        if is_pair:
            shift = np.stack([image % 3 - 1, image // 3 % 3 - 1, image // 9 - 1], axis=1)
            branch = position[second] + shift * edges - start
        if kind == "sphere_sphere":
            normal = branch / np.linalg.norm(branch, axis=1, keepdims=True).clip(min=np.finfo(float).tiny)
            arm = 0.5 * branch + 0.5 * state["radius_difference"][:, None] * normal
            tangential, overlap = state["tangential_force"], state["root_overlap"] ** 2
        else:
            normal, overlap = state["normal"], state["overlap"]
            frame = np.stack([state["axis"], np.cross(normal, state["axis"])], axis=1)
            tangential = np.einsum("ki,kij->kj", state["tangential"], frame)
            arm = 0.5 * branch + state["point"] if is_pair else state["point"]
        none = np.full(len(first), NO_GRAIN)
        return {"first": first, "second": second if is_pair else none, "start": start,
                "branch": branch if is_pair else arm, "normal_force": weight * state["normal_force"],
                "tangential_force": weight[:, None] * tangential, "overlap": overlap, "direction": normal,
                "place": start + arm, "weight": weight, "wall": second if kind == "grain_plane" else none,
                "feature": second if kind == "grain_surface" else none, "law": np.full(len(first), law),
                "kind": np.full(len(first), kind)}


def named(layout: tuple[tuple[str, int], ...], rows: np.ndarray) -> dict[str, np.ndarray]:
    """Columns of a block of numbers by name. @param rows (k, sum of the lengths)"""
    ends = np.cumsum([length for _, length in layout])
    return {name: rows[:, end - length:end] if length > 1 else rows[:, end - 1]
            for (name, length), end in zip(layout, ends)}


def rows_of(name: str, values: np.ndarray) -> np.ndarray:
    """An array of the particles in rows: three numbers a vector, four a quaternion."""
    scalars = ("id", "mass", "volume", "bounding_radius", "turned", "weight", "first_part")
    return values if name in scalars else values.reshape(-1, 4 if name == "orientation" else 3)


def joined(blocks: list[np.ndarray], *shape: int) -> np.ndarray:
    return np.concatenate(blocks) if blocks else np.zeros((0, *shape))
