"""What a release has: `release_test.py PROGRAM SOURCES` makes its site, and reads the files for GitHub and GitLab."""

import html.parser
import pathlib
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

import yaml

PROGRAM, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])


class Page(html.parser.HTMLParser):
    """Its places, links and pictures, and what no converter took for a list."""

    def __init__(self, text):
        super().__init__()
        self.places, self.targets, self.texts = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.places.add(values.get("id"))
        self.targets += [values[name] for name in ("href", "src") if values.get(name)]

    def handle_data(self, data):
        self.texts += [line for line in data.splitlines() if line.startswith(("- ", "| ---", "|---"))]


def faults_of(folder):
    """Links of a site that lead nowhere, as texts."""
    pages = {path.resolve(): Page(path.read_text()) for path in folder.rglob("*.html") if path.parent.name != "runs"}
    faults = []
    for path, page in pages.items():
        for target in page.targets:
            url = urllib.parse.urlsplit(target)
            other = (path.parent / url.path).resolve() if url.path else path
            if not url.scheme and (not other.exists() or (url.fragment and url.fragment not in pages[other].places)):
                faults.append(f"{path.relative_to(folder.resolve())}: {target} is not there")
        faults += [f"{path.relative_to(folder.resolve())}: '{text}' is shown as it is" for text in page.texts]
    return faults


class SiteTest(unittest.TestCase):
    def test_its_links_lead_to_pages_pictures_and_headings_and_every_document_is_there(self):
        with tempfile.TemporaryDirectory() as scratch:
            site = pathlib.Path(scratch, "site")
            subprocess.run([SOURCES / "apps/package/make_site", PROGRAM, SOURCES, site], check=True)
            self.assertEqual(faults_of(site), [])
            for page in ("index", "ARCHITECTURE", "apps/labs/latency", "apps/lab/study/paper/RESULTS", "runs/pages", "runs/rays", "runs/questions"):
                self.assertTrue((site / f"{page}.html").exists(), page)
            self.assertIn("runs/rays.html", (site / "index.html").read_text())

    def test_a_link_that_leads_nowhere_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "a.html").write_text('<a href="b.html">b</a><a href="#c">c</a><h1 id="d">d</h1><a href="a.html#d">d</a>')
            self.assertEqual(faults_of(pathlib.Path(folder)), ["a.html: b.html is not there", "a.html: #c is not there"])


class ContinuousIntegrationTest(unittest.TestCase):
    COMMANDS = ["tests/run", "apps/package/release release"]

    def check(self, lines):
        ours = [line for line in lines if not line.startswith(("apt-get update", "mv release/site "))]
        self.assertEqual(ours, self.COMMANDS)
        for command in ours:
            self.assertTrue((SOURCES / command.split()[0]).stat().st_mode & 0o100, command)

    def test_github_runs_the_tests_and_makes_a_release_of_a_tag(self):
        jobs = yaml.safe_load((SOURCES / ".github/workflows/dmpc.yml").read_text())["jobs"]
        self.check([step["run"] for name in ("test", "release") for step in jobs[name]["steps"] if "run" in step])
        self.assertEqual(jobs["release"]["needs"], "test")

    def test_gitlab_does_too(self):
        jobs = yaml.safe_load((SOURCES / ".gitlab-ci.yml").read_text())
        self.check([line for name in ("test", "release", "pages") for line in jobs[name]["script"]])
        self.assertEqual(jobs["release"]["needs"], ["test"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
