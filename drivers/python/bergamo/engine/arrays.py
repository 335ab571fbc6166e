"""The arrays of a simulation's grains, in place."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .grains import rows_of
from .views import View

WRITABLE = ("velocity", "angular_momentum", "external_force", "external_torque")


class Arrays:
    """n grains, a row each, in the engine's order, which changes now and then: go by id. Each array is a view of what the
    engine has, see View; those that other state follows from are read-only.
    """

    _model: Any

    def _view(self, name: str) -> View:
        return View.of(self._model.lend(name), name in WRITABLE)

    def __len__(self) -> int:
        """Grains."""
        return self._model.n_grains

    @property
    def id(self) -> View:
        """Who is who, (n,); read-only."""
        return self._view("id")

    @property
    def position(self) -> View:
        """Centres of mass, (n, 3) [m]; read-only."""
        return self._view("position")

    @property
    def orientation(self) -> View:
        """Quaternions (x, y, z, w), body to global, (n, 4); read-only."""
        return self._view("orientation")

    @property
    def velocity(self) -> View:
        """Of the half step before, (n, 3) [m/s]; may be written between steps."""
        return self._view("velocity")

    @velocity.setter
    def velocity(self, values: ArrayLike) -> None:
        self._view("velocity")[...] = rows_of("velocity", values, len(self), 3)

    @property
    def angular_momentum(self) -> View:
        """About the centres, global frame, of the half step before, (n, 3) [kg m^2/s]; may be written between steps."""
        return self._view("angular_momentum")

    @angular_momentum.setter
    def angular_momentum(self, values: ArrayLike) -> None:
        self._view("angular_momentum")[...] = rows_of("angular_momentum", values, len(self), 3)

    @property
    def angular_velocity(self) -> View:
        """Mean over the step before, global frame, (n, 3) [1/s]; read-only."""
        return self._view("angular_velocity")

    @property
    def force(self) -> View:
        """Resultants of the contacts at the present step, (n, 3) [N]; read-only."""
        self._model.compute_forces()
        return self._view("force")

    @property
    def torque(self) -> View:
        """About the centres at the present step, (n, 3) [N m]; read-only."""
        self._model.compute_forces()
        return self._view("torque")

    @property
    def mass(self) -> View:
        """(n,) [kg], infinite for those that are fixed; read-only."""
        return self._view("mass")

    @property
    def volume(self) -> View:
        """Of the solid, (n,) [m^3]; read-only."""
        return self._view("volume")

    @property
    def inertia(self) -> View:
        """Principal moments in the body frame, (n, 3) [kg m^2]; read-only."""
        return self._view("inertia")

    @property
    def bounding_radius(self) -> View:
        """About the centres, (n,) [m]; read-only."""
        return self._view("bounding_radius")

    @property
    def external_force(self) -> View | None:
        """Added to the contacts' at every step until it is changed, (n, 3) [N]; none where there is none. Set it to (3,),
        (n, 3) or none; then it may be written.
        """
        return self._external("external_force")

    @external_force.setter
    def external_force(self, values: ArrayLike | None) -> None:
        self._set_external("external_force", values)

    @property
    def external_torque(self) -> View | None:
        """About the centres, (n, 3) [N m]; likewise."""
        return self._external("external_torque")

    @external_torque.setter
    def external_torque(self, values: ArrayLike | None) -> None:
        self._set_external("external_torque", values)

    def _external(self, name: str) -> View | None:
        view = self._view(name)
        return view if len(view) else None

    def _set_external(self, name: str, values: ArrayLike | None) -> None:
        rows = np.zeros((0, 3)) if values is None else rows_of(name, values, len(self), 3)
        self._model.set_external(name, rows)
