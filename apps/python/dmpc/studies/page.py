"""Pages of studies: one file, for light and dark screens and for paper, without scripts."""

import html
import importlib.util

from . import plots

_HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
:root {{ color-scheme: light dark; --ink: #222; --paper: #fff; --faint: #777; --line: #ccc }}
@media (prefers-color-scheme: dark) {{ :root {{ --ink: #ddd; --paper: #17191c; --faint: #999; --line: #444 }} }}
@media print {{ :root {{ --ink: #000; --paper: #fff }} }}
body {{ font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); max-width: 62rem;
  margin: 2rem auto; padding: 0 1rem }}
h1 {{ font-size: 1.6rem }} h2 {{ font-size: 1.15rem; margin-top: 2.2rem }}
p.first {{ font-size: 1.15rem }}
img, svg {{ max-width: 100%; height: auto }}
pre {{ overflow-x: auto; font-size: .8rem; border-left: 3px solid var(--line); padding: .3rem .6rem; white-space: pre-wrap;
  overflow-wrap: anywhere }}
div.wide {{ overflow-x: auto }} table {{ border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums }}
td, th {{ padding: .15rem .6rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top }}
.note {{ color: var(--faint); font-size: .85rem }}
</style></head><body>
<h1>{title}</h1>
"""


def document(title, parts):
    """Of parts in HTML, which are written below the title."""
    return "\n".join([_HEAD.format(title=html.escape(title)), *parts, "</body></html>"])


def rows(heads, rows):
    head = "".join(f"<th>{html.escape(each)}" for each in heads)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(str(each))}" for each in row) for row in rows)
    return f"<div class=wide><table><tr>{head}{body}</table></div>"


def heading(text):
    return f"<h2>{html.escape(text)}</h2>"


def paragraph(text, kind=""):
    return f"<p{f' class={kind}' if kind else ''}>{html.escape(text)}</p>"


def of_table(table, drawn):
    """A table with its notes, below its plots, where there is matplotlib to draw them."""
    pictures = [plots.draw(plot, table, True) for plot in drawn] if importlib.util.find_spec("matplotlib") else []
    return document(table.title, [*pictures, rows([column.header for column in table.columns], map(table.texts, table.rows)),
                                  *(paragraph(note, "note") for note in table.notes)])
