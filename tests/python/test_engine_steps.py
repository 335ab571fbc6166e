"""Blocks of steps: callbacks, exceptions out of them, Ctrl-C, other threads."""

import gc
import os
import signal
import threading
import time
import unittest
import weakref

import numpy as np
from engine_scenes import falling, loose, sphere_of_radius

from bergamo import engine

LONG = 10**9  # steps: more than any test waits for


class Blocks(unittest.TestCase):
    def test_steps_and_times(self):
        simulation = sphere_of_radius()
        self.assertEqual((simulation.n_steps, simulation.time), (0, 0.))
        self.assertEqual(simulation.step(), 1)
        self.assertEqual(simulation.step(9), 9)
        self.assertEqual(simulation.step(0), 0)
        self.assertEqual(simulation.n_steps, 10)
        self.assertAlmostEqual(simulation.time, 2e-4, delta=1e-15)
        self.assertEqual(simulation.run_until(1e-3), 40)
        self.assertEqual(simulation.run_until(1e-3), 0)
        self.assertEqual(simulation.run_until(5e-4), 0)
        self.assertEqual(simulation.run_until(1.0099e-3), 0)  # nearer to the step that is made
        for bad, word in ((-1, "number of steps is -1: it must be at least 0"),):
            with self.assertRaisesRegex(engine.ConfigError, word):
                simulation.step(bad)
        with self.assertRaises(TypeError):
            simulation.step("many")
        with self.assertRaisesRegex(engine.ConfigError, "finite"):
            simulation.run_until(float("nan"))

    def test_callbacks_go_by_the_number_of_steps(self):
        simulation = sphere_of_radius()
        seen = []
        end = simulation.every(4, lambda: seen.append(simulation.n_steps))
        simulation.step(6)
        simulation.step(6)
        self.assertEqual(seen, [4, 8, 12])
        end()
        simulation.step(8)
        self.assertEqual(len(seen), 3)
        with self.assertRaisesRegex(engine.ConfigError, "at least 1"):
            simulation.every(0, seen.clear)

    def test_callbacks_leave_the_bits_alone(self):
        """Reading has forces made; that must not change the run."""
        plain, watched = falling(3), falling(3)
        watched.every(7, lambda: (watched.contacts(), watched.energy(), watched.force, watched.stable_time_step))
        plain.step(2000)
        watched.step(2000)
        self.assertGreater(len(plain.contacts()), 10)
        watched.contacts()
        self.assertEqual(plain.state_hash, watched.state_hash)

    def test_a_callback_may_change_the_simulation(self):
        simulation = falling(3)
        simulation.every(100, lambda: simulation.remove(np.argmax(simulation.position[:, 2])))
        self.assertEqual(simulation.step(350), 350)
        self.assertEqual(len(simulation), 27 - 3)
        ids = set(simulation.id)
        self.assertEqual(len(ids), 24)

    def test_a_callback_may_stop(self):
        simulation = sphere_of_radius()
        simulation.every(5, simulation.stop)
        simulation.every(5, lambda: self.fail("called after the stop"))
        self.assertEqual(simulation.step(100), 5)

    def test_an_exception_comes_out_between_two_steps(self):
        simulation, undisturbed = falling(2), falling(2)

        class Mine(Exception):
            pass

        def fail():
            raise Mine("of this kind")

        end = simulation.every(30, fail)
        with self.assertRaisesRegex(Mine, "of this kind"):
            simulation.step(LONG)
        self.assertEqual(simulation.n_steps, 30)
        end()
        simulation.step(70)
        undisturbed.step(100)
        self.assertEqual(simulation.state_hash, undisturbed.state_hash)

    def test_a_callback_cannot_step(self):
        simulation = sphere_of_radius()
        end = simulation.every(3, lambda: simulation.step(1))
        with self.assertRaisesRegex(engine.Busy, "cannot step the simulation that calls it"):
            simulation.step(10)
        end()
        self.assertEqual(simulation.step(10), 10)
        other = sphere_of_radius()
        simulation.every(1, lambda: other.step(1))
        simulation.step(5)
        self.assertEqual(other.n_steps, 5)

    def test_a_callback_of_its_own_simulation_is_no_leak(self):
        simulation = sphere_of_radius()
        simulation.every(1, lambda: simulation.time)
        simulation.step(2)
        gone = weakref.ref(simulation)
        del simulation
        gc.collect()
        self.assertIsNone(gone())

    def test_a_failed_step(self):
        simulation = falling(2)
        simulation.velocity[3] = np.nan
        with self.assertRaises(engine.RunError) as first:
            simulation.step(LONG)
        with self.assertRaisesRegex(engine.RunError, "failed in an earlier step") as second:
            simulation.step(1)
        self.assertIn(str(first.exception), str(second.exception))
        self.assertIsInstance(first.exception, RuntimeError)

    def test_forces_of_another_length(self):
        """What only shows in a step: nothing is broken by it."""
        simulation = falling(2)
        simulation.external_force = 0, 0, 0
        simulation.step(3)
        simulation.add(loose(1))
        self.assertEqual(len(simulation.external_force), 9)
        simulation.step(3)


def tell_when_busy(simulation, started):
    while True:
        try:
            simulation.time
        except engine.Busy:
            return started.set()
        time.sleep(1e-3)


class Interrupts(unittest.TestCase):
    def setUp(self):
        # A shell's background job ignores Ctrl-C, and so would Python.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))

    def interrupted(self, step):
        """Sends SIGINT once the block is under way. @return seconds from there to the exception"""
        sent = []

        def send():
            started.wait()
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        started = threading.Event()
        thread = threading.Thread(target=send)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            step(started)
        thread.join()
        return time.monotonic() - sent[0]

    def test_ctrl_c_stops_a_long_block(self):
        """Without a callback, in which Python would look for signals by itself."""
        simulation, undisturbed = falling(2), falling(2)

        def long_block(started):
            threading.Thread(target=tell_when_busy, args=(simulation, started)).start()
            simulation.step(LONG)

        self.interrupted(long_block)
        n = simulation.n_steps
        self.assertGreater(n, 0)
        self.assertLess(n, LONG)
        simulation.step(10)
        undisturbed.step(n + 10)
        self.assertEqual(simulation.state_hash, undisturbed.state_hash)

    def test_ctrl_c_stops_a_packing(self):
        def pack(started):
            threading.Timer(0.3, started.set).start()
            engine.pack(engine.UniformSizes(), engine.Space.box((0, 0, 0), (0.012, 0.012, 0.012)), solid_fraction=0.66,
                        max_iterations=10**6)

        self.interrupted(pack)

    def test_a_handler_of_ones_own(self):
        simulation = sphere_of_radius()
        seen = []
        before = signal.signal(signal.SIGUSR1, lambda *_: (seen.append(simulation.n_steps), simulation.stop()))
        self.addCleanup(signal.signal, signal.SIGUSR1, before)
        called = iter(range(10**9))
        simulation.every(50, lambda: os.kill(os.getpid(), signal.SIGUSR1) if next(called) == 0 else None)
        n = simulation.step(LONG)
        self.assertEqual(len(seen), 1)
        self.assertEqual(simulation.n_steps, n)


class Threads(unittest.TestCase):
    def test_other_threads_run_while_steps_are_made(self):
        """The lock is free: this thread must see the other one within its block, stop it, and be told that it is busy."""
        simulation = falling(2)
        view = simulation.position
        started, errors, made = threading.Event(), [], []

        def block():
            try:
                made.append(simulation.step(LONG))
            except BaseException as error:  # shown below
                errors.append(error)

        thread = threading.Thread(target=block)
        thread.start()
        tell_when_busy(simulation, started)  # no callback, in which Python would change threads by itself
        looks = (lambda: simulation.step(1), lambda: simulation.contacts(), lambda: view[0], lambda: simulation.position,
                 lambda: simulation.time, lambda: simulation.add(loose(1)), lambda: simulation.remove([0]),
                 lambda: simulation.save("/tmp/never.h5"), lambda: setattr(simulation, "velocity", (0, 0, 0)),
                 lambda: simulation.set_plane_velocity(0, (0, 0, 0)))
        for number, look in enumerate(looks):
            with self.assertRaises(engine.Busy, msg=number):
                look()
        simulation.stop()
        thread.join()
        self.assertEqual(errors, [])
        self.assertEqual(made, [simulation.n_steps])
        self.assertEqual(simulation.step(1), 1)

    def test_numbers_of_threads(self):
        before = engine.threads()
        self.addCleanup(engine.set_threads, before)
        engine.set_threads(2)
        self.assertEqual(engine.threads(), 2)
        engine.set_threads(3)
        falling(10).step(2)
        self.assertGreaterEqual(len(os.listdir("/proc/self/task")), 3)
        with self.assertRaisesRegex(engine.ConfigError, "number of threads is 0: it must be at least 1"):
            engine.set_threads(0)
        self.assertIn(engine.pack_width(), (2, 4, 8))


if __name__ == "__main__":
    unittest.main()
