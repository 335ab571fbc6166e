"""A simulation of grains, stepped from Python."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..contacts import Contacts
from ..periodic import cell_of_edges
from .arrays import Arrays
from .bodies import Plane, Surface
from .drawing import draw_into, make_folder
from .errors import ConfigError
from .grains import Grains, rows_of
from .library import library
from .loading import Compression, Loading
from .parameters import Parameters, parameters_of, text_of


class Simulation(Arrays):
    """Grains, planes and surfaces, stepped by the engine that the drivers use: the same bits on any number of threads and
    after any restart. Global frame, SI units, tension positive, quaternions (x, y, z, w).

    Between two steps everything may be read and changed. What needs the forces of the present step (contacts, energies,
    loads, pictures, remove()) has them made; that changes nothing of the run, but from there to the next step no grains
    can be added: add first, then read. Errors leave the simulation as it was, but for a RunError out of the middle of a
    step. One thread at a time: while one steps, others get Busy.

    @param grains at least one; they are copied, and sorted by place: ids, which are rows of `grains`, say who is who
    @param planes in a periodic cell along the axes in which it repeats itself alone; surfaces none in one
    """

    def __init__(self, parameters: Parameters, grains: Grains, planes: Iterable[Plane] = (),
                 surfaces: Iterable[Surface] = ()) -> None:
        self._begin(library().Model(parameters, grains._particles, list(planes)))
        for surface in surfaces:
            self.add_surface(surface)

    def _begin(self, model: Any) -> None:
        self._model = model
        self._calls: list[tuple[int, Callable[[], object]]] = []

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Simulation:
        """The simulation that save() wrote; it goes on with the same bits. Callbacks are to be given again. RunError for a
        file that is missing, damaged or of another kind, such as a driver's snapshot.
        """
        simulation = cls.__new__(cls)
        simulation._begin(library().Model.load(fspath(path)))
        return simulation

    def save(self, path: str | PathLike[str]) -> None:
        """Writes all that the simulation needs to go on, whole or not at all; RunError where it cannot be written.
        `bergamo.open(folder).snapshot()` reads a file snapshot.h5. The folder is made.
        """
        make_folder(Path(path).parent)
        self._model.save(fspath(path), text_of(self.parameters))

    # Steps

    def step(self, n_steps: int = 1) -> int:
        """Makes steps, without Python's lock. Ctrl-C ends them after one of them, as do exceptions out of a callback, and
        stop(). @return how many were made
        """
        return self._model.step(n_steps, self._calls)

    def run_until(self, time: float) -> int:
        """Steps until the time is as near to the one given [s] as steps allow; as step()."""
        return self._model.run_until(time, self._calls)

    def every(self, n_steps: int, call: Callable[[], object]) -> Callable[[], None]:
        """Has a function called between two steps whenever the number of all steps is a multiple of n_steps. It may read
        and change the simulation, and stop() it, but not step it. @return what ends the calls
        """
        if n_steps < 1:
            raise ConfigError(f"number of steps between two calls is {n_steps}: it must be at least 1")
        entry = (n_steps, call)
        self._calls.append(entry)

        def end() -> None:
            self._calls = [other for other in self._calls if other is not entry]

        return end

    def stop(self) -> None:
        """Ends the block of steps under way after the present step, from a callback or another thread."""
        self._model.stop()

    def load_cell(self, loading: Loading, density: float = 2650.) -> int:
        """Steps a periodic cell through one stage, to its end; as step(). Afterwards the cell goes on at the rate that it
        has then: set cell_rate. RunError where the stage has not ended after its longest time; the simulation may go on.
        @param density of the grains, for the mass of the cell's walls [kg/m^3]
        """
        return self._model.load_cell(loading, density, self._calls)

    def compress_box(self, compression: Compression) -> int:
        """Moves the first six planes, those of box_planes(), until their pressures hold and the grains rest; as step().
        They keep their last velocity. RunError after the longest time; the simulation may go on.
        """
        return self._model.compress_box(compression, self._calls)

    @property
    def time(self) -> float:
        """[s]"""
        return self._model.time

    @property
    def n_steps(self) -> int:
        """Since the start."""
        return self._model.n_steps

    @property
    def parameters(self) -> Parameters:
        """As they are now. Setting them changes all but the elastic materials, which must stay."""
        return parameters_of(self._model.parameters)

    @parameters.setter
    def parameters(self, parameters: Parameters) -> None:
        self._model.change(parameters)

    @property
    def stable_time_step(self) -> float:
        """Longest time step that the present contacts bear [s]; infinite without any. Leave a margin."""
        return self._model.stable_time_step()

    @property
    def state_hash(self) -> int:
        """Of all bits that a step depends on."""
        return self._model.state_hash

    # Grains that come and go

    def add(self, grains: Grains) -> np.ndarray:
        """Adds grains between steps. @return their new ids, (n,). ConfigError once the forces of the step were asked for."""
        return self._model.add(grains._particles)

    def remove(self, rows: ArrayLike) -> np.ndarray:
        """Removes grains. @param rows numbers, or a mask (n,). @return their ids, by row"""
        chosen = np.asarray(rows)
        if chosen.dtype == bool:
            if chosen.shape != (len(self),):
                raise ConfigError(f"the mask of grains to be removed has the shape {chosen.shape}: it must be ({len(self)},)")
            chosen = np.flatnonzero(chosen)
        elif chosen.size and not np.issubdtype(chosen.dtype, np.integer):
            raise ConfigError("grains to be removed are named by whole numbers or by a mask")
        return self._model.remove(np.atleast_1d(chosen).astype(np.int64))

    def rest(self) -> None:
        """Stops all grains where they are."""
        self._model.rest()

    # Planes and surfaces

    @property
    def planes(self) -> list[Plane]:
        """As they are now."""
        return [Plane(**self._model.plane(k)) for k in range(self._model.n_planes)]

    def add_plane(self, plane: Plane) -> None:
        self._model.add_plane(plane)

    def remove_plane(self, number: int) -> None:
        """Later ones move up by one."""
        self._model.remove_plane(number)

    def set_plane_velocity(self, number: int, velocity: ArrayLike) -> None:
        """From the next step on. @param velocity (3,) [m/s]"""
        self._model.set_plane_velocity(number, velocity)

    def plane_force(self, number: int) -> np.ndarray:
        """Of the grains on a plane at the present step, (3,) [N]."""
        return self._model.load_of_plane(number)[0]

    def plane_work(self, number: int) -> float:
        """Done by a plane on the grains, up to the present step [J]."""
        return self._model.load_of_plane(number)[1]

    @property
    def surfaces(self) -> list[Surface]:
        """As they are now; copies."""
        return [Surface._of(self._model.surface(k)) for k in range(self._model.n_surfaces)]

    def add_surface(self, surface: Surface) -> None:
        """It is copied."""
        self._model.add_surface(surface._surface)

    def remove_surface(self, number: int) -> None:
        """Later ones move up by one."""
        self._model.remove_surface(number)

    def set_surface_velocity(self, number: int, velocity: ArrayLike | None) -> None:
        """From the next step on. @param velocity of its nodes, (3,) or (m, 3) [m/s]; none: it rests"""
        m = len(self._model.surface(number).nodes)
        rows = np.zeros((0, 3)) if velocity is None else rows_of("velocity of a surface", velocity, m, 3)
        self._model.set_surface_velocity(number, rows)

    def node_forces(self, number: int) -> np.ndarray:
        """Of the grains on the nodes of a surface at the present step, (m, 3) [N]."""
        return self._model.node_forces(number)

    @property
    def surface_forces(self) -> np.ndarray:
        """Of the grains on the surfaces at the present step, a row each, (s, 3) [N]."""
        return self._model.surface_loads()[:, :3]

    @property
    def surface_moments(self) -> np.ndarray:
        """About the origin, (s, 3) [N m]."""
        return self._model.surface_loads()[:, 3:]

    # The periodic cell

    @property
    def cell(self) -> np.ndarray | None:
        """Edges of the periodic cell now, (3,) [m], from the origin, infinite along axes where nothing repeats itself; none
        where nothing does.
        """
        edges = self._model.cell_edges
        return cell_of_edges(edges)

    @property
    def cell_rate(self) -> np.ndarray:
        """Rates of the edges, (3,) [m/s]. Where they are set, grains keep their velocities; images follow."""
        return self._model.cell_rate

    @cell_rate.setter
    def cell_rate(self, rate: ArrayLike) -> None:
        self._model.cell_rate = rate

    @property
    def cell_stress(self) -> np.ndarray:
        """Principal mean stresses of the periodic cell at the present step, tension positive, (3,) [Pa]."""
        if self.cell is None:
            raise ConfigError("there is no periodic cell, whose stress could be asked for: see bergamo.stress()")
        return self._model.cell_stress()

    # Measures and files

    def contacts(self) -> Contacts:
        """Touching contacts at the present step, with forces and places: copies. What bergamo measures of contacts (stress,
        fabric_tensor, force_chains, ...) takes them. Fields: weight, wall (number of the plane), feature (of the
        surfaces), law.
        """
        return Contacts(self.time, **self._model.contacts(), cell=self.cell)

    def energy(self) -> dict[str, float]:
        """Energies of the grains at the present step and what flowed in and out since the start [J]. In exact arithmetic
        "balance", kinetic + elastic + losses - works, stays constant.
        """
        return self._model.energy()

    def reset_accounts(self) -> None:
        """Starts losses and works anew from zero."""
        self._model.reset_accounts()

    def draw(self, folder: str | PathLike[str], what: Sequence[str] = ("grains", "contacts", "surfaces")) -> list[Path]:
        """Adds a picture of the present step to the series of a folder, for ParaView and `bergamo.open(folder).pictures`.
        @return its files
        """
        for name in what:
            if name not in ("grains", "contacts", "surfaces"):
                raise ConfigError(f"there are no pictures of '{name}': draw grains, contacts or surfaces")
        names = [name for name in what if name != "surfaces" or self._model.n_surfaces]
        return draw_into(Path(folder), self._model, names, self.time)

    def __repr__(self) -> str:
        return f"<Simulation: {len(self)} grains at {self.time:.6g} s, step {self.n_steps}>"
