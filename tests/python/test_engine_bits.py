"""The same bits from Python as from C++, on any number of threads, and after a restart."""

import subprocess
import unittest

from engine_scenes import BUILD, falling
from small_runs import FolderCase

from bergamo import engine

STEP_SNAPSHOT = BUILD / "tests" / "python" / "step_snapshot"


class Bits(FolderCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(engine.set_threads, engine.threads())

    def test_threads(self):
        hashes = []
        for n_threads in (1, 2):
            engine.set_threads(n_threads)
            simulation = falling(8, sort_interval=3)  # enough grains for a team
            simulation.run_until(0.06)
            hashes.append(simulation.state_hash)
            self.assertGreater(len(simulation.contacts()), 300)
        self.assertEqual(*hashes)

    def test_restart(self):
        """From between two steps, and from where the forces of the step were asked for."""
        simulation = falling(4)
        simulation.external_force = 1e-7, 0, 0
        simulation.step(700)
        for name, look in (("plain.h5", lambda: None), ("read.h5", simulation.contacts)):
            look()
            simulation.save(self.tmp / name)
            restarted = engine.Simulation.load(self.tmp / name)
            self.assertEqual((restarted.n_steps, restarted.time), (simulation.n_steps, simulation.time))
            self.assertEqual(restarted.state_hash, simulation.state_hash)
            self.assertEqual(restarted.parameters, simulation.parameters)
            restarted.step(500)
            simulation.step(500)
            self.assertEqual(restarted.state_hash, simulation.state_hash)

    def test_blocks_of_any_size(self):
        whole, pieces = falling(3), falling(3)
        whole.step(600)
        for n in (1, 99, 250, 250):
            pieces.step(n)
        self.assertEqual(whole.state_hash, pieces.state_hash)

    def test_steps_from_cpp(self):
        simulation = falling(5)
        simulation.step(600)
        simulation.save(self.tmp / "snapshot.h5")
        result = subprocess.run([STEP_SNAPSHOT, self.tmp / "snapshot.h5", "200", "2"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        simulation.step(400)
        self.assertEqual(int(result.stdout.split()[-1]), simulation.state_hash)


if __name__ == "__main__":
    unittest.main()
