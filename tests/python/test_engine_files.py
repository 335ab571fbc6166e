"""What Python's simulations write is read by the package as a driver's run is."""

import unittest

import numpy as np
from engine_scenes import falling
from small_runs import FolderCase

import bergamo
from bergamo import engine


class Files(FolderCase):
    def setUp(self):
        super().setUp()
        self.simulation = falling(4)
        self.simulation.step(2500)

    def test_a_snapshot_is_read_as_a_run(self):
        simulation = self.simulation
        simulation.save(self.tmp / "run" / "snapshot.h5")
        run = bergamo.open(self.tmp / "run")
        state = run.snapshot()
        self.assertEqual((state.time, state.kind), (simulation.time, "simulation in Python"))
        np.testing.assert_array_equal(state.grains.id, simulation.id)
        np.testing.assert_array_equal(state.grains.position, simulation.position)
        np.testing.assert_array_equal(state.grains.quaternion, simulation.orientation)
        self.assertEqual(state.parameters["Material 0/Young's modulus"], 5e6)
        self.assertEqual(state.parameters["Law 0 1/friction"], 0.4)
        self.assertEqual(len(state.walls), 4)

    def test_contacts_are_those_of_the_snapshot(self):
        """Which was made by the other reader, from what a contact remembers."""
        contacts = self.simulation.contacts()
        self.assertGreater(len(contacts), 40)
        self.assertTrue((contacts["wall"] >= 0).any() and (contacts["feature"] >= 0).any() and (contacts.second >= 0).any())
        self.simulation.save(self.tmp / "snapshot.h5")
        others = bergamo.Snapshot(self.tmp / "snapshot.h5").contacts
        self.assertEqual(len(contacts), len(others))

        def sorted_rows(some):
            rows = np.column_stack([some.first, some.second, some["wall"], some["feature"], some.point, some.force, some.normal,
                                    some.overlap, some.branch])
            return rows[np.lexsort(rows[:, :4].T)]

        np.testing.assert_allclose(sorted_rows(contacts), sorted_rows(others), rtol=1e-9, atol=1e-12)

    def test_forces_of_contacts_add_up(self):
        simulation = self.simulation
        contacts = simulation.contacts()
        row = {number: k for k, number in enumerate(simulation.id)}
        force = np.zeros((len(simulation), 3))
        np.add.at(force, [row[k] for k in contacts.first], contacts.force)
        pairs = contacts.second >= 0
        np.add.at(force, [row[k] for k in contacts.second[pairs]], -contacts.force[pairs])
        np.testing.assert_allclose(force, simulation.force, atol=1e-12 * np.abs(contacts.force).max() * len(contacts))
        on_floor = contacts["feature"] >= 0
        np.testing.assert_allclose(-contacts.force[on_floor].sum(axis=0), simulation.surface_forces[0], rtol=1e-10, atol=1e-14)
        for k in range(4):
            np.testing.assert_allclose(-contacts.force[contacts["wall"] == k].sum(axis=0), simulation.plane_force(k), atol=1e-14)

    def test_the_energy_is_balanced(self):
        energy = self.simulation.energy()
        self.assertGreater(energy["kinetic"], 0)
        start = falling(4).energy()["balance"]
        self.assertAlmostEqual(energy["balance"], start, delta=0.01 * energy["gravity_work"])
        self.simulation.reset_accounts()
        self.assertEqual(self.simulation.energy()["friction_loss"], 0)

    def test_pictures(self):
        simulation = self.simulation
        simulation.draw(self.tmp)
        simulation.save(self.tmp / "snapshot.h5")
        simulation.step(10)
        simulation.draw(self.tmp)
        later = simulation.time
        pictures = bergamo.open(self.tmp).pictures
        self.assertEqual(list(pictures), ["contacts", "grains", "surfaces"])
        self.assertEqual(len(pictures["grains"]), 2)
        self.assertAlmostEqual(pictures["grains"].times[-1], later, delta=1e-9)
        grains = pictures["grains"][-1]
        np.testing.assert_allclose(grains.position, simulation.position, atol=1e-8)
        self.assertEqual(len(pictures["contacts"][-1]), len(simulation.contacts()))
        again = engine.Simulation.load(self.tmp / "snapshot.h5")  # a run that is begun anew from there draws over it
        again.step(5)
        again.draw(self.tmp, ["grains"])
        self.assertEqual(len(pictures["grains"]), 2)
        self.assertLess(bergamo.open(self.tmp).pictures["grains"].times[-1], later)
        with self.assertRaisesRegex(engine.ConfigError, "no pictures of 'sound'"):
            simulation.draw(self.tmp, ["sound"])

    def test_files_that_are_none(self):
        path = self.tmp / "snapshot.h5"
        with self.assertRaisesRegex(engine.RunError, "snapshot.h5"):
            engine.Simulation.load(path)
        self.simulation.save(path)
        data = bytearray(path.read_bytes())
        data[len(data) // 2] ^= 1
        path.write_bytes(data)
        with self.assertRaisesRegex(engine.RunError, "damaged"):
            engine.Simulation.load(path)

    def test_places_that_cannot_be_written(self):
        file = self.write("file", "")
        for path in (file / "snapshot.h5", self.tmp):
            with self.assertRaisesRegex(engine.RunError, str(self.tmp)):
                self.simulation.save(path)
        for folder in (file, file / "inner"):
            with self.assertRaisesRegex(engine.RunError, "cannot make the folder"):
                self.simulation.draw(folder)
        self.assertEqual([path.name for path in self.tmp.iterdir()], ["file"])


if __name__ == "__main__":
    unittest.main()
