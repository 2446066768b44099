"""The labs' notebooks: `notebooks_test.py PROGRAM EXAMPLES SOURCES [unittest's words]`. Ends with 77 where packages are missing.

Solutions are executed from the first cell to the last; notebooks with blanks stop at the first of them."""

import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

PROGRAM, EXAMPLES, SOURCES = sys.argv[1:4]
LABS = pathlib.Path(SOURCES, "apps/labs")
sys.path.insert(0, str(LABS))
sys.dont_write_bytecode = True
from importlib.machinery import SourceFileLoader  # noqa: E402

import lab  # noqa: E402

make_notebooks, make_pages, pictures = (SourceFileLoader(name, str(LABS / name)).load_module()
                                        for name in ("make_notebooks", "make_pages", "pictures"))

try:
    import nbclient
    import nbformat
except ModuleNotFoundError as error:
    print(f"skipped: {error}; tests/run installs what is missing")
    sys.exit(77)

os.environ["PATH"] = os.pathsep.join([str(pathlib.Path(PROGRAM).parent), EXAMPLES, os.environ["PATH"]])
os.environ["PYTHONPATH"] = str(pathlib.Path(SOURCES, "apps/python"))
os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # of which the debugger of notebooks warns


def executed(cells):
    """The notebook after it has run in a folder of its own, and what its cells have printed."""
    notebook = nbformat.reads(json.dumps(cells), as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    return "".join(output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", []))


class NotebookTest(unittest.TestCase):
    def test_each_notebook_is_made_of_its_page_and_its_solutions(self):
        self.assertEqual(sorted(path.stem for path in (LABS / "notebooks").iterdir()), lab.NAMES)
        for name in lab.NAMES:
            self.assertEqual((LABS / "notebooks" / f"{name}.ipynb").read_text(), make_notebooks.text_of(lab.read(name)),
                             f"{name}: apps/labs/make_notebooks makes it anew")

    def test_each_notebook_is_a_notebook_with_blanks_and_without_solutions_or_outputs(self):
        for name in lab.NAMES:
            notebook = nbformat.read(LABS / "notebooks" / f"{name}.ipynb", as_version=4)
            nbformat.validate(notebook)
            code = [cell for cell in notebook.cells if cell.cell_type == "code"]
            self.assertTrue(any(re.search(r"(=|return) \.\.\.$", cell.source, re.MULTILINE) for cell in code), name)
            self.assertFalse(any("# blank" in cell.source or cell.outputs for cell in code), name)
            for question in lab.read(name).questions:
                self.assertNotIn(question.answer, "".join(cell.source for cell in notebook.cells))

    def test_each_page_has_two_pictures_or_more_and_all_are_there(self):
        shown = set()
        for name in lab.NAMES:
            pictures = [file for typed in lab.read(name).typed() for file, _ in typed.pictures]
            self.assertGreaterEqual(len(pictures), 2, name)
            self.assertEqual(len(pictures), (LABS / f"{name}.md").read_text().count("!["), name)
            for file in pictures:
                self.assertIn((LABS / file).read_bytes()[:4], (b"\x89PNG", b"<?xm", b"<svg"), file)
            shown.update(pictures)
        self.assertEqual({f"figures/{path.name}" for path in (LABS / "figures").iterdir()}, shown)

    def test_a_blank_is_a_line_whose_right_side_is_left_out(self):
        question = lab.Question("", code="a = 1\nb[0], c = f(2)  # blank\ndef g():\n    return 3  # blank\nassert a == 1\n")
        self.assertEqual(question.with_blanks(), "a = 1\nb[0], c = ...\ndef g():\n    return ...\nassert a == 1\n")

    def test_links_of_notebooks_lead_somewhere(self):
        places = [place for name in lab.NAMES for place in re.findall(r"\[[^]]+\]\(([^)]+?)(?:#[^)]*)?\)", "".join(
            "".join(cell["source"]) for cell in make_notebooks.notebook(lab.read(name))["cells"] if cell["cell_type"] == "markdown"))]
        self.assertIn("speedup.ipynb", places)
        for place in places:
            self.assertTrue((LABS / "notebooks" / place).exists(), place)

    def test_a_wrong_blank_is_told_with_what_was_expected_and_what_it_is(self):
        question = lab.Question("", code='a = 1  # blank\nc = 2\nassert a == c and {"x": a} != {}\nassert c == 3\n')
        self.assertEqual(question.blanks(), ["a"])
        cell = make_notebooks.explained(question.with_blanks().replace("...", "7"), question.blanks())
        with self.assertRaises(AssertionError) as raised:
            exec(cell)
        self.assertEqual(str(raised.exception), 'expected a == c and {"x": a} != {}, but a = 7')
        self.assertTrue(cell.endswith("assert c == 3, f'expected c == 3'\n"))

    def test_a_command_of_a_page_becomes_a_call_or_a_line_of_the_shell(self):
        typed = lab.Typed("dmpc study sweep balls-1 --nodes=3 --in-flight=1 --vary=page-size:512B,1KiB --columns=a.b,c")
        self.assertEqual(make_notebooks.words_of(typed, "frame_1"),
                         'frame_1 = dmpc.sweep("balls-1", nodes=3, in_flight=1, page_size=["512B", "1KiB"],\n'
                         '                     columns=["a.b", "c"])\nframe_1')
        self.assertEqual(make_notebooks.words_of(lab.Typed("for a in 1; do b; done"), ""), "!for a in 1; do b; done")


class PageTest(unittest.TestCase):
    def page(self, text, pages=None):
        return make_pages.page_of(text, pages or {}, LABS)

    def test_a_page_has_headings_paragraphs_commands_tables_and_questions(self):
        page = self.page("# Lab: <a>\n\n**Asked.** a `b<c` & d\n\n    dmpc x < y\n        z\n\n| a | b |\n|---|--:|\n| 1 | 2 |\n\n"
                         "1. Why?\n2. How,\n   then?\n")
        for part in ("<h1>Lab: &lt;a&gt;</h1>", "<p><b>Asked.</b> a <code>b&lt;c</code> &amp; d</p>", "<pre>dmpc x &lt; y\n    z</pre>",
                     '<th>a</th><th class="number">b</th>', '<td>1</td><td class="number">2</td>', '<p id="q1"><b>1.</b> Why?</p>',
                     '<p id="q2"><b>2.</b> How,\n   then?</p>'):
            self.assertIn(part, page)

    def test_stressed_words_lose_their_asterisks_and_products_keep_theirs(self):
        self.assertIn("<p><em>A fault</em>, an <em>x</em>. 2 * 3 * 4, a*b*c, <code>*p*</code></p>",
                      self.page("# L\n\n*A fault*, an *x*. 2 * 3 * 4, a*b*c, `*p*`\n"))

    def test_code_in_a_fence_stays_as_it_is_with_its_blank_lines(self):
        self.assertIn("<pre>a = 1\n\nb = `2`  # **x**\n</pre>", self.page("# L\n\n```python\na = 1\n\nb = `2`  # **x**\n```\n\n1. x\n"))

    def test_links_lead_to_labs_and_others_are_words(self):
        page = self.page("# L\n\nSee [the lab](balance.md) and [words](../../README.md#work).\n", {"balance.md": "balance.html"})
        self.assertIn('See <a href="balance.html">the lab</a> and words.', page)

    def test_pictures_are_within_the_page(self):
        page = self.page('# L\n\n![Who "waits"](figures/deadlock-circle.svg "circle")\n')
        self.assertIn('<img alt="Who &quot;waits&quot;" src="data:image/svg+xml;base64,PHN2Zy', page)

    def test_the_circle_is_drawn_from_the_words_of_a_standstill(self):
        drawn = pictures.circle("x\nin a circle: node 5 waits for node 7, that for node 6, that for node 5\n")
        self.assertEqual(re.findall(r'middle">(\d+)<', drawn), ["5", "7", "6"])
        self.assertEqual(drawn.count("<line "), 3)
        with self.assertRaisesRegex(ValueError, "nobody told a circle"):
            pictures.circle("64 items have come\n")


class SolvedTest(unittest.TestCase):
    def test_blanks_stop_a_notebook(self):
        for name in ("latency", "deadlock"):
            with self.assertRaises(nbclient.exceptions.CellExecutionError):
                executed(make_notebooks.notebook(lab.read(name)))


def solved(name):
    def test(self):
        one = lab.read(name)
        printed = [line.rstrip() for line in executed(make_notebooks.notebook(one, with_solutions=True)).splitlines()]
        for question in one.questions:
            for line in question.shown.splitlines():
                self.assertIn(line.rstrip(), printed)
    return test


for each in lab.NAMES:
    setattr(SolvedTest, f"test_the_solutions_of_{each}_hold", solved(each))

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
