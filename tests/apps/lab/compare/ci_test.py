"""The examples for continuous integration: `ci_test.py PROGRAM EXAMPLES`. Ends with 77 where python3-yaml is missing."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, EXAMPLES = sys.argv[1], pathlib.Path(sys.argv[2])
try:
    import yaml
except ModuleNotFoundError as error:
    print(f"skipped: {error}; tests/run installs what is missing")
    sys.exit(77)


def github_lines():
    """What each step runs, by the shell that GitHub has for it."""
    job = yaml.safe_load((EXAMPLES / "github.yml").read_text())["jobs"]["compare"]
    return [("sh", "-e", "-c", step["run"]) for step in job["steps"] if "run" in step]


def gitlab_lines():
    job = yaml.safe_load((EXAMPLES / "gitlab-ci.yml").read_text())["compare"]
    return [("sh", "-e", "-c", line) for line in [*job["before_script"], *job["script"]]]


class ExamplesTest(unittest.TestCase):
    """Each example's lines in a repository of their own, as far as they need no package manager."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.repository = pathlib.Path(folder.name, "repository")
        self.repository.mkdir()
        programs = pathlib.Path(folder.name, "programs")
        programs.mkdir()
        (programs / "dmpc").symlink_to(PROGRAM)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}

    def status(self, lines):
        """Of the first that fails, as both systems have it; installation is left out."""
        for line in lines:
            if "apt-get" not in line[-1]:
                done = subprocess.run(line, cwd=self.repository, env=self.environment, capture_output=True)
                if done.returncode != 0:
                    return done.returncode
        return 0

    def accept(self):
        shutil.copytree(self.repository / "measured", self.repository / "baseline", dirs_exist_ok=True)

    def test_both_install_the_package_before_anything_else(self):
        for lines in (github_lines(), gitlab_lines()):
            self.assertIn("apt-get install -y ./packages/dmpc_", lines[0][-1])
            self.assertGreaterEqual(sum("dmpc compare" in line[-1] for line in lines), 1)

    def test_a_run_fails_without_a_baseline_passes_with_its_own_and_fails_where_something_got_worse(self):
        for lines in (github_lines(), gitlab_lines()):
            with self.subTest(lines=lines):
                shutil.rmtree(self.repository / "baseline", ignore_errors=True)
                self.assertEqual(self.status(lines), 1)
                self.accept()
                self.assertEqual(self.status(lines), 0)
                self.change(lambda counters: counters["virtual_seconds"].update(total=counters["virtual_seconds"]["total"] * 1.01))
                self.assertEqual(self.status(lines), 0)
                self.change(lambda counters: counters["virtual_seconds"].update(total=counters["virtual_seconds"]["total"] / 1.05))
                self.assertEqual(self.status(lines), 5)
                self.change(lambda counters: counters["pages"].update(faults=round(counters["pages"]["faults"] / 1.2)))
                self.assertEqual(self.status(lines), 5)
                self.change(lambda counters: counters["rays"].update(total=counters["rays"]["total"] + 1))
                self.assertEqual(self.status(lines), 5)
                self.assertIn("rays.total", (self.repository / "measured/both.html").read_text())

    def test_another_picture_fails(self):
        lines = gitlab_lines()
        self.status(lines)
        self.accept()
        subprocess.run([PROGRAM, "render", "rings-3-t1", "--resolution=64x64", "--ambient=0.3", "--quiet", "-o", "baseline/rings.exr"],
                       cwd=self.repository, check=True)
        self.assertEqual(self.status(lines), 5)

    def change(self, changed):
        """The counters of the baseline's page, from a run as it was measured."""
        page = (self.repository / "measured/rings.html").read_text()
        before, data, after = re.fullmatch(r'(.*<script type="application/json" id="data">)(.*?)(</script>.*)', page, re.DOTALL).groups()
        values = json.loads(data)
        changed(values["stats"])
        (self.repository / "baseline/rings.html").write_text(before + json.dumps(values).replace("<", "\\u003c") + after)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
