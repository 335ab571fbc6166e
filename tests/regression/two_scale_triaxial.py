#!/usr/bin/env python3
"""The driver two_scale_triaxial as a user runs it: results, restart, bad input, failures.

Usage: two_scale_triaxial.py PROGRAM [TOPIC]
"""

import csv
import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from driver_process import SNAPSHOTS_BY_STEPS, n_rows, stop_when

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "verification"))
import fe_hypoplastic_reference as sand

PROGRAM = Path(sys.argv.pop(1)).resolve()
FOLDER = Path(__file__).resolve().parents[2] / "drivers" / "two_scale_triaxial"
SMOKE = FOLDER / "smoke.prm"
PRESSURE, PRESSURE_OF_CONTINUUM = 4e3, 1e3
# Most steps are those of the packing, which comes the faster to the pressure the higher it is.
QUICK_PACKING = ["--set", f"Packing/pressure={PRESSURE}", "--set", "Packing/largest strain rate=400"]


class Case(unittest.TestCase):
    def setUp(self):
        self.tmp = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.tmp, True)

    def command(self, output, *options, prm=SMOKE):
        quick = QUICK_PACKING if prm == SMOKE and "Model/kind=continuum" not in options else []
        return [str(PROGRAM), str(prm), "--output", str(output), "--no-plots", "--quiet", *quick, *options]

    def run_driver(self, output, *options, prm=SMOKE, **kwargs):
        return subprocess.run(self.command(output, *options, prm=prm), capture_output=True, text=True, **kwargs)

    def assert_refused(self, result, *words, code=2):
        """One clear message with these words, and nothing of the machinery behind it."""
        self.assertEqual(result.returncode, code, result.stderr)
        errors = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        for word in words:
            self.assertIn(word, errors[0])
        for noise in ("dealii", "ParameterHandler", "HDF5-DIAG", "terminate called", "what():"):
            self.assertNotIn(noise, result.stderr)


def history(folder):
    with open(folder / "history.csv", newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


class Results(Case):
    def test_stepped_interface(self):
        """The overlap goes down by a layer behind the middle: stresses are those over a flat one, and even."""
        cube = ["--set", "Model/elements per edge=5", "--set", "Model/continuum layers=4", "--set", "Model/overlap layers=2",
                "--set", "Coupling/penalty=1e14", "--set", "Loading/time step=6e-8"]
        final = {}
        for shape in ("flat", "stepped"):
            out = self.tmp / shape
            result = self.run_driver(out, *cube, "--set", f"Model/interface={shape}")
            self.assertEqual(result.returncode, 0, result.stderr)
            summary = json.loads((out / "summary.json").read_text())
            self.assertLess(summary["energy_residual"], 1e-5)
            self.assertLess(summary["time_step_s"], summary["stable_time_step_s"])
            final[shape] = history(out)[-1]
            with open(out / "contact_forces.csv", newline="") as file:
                forces = list(csv.DictReader(file))
            self.assertGreater(len(forces), 20)
            for row in forces:
                self.assertGreater(float(row["force_N"]), 0)
                # the direction's cosines
                self.assertAlmostEqual(sum(math.cos(math.radians(float(row[f"angle_to_{axis}_deg"])))**2 for axis in "xyz"), 1)
        for direction in "123":
            flat, stepped = (final[shape][f"stress_{direction}_Pa"] for shape in ("flat", "stepped"))
            # two small cubes of some hundred grains; without the joint at the side of the step it would be a half
            self.assertLess(abs(stepped / flat - 1), 0.25)

    def test_models(self):
        """Each model runs to its end; what it writes is whole and makes sense."""
        final = {}
        for kind in ("two-scale", "grains", "continuum"):
            with self.subTest(kind):
                out = self.tmp / kind
                result = self.run_driver(out, "--set", f"Model/kind={kind}")
                self.assertEqual(result.returncode, 0, result.stderr)
                rows = history(out)
                summary = json.loads((out / "summary.json").read_text())
                self.assertGreaterEqual(len(rows), 50)
                self.assertEqual(summary["model"], kind)
                self.assertEqual(summary["undecided_contacts"], 0)
                # Works and losses close by construction; what is left is the turning of arms within a step, of first
                # order in the motion of a step (1e-6 of a grain).
                self.assertLess(summary["energy_residual"], 1e-5)
                self.assertLess(summary["max_overlap_over_radius"], 0.02)
                self.assertLess(summary["time_step_s"], summary["stable_time_step_s"])
                pressure = PRESSURE_OF_CONTINUUM if kind == "continuum" else PRESSURE
                for direction in "123":
                    # starts at the packing's pressure, ends compressed
                    self.assertAlmostEqual(rows[0][f"stress_{direction}_Pa"], -pressure, delta=0.3 * pressure)
                    self.assertLess(rows[-1][f"stress_{direction}_Pa"], -2 * pressure)
                strain = sum(rows[-1][f"strain_{d}"] for d in "123")
                self.assertAlmostEqual(strain, -0.003, delta=1e-9)
                self.assertTrue((out / "parameters.prm").exists())
                if kind != "continuum":
                    self.assertTrue((out / "grains_0001.vtu").exists())
                if kind != "grains":
                    self.assertTrue((out / "continuum_0001.vtu").exists())
                final[kind] = rows[-1]

    def test_needs_no_mpi(self):
        """Where MPI could not start, one model alone does: only the start of coupled ones has a use for it."""
        command = shlex.join(self.command(self.tmp / "run", "--set", "Model/kind=grains", "--set",
                                          "Loading/isotropic time=1e-5", "--set", "Loading/shear time=1e-5"))
        result = subprocess.run(["bash", "-c", f"export TMPDIR=/proc/none; ulimit -n 20; exec {command}"],
                                capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_continuum_closed_form(self):
        """A homogeneous elastic start: p = p0 - K eps_v while no yielding (Hooke)."""
        for elements in ("Model/bending elements=false", "Model/bending elements=true", "Model/large strain=true"):
            with self.subTest(elements):
                out = self.tmp / elements.replace("/", "-")
                options = ["Model/kind=continuum", "Loading/axial strain=0", "Loading/volumetric strain change=0", elements]
                result = self.run_driver(out, *[x for o in options for x in ("--set", o)])
                self.assertEqual(result.returncode, 0, result.stderr)
                last = history(out)[-1]
                bulk_modulus = 60e6 / (3 * (1 - 2 * 0.145))
                for direction in "123":
                    # forces over the shrunken faces: (1 - eps/3)^2 = 1 - 0.0013; waves are damped to below that
                    self.assertAlmostEqual(last[f"stress_{direction}_Pa"], -PRESSURE_OF_CONTINUUM - bulk_modulus * 0.002,
                                           delta=0.003 * bulk_modulus * 0.002)

    def test_bending_elements(self):
        """Below grains their stresses are near those of plain elements, but others, and the energy balance closes."""
        last = {}
        for bending in ("false", "true"):
            out = self.tmp / bending
            result = self.run_driver(out, "--set", f"Model/bending elements={bending}")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertLess(json.loads((out / "summary.json").read_text())["energy_residual"], 1e-5)
            last[bending] = history(out)[-1]
        for direction in "123":
            ratio = last["true"][f"stress_{direction}_Pa"] / last["false"][f"stress_{direction}_Pa"]
            self.assertAlmostEqual(ratio, 1, delta=0.05)
            self.assertNotEqual(ratio, 1)

    def test_rotation(self):
        """Weak ground that grains press into: its elements turn, which is told, and warned of beyond five degrees where
        strains are small."""
        for large in (False, True):
            with self.subTest(large):
                out = self.tmp / str(large)
                options = ["Continuum/friction angle=1", "Continuum/dilation angle=0", "Continuum/cohesion=10",
                           "Loading/axial strain=-0.1", "Loading/shear time=0.002", f"Model/large strain={str(large).lower()}"]
                result = self.run_driver(out, *[x for o in options for x in ("--set", o)])
                self.assertEqual(result.returncode, 0, result.stderr)
                figures = json.loads((out / "summary.json").read_text())
                self.assertGreater(figures["greatest_rotation_degrees"], 1)
                self.assertLess(figures["energy_residual"], 1e-5)
                self.assertEqual("turned by" in result.stderr, not large and figures["greatest_rotation_degrees"] > 5,
                                 result.stderr)

    def test_continuum_of_sand(self):
        """Isotropic compression of hypoplastic sand, integrated apart from the program. Slow and damped: small vibrations
        take stress from it."""
        out = self.tmp / "run"
        options = ["Model/kind=continuum", "Continuum/law=hypoplastic sand", "Continuum/Sand/void ratio=0.7",
                   "Continuum/damping=500", "Loading/isotropic time=0.02", "Loading/time step=1e-6",
                   "Loading/axial strain=0", "Loading/volumetric strain change=0"]
        result = self.run_driver(out, *[x for o in options for x in ("--set", o)])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(json.loads((out / "summary.json").read_text())["energy_residual"], 1e-11)

        def rates(state):
            D = sand.tensor(lambda i, j: -1 / 3 if i == j else 0)
            stress = sand.tensor(lambda i, j: state[0] if i == j else 0)
            return [sand.Response(sand.SANDS["hochstetten"], stress, state[1]).rate(D)[0][0], -(1 + state[1])]
        state = [-PRESSURE_OF_CONTINUUM, 0.7]
        for _ in range(200):
            state = sand.advance(rates, state, 0.002 / 200)
        self.assertLess(state[0], -2 * PRESSURE_OF_CONTINUUM)
        last = history(out)[-1]
        for direction in "123":
            # forces over the shrunken faces; inertia and damping leave some 1e-4
            stress = last[f"stress_{direction}_Pa"] * (1 - 0.002 / 3) ** 2
            self.assertAlmostEqual(stress / state[0], 1, delta=1e-3)

    def test_sand_below_grains(self):
        """Both models joined, the continuum hypoplastic sand."""
        out = self.tmp / "run"
        result = self.run_driver(out, "--set", "Continuum/law=hypoplastic sand", "--set", "Continuum/Sand/void ratio=0.6")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(json.loads((out / "summary.json").read_text())["energy_residual"], 1e-5)
        self.assertLess(history(out)[-1]["stress_3_Pa"], -2 * PRESSURE)

    def test_continuum_that_outgrows_its_step(self):
        """Its stiffness grows with the pressure until the given step is no longer stable: one message, no results."""
        out = self.tmp / "run"
        options = ["Model/kind=continuum", "Continuum/reference pressure=1e3", "Continuum/stiffness exponent=1",
                   "Loading/time step=1e-6"]
        result = self.run_driver(out, *[x for o in options for x in ("--set", o)])
        self.assertEqual(result.returncode, 1, result.stderr)
        for words in ("continuum: element ", "at time ", "become so stiff", "choose a smaller time step"):
            self.assertIn(words, result.stderr)
        self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
        self.assertFalse((out / "summary.json").exists())


class Periodic(Case):
    CELL = [x for o in ("Model/sides=periodic", "Model/elements per height=6", "Model/continuum layers=4",
                        "Model/overlap layers=1", "Loading/time step=9e-8", "Continuum/Young's modulus=4e8",
                        "Continuum/friction angle=40") for x in ("--set", o)]

    def test_models(self):
        """Grains alone, a layer of continuum between grains, and continuum alone, without walls."""
        for kind in ("grains", "two-scale", "continuum"):
            with self.subTest(kind):
                out = self.tmp / kind
                result = self.run_driver(out, "--set", f"Model/kind={kind}", *self.CELL)
                self.assertEqual(result.returncode, 0, result.stderr)
                rows, summary = history(out), json.loads((out / "summary.json").read_text())
                self.assertLess(summary["energy_residual"], 1e-6)
                self.assertGreater(rows[-1]["energy_wall_work_J"], 0)
                width, _, height = summary["cube_edges_m"]
                self.assertAlmostEqual(height / width, 2, delta=0.1)
                for direction in "123":
                    self.assertLess(rows[-1][f"stress_{direction}_Pa"], -2 * PRESSURE)
                # at rest the upright stress is one, whatever bears it; what is left are waves of a quick loading
                self.assertLess(rows[-1]["stress_3_unevenness"], 0.05)

    def test_restart(self):
        """kill -9 in the loading, then --restart on another number of threads: the same bits."""
        whole, killed = self.tmp / "whole", self.tmp / "killed"
        self.assertEqual(self.run_driver(whole, "--threads", "1", *self.CELL).returncode, 0)
        stop_when(lambda: n_rows(killed / "history.csv") > 25,
                  self.command(killed, *SNAPSHOTS_BY_STEPS, "--threads", "1", *self.CELL))
        self.assertFalse((killed / "summary.json").exists())
        result = self.run_driver(killed, *SNAPSHOTS_BY_STEPS, "--restart", "--threads", "2", *self.CELL)
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("history.csv", "grains_0001.vtu", "stress_profile.csv"):
            self.assertEqual((whole / name).read_bytes(), (killed / name).read_bytes(), name)

    def test_bad_input(self):
        refused = lambda *options: self.run_driver(self.tmp / "run", *self.CELL,
                                                   *[x for o in options for x in ("--set", o)])
        self.assert_refused(refused("Model/continuum layers=5"), "Model/continuum layers is 5", "both even or both odd")
        self.assert_refused(refused("Model/interface=stepped"), "Model/interface", "choose flat, or walls")
        self.assert_refused(refused("Coupling/renewal=0.1"), "Coupling/renewal is 0.1", "choose 0, or walls")
        self.assert_refused(refused("Model/sides=walls"), "Model/elements per height is 6", "Model/sides = periodic")


class Sample(Case):
    def test_same_bits(self):
        """Two scales over the packing of a run of grains alone, with another friction: as if they had packed it."""
        for name, cell in ("walls", []), ("periodic", Periodic.CELL):
            with self.subTest(name):
                grains, own, shared = (self.tmp / f"{name}-{run}" for run in ("grains", "own", "shared"))
                for out, *options in ((grains, "--set", "Model/kind=grains", "--threads", "2"),
                                      (own, "--set", "Grains/friction=0.3", "--threads", "1"),
                                      (shared, "--set", "Grains/friction=0.3", "--threads", "2", "--set",
                                       f"Packing/sample={grains / 'sample.h5'}")):
                    result = self.run_driver(out, *cell, *options)
                    self.assertEqual(result.returncode, 0, result.stderr)
                for file in ("history.csv", "grains_0001.vtu", "stress_profile.csv"):
                    self.assertEqual((own / file).read_bytes(), (shared / file).read_bytes(), file)
                self.assertTrue((own / "sample.h5").exists())
                self.assertFalse((shared / "sample.h5").exists())

    def test_bad_input(self):
        grains, out = self.tmp / "grains", self.tmp / "run"
        self.assertEqual(self.run_driver(grains, "--set", "Model/kind=grains").returncode, 0)
        sample = ["--set", f"Packing/sample={grains / 'sample.h5'}"]
        refused = lambda *options: self.run_driver(out, *sample, *[x for o in options for x in ("--set", o)])
        self.assert_refused(refused("Grains/density=2600"), "sample.h5", "density", "2600' here", "leave Packing/sample out")
        self.assert_refused(refused("Model/edge=0.006"), "edges = 0.006 0.006 0.006", "leave Packing/sample out")
        self.assert_refused(refused("Packing/sample=" + str(grains / "snapshot.h5")), "snapshot.h5", code=1)
        self.assert_refused(refused("Packing/sample=none.h5"), "none.h5", code=1)
        self.assertFalse(out.exists())


class Restart(Case):
    def test_killed_run_goes_on_with_the_same_bits(self):
        """kill -9 in the loading, then --restart on another number of threads: the files are those of a run in one go."""
        whole, killed = self.tmp / "whole", self.tmp / "killed"
        cycle = ["--set", "Continuum/steps per force=3"]  # the snapshot falls into one
        self.assertEqual(self.run_driver(whole, "--threads", "1", *cycle).returncode, 0)
        options = [*SNAPSHOTS_BY_STEPS, "--threads", "1", *cycle]
        stop_when(lambda: n_rows(killed / "history.csv") > 25, self.command(killed, *options))
        self.assertFalse((killed / "summary.json").exists())
        self.assertTrue((killed / "snapshot.h5").exists())
        result = self.run_driver(killed, *SNAPSHOTS_BY_STEPS, "--restart", "--threads", "2", *cycle)
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("history.csv", "grains_0000.vtu", "grains_0001.vtu"):
            self.assertEqual((whole / name).read_bytes(), (killed / name).read_bytes(), name)
        # The mesh file carries its time of writing in a comment.
        meshes = [re.sub(rb"<!--.*?-->", b"", (run / "continuum_0001.vtu").read_bytes(), flags=re.S) for run in (whole, killed)]
        self.assertEqual(*meshes)

    def test_figures_survive_a_restart(self):
        """The largest overlap is met early, in a path that unloads: a run that goes on after it still reports it. Lost
        terminals stop a run like Ctrl-C."""
        options = ["--set", "Model/kind=grains", "--set", "Loading/path=unloading", "--set",
                   "Loading/volumetric strain change=0.004", "--set", "Loading/axial strain=0", "--set",
                   "Output/snapshot interval=1e-3"]
        whole, parts = self.tmp / "whole", self.tmp / "parts"
        self.assertEqual(self.run_driver(whole, *options).returncode, 0)
        rows = history(whole)
        overlaps = [row["max_overlap_over_radius"] for row in rows]
        self.assertLess(overlaps.index(max(overlaps)), 0.7 * len(rows))  # else this test shows nothing
        process = subprocess.Popen(self.command(parts, *options), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None:
            try:
                if len((parts / "history.csv").read_text().splitlines()) > 0.8 * len(rows):
                    break
            except OSError:
                pass
            time.sleep(0.005)
        process.send_signal(signal.SIGHUP)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(self.run_driver(parts, "--restart", *options).returncode, 0)
        self.assertEqual((whole / "history.csv").read_bytes(), (parts / "history.csv").read_bytes())
        summaries = [json.loads((run / "summary.json").read_text()) for run in (whole, parts)]
        for name in ("max_overlap_over_radius", "energy_residual", "stable_time_step_s", "steps"):
            self.assertEqual(summaries[0][name], summaries[1][name], name)

    def test_interrupt(self):
        """Ctrl-C ends the step, writes a snapshot and says how to go on."""
        out = self.tmp / "run"
        result = stop_when((out / "parameters.prm").exists, self.command(out), signal.SIGINT)
        self.assertIn("--restart", result.stdout)
        self.assertTrue((out / "snapshot.h5").exists())
        self.assertEqual(self.run_driver(out, "--restart").returncode, 0)


class BadInput(Case):
    def test_parameters(self):
        """Every mistake is refused before any work, names the thing, and leaves no folder."""
        out = self.tmp / "run"
        mistakes = {
            "Grains/frction=0.3": ("frction", "friction"),
            "Continuum/steps per force=1000": ("Continuum/steps per force is 1000", "stable step of the continuum"),
            "Grain/friction=0.3": ("Grain/friction", "Grains"),
            "Grains/friction=rough": ("friction", "rough"),
            "Continuum/Poisson's ratio=0.6": ("Poisson's ratio", "0.6", "0.5"),
            "Grains/Poisson's ratio=0.6": ("Poisson's ratio", "0.6"),
            "Grains/largest exponent=2": ("largest exponent", "2"),
            "Grains/smallest half-axis=-0.0002": ("smallest half-axis", "-0.0002"),
            "Loading/time step=0": ("time step", "0"),
            "Loading/time step=1e-5": ("time step", "1e-05", "stable"),
            "Packing/time step=1e-5": ("time step", "stable"),
            "Model/overlap layers=2": ("overlap layers", "2"),
            "Model/continuum layers=3": ("continuum layers", "3"),
            "Model/elements per edge=50": ("elements per edge",),
            "Model/edge=0.0005": ("edge",),
            "Packing/initial solid fraction=0.7": ("initial solid fraction", "0.7"),
            "Packing/initial solid fraction=0.3": ("does not fit", "solid fraction"),
            "Continuum/dilation angle=40": ("dilation", "40"),
            "Continuum/law=sand": ("Continuum/law", "hypoplastic sand"),
            "Coupling/penalty=-1": ("penalty", "-1"),
            "Loading/axial strain=nan": ("axial strain", "nan"),
            "Loading/isotropic time=1e30": ("Loading/isotropic time", "1e+30", "steps"),
            "Loading/time step=1e-300": ("Loading/time step", "1e-300", "steps"),
            "Model/edge=1000": ("number of grains", "2^31"),
        }
        for setting, words in mistakes.items():
            with self.subTest(setting):
                self.assert_refused(self.run_driver(out, "--set", setting), *words)
                self.assertFalse(out.exists())

    def test_continuum_time_step(self):
        """Refused at once: before the grains are packed, and before anything is written."""
        for kind in ("continuum", "two-scale"):
            with self.subTest(kind):
                result = self.run_driver(self.tmp / "run", "--set", f"Model/kind={kind}", "--set",
                                         "Loading/time step=5e-7", "--set", "Continuum/Young's modulus=1e11")
                self.assert_refused(result, "Loading/time step is 5e-07 s", "stable step of the continuum")
                self.assertFalse((self.tmp / "run").exists())

    def test_sand(self):
        """A state that sand cannot have is refused before the grains are packed."""
        for setting, words in {"Packing/pressure=50": ("Continuum/Sand/least pressure", "Packing/pressure", "50 Pa"),
                               "Continuum/Sand/void ratio=0.3": ("initial_void_ratio = 0.3", "e_d =")}.items():
            with self.subTest(setting):
                result = self.run_driver(self.tmp / "run", "--set", "Continuum/law=hypoplastic sand", "--set", setting)
                self.assert_refused(result, *words)
                self.assertFalse((self.tmp / "run").exists())

    def test_files(self):
        out = self.tmp / "run"
        self.assert_refused(self.run_driver(out, prm=self.tmp / "none.prm"), "none.prm")
        broken = self.tmp / "broken.prm"
        broken.write_text("subsection Model\n  set kind = fluid\nend\n")
        self.assert_refused(self.run_driver(out, prm=broken), "kind", "fluid", "two-scale")
        self.assert_refused(self.run_driver(out, "--restart"), "snapshot")
        out.mkdir()
        (out / "history.csv").write_text("precious")
        self.assert_refused(self.run_driver(out), str(out), "--force")
        self.assertEqual((out / "history.csv").read_text(), "precious")

    def test_parameter_files(self):
        """Every parameter file of the driver is read and valid: what is refused is only the missing snapshot."""
        files = sorted(FOLDER.glob("*.prm"))
        self.assertGreaterEqual(len(files), 3)
        for prm in files:
            with self.subTest(prm.name):
                self.assert_refused(self.run_driver(self.tmp / "run", "--restart", prm=prm), "snapshot")

    def test_read_only_folder(self):
        if os.geteuid() == 0:
            self.assert_refused(self.run_driver(Path("/proc/bergamo")), "/proc")
        else:
            self.tmp.chmod(0o500)
            self.assert_refused(self.run_driver(self.tmp / "run"), str(self.tmp))


class Failures(Case):
    def finished_packing(self):
        """A run that was stopped early, with its snapshot."""
        out = self.tmp / "run"
        stop_when((out / "parameters.prm").exists, self.command(out), signal.SIGINT)
        return out

    def test_damaged_and_foreign_snapshots(self):
        out = self.finished_packing()
        snapshot = out / "snapshot.h5"
        good = snapshot.read_bytes()
        damaged = bytearray(good)
        damaged[len(good) // 2] ^= 1
        for name, content in {"flipped bit": bytes(damaged), "half": good[: len(good) // 2], "text": b"hello" * 1000,
                              "empty": b""}.items():
            with self.subTest(name):
                snapshot.write_bytes(content)
                self.assert_refused(self.run_driver(out, "--restart"), "snapshot.h5", code=1)
                self.assertEqual(snapshot.read_bytes(), content)  # nothing touched
        snapshot.write_bytes(good)
        self.assert_refused(self.run_driver(out, "--restart", "--set", "Grains/friction=0.5"), "friction", "0.5")

    def test_full_disk(self):
        """A small file system of its own: one message, the last snapshot stays whole."""
        out = self.finished_packing()
        full = self.tmp / "full"
        full.mkdir()
        size = (out / "snapshot.h5").stat().st_size + 100_000
        inside = f"""mount -t tmpfs -o size={size} none {full} && cp {out}/* {full} || exit 99
            {shlex.join(self.command(full, "--restart"))}; status=$?
            cmp {out}/snapshot.h5 {full}/snapshot.h5 || exit 98
            exit $status"""
        result = subprocess.run(["unshare", "--map-root-user", "--mount", "bash", "-c", inside],
                                capture_output=True, text=True)
        if result.returncode == 99 or "unshare" in result.stderr:
            self.skipTest("this machine allows no mounts: " + result.stderr)
        self.assert_refused(result, str(full), "No space left", code=1)

    def test_diverging_run(self):
        """A time step that the start cannot know to be too long: the run ends with place and time, not with nonsense."""
        result = self.run_driver(self.tmp / "run", "--set", "Loading/time step=1.5e-6", "--set",
                                 "Loading/isotropic time=0.02")
        self.assert_refused(result, "diverged", "time step", code=1)
        self.assertIn("warning: Loading/time step is 1.5e-06 s", result.stderr)  # also with --quiet


if __name__ == "__main__":
    unittest.main(verbosity=2)
