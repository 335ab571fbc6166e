"""Pictures as arrays, beside what their runs have written as numbers: single precision, so to some 1e-6."""

import unittest

import numpy as np
from small_runs import FolderCase, run_of

import bergamo
from bergamo import rotation, shapes

PENETRATION = ("penetration", "Sand/Settling/time=0.02", "Penetration/depth=1e-3", "Penetration/start time=2e-3",
               "Output/samples=20")
INTRUDER = 0  # the only surface


class Penetration(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = bergamo.open(run_of(*PENETRATION))
        cls.last = cls.run_.history.row(-1)
        cls.grains, cls.contacts, cls.surfaces = (cls.run_.pictures[name][-1] for name in ("grains", "contacts", "surfaces"))

    def test_series(self):
        series = self.run_.pictures["grains"]
        self.assertEqual(set(self.run_.pictures), {"grains", "contacts", "surfaces"})
        self.assertEqual(series.times[-1], self.last["time_s"])
        self.assertEqual(len(series), self.run_.parameters["Output/pictures"])
        self.assertEqual(series.at(1e9).time, self.grains.time)
        self.assertEqual(series.at(-1).time, series.times[0])
        self.assertEqual(len(series[1:]), len(series) - 1)
        self.assertEqual([path.name for path in series.paths], [f"grains_{k:04d}.vtu" for k in range(len(series))])

    def test_shapes_of_grains(self):
        """Half-axes, exponents and turns make the surface that they were taken from, and the volume of the sand."""
        grains, mesh = self.grains, self.run_.pictures["grains"].mesh(-1)
        self.assertEqual(len(grains), self.run_.summary["particles"])
        points = mesh.points.astype(float).reshape(len(grains), -1, 3)
        turns = rotation.matrices(grains.quaternion)
        np.testing.assert_allclose(np.linalg.det(turns), 1, atol=1e-5)
        for k in range(0, len(grains), 10):
            body = (points[k] - grains.position[k]) @ turns[k]
            value = shapes.inside_outside(body, grains.half_axes[k], grains.exponents[k])
            np.testing.assert_allclose(value, 1, atol=2e-3)  # F is steep for small exponents: 2/e times the place's error
        parameters, summary = self.run_.parameters, self.run_.summary
        density = parameters["Sand/Grains/density"] if "Sand/Grains/density" in parameters else parameters["Grains/density"]
        gravity = next(value.value for name, value in parameters.flat().items() if name.endswith("gravity"))
        self.assertAlmostEqual(grains.volume.sum() * density * gravity / summary["sand_weight_N"], 1, delta=1e-5)

    def test_coordination(self):
        numbers = bergamo.coordination_numbers(self.grains, self.contacts)
        for value, name in ((numbers.mean, "coordination_number"), (numbers.deviation, "coordination_number_deviation"),
                            (numbers.mechanical, "mechanical_coordination_number"),
                            (numbers.without_rattlers, "coordination_number_without_rattlers"),
                            (numbers.n_rattlers / len(self.grains), "rattler_fraction")):
            self.assertAlmostEqual(value, self.last[name], delta=1e-12, msg=name)

    def test_forces_on_walls_and_intruder(self):
        """The contacts with second bodies that are no grains bear what intruder, floor and sides do."""
        walls = self.contacts.where(self.contacts.is_with_wall)
        on_them = -walls.force.sum(axis=0)
        size = np.abs(walls.normal_force).sum()
        wanted = self.last["resistance_N"] + self.last["floor_force_N"] + self.last["sides_force_N"]
        self.assertAlmostEqual(on_them[2], wanted, delta=1e-6 * size)
        self.assertGreater(self.last["resistance_N"], 1e-3 * size)
        on_intruder = self.surfaces.force_on(INTRUDER)
        for axis, name in ((0, "lateral_force_x_N"), (1, "lateral_force_y_N"), (2, "resistance_N")):
            self.assertAlmostEqual(on_intruder[axis], self.last[name], delta=1e-6 * size, msg=name)

    def test_pressures_in_grains(self):
        """- sum of arm . force / 3 V of each grain, as the program has drawn it: places, forces and volumes at once."""
        contacts, grains = self.contacts, self.grains
        first, second = grains.rows_of(contacts.first), grains.rows_of(contacts.second)
        arm, force, other = contacts.point - contacts.start, contacts.force, second >= 0
        virial = np.bincount(first, (arm * force).sum(axis=1), len(grains))
        far_arm = (arm - contacts.branch)[other]
        virial -= np.bincount(second[other], (far_arm * force[other]).sum(axis=1), len(grains))
        pressure = -virial / (3 * grains.volume)
        np.testing.assert_allclose(pressure, grains["pressure"], atol=2e-5 * np.abs(pressure).max())

    def test_solid_fraction_below_the_tip(self):
        lowest = self.surfaces.node[:, 2].min()
        width = self.run_.parameters["Intruder/width"]
        found = bergamo.sampled_solid_fraction(self.grains, np.array([[0, 0, lowest - width / 2]]), width / 2)
        self.assertAlmostEqual(found[0], self.last["solid_fraction_below_tip"], delta=1e-5)

    def test_what_is_not_there(self):
        with self.assertRaisesRegex(bergamo.UnknownName, "no field 'presure'; did you mean 'pressure'"):
            self.grains["presure"]
        with self.assertRaisesRegex(bergamo.UnknownName, "no pictures of 'grain'; did you mean 'grains'"):
            self.run_.pictures["grain"]
        with self.assertRaisesRegex(bergamo.BadArgument, "not among"):
            self.grains.rows_of(np.array([10 ** 9]))


class Silo(unittest.TestCase):
    """Points for grains, a field on a grid, surfaces."""

    @classmethod
    def setUpClass(cls):
        cls.run_ = bergamo.open(run_of("silo_discharge"))

    def test_points(self):
        first = self.run_.pictures["grains"][0]
        self.assertEqual(len(first), self.run_.summary["grains"])
        density = self.run_.parameters["Grains/density"]
        self.assertAlmostEqual(first.volume.sum() * density / self.run_.summary["filled_mass_kg"], 1, delta=1e-5)
        with self.assertRaisesRegex(bergamo.MissingData, "points"):
            first.half_axes

    def test_field_on_a_grid(self):
        field = self.run_.pictures["velocity"][-1]
        cells = np.array(self.run_.parameters["Velocity field/cells"])
        self.assertEqual(field.cells.shape, (cells.prod(), 8))
        self.assertEqual(field["velocity"].shape, ((cells + 1).prod(), 3))
        self.assertEqual(field["solid_fraction"].shape, ((cells + 1).prod(),))

    def test_forces_on_the_walls(self):
        """Tractions times areas are the forces of the history, by surface."""
        surfaces, last = self.run_.pictures["surfaces"][-1], self.run_.history.row(-1)
        names = [name[:-len("_force_x_N")] for name in last if name.endswith("_force_x_N")]
        size = max(abs(last[f"{name}_force_{axis}_N"]) for name in names for axis in "xyz")
        for number, name in enumerate(names):
            for axis, value in zip("xyz", surfaces.force_on(number)):
                self.assertAlmostEqual(value, last[f"{name}_force_{axis}_N"], delta=1e-5 * size, msg=name)


class Continuum(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = bergamo.open(run_of("strip_footing", "Footing/settlement=0.003", "Footing/loading time=0.15"))
        cls.ground = cls.run_.pictures["continuum"][-1]

    def test_nodes_and_elements(self):
        """A structured mesh of bricks: nodes are the corners, once each, and elements fill the box."""
        ground = self.ground
        reference = ground.reference
        sides = [len(np.unique(column.round(9))) for column in reference.T]
        self.assertEqual(len(reference), np.prod(sides))
        self.assertEqual(len(ground.element), np.prod(np.array(sides) - 1))
        corners = reference[ground.element]
        volumes = np.prod(np.ptp(corners, axis=1), axis=1)
        self.assertAlmostEqual(volumes.sum() / np.prod(np.ptp(reference, axis=0)), 1, delta=1e-6)
        np.testing.assert_array_equal(ground.node, reference + ground.displacement)
        self.assertGreater(np.abs(ground.displacement).max(), 0)

    def test_stress(self):
        ground = self.ground
        stress = ground.stress
        size = np.abs(stress).max()
        np.testing.assert_array_equal(stress, stress.transpose(0, 2, 1))
        principal = np.stack([ground[f"principal_stress_{k}"] for k in (1, 2, 3)], axis=1)
        np.testing.assert_allclose(np.linalg.eigvalsh(stress)[:, ::-1], principal, atol=1e-6 * size)
        np.testing.assert_allclose([bergamo.pressure(one) for one in stress], ground["pressure"], atol=1e-6 * size)
        np.testing.assert_allclose([bergamo.deviatoric_stress(one) for one in stress], ground["deviatoric_stress"],
                                   atol=1e-6 * size)

    def test_fields_at_nodes_and_elements(self):
        ground = self.ground
        np.testing.assert_allclose(ground.at_elements(ground.node), ground.centre)
        np.testing.assert_allclose(ground.at_nodes(np.full(len(ground.element), 7.)), 7)
        centres = ground.centre
        of_nodes = ground.at_nodes(centres)
        for node in range(0, len(of_nodes), 7):
            around = [centres[k] for k, element in enumerate(ground.element) if node in element]
            np.testing.assert_allclose(of_nodes[node], np.mean(around, axis=0))
        with self.assertRaisesRegex(bergamo.UnknownName, "no field 'presure'; did you mean 'pressure'"):
            ground["presure"]


class Clumps(unittest.TestCase):
    """Grains of two parts, drawn part by part."""

    HALF_AXES, EXPONENTS = [[0.7, 0.5, 0.5], [0.4, 0.4, 0.6]], [[0.8, 0.8], [1, 1.2]]

    def test_parts_of_a_picture_are_those_of_its_grains(self):
        folder = run_of("rve_triaxial", "Grains/shape=clumps", "Grains/sizes=uniform", "Ensemble/confining pressures=50e3",
                        "Grains/Clumps/parts=0 0 0 0.7 0.5 0.5 0.8 0.8 ; 0.8 0 0.5 0.4 0.4 0.6 1 1.2",
                        "Grains/Uniform/smallest diameter=1e-3", "Grains/Uniform/largest diameter=1.1e-3",
                        "Packing/solid fraction=0.2", "Stage 2/axial strain=-0.002", "Output/pictures=true",
                        "Ensemble/edges=0.0058", "Output/rows=2")
        grains = bergamo.open(folder).runs["samples/0001"].pictures["grains"][-1]
        self.assertEqual(len(grains), bergamo.open(folder).summary["particles"])
        parts = grains.parts
        self.assertEqual(parts.grain.tolist(), np.repeat(np.arange(len(grains)), 2).tolist())
        scale = parts.half_axes[:, 0].reshape(-1, 2) / [0.7, 0.4]  # one size a grain
        np.testing.assert_allclose(scale[:, 0], scale[:, 1], rtol=1e-4)
        np.testing.assert_allclose(parts.half_axes.reshape(-1, 2, 3), scale[:, :1, None] * self.HALF_AXES, rtol=1e-4)
        np.testing.assert_allclose(parts.exponents.reshape(-1, 2, 2), np.broadcast_to(self.EXPONENTS, (len(grains), 2, 2)),
                                   atol=1e-4)
        line = np.diff(parts.centre.reshape(-1, 2, 3), axis=1)[:, 0]
        np.testing.assert_allclose(np.linalg.norm(line, axis=1), scale[:, 0] * np.hypot(0.8, 0.5), rtol=1e-4)
        with self.assertRaisesRegex(bergamo.MissingData, "parts"):
            grains.half_axes


class Damaged(FolderCase):
    def test_truncated_and_foreign_files(self):
        path = run_of(*PENETRATION) / "grains_0000.vtu"
        content = path.read_bytes()
        at = content.index(b'Name="connectivity"')
        other = content[:at] + content[at:].replace(b'Name="connectivity"', b'Name="disconnected"', 1)
        for name, data, word in (("short", content[:-100], "does not end"), ("empty", b"", "does not begin"),
                                 ("foreign", b"solid </VTKFile>", "does not begin"), ("other", other, "VTK cannot read it")):
            damaged = self.tmp / f"{name}_0000.vtu"
            damaged.write_bytes(data)
            with self.assertRaisesRegex(bergamo.DamagedFile, word):
                bergamo.read_vtu(damaged)
        (self.tmp / "grains_0000.vtu").write_bytes((run_of(*PENETRATION) / "contacts_0000.vtu").read_bytes())
        with self.assertRaisesRegex(bergamo.DamagedFile, "no surfaces of grains"):
            bergamo.Pictures(self.tmp)["grains"][0]


if __name__ == "__main__":
    unittest.main()
