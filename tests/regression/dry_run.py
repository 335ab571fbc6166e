#!/usr/bin/env python3
"""What every driver tells of a run before it starts, beside the run; warnings of unusual values; --help of a parameter.

Usage: dry_run.py FOLDER_OF_PROGRAMS [TOPIC]
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAMS = Path(sys.argv.pop(1)).resolve()
ROOT = Path(__file__).resolve().parents[2]
DRIVERS = sorted(path.parent.name for path in ROOT.glob("drivers/*/main.cc"))
SIZES = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
sys.path.insert(0, str(ROOT / "drivers" / "python"))

from bergamo.parameters import parse_parameters, read_parameters  # noqa: E402


class Case(unittest.TestCase):
    def setUp(self):
        self.tmp = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.tmp, True)

    def run_driver(self, driver, *words):
        return subprocess.run([str(PROGRAMS / driver), *map(str, words), "--threads", "1"], capture_output=True, text=True,
                              cwd=self.tmp)

    def forecast(self, driver, *words):
        """Its text, by the first words of its lines; a line that has none goes on with the one above."""
        result = self.run_driver(driver, *words, "--dry-run")
        self.assertEqual((result.returncode, result.stderr), (0, ""), driver)
        lines = {}
        for line in result.stdout.splitlines():
            self.assertLess(len(line), 200)
            name = line[:13].strip() or name
            lines.setdefault(name, []).append(line[13:])
        self.assertEqual(os.listdir(self.tmp), [], driver)  # nothing is written
        return lines

    def smoke(self, driver):
        path = ROOT / "drivers" / driver / "smoke.prm"
        return path if path.exists() else path.with_name(f"{driver}.prm")


def number_in(text):
    return float(re.search(r"[\d.]+", text)[0])


def bytes_in(text):
    found = re.search(r"about ([\d.e+]+) (kB|MB|GB)", text)
    return float(found[1]) * SIZES[found[2]]


class Forecasts(Case):
    def test_every_driver_tells_what_a_run_would_be_and_writes_nothing(self):
        self.assertGreater(len(DRIVERS), 12)
        for driver in DRIVERS:
            with self.subTest(driver):
                told = self.forecast(driver, self.smoke(driver), "--output", "results/out")
                for name in ("memory", "disk"):
                    self.assertGreater(bytes_in(told[name][0]), 0)
                self.assertIn("in results/out", told["disk"][0])
                if driver != "fit_mohr_coulomb":  # which makes no steps
                    self.assertTrue("grains" in told or "elements" in told)
                    self.assertGreater(number_in(told["steps"][0]), 0)
                    self.assertIn("half to twice as long", told["time"][0])

    def test_clumps(self):
        told = self.forecast("rve_triaxial", ROOT / "drivers" / "rve_triaxial" / "clumps.prm")
        self.assertGreater(number_in(told["grains"][0]), 0)

    def compare(self, driver, steps, *words):
        """Grains, elements, steps and size of the files as a run has them. @param steps of the forecast's lines"""
        told = self.forecast(driver, *words)
        result = self.run_driver(driver, *words, "--output", "run", "--quiet", "--no-plots")
        self.assertEqual(result.returncode, 0, result.stderr)
        figures = json.loads((self.tmp / "run" / "summary.json").read_text())
        if figures["particles"] > 1:
            self.assertEqual(number_in(told["grains"][0]), figures["particles"])
        if "elements" in told:
            self.assertEqual(number_in(told["elements"][0]), figures["elements"])
        self.assertAlmostEqual(number_in(told["steps"][steps]), figures["steps"], delta=2)
        size = sum(path.stat().st_size for path in (self.tmp / "run").rglob("*") if path.is_file())
        self.assertTrue(0.5 < bytes_in(told["disk"][0]) / size < 2, (told["disk"], size))

    def test_elements_of_a_footing(self):
        self.compare("strip_footing", 0, self.smoke("strip_footing"))

    def test_a_beam(self):
        self.compare("beam_impact", 0, self.smoke("beam_impact"))

    def test_grains_that_settle(self):
        short = ["Sand/Settling/time=2e-3", "Penetration/depth=1e-4", "Penetration/start time=1e-3"]
        self.compare("penetration", 2, self.smoke("penetration"), *(word for one in short for word in ("--set", one)))


class Warnings(Case):
    def test_values_in_other_units(self):
        footing = self.smoke("strip_footing")
        result = self.run_driver("strip_footing", footing, "--set", "Continuum/density=1.8", "--output", "run", "--quiet",
                                 "--no-plots", "--set", "Footing/loading time=0.01", "--set", "Footing/settlement=1e-4")
        self.assertEqual(result.returncode, 0, result.stderr)
        warning = next(line for line in result.stderr.splitlines() if "density" in line)
        self.assertRegex(warning, r'\Awarning: Continuum/density is 1\.8 kg/m3 \(--set ".*"\), where 500 to 5000 kg/m3 is '
                                  r"usual; did you mean 1800 kg/m3 \(1\.8 g/cm3\)\?\Z")
        figures = json.loads((self.tmp / "run" / "summary.json").read_text())
        self.assertIn(warning, [f"warning: {text}" for text in figures["warnings"]])

    def test_values_that_are_unwise_beside_others(self):
        for driver, setting, text in (
                ("penetration", "Penetration/time step=1e-9", "Penetration/time step is 1e-09 s"),
                ("two_scale_triaxial", "Coupling/penalty=1e6", "both models may drift apart")):
            result = self.run_driver(driver, self.smoke(driver), "--dry-run", "--set", setting)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stderr, rf"\Awarning: .*{text}.* usual.*\n\Z")

    def test_no_parameter_file_of_the_project_has_one(self):
        """Nor a default. By the ranges that the programs print; what they say of values together is asked above."""
        files = [path for path in ROOT.glob("drivers/*/*.prm")]
        self.assertGreater(len(files), 30)
        n_checked = 0
        known = {driver: parse_parameters(self.run_driver(driver, "--print-parameters").stdout).flat() for driver in DRIVERS}
        for driver in DRIVERS:
            for path, parameter in known[driver].items():
                n_checked += self.check_usual(driver, path, parameter.text, parameter.usual)
        for file in files:
            driver = file.parent.name if file.name != "periodic_cell.prm" else "rve_triaxial"
            for path, given in read_parameters(file).flat().items():
                self.assertIn(path, known[driver], file)
                n_checked += self.check_usual(file, path, given.text, known[driver][path].usual)
        self.assertGreater(n_checked, 300)

    def check_usual(self, where, path, text, usual):
        """@return whether there was a range to check"""
        if not usual:
            return False
        lowest, highest = map(float, re.fullmatch(r"(\S+) to (\S+)", usual).groups())
        for number in filter(None, (part.strip() for part in text.split(","))):
            self.assertTrue(float(number) == 0 or lowest <= float(number) <= highest, f"{where}: {path} = {text}")
        return True


class Help(Case):
    def test_a_parameter_with_its_value_in_force(self):
        path = self.smoke("strip_footing")
        result = self.run_driver("strip_footing", path, "--help", "Footing/settlement")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"\AFooting/settlement\n  at the end\n  unit +m\n")
        self.assertRegex(result.stdout, r"  default +0\.03 m\n  in force +0\.03 m, set by smoke\.prm line \d\n\Z")
        self.assertEqual(os.listdir(self.tmp), [])

    def test_a_misspelt_one(self):
        result = self.run_driver("strip_footing", "--help", "Footing/setlement")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("did you mean 'Footing/settlement'", result.stderr)

    def test_the_whole_program(self):
        for words in (["--help"], [self.smoke("strip_footing"), "-h"], ["--help", self.smoke("strip_footing")]):
            result = self.run_driver("strip_footing", *words)
            self.assertEqual(result.returncode, 0)
            self.assertIn("--dry-run", result.stdout)
            self.assertIn("[Section/Name]", result.stdout)


class PrintedParameters(Case):
    def test_they_are_those_in_force_and_give_the_same_again(self):
        first, second = (os.path.join(self.tmp, name) for name in ("first.prm", "second.prm"))
        given = [self.smoke("strip_footing"), "--set", "Footing/settlement=0.0123"]
        for name, words in ((first, given), (second, [first])):
            result = self.run_driver("strip_footing", *words, "--print-parameters")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            Path(name).write_text(result.stdout)
        self.assertEqual(Path(first).read_text(), Path(second).read_text())
        printed = read_parameters(first).flat()
        self.assertEqual(printed["Footing/settlement"].text, "0.0123")
        for path, parameter in read_parameters(self.smoke("strip_footing")).flat().items():
            if path != "Footing/settlement":
                self.assertEqual(float(printed[path].text), float(parameter.text), path)

    def test_a_mistake_in_what_is_given_is_told(self):
        result = self.run_driver("strip_footing", "--set", "Footing/setlement=1", "--print-parameters")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("Footing/settlement", result.stderr)


if __name__ == "__main__":
    unittest.main()
