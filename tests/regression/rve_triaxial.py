#!/usr/bin/env python3
"""The driver rve_triaxial as a user runs it: results, threads, restart after a kill, bad input.

Usage: rve_triaxial.py PROGRAM [TOPIC]
"""

import atexit
import csv
import functools
import json
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from driver_process import SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "rve_triaxial" / "smoke.prm"
CLUMPS = SMOKE.with_name("clumps.prm")
NOT_OF_THE_RESULT = {"wall_time_s"}


class Case(unittest.TestCase):
    def setUp(self):
        self.tmp = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.tmp, True)

    def command(self, output, *options, parameters=SMOKE):
        return [str(PROGRAM), str(parameters), "--output", str(output), "--no-plots", "--quiet", *options]

    def run_driver(self, output, *options, **command):
        return subprocess.run(self.command(output, *options, **command), capture_output=True, text=True)

    def whole_run(self):
        """Folder of a run that nothing interrupts: one for all tests that compare with it."""
        folder = uninterrupted_folder()
        if not folder.exists():
            result = self.run_driver(folder)
            self.assertEqual(result.returncode, 0, result.stderr)
        return folder

    def assert_refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def assert_same_results(self, one, other):
        self.assertEqual(table(one / "ensemble.csv", NOT_OF_THE_RESULT), table(other / "ensemble.csv", NOT_OF_THE_RESULT))
        for sample in ("0001", "0002"):
            for name in ("history.csv", "distributions.csv"):
                self.assertEqual((one / "samples" / sample / name).read_text(),
                                 (other / "samples" / sample / name).read_text(), (sample, name))


@functools.cache
def uninterrupted_folder():
    parent = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, parent, True)
    return Path(parent) / "whole"


def table(path, without=()):
    with open(path, newline="") as file:
        return [{key: value for key, value in row.items() if key not in without} for row in csv.DictReader(file)]


def numbers(path):
    return [{key: float(value) for key, value in row.items()} for row in table(path)]


class Results(Case):
    def test_ensemble(self):
        """Two pressures on the same packing: what is written is whole and makes sense, whatever the threads."""
        out = self.tmp / "two"
        result = self.run_driver(out, "--threads", "2", "--set", "Output/pictures=true")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = numbers(out / "ensemble.csv")
        self.assertEqual([row["confining_pressure_Pa"] for row in rows], [25e3, 100e3])
        self.assertEqual(rows[0]["seed"], rows[1]["seed"])
        self.assertEqual(rows[0]["generated_solid_fraction"], rows[1]["generated_solid_fraction"])
        for number, row in enumerate(rows, 1):
            folder = out / "samples" / f"{number:04d}"
            self.assertEqual(row["finished"], 1)
            self.assertEqual(row["undecided_contacts"], 0)
            self.assertLess(row["energy_residual"], 1e-3)
            self.assertLess(row["time_step_s"], row["stable_time_step_s"])
            self.assertTrue(0.6 < row["generated_solid_fraction"] < 0.72)  # random close packings with friction
            self.assertFalse((folder / "snapshot.h5").exists())
            self.assertTrue((folder / "grains_0002.vtu").exists())

            history = numbers(folder / "history.csv")
            pressure = row["confining_pressure_Pa"]
            shear = [sample for sample in history if sample["stage"] == 2]
            self.assertAlmostEqual(shear[0]["strain_z"], 0, delta=1e-4)
            for axis in ("xx", "yy", "zz"):
                self.assertAlmostEqual(shear[0][f"stress_{axis}_Pa"], -pressure, delta=0.02 * pressure)
            self.assertAlmostEqual(shear[-1]["strain_z"], -0.02, delta=1e-4)
            self.assertLess(shear[-1]["stress_zz_Pa"], 1.5 * shear[-1]["stress_xx_Pa"])  # compression is negative
            self.assertLess(shear[2]["strain_z"], 0)
            self.assertGreater(shear[2]["strain_z"], -2e-4)  # rows lie close where the stiffness is read
            for sample in history:
                volume = (1 + sample["strain_x"]) * (1 + sample["strain_y"]) * (1 + sample["strain_z"]) - 1
                self.assertAlmostEqual(sample["volumetric_strain"], volume, delta=1e-12)
                if sample["n_contacts"]:
                    self.assertAlmostEqual(sum(sample[f"fabric_{a}"] for a in ("xx", "yy", "zz")), 1, delta=1e-12)
            self.assertGreater(shear[-1]["fabric_zz"], 0.34)  # contacts turn towards the load

        one = self.tmp / "one"
        result = self.run_driver(one, "--threads", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_same_results(out, one)
        summary = json.loads((one / "summary.json").read_text())
        self.assertEqual(summary["samples"], 2)
        self.assertEqual(summary["steps"], sum(row["n_steps"] for row in rows))

    def test_other_paths(self):
        """Extension, constant volume, constant pressure and a cycle, one after the other, each as it is defined."""
        out = self.tmp / "paths"
        settings = ["Ensemble/confining pressures=50e3", "Stage 2/axial strain=0.004",
                    "Stage 3/path=constant volume", "Stage 3/axial strain=-0.004", "Stage 3/inertial number=0.01",
                    "Stage 4/path=constant pressure", "Stage 4/axial strain=-0.004", "Stage 4/inertial number=0.003",
                    "Stage 5/path=triaxial", "Stage 5/axial strain=-0.002", "Stage 5/cycles=1",
                    "Stage 5/inertial number=0.01",
                    "Stage 6/path=true triaxial", "Stage 6/stresses=40e3, 50e3, 60e3", "Stage 6/inertial number=0.01",
                    "Stage 6/force tolerance=0.1"]
        options = [word for setting in settings for word in ("--set", setting)]
        result = self.run_driver(out, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        history = numbers(out / "samples" / "0001" / "history.csv")
        stages = {k: [row for row in history if row["stage"] == k] for k in range(7)}
        self.assertAlmostEqual(stages[2][-1]["strain_z"], 0.004, delta=1e-4)
        self.assertGreater(stages[2][-1]["stress_zz_Pa"], stages[2][-1]["stress_xx_Pa"])
        for row in stages[3]:
            self.assertAlmostEqual(row["volumetric_strain"], 0, delta=2e-5)
        pressures = [-sum(row[f"stress_{a}_Pa"] for a in ("xx", "yy", "zz")) / 3 for row in stages[4]]
        self.assertAlmostEqual(sum(pressures[len(pressures) // 2:]) / len(pressures[len(pressures) // 2:]), 50e3,
                               delta=2.5e3)
        strains = [row["strain_z"] for row in stages[5]]
        self.assertAlmostEqual(min(strains), -0.002, delta=1e-4)
        self.assertAlmostEqual(max(strains), 0.002, delta=1e-4)
        self.assertAlmostEqual(strains[-1], 0, delta=1e-4)
        for axis, pressure in (("xx", 40e3), ("yy", 50e3), ("zz", 60e3)):
            self.assertAlmostEqual(stages[6][-1][f"stress_{axis}_Pa"], -pressure, delta=0.01 * pressure)


    def test_clumps(self):
        """Bent grains of three parts: packed, compressed and sheared."""
        out = self.tmp / "clumps"
        result = self.run_driver(out, parameters=CLUMPS)
        self.assertEqual(result.returncode, 0, result.stderr)
        row = numbers(out / "ensemble.csv")[0]
        self.assertGreater(row["n_particles"], 100)
        self.assertGreater(row["solid_fraction"], 0.45)  # from 0.22: the compression made it dense
        self.assertGreater(row["coordination_number"], 3)
        self.assertEqual(row["undecided_contacts"], 0)
        self.assertLess(row["energy_residual"], 0.02)
        last = numbers(out / "samples" / "0001" / "history.csv")[-1]
        self.assertAlmostEqual(last["strain_z"], -0.02, delta=1e-3)
        self.assertLess(last["stress_zz_Pa"], last["stress_xx_Pa"])


class Restart(Case):
    def test_kill(self):
        """Killed twice, and stopped by Ctrl-C once: what it gives in the end is the same to the last bit."""
        whole, parts = self.whole_run(), self.tmp / "parts"
        sample = parts / "samples" / "0001"
        options = list(SNAPSHOTS_BY_STEPS)
        for stage, send in ((0, signal.SIGKILL), (1, signal.SIGKILL), (2, signal.SIGINT)):
            has_snapshot = renewal(sample / "snapshot.h5")
            stop_when(lambda: has_snapshot() and n_rows(sample / "history.csv", lambda row: row[1] == str(stage)) > 0,
                      self.command(parts, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        result = self.run_driver(parts, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_same_results(whole, parts)
        again = self.run_driver(parts, *options)  # nothing is left to do
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assert_same_results(whole, parts)
        self.assert_refused(self.run_driver(parts, *options, "--set", "Ensemble/seed=2"), "other parameters")

    def test_stopped_while_it_packs(self):
        """The first Ctrl-C ends a packing after its iteration, without a sample half begun."""
        out = self.tmp / "run"
        sample = out / "samples" / "0001"
        options = ["--threads", "1", "--set", "Ensemble/edges=0.02"]  # some thousand grains: a packing of many seconds
        result = stop_when(sample.exists, self.command(out, *options), signal.SIGINT)
        self.assertIn("go on with --restart", result.stdout)
        self.assertEqual(list(sample.iterdir()), [])

    def test_damaged_snapshot(self):
        """A sample whose snapshot is damaged is named; the other one is finished."""
        out = self.tmp / "run"
        options = ["--threads", "1", *SNAPSHOTS_BY_STEPS]
        snapshot = out / "samples" / "0001" / "snapshot.h5"
        stop_when(snapshot.exists, self.command(out, *options))
        data = bytearray(snapshot.read_bytes())
        data[len(data) // 2] ^= 1
        snapshot.write_bytes(data)
        result = self.run_driver(out, *options, "--restart")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("sample 1", result.stderr)
        self.assertIn("snapshot.h5", result.stderr)
        self.assertEqual([row["finished"] for row in numbers(out / "ensemble.csv")], [0, 1])
        # What the message says helps.
        self.assertIn("or remove it, and --restart begins the sample anew", result.stderr)
        snapshot.unlink()
        result = self.run_driver(out, *options, "--restart")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_same_results(self.whole_run(), out)

    def test_failed_sample(self):
        """Under the lower pressure a stage takes too long. The options that the message gives run that sample alone, with
        another limit and what it would have given in its ensemble."""
        whole, out, alone = self.whole_run(), self.tmp / "out", self.tmp / "alone"
        last = [table(whole / "samples" / sample / "history.csv") for sample in ("0001", "0002")]
        shear = [float(rows[-1]["time_s"]) - next(float(row["time_s"]) for row in rows if row["stage"] == "2")
                 for rows in last]
        self.assertGreater(shear[0], 1.5 * shear[1])  # slower at the same inertial number: the first sample fails
        limit = f"Stage 2/longest time={(shear[0] + shear[1]) / 2}"
        result = self.run_driver(out, "--set", limit)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("sample 1: the stage did not end within", result.stderr)
        self.assertEqual([row["finished"] for row in numbers(out / "ensemble.csv")], [0, 1])
        line = next(line for line in result.stderr.splitlines() if line.startswith("  sample 1: --set"))
        result = self.run_driver(alone, *shlex.split(line.split(": ", 1)[1]))
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("history.csv", "distributions.csv"):
            self.assertEqual((whole / "samples" / "0001" / name).read_text(),
                             (alone / "samples" / "0001" / name).read_text())

    def test_full_disk(self):
        """A file system too small for a snapshot: one message, the table of samples stays whole."""
        full = self.tmp / "full"
        full.mkdir()
        settings = [*SNAPSHOTS_BY_STEPS, "--threads", "1"]
        inside = f"""mount -t tmpfs -o size=200k none {full} || exit 99
            {' '.join(shlex.quote(word) for word in self.command(full, '--force', *settings))}; status=$?
            cp -r {full} {self.tmp}/kept
            exit $status"""
        result = subprocess.run(["unshare", "--map-root-user", "--mount", "bash", "-c", inside],
                                capture_output=True, text=True)
        if result.returncode == 99 or "unshare" in result.stderr:
            self.skipTest("this machine allows no mounts: " + result.stderr)
        self.assertEqual(result.returncode, 1, result.stderr)
        for word in ("sample 1", str(full), "No space left", "free some space"):
            self.assertIn(word, result.stderr)
        for row in numbers(self.tmp / "kept" / "ensemble.csv"):
            self.assertEqual(row["finished"], 0)


class BadInput(Case):
    def test_refusals(self):
        """One clear message before any work, and no folder."""
        for setting, words in {
            "Ensemble/edges=0.002": ("0.002",),
            "Ensemble/confining pressures=": ("confining pressures",),
            "Stage 1/path=none": ("Stage 1/path is none", "stage 2"),
            "Stage 2/path=sideways": ("Stage 2/path", "triaxial"),
            "Stage 2/axial strain=0": ("axial strain",),
            "Stage 2/inertial number=0.5": ("inertial number",),
            "Grains/sizes=sieves --set Grains/Sieves/d10=2e-3": ("d10",),
            "Packing/solid fraction=1.2": ("solid fraction",),
            "Grains/shape=clumps": ("0.55", "not tightened", "0.35"),
            "Grains/Clumps/parts=0 0 0 1 1 1 1": ("Grains/Clumps/parts", "7 numbers"),
        }.items():
            with self.subTest(setting):
                out = self.tmp / "refused"
                options = [word for part in setting.split(" --set ") for word in ("--set", part)]
                self.assert_refused(self.run_driver(out, *options), *words)
                self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
