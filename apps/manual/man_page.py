"""The manual page, in the language of man(7)."""

from declared import leaves, value_alone

DESCRIPTION = (
    "dmpc emulates a distributed-memory parallel computer on this machine and renders on it. N nodes, usually one thread each, with strictly "
    "bounded memories of their own, share nothing and communicate only by messages; scenes need not fit into the memory of any of them. Either "
    "pages of the scene's database travel to the nodes whose rays need them, or rays travel to the nodes that have the part of space through "
    "which they pass. Everything that travels is counted, and the picture is the same to the last bit.")
VARIABLES = {"TMPDIR": "Folder of temporary files; /tmp if not set.",
             "NO_COLOR": "Always respected: dmpc never writes in colour. Progress is shown on terminals only."}
SOURCE_COLUMNS = 78
# Characters that mean something in roff, or that a printer replaces; a line may end behind |.
ESCAPES = str.maketrans({"\\": "\\(rs", "-": "\\-", "'": "\\(aq", "`": "\\(ga", "^": "\\(ha", "~": "\\(ti", '"': "\\(dq", "|": "|\\:"})


def roff(text):
    """The text so that it is printed literally, on any line, and can be typed when copied from the page."""
    return "\n".join(("\\&" if line.startswith(".") else "") + line.translate(ESCAPES) for line in text.split("\n"))


def wrapped(line):
    """The line, escaped and cut at blanks such that sources stay readable; one line if it is empty."""
    parts = [""]
    for word in map(roff, line.split()):
        if parts[-1] and len(parts[-1]) + 1 + len(word) > SOURCE_COLUMNS:
            parts.append("")
        parts[-1] += (" " if parts[-1] else "") + word
    return parts


def highlighted(term, rest):
    return (f"\\fB{roff(term)}\\fP" if term else "") + (f"\\fI{roff(rest)}\\fP" if rest else "") + "\n"


class Page:
    """A page, written from top to bottom. Texts are given literally, with line ends where lines are to end."""

    def __init__(self, title, source):
        self.text = f'.TH "{roff(title)}" 1 "" "{roff(source)}" "User Commands"\n.ad l\n.nh\n'
        self._is_begun = True  # a section or part has begun, which begins a paragraph

    def begin(self, request, title):
        """A section (SH) or part (SS)."""
        self.text += f'.{request} "{roff(title)}"\n'
        self._is_begun = True

    def add_text(self, text):
        self.text += ".br\n".join("".join(part + "\n" for part in wrapped(line)) for line in text.splitlines())

    def _begin_paragraph(self):
        self.text += "" if self._is_begun else ".PP\n"
        self._is_begun = False

    def add_paragraph(self, text):
        self._begin_paragraph()
        self.add_text(text)

    def add_heading(self, text):
        self._begin_paragraph()
        self.text += f'.I "{roff(text)}"\n'

    def add_call(self, term, rest):
        """A line of a synopsis: `term` in bold, `rest` after it in italics."""
        self.text += ("" if self._is_begun else ".br\n") + highlighted(term, rest)
        self._is_begun = False

    def add_entry(self, term, rest, text):
        """As a call, with `text` indented below."""
        self.text += ".TP\n" + highlighted(term, rest)
        self._is_begun = False
        self.add_text(text)

    def add_lines(self, text):
        """Lines that keep their breaks and blanks."""
        self._begin_paragraph()
        self.text += ".nf\n" + "".join((roff(line) or "\\&") + "\n" for line in text.splitlines()) + ".fi\n"


def usage(command):
    """ " SCENE -o IMAGE [OPTION]..."."""
    words = [argument["value"] + ("..." if argument["is_list"] else "") for argument in command["arguments"]]
    parts = [word if argument["is_required"] else f"[{word}]" for word, argument in zip(words, command["arguments"])]
    parts += [f"{option['names'][0]} {value_alone(option)}" for option in command["options"] if option["is_required"]]
    return "".join(" " + part for part in [*parts, "[OPTION]..."])


def is_call(line):
    return line.startswith("  dmpc ")


def remarks(command):
    """The end of the command's help without its calls and the line that announces them, by paragraphs."""
    lines = ["" if is_call(line) or line == "Examples:" else line + "\n" for line in command["examples"].splitlines()]
    paragraphs = [""]
    for line, original in zip(lines, command["examples"].splitlines()):
        if not original and paragraphs[-1]:
            paragraphs.append("")
        paragraphs[-1] += line if original else ""
    return paragraphs if paragraphs[-1] else paragraphs[:-1]


def add_options(page, path, command, known):
    """An option that another command explains, too, is explained by the first alone; `known` is a list of options with their commands."""
    elsewhere = []
    group = command["options"][0]["group"]
    for option in command["options"]:
        same = [where for each, where in known if all(each[key] == option[key] for key in ("names", "value", "text"))]
        if option["names"][-1] == "--help":
            continue
        if same:
            if not elsewhere or elsewhere[-1][0] != same[0]:
                elsewhere.append((same[0], []))
            elsewhere[-1][1].append(option["names"][-1])
            continue
        if option["group"] != group:
            group = option["group"]
            page.add_heading(group)
        add_option(page, option, path, known)
    for where, names in elsewhere:
        page.add_paragraph(f"As in dmpc {where}: {', '.join(names)}.")


def add_option(page, option, path, known):
    known.append((option, path))
    page.add_entry(", ".join(option["names"]), "=" + option["value"] if option["value"] else "", option["text"])


def add_command(page, path, command, known):
    page.begin("SS", f"dmpc {path}")
    page.add_paragraph(command["text"] + ".")
    for argument in command["arguments"]:
        page.add_entry("", argument["value"], argument["text"])
    add_options(page, path, command, known)
    for remark in remarks(command):
        if "  " in remark:  # a table, whose breaks of lines mean something
            page.add_lines(remark)
        else:
            page.add_paragraph(" ".join(remark.splitlines()))


def man_page(declared):
    program, known = declared["program"], []
    page = Page("DMPC", f"dmpc {declared['version']}")
    page.begin("SH", "NAME")
    page.add_text("dmpc - " + program["text"].split(": ", 1)[1])
    page.begin("SH", "SYNOPSIS")
    for path, command in leaves(program):
        page.add_call(f"dmpc {path}", usage(command))
    page.begin("SH", "DESCRIPTION")
    page.add_paragraph(DESCRIPTION)
    page.begin("SH", "OPTIONS")
    for option in program["options"]:
        add_option(page, option, "", known)
    page.add_paragraph(
        "Every command takes --help, too. A value follows its option as --option=VALUE or as the next word; the default is in brackets.")
    page.begin("SH", "COMMANDS")
    for path, command in leaves(program):
        add_command(page, path, command, known)
    page.begin("SH", "EXAMPLES")
    for _, command in leaves(program):
        if calls := "".join(line[2:] + "\n" for line in command["examples"].splitlines() if is_call(line)):
            page.add_lines(calls)
    page.begin("SH", "EXIT STATUS")
    for status in declared["exit_statuses"]:
        page.add_entry(str(status["status"]), "", status["meaning"])
    page.begin("SH", "ENVIRONMENT")
    for name, text in VARIABLES.items():
        page.add_entry(name, "", text)
    page.begin("SH", "SEE ALSO")
    page.add_paragraph("oiiotool(1)")
    return page.text
