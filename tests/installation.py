#!/usr/bin/env python3
"""The grains installed: a project of its own finds them, builds with them and runs, with no deal.II; the installed Python
package imports.

Usage: installation.py CMAKE BUILD_FOLDER
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CONSUMER = Path(__file__).resolve().parent / "consumer"
CMAKE, BUILD = sys.argv.pop(1), sys.argv.pop(1)


def run(*words, **options):
    return subprocess.run([*map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.tmp = Path(cls.folder.name)
        cls.prefix = cls.tmp / "a prefix"
        for component in ("dem", "python"):
            done = run(CMAKE, "--install", BUILD, "--prefix", cls.prefix, "--component", component)
            if done.returncode:
                raise AssertionError(done.stdout)

    def configure(self, name, *settings):
        return run(CMAKE, "-S", CONSUMER, "-B", self.tmp / name, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                   "-DCMAKE_BUILD_TYPE=Release", *settings)

    def test_the_grains_without_deal_ii(self):
        done = self.configure("consumer", "-DCMAKE_DISABLE_FIND_PACKAGE_deal.II=ON")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = run(CMAKE, "--build", self.tmp / "consumer", "-j", "1")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = run(self.tmp / "consumer" / "two_grains")
        self.assertEqual((done.returncode, done.stdout), (0, "velocities -0.25 and 0.5 m/s\n"))

    def test_nothing_of_the_checkout_is_named(self):
        source = str(CONSUMER.parents[1])
        for path in self.prefix.rglob("*.cmake"):
            self.assertNotIn(source, path.read_text(), path)

    def test_other_packs_and_missing_components_are_refused(self):
        config = next(self.prefix.rglob("BergamoConfig.cmake"))
        text = config.read_text()
        self.addCleanup(config.write_text, text)
        config.write_text(text.replace("size() == ", "size() == 1"))
        done = self.configure("packs")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("was built for packs", done.stdout)
        config.write_text(text)
        project = self.tmp / "continuum" / "CMakeLists.txt"
        project.parent.mkdir()
        project.write_text("cmake_minimum_required(VERSION 3.22)\nproject(One LANGUAGES CXX)\n"
                           "find_package(Bergamo REQUIRED COMPONENTS fe)\n")
        done = run(CMAKE, "-S", project.parent, "-B", project.parent / "build", "-G", "Ninja",
                   f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("its component fe is not installed below", " ".join(done.stdout.split()))

    def test_the_package_in_python(self):
        package = next(self.prefix.rglob("bergamo/__init__.py")).parents[1]
        self.assertTrue((package / "bergamo" / "export" / "states" / "glyphs.py").is_file())  # read by export
        done = run("/usr/bin/python3", "-B", "-m", "bergamo", "show", self.tmp / "nowhere", cwd=self.tmp,
                   env={**os.environ, "PYTHONPATH": str(package)})
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("nowhere: no such folder of a run", done.stdout)


if __name__ == "__main__":
    unittest.main()
