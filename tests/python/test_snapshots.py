"""Snapshots as arrays, beside what their runs have written at the same step: to rounding."""

import unittest

import numpy as np
from small_runs import FolderCase, run_of, stopped_run_of

import bergamo

ROUNDING = 1e-12  # of sums of some thousand numbers, over the largest of them


def loads_of(grains, contacts):
    """Resultants and torques of the contacts by grain, (n, 3) each."""
    force, torque = np.zeros((2, len(grains), 3))
    first, second = grains.rows_of(contacts.first), grains.rows_of(contacts.second)
    arm, on_first, pair = contacts.point - contacts.start, contacts.force, second >= 0
    np.add.at(force, first, on_first)
    np.add.at(force, second[pair], -on_first[pair])
    np.add.at(torque, first, np.cross(arm, on_first))
    np.add.at(torque, second[pair], -np.cross((arm - contacts.branch)[pair], on_first[pair]))
    return force, torque


class Case(unittest.TestCase):
    def assert_near(self, found, wanted, tolerance=ROUNDING):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=tolerance * np.abs(wanted).max())


class PeriodicCell(Case):
    """A sample that was stopped while it is compressed; every step has a row of its history."""

    @classmethod
    def setUpClass(cls):
        folder = stopped_run_of("rve_triaxial", "samples/0001/history.csv", 2500, "Output/row interval=1",
                                "Ensemble/confining pressures=25e3")
        cls.whole = bergamo.open(folder)
        cls.sample = cls.whole.runs["samples/0001"]
        cls.snapshot = cls.sample.snapshot()
        cls.grains, cls.contacts = cls.snapshot.grains, cls.snapshot.contacts
        history = cls.sample.history
        cls.row = history.row(int(np.abs(history["time_s"] - cls.contacts.time).argmin()))

    def test_state(self):
        self.assertEqual((self.whole.state, self.sample.state), ("interrupted", "interrupted"))
        self.assertEqual(self.row["time_s"], self.contacts.time)
        self.assertGreater(self.snapshot.time, self.contacts.time)  # places are a step ahead
        self.assertEqual(self.snapshot.kind, "sample of a triaxial ensemble")
        self.assertEqual(self.snapshot.parameters["Output/rows"], self.sample.parameters["Output/rows"])
        self.assertTrue((self.snapshot.cell != self.contacts.cell).all())  # and so is the cell

    def test_stress_of_the_cell(self):
        stress = bergamo.stress(self.contacts)
        wanted = np.array([[self.row[f"stress_{''.join(sorted(i + j))}_Pa"] for j in "xyz"] for i in "xyz"])
        self.assert_near(0.5 * (stress + stress.T), wanted)
        self.assertGreater(bergamo.pressure(stress), 100)

    def test_stresses_of_boxes_add_up_to_that_of_the_cell(self):
        cell = self.contacts.cell
        for share in ("branch", "point"):
            corners = np.stack(np.meshgrid(range(3), range(2), range(4)), axis=-1).reshape(-1, 3)
            boxes = [bergamo.stress_in_box(self.contacts, cell * corner / [3, 2, 4], cell * (corner + 1) / [3, 2, 4], share)
                     for corner in corners]
            self.assert_near(np.mean(boxes, axis=0), bergamo.stress(self.contacts))
        slices = bergamo.stress_profile(self.contacts, np.zeros(3), cell, "y", 7)
        self.assert_near(slices.mean(axis=0), bergamo.stress(self.contacts))
        moved = bergamo.stress_in_box(self.contacts, 0.3 * cell, 1.3 * cell - 1e-9 * cell)  # beyond the faces: images
        self.assert_near(moved, bergamo.stress(self.contacts), 1e-6)

    def test_coordination(self):
        numbers = bergamo.coordination_numbers(self.grains, self.contacts)
        self.assertEqual(len(self.contacts), self.row["n_contacts"])
        for value, name in ((numbers.mean, "coordination_number"), (numbers.mechanical, "mechanical_coordination_number"),
                            (numbers.without_rattlers, "coordination_number_without_rattlers"),
                            (numbers.n_rattlers / len(self.grains), "rattler_fraction")):
            self.assertAlmostEqual(value, self.row[name], delta=1e-12, msg=name)
        self.assertGreater(numbers.n_rattlers, 0)
        self.assertEqual(numbers.of_grains.sum(), 2 * len(self.contacts))

    def test_fabric_and_forces(self):
        fabric = bergamo.fabric_tensor(self.contacts)
        for k, axis in enumerate("xyz"):
            self.assertAlmostEqual(fabric[k, k], self.row[f"fabric_{axis}{axis}"], delta=1e-14)
        self.assertAlmostEqual(bergamo.anisotropy(fabric), self.row["fabric_anisotropy"], delta=1e-13)
        self.assertAlmostEqual(self.contacts.normal_force.mean() / self.row["mean_normal_force_N"], 1, delta=1e-13)
        radius = self.grains["bounding_radius"]
        smaller = np.minimum(*(radius[self.grains.rows_of(ids)] for ids in (self.contacts.first, self.contacts.second)))
        self.assertAlmostEqual((self.contacts.overlap / smaller).max(), self.row["max_overlap_over_radius"], delta=1e-14)

    def test_solid_fraction(self):
        volume = self.contacts.cell.prod()
        fraction = bergamo.solid_fraction(self.grains, volume)
        self.assertAlmostEqual(fraction, self.row["solid_fraction"], delta=1e-13)
        cell = self.snapshot.cell  # now
        counted = bergamo.solid_fraction_in(self.grains, bergamo.Box(np.zeros(3), cell), 60, cell)
        self.assertAlmostEqual(counted, self.grains.volume.sum() / cell.prod(), delta=2e-3)  # points, and overlaps count once

    def test_loads_of_grains(self):
        force, torque = loads_of(self.grains, self.contacts)
        self.assert_near(force, self.grains["force"])
        self.assert_near(torque, self.grains["torque"])

    def test_shapes(self):
        self.assert_near(self.grains.parts.volume, self.grains.volume)
        self.assert_near(np.linalg.norm(self.grains.quaternion, axis=1), np.ones(len(self.grains)))
        self.assertTrue((self.grains["bounding_radius"] >= self.grains.half_axes.max(axis=1)).all())
        for k in range(0, len(self.grains), 20):
            self.assertTrue(self.grains.parts.is_inside(k, self.grains.position[k:k + 1])[0])


class BeadsInASilo(Case):
    """Spheres and surfaces, at rest under their weight."""

    @classmethod
    def setUpClass(cls):
        cls.run_ = bergamo.open(run_of("silo_discharge"))
        cls.snapshot = cls.run_.snapshot("filled.h5")

    def test_loads_of_grains(self):
        grains, contacts = self.snapshot.grains, self.snapshot.contacts
        self.assertEqual(set(contacts["kind"]), {"sphere_sphere", "grain_surface"})
        force, torque = loads_of(grains, contacts)
        self.assert_near(force, grains["force"])  # without the weight
        self.assert_near(torque, grains["torque"])

    def test_moment_of_forces(self):
        """Branches times forces are what walls do to the whole, less what accelerates the grains (Weber 1966)."""
        grains, contacts = self.snapshot.grains, self.snapshot.contacts
        place = grains.position - self.snapshot["dem/last_step"] * grains["drift_velocity"]
        force, _ = loads_of(grains, contacts)
        walls = contacts.where(contacts.is_with_wall)
        wanted = np.einsum("ki,kj->ij", walls.point, walls.force) - np.einsum("ni,nj->ij", place, force)
        self.assert_near(bergamo.force_moment(contacts), wanted)

    def test_surfaces(self):
        surfaces, picture = self.snapshot.surfaces, self.run_.pictures["surfaces"][0]
        self.assertEqual(len(np.unique(surfaces.surface)), self.snapshot["dem/surfaces/size"])
        self.assertEqual(surfaces.corners.shape, (len(surfaces), 3, 3))
        common = surfaces.node[np.isin(surfaces.node[:, 2], picture.node[:, 2])]
        self.assertGreater(len(common), 0)
        with self.assertRaisesRegex(bergamo.UnknownName, "pressure"):
            surfaces.pressure

    def test_before_there_are_grains(self):
        with self.assertRaisesRegex(bergamo.MissingData, "before there are any"):
            self.run_.snapshot().grains
        with self.assertRaisesRegex(bergamo.MissingFile, "filled.h5"):
            self.run_.snapshot("full.h5")


class TwoScales(Case):
    """Weighted contacts, plane walls and a continuum."""

    @classmethod
    def setUpClass(cls):
        cls.run_ = bergamo.open(stopped_run_of("two_scale_triaxial", "history.csv", 10, "Packing/pressure=4e3",
                                               "Packing/largest strain rate=400"))
        cls.snapshot = cls.run_.snapshot()

    def test_forces_on_walls(self):
        contacts, walls = self.snapshot.contacts, self.snapshot.walls
        size = max(np.abs(wall.force).max() for wall in walls)
        for number, wall in enumerate(walls):
            of_wall = contacts.where(contacts["wall"] == number)
            np.testing.assert_allclose(-of_wall.force.sum(axis=0), wall.force, rtol=0, atol=ROUNDING * size)
            np.testing.assert_allclose(of_wall.normal, np.broadcast_to(-wall.normal, of_wall.normal.shape), atol=1e-14)
        self.assertLess(contacts["weight"].min(), 0.9)

    def test_continuum(self):
        continuum, picture = self.snapshot.continuum, self.run_.pictures["continuum"][0]
        self.assertEqual(continuum["displacement"].shape, picture.node.shape)
        for name in ("velocity", "internal_force", "external_force"):
            self.assertEqual(continuum[name].shape, picture.node.shape)

    def test_weights_of_grains(self):
        grains = self.snapshot.grains
        self.assertTrue(((grains["weight"] > 0) & (grains["weight"] <= 1)).all())
        with self.assertRaisesRegex(bergamo.UnknownName, "no field 'weigth'; did you mean 'weight'"):
            grains["weigth"]


class Damaged(FolderCase):
    def test_files_that_are_none(self):
        whole = (run_of("silo_discharge") / "filled.h5").read_bytes()
        for content, word in ((whole[:-1], "follow its seal"), (whole + b"x", "follow its seal"),
                              (whole[512:], "is no archive"), (b"", "is no archive"),
                              (whole.replace(b"format 1", b"format 2", 1), "format 2")):
            path = self.tmp / "snapshot.h5"
            path.write_bytes(content)
            with self.assertRaisesRegex(bergamo.DamagedFile, word):
                bergamo.Snapshot(path)

    def test_damaged_arrays(self):
        """HDF5 notices by the sums that it keeps."""
        path = run_of("silo_discharge") / "filled.h5"
        whole, positions = bytearray(path.read_bytes()), bergamo.Snapshot(path).grains.position
        at = whole.find(positions.tobytes())
        self.assertGreater(at, 0)
        whole[at + 8] ^= 1
        damaged = self.tmp / "snapshot.h5"
        damaged.write_bytes(whole)
        with self.assertRaisesRegex(bergamo.DamagedFile, "is damaged"):
            bergamo.Snapshot(damaged).grains

    def test_unknown_names(self):
        snapshot = bergamo.Snapshot(run_of("silo_discharge") / "filled.h5")
        with self.assertRaisesRegex(bergamo.UnknownName, "did you mean 'dem/time'"):
            snapshot["dem/tim"]


if __name__ == "__main__":
    unittest.main()
