"""The study's report: its folder of Markdown, tables, plots, hashes and an archive of them all, and its page."""

import hashlib
import zipfile

from ..studies import page
from ..studies.plots import draw
from ..studies.table import WIDTH
from ..studies.texts import folded
from . import plots
from .conclusions import conclusion
from .summary import TITLE

HASHES, ARCHIVE = "SHA256SUMS", "paper.zip"


class Report:
    """`texts` are paragraphs, `tables` have names for their files."""

    def __init__(self, texts, tables):
        self.texts, self.tables, self.drawn = list(texts), tables, {}
        try:
            self.drawn = {plot.name: draw(plot, table, True) for name, table in tables.items() for plot in plots.PLOTS.get(name, ())}
            self.complaint = ""
        except ModuleNotFoundError as error:
            self.complaint = f"the plots are not drawn: there is no {error.name}: apt-get install python3-matplotlib"

    def markdown(self, has_pictures=False):
        texts = [*self.texts, *([f"Note: {self.complaint}."] if self.complaint else [])]
        parts = [f"# {TITLE}\n", *(folded(text, WIDTH, "") + "\n" for text in texts)]
        for name, table in self.tables.items():
            parts.append(table.text("markdown"))
            parts += [f"![{plot.title}]({plot.name}.svg)\n" for plot in self._plots(name) if has_pictures]
        return "\n".join(parts)

    def html(self):
        parts = [page.paragraph(text, "" if at else "first") for at, text in enumerate(self.texts)]
        for name, table in self.tables.items():
            parts += [page.heading(table.title), page.paragraph(conclusion(name, table))]
            parts += [self.drawn[plot.name] for plot in self._plots(name)]
            parts += [page.rows([column.header for column in table.columns], map(table.texts, table.rows)),
                      *(page.paragraph(note, "note") for note in table.notes)]
        return page.document(TITLE, parts)

    def _plots(self, table):
        return [plot for plot in plots.PLOTS.get(table, ()) if plot.name in self.drawn]

    def files(self):
        """Texts by the names of their files."""
        files = {f"{name}.{form}": table.text(form) for name, table in self.tables.items() for form in ("csv", "json")}
        files |= {f"{name}.svg": svg for name, svg in self.drawn.items()}
        files |= {"report.md": self.markdown(has_pictures=True), "index.html": self.html()}
        files[HASHES] = "".join(f"{hashlib.sha256(text.encode()).hexdigest()}  {name}\n" for name, text in files.items())
        return files

    def write(self, folder):
        """Raises OSError."""
        files = self.files()
        for name, text in files.items():
            (folder / name).write_text(text)
        with zipfile.ZipFile(folder / ARCHIVE, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, text in files.items():
                # Without a date, so that equal files give equal archives.
                archive.writestr(zipfile.ZipInfo(f"paper/{name}"), text, zipfile.ZIP_DEFLATED)
