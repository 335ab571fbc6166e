"""Views of a simulation's arrays: in place while they are its own, and an error, never other numbers, afterwards."""

import copy
import gc
import pickle
import unittest
import weakref

import numpy as np
from engine_scenes import falling, loose, sphere_of_radius

from bergamo import engine


class InPlace(unittest.TestCase):
    def test_views_show_what_is_there_now(self):
        simulation = sphere_of_radius(height=1.)
        position, velocity = simulation.position, simulation.velocity
        before = position.copy()
        simulation.step(1000)  # free fall: leapfrog's velocity is of the half step before, and its first step a whole one
        fallen = before - position
        self.assertEqual(type(fallen), np.ndarray)
        self.assertAlmostEqual(fallen[0, 2], 0.5 * 9.81 * simulation.time**2, delta=9.81 * simulation.time * 2e-5)
        self.assertAlmostEqual(velocity[0, 2], -9.81 * simulation.time, delta=9.81 * 2e-5)
        self.assertTrue(np.shares_memory(position, simulation.position))

    def test_shapes(self):
        simulation = falling(2)
        rows = {"id": (), "position": (3,), "orientation": (4,), "velocity": (3,), "angular_momentum": (3,),
                "angular_velocity": (3,), "force": (3,), "torque": (3,), "mass": (), "volume": (), "inertia": (3,),
                "bounding_radius": ()}
        for name, shape in rows.items():
            view = getattr(simulation, name)
            self.assertIsInstance(view, np.ndarray, name)
            self.assertEqual(view.shape, (8, *shape), name)
        np.testing.assert_allclose(np.linalg.norm(simulation.orientation, axis=1), 1, rtol=1e-14)
        self.assertEqual(sorted(simulation.id), list(range(8)))

    def test_velocities_may_be_written_and_count(self):
        simulation = sphere_of_radius(height=1., gravity=(0, 0, 0))
        simulation.velocity[0] = 1, 2, 3
        simulation.step(10)
        np.testing.assert_allclose(simulation.position[0], np.array([0, 0, 1]) + 2e-4 * np.array([1, 2, 3]), rtol=1e-12)
        simulation.velocity += 1
        simulation.velocity *= 2
        np.testing.assert_allclose(simulation.velocity, [[4, 6, 8]], rtol=1e-14)
        simulation.velocity = 0, 0, 5
        np.testing.assert_array_equal(simulation.velocity, [[0, 0, 5]])
        with self.assertRaisesRegex(engine.ConfigError, r"velocity has the shape \(2, 3\): it must be \(3,\) or \(1, 3\)"):
            simulation.velocity = np.zeros((2, 3))

    def test_what_other_state_follows_from_is_read_only(self):
        simulation = falling(2)
        for name in ("id", "position", "orientation", "angular_velocity", "force", "torque", "mass", "volume", "inertia",
                     "bounding_radius"):
            view = getattr(simulation, name)
            with self.assertRaisesRegex(ValueError, "read-only"):
                view[0] = 0
            with self.assertRaises(ValueError, msg=name):
                np.asarray(view)[0] = 0
            with self.assertRaises(ValueError, msg=name):
                view.flags.writeable = True

    def test_external_forces(self):
        simulation = sphere_of_radius(height=1., gravity=(0, 0, 0))
        self.assertIsNone(simulation.external_force)
        simulation.external_force = 0, 0, 1e-3
        simulation.step(100)
        speed = 1e-3 / simulation.mass[0] * simulation.time
        self.assertAlmostEqual(simulation.velocity[0, 2], speed, delta=1e-9 * speed)
        view = simulation.external_force
        view[:] = 0
        simulation.step(100)
        self.assertAlmostEqual(simulation.velocity[0, 2], speed, delta=1e-9 * speed)
        simulation.external_force = None
        self.assertIsNone(simulation.external_force)
        with self.assertRaises(engine.StaleView):
            view[0]
        with self.assertRaisesRegex(engine.ConfigError, "external_force"):
            simulation.external_force = np.zeros((3, 3))


class Stale(unittest.TestCase):
    def every_look(self, view):
        """What Python and NumPy can do with an array."""
        return [lambda: view[0], lambda: view.sum(), lambda: view + 1, lambda: 1 - view, lambda: view.copy(),
                lambda: np.linalg.norm(view), lambda: np.concatenate([np.zeros_like(np.ones(view_shape)), view]),
                lambda: list(view), lambda: len(view), lambda: view.T, lambda: view.shape, lambda: str(view),
                lambda: f"{view}", lambda: view == 0, lambda: np.sort(view), lambda: np.where(view > 0, view, 0),
                lambda: view.tolist(), lambda: copy.copy(view), lambda: copy.deepcopy(view), lambda: pickle.dumps(view),
                lambda: view @ np.eye(3), lambda: np.einsum("ij,ij->i", view, view), lambda: view.view(np.ndarray),
                lambda: view.data, lambda: 0. in view, lambda: view.astype(float), lambda: np.max(view),
                lambda: np.add(1, 1, out=view), lambda: view.__setitem__(0, 0)]

    def check_stale(self, view):
        global view_shape
        view_shape = (64, 3)
        for number, look in enumerate(self.every_look(view)):
            with self.assertRaisesRegex(engine.StaleView, "no longer of the simulation", msg=number):
                look()
        self.assertIn("no longer of the simulation", repr(view))

    def test_after_grains_are_added_removed_or_sorted(self):
        for change in (lambda s: s.add(loose(1)), lambda s: s.remove([3]), self.sort):
            simulation = falling()
            view, other = simulation.velocity, simulation.id
            inner = view[2:, 1:]
            kept = view.copy()
            change(simulation)
            self.check_stale(view)
            for stale in (inner, other):
                with self.assertRaises(engine.StaleView):
                    stale[0]
            self.assertEqual(kept.sum(), kept.sum())  # an array of its own
            self.assertEqual(len(simulation.velocity), len(simulation))

    def sort(self, simulation):
        before = simulation.id.copy()
        simulation.parameters = engine.Parameters(**{**vars(simulation.parameters), "sort_interval": 1})
        view = simulation.id
        for _ in range(100):
            simulation.step(20)
            try:
                view[0]
            except engine.StaleView:
                break
        self.assertEqual(sorted(before), sorted(simulation.id))

    def test_sorting_is_told_even_from_within_a_block(self):
        """A view is of the rows that it was made with, or stale: ids say whether they are the same."""
        simulation = falling(sort_interval=1)
        told = 0
        for _ in range(200):
            view, ids = simulation.id, simulation.id.copy()
            simulation.step(25)
            try:
                np.testing.assert_array_equal(view, ids)
            except engine.StaleView:
                told += 1
                view = simulation.id
        self.assertGreater(told, 2)

    def test_plain_arrays_keep_memory_without_numbers(self):
        simulation = falling()
        plain, ids = np.asarray(simulation.velocity), np.asarray(simulation.id)
        self.assertIs(type(plain), np.ndarray)
        memory = memoryview(simulation.velocity)
        self.assertTrue(np.shares_memory(plain, simulation.velocity))
        simulation.add(loose(1))
        for _ in range(20):
            simulation.step(20)
        self.assertTrue(np.isnan(plain).all())
        self.assertTrue((ids == -1).all())
        self.assertNotEqual(memory[0, 0], memory[0, 0])
        plain[:] = 7  # and nobody else's
        self.assertFalse((np.asarray(simulation.velocity) == 7).any())
        self.assertTrue(np.isfinite(simulation.velocity).all())

    def test_a_view_keeps_its_simulation(self):
        simulation = falling(2)
        view = simulation.position
        plain = np.asarray(simulation.velocity)
        gone = weakref.ref(simulation)
        expected = view.copy(), plain.copy()
        del simulation
        gc.collect()
        self.assertIsNone(gone())
        trash = [np.full((8, 3), 5.) for _ in range(1000)]  # what would take the memory if it were free
        np.testing.assert_array_equal(view, expected[0])
        np.testing.assert_array_equal(plain, expected[1])
        del trash

    def test_copies_are_arrays_of_their_own(self):
        simulation = falling(2)
        view = simulation.position
        copies = [view.copy(), view[[0, 1]], view[view[:, 0] > 0], view + 0, np.sort(view, axis=0), view.astype(np.float32),
                  np.concatenate([view, view]), copy.deepcopy(view), pickle.loads(pickle.dumps(view)), np.array(view),
                  view.T.copy(), view.flatten()]
        simulation.add(loose(1))
        for number, one in enumerate(copies):
            self.assertTrue(np.isfinite(one).all(), number)


if __name__ == "__main__":
    unittest.main()
