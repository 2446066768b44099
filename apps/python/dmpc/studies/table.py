"""Tables of results: rows under named columns, as Markdown, CSV or JSON in the form that dmpc's own tables have."""

import json
import math
import re
from dataclasses import dataclass

from .. import program
from .texts import folded

FORMATS = ("markdown", "csv", "json", "jsonl")
WIDTH = 120  # of a line of Markdown
_SHOWN = 79  # letters of a row that is shown by itself


@dataclass(frozen=True)
class Column:
    name: str
    unit: str = ""
    digits: int = 0  # of floats, in Markdown
    is_heading: bool = False  # of a first column: in Markdown rows with the same text stand below it

    @property
    def header(self):
        return f"{self.name} ({self.unit})" if self.unit else self.name

    @property
    def key(self):
        return self.name.replace(" ", "_")


class Table:
    """`rows` are lists of None, texts, integers and finite floats; `shown` is called with the text of each row that is added."""

    def __init__(self, title, columns, shown=lambda text: None):
        self.title, self.columns, self.rows, self.notes = title, tuple(columns), [], []
        self._shown = shown

    def add(self, row):
        row = list(row)
        if len(row) != len(self.columns):
            raise ValueError(f"the row has {len(row)} cells, expected {len(self.columns)}: {row}")
        if any(isinstance(cell, float) and not math.isfinite(cell) for cell in row):
            raise ValueError(f"the row has a number that is not finite: {row}")
        self.rows.append(row)
        self._shown(self._row_text(row))

    def note(self, sentence):
        self.notes.append(sentence)

    def value(self, row, name):
        """The cell in the column of this name."""
        return row[[column.name for column in self.columns].index(name)]

    def named_rows(self):
        """The rows as dictionaries by the columns' names."""
        return [dict(zip((column.name for column in self.columns), row)) for row in self.rows]

    def texts(self, row):
        """The row's cells for people."""
        return [_text(*each) for each in zip(self.columns, row)]

    def text(self, form):
        return {"markdown": self._markdown, "csv": self._csv, "json": self._json, "jsonl": self._json_lines}[form]()

    def _row_text(self, row):
        """Names and cells, as many as fit on a line."""
        text = ""
        for column, cell in zip(self.columns, row):
            more = (", " if text else "") + f"{column.header} {_markdown_cell(column, cell)}"
            if cell is not None and len(text) + len(more) <= _SHOWN:
                text += more
        return text

    def _markdown(self):
        parts = [folded(f"**{self.title}**", WIDTH) + "\n"]
        if self.columns and self.columns[0].is_heading:
            for name in dict.fromkeys(row[0] for row in self.rows):
                rows = [row[1:] for row in self.rows if row[0] == name]
                parts += ["\n" + folded(f"**{self.columns[0].name} {name}**", WIDTH) + "\n", _markdown_rows(self.columns[1:], rows)]
        else:
            parts.append(_markdown_rows(self.columns, self.rows))
        parts += ["\n"] if self.notes else []
        return "".join(parts + [folded("- " + note, WIDTH) + "\n" for note in self.notes])

    def _csv(self):
        lines = [[_quoted(column.header) for column in self.columns], *([_csv_cell(cell) for cell in row] for row in self.rows)]
        return "".join(",".join(line) + "\n" for line in lines)

    def _objects(self):
        return [{column.key: cell for column, cell in zip(self.columns, row)} for row in self.rows]

    def _json(self):
        columns = [{"name": column.key, "unit": column.unit or None} for column in self.columns]
        whole = {"format": program.FORMAT, "title": self.title, "columns": columns, "rows": self._objects(), "notes": self.notes}
        return json.dumps(whole, indent=2, ensure_ascii=False) + "\n"

    def _json_lines(self):
        return "".join(json.dumps(row, separators=(",", ":"), ensure_ascii=False) + "\n" for row in self._objects())


def _text(column, cell):
    if cell is None or isinstance(cell, str):
        return cell or ""
    return f"{cell:,}" if isinstance(cell, int) else f"{cell:.{column.digits}f}"


def _markdown_cell(column, cell):
    return re.sub(r"[\n\r]", " ", _text(column, cell).replace("|", r"\|"))


def _markdown_rows(columns, rows):
    """In parts that fit a line, each of which begins with the columns that tell the rows apart."""
    lines = [[column.header.replace("|", r"\|") for column in columns],
             *([_markdown_cell(*each) for each in zip(columns, row)] for row in rows)]
    is_text = [any(isinstance(row[at], str) for row in rows) for at in range(len(columns))]
    key = _key_count(lines)
    if _width(lines, range(len(columns))) > WIDTH and _width(lines, range(key)) > WIDTH / 2:
        lines = [[name, *line] for name, line in zip(["row", *map(str, range(1, len(lines)))], lines)]
        is_text.insert(0, False)
        key = 1
    text = ""
    for part in _parts(lines, key):
        widths = [max(len(line[at]) for line in lines) for at in part]
        rule = "|" + "".join("-" * (width + 1) + ("-|" if is_text[at] else ":|") for at, width in zip(part, widths))
        filled = ["|" + "".join(f" {line[at]:{'<' if is_text[at] else '>'}{width}} |" for at, width in zip(part, widths)) for line in lines]
        text += "\n" + "\n".join([filled[0], rule, *filled[1:]]) + "\n"
    return text


def _width(lines, part):
    return 1 + sum(3 + max(len(line[at]) for line in lines) for at in part)


def _key_count(lines):
    """The fewest columns from the left by which all lines differ, or all columns."""
    return next((count for count in range(1, len(lines[0])) if len({tuple(line[:count]) for line in lines}) == len(lines)), len(lines[0]))


def _parts(lines, key):
    columns = list(range(len(lines[0])))
    if _width(lines, columns) <= WIDTH:
        return [columns]
    parts = [columns[:key]]
    for column in columns[key:]:
        if len(parts[-1]) > key and _width(lines, [*parts[-1], column]) > WIDTH:
            parts.append(columns[:key])
        parts[-1].append(column)
    return parts


def _quoted(text):
    return '"' + text.replace('"', '""') + '"' if re.search('[,"\r\n]', text) else text


def _csv_cell(cell):
    """Spreadsheets would run a text that begins as a formula does, unless an apostrophe stands before it."""
    if isinstance(cell, str):
        is_formula = re.match(r"[=@\t\r]|[+-](?=.*[^0-9.,eE+%-])", cell, re.DOTALL)
        return _quoted(("'" if is_formula else "") + cell)
    return "" if cell is None else str(cell) if isinstance(cell, int) else shortest(cell)


def shortest(value):
    """The shortest text that reads back as the same number: 0.25, 5e-04."""
    sign, digits, point = _decimal(value)
    short = f"{digits[0]}{'.' if digits[1:] else ''}{digits[1:]}e{point - 1:+03d}"
    if point <= 0:
        plain = "0." + "0" * -point + digits
    elif point < len(digits):
        plain = digits[:point] + "." + digits[point:]
    else:
        plain = f"{abs(value):.0f}"
    return sign + (plain if len(plain) <= len(short) or digits == "0" else short)


def _decimal(value):
    """Sign, digits, and the number of digits before the point."""
    mantissa, exponent = f"{value!r}e0".split("e")[:2]
    whole, _, fraction = mantissa.lstrip("-").partition(".")
    fraction = fraction.rstrip("0")
    digits = (whole + fraction).lstrip("0")
    point = int(exponent) + len(whole) - (len(whole + fraction) - len(digits))
    return "-" if mantissa.startswith("-") else "", digits.rstrip("0") or "0", point if digits else 1
