"""Figures of RESULTS.md files that stand behind "Recomputed:", rendered again: `recomputed_test.py PROGRAM SOURCES`.

A section with a table and a `dmpc render` command of `--runner=virtual` names three figures or more:

    Recomputed: 0.0084 s by `mount-6-t6 --machine=hdr`; 12,503 packets.by_kind.page_request.packets by `--resident=50`.

Each is of the section's first such command, in which the quoted words replace the scene and options of the same name. A figure in s or ms
is the virtual time, % a share; other names are paths in the file of --stats. Of several frames it is the mean of all but the first. Every
figure stands elsewhere in its section, too.
"""

import concurrent.futures
import functools
import json
import os
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])
NAMES = {"s": ("virtual_seconds.total", 1), "ms": ("virtual_seconds.total", 1000)}


def sections():
    """Their documents and lines, from each heading "## " to the next."""
    for document in sorted(SOURCES.glob("**/RESULTS.md")):
        if "build" not in document.relative_to(SOURCES).parts:
            for section in re.split(r"^(?=## )", document.read_text(), flags=re.MULTILINE)[1:]:
                yield f"{document.relative_to(SOURCES)}: {section.splitlines()[0]}", section


def command_of(section):
    """The words behind `dmpc render`, without the picture, or None."""
    found = re.search(r"^ {4}dmpc render (.*--runner=virtual.*) -o \S+(?: +#.*)?$", section, re.MULTILINE)
    return found and shlex.split(found[1])


def cells_of(section):
    """(figure, name, words) of each cell."""
    line = re.search(r"^Recomputed: (.*?)(?:\n\n|\Z)", section, re.MULTILINE | re.DOTALL)
    texts = line[1].replace("\n", " ").strip().split("; ") if line else []
    cells = [re.fullmatch(r"([\d.,]+) (.+?) by `(.+?)`\.?", text) for text in texts]
    if not all(cells):
        raise ValueError(f"expected 'Recomputed: FIGURE NAME by `OPTIONS`; ...', found: {line[0]}")
    return [cell.groups() for cell in cells]


def changed(command, words):
    def name(word):
        return word.split("=")[0] if word.startswith("--") else "scene"
    return tuple([word for word in command if name(word) not in map(name, words)] + list(words))


@functools.cache
def stats_of(words):
    with tempfile.TemporaryDirectory() as folder:
        frame = ".####" if any(word.startswith("--frames=") for word in words) else ""
        subprocess.run([PROGRAM, "render", *words, "--quiet", f"--stats={folder}/stats{frame}.json", "-o", f"{folder}/a{frame}.exr"],
                       check=True)
        return [json.loads(path.read_text()) for path in sorted(pathlib.Path(folder).glob("stats*.json"))[1 if frame else 0:]]


def as_written(figure, name, stats):
    """The value with as many digits behind the point as the figure has, and commas if that has some."""
    share = name.startswith("% ")
    path, factor = NAMES.get(name, (name[2:], 100) if share else (name, 1))
    value = statistics.mean(functools.reduce(lambda part, key: part[key], path.split("."), each) for each in stats) * factor
    text = f"{value:,.{len(figure.partition('.')[2])}f}"
    text = text if "," in figure else text.replace(",", "")
    return text[1:] if figure.startswith(".") and text.startswith("0.") else text


def faults_of(title, section, run=stats_of):
    """What is wrong with a section, as texts."""
    command, cells = command_of(section), cells_of(section)
    if cells and not command:
        return [f"{title}: recomputes figures, but has no command `dmpc render ... --runner=virtual ... -o FILE`"]
    if command and "\n|" in section and len(cells) < 3:
        return [f"{title}: has a table by a virtual render, and recomputes {len(cells)} of its figures, not three"]
    rest = re.sub(r"^Recomputed: .*?(?:\n\n|\Z)", "", section, flags=re.MULTILINE | re.DOTALL)
    faults = []
    for figure, name, words in cells:
        found = as_written(figure, name, run(changed(command, shlex.split(words))))
        if found != figure:
            faults.append(f"{title}: {figure} {name} by `{words}` is {found}")
        if figure not in re.findall(r"[\d.,]*\d", rest):
            faults.append(f"{title}: {figure} {name} by `{words}` stands nowhere else in the section")
    return faults


class RecomputedTest(unittest.TestCase):
    def test_every_figure_is_what_the_program_prints_today(self):
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for faults in pool.map(lambda section: faults_of(*section), sections()):
                for fault in faults:
                    with self.subTest():
                        self.fail(fault)

    def test_they_are_few(self):
        self.assertIn(sum(len(cells_of(section)) for _, section in sections()), range(12, 41))


class FaultsTest(unittest.TestCase):
    SECTION = """## Title
    dmpc render rings-4 --runner=virtual --nodes=8 -o a.png

| 8 nodes | 0.125 | 1,250 |

Recomputed: 0.125 s by `--nodes=4`; 125 ms by `tree-8`; 1,250 a.b by `--nodes=4`; 12.5 % c by
`tree-8`.
"""
    STATS = {"virtual_seconds": {"total": 0.125}, "a": {"b": 1250}, "c": 0.125}

    def faults(self, old, new):
        return faults_of("t", self.SECTION.replace(old, new), lambda words: [self.STATS])

    def test_words_replace_the_scene_and_options_of_the_same_name(self):
        command = command_of(self.SECTION)
        self.assertEqual(changed(command, ["tree-8"]), ("--runner=virtual", "--nodes=8", "tree-8"))
        self.assertEqual(changed(command, ["--nodes=4", "--x"]), ("rings-4", "--runner=virtual", "--nodes=4", "--x"))

    def test_a_figure_that_the_program_does_not_print_is_named(self):
        self.assertEqual(self.faults("| 1,250", "| 125 | 12.5 | 1,250"), [])
        self.assertIn("t: 0.126 s by `--nodes=4` is 0.125", self.faults("0.125", "0.126"))
        self.assertIn("t: 1,251 a.b by `--nodes=4` is 1,250", self.faults("1,250", "1,251"))

    def test_a_figure_that_stands_in_no_table_is_named(self):
        self.assertEqual(self.faults("", ""), [f"t: {cell} stands nowhere else in the section"
                                              for cell in ("125 ms by `tree-8`", "12.5 % c by `tree-8`")])

    def test_a_section_without_a_virtual_render_has_nothing_to_recompute_from(self):
        self.assertEqual(len(self.faults("virtual", "threads")), 1)

    def test_less_than_three_and_other_forms_are_refused(self):
        self.assertEqual(len(self.faults("; 1,250 a.b by `--nodes=4`; 12.5 % c by\n`tree-8`", "")), 1)
        with self.assertRaises(ValueError):
            self.faults(" by `tree-8`;", ";")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
