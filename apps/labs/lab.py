"""A lab's page and its solutions, read: what is typed, which pictures it shows, what is asked, and how that is answered."""

import pathlib
import re
from dataclasses import dataclass, field

FOLDER = pathlib.Path(__file__).resolve().parent
NAMES = sorted(page.stem for page in FOLDER.glob("*.md") if page.stem != "README")

# Commands stand in blocks that are indented by four blanks, at the block's first line; what they print follows.
COMMAND = re.compile(r"    (dmpc|passing_ring|broadcast|for) ")
PICTURE = re.compile(r'!\[(?P<text>[^]]+)\]\((?P<file>\S+) "(?P<source>[^"]+)"\)$')
QUESTION = re.compile(r"(\d+)\. ")
BLANK = re.compile(r"^(\s*(?:[^=\n]+ =|return)) .*  # blank$", re.MULTILINE)


@dataclass
class Typed:
    """A command, and the pictures that the page shows of it: file and where that comes from."""

    command: str
    pictures: list = field(default_factory=list)


@dataclass
class Question:
    """`answer` are words, `code` what a notebook does, with lines that students write; `shown` what it prints."""

    text: str
    answer: str = ""
    code: str = ""
    shown: str = ""

    def with_blanks(self):
        return BLANK.sub(r"\1 ...", self.code)

    def blanks(self):
        """The names of what stands in blanks."""
        return [name for name in re.findall(r"^ *(\w+).*# blank$", self.code, re.MULTILINE) if name != "return"]


@dataclass
class Lab:
    """`parts` are texts and Typed in the page's order, up to the questions."""

    name: str
    title: str
    parts: list
    questions: list

    def typed(self):
        return [part for part in self.parts if isinstance(part, Typed)]


def read(name, folder=FOLDER):
    """The lab of this name. Raises ValueError, naming the file, if page and solutions do not go together."""
    page = (folder / f"{name}.md").read_text()
    body, _, asked = page.partition("\n**Questions.**\n")
    parts = _parts(body.split("\n")[1:])
    questions = [Question(text) for text in _numbered(asked)]
    _answer(questions, folder / "solutions" / f"{name}.md")
    return Lab(name, page.split("\n", 1)[0].removeprefix("# "), parts, questions)


def _parts(lines):
    """Texts, and commands without what they print: paragraphs are parted by blank lines."""
    parts = []
    for paragraph in re.split(r"\n\n+", "\n".join(lines).strip("\n")):
        picture = PICTURE.match(paragraph)
        if picture:
            next(part for part in reversed(parts) if isinstance(part, Typed)).pictures.append((picture["file"], picture["source"]))
        elif COMMAND.match(paragraph):
            parts += [Typed(command) for command in _commands(paragraph)]
        elif not paragraph.startswith(("    ", "|")):
            parts.append(paragraph)
    return parts


def _commands(paragraph):
    """Of which lines that go on end with a backslash."""
    joined = re.sub(r"\\\n +", "", paragraph)
    return [line.strip() for line in joined.split("\n") if COMMAND.match(line)]


def _numbered(text):
    items = []
    for line in text.split("\n"):
        if match := QUESTION.match(line):
            items.append(line[match.end() :])
        elif items and line.startswith("   "):
            items[-1] += " " + line.strip()
    return items


def _answer(questions, path):
    fence = None
    number = -1
    for line in path.read_text().split("\n"):
        if line.startswith("```"):
            fence = None if fence else {"python": "code", "text": "shown"}[line[3:]]
        elif fence:
            setattr(questions[number], fence, getattr(questions[number], fence) + line + "\n")
        elif match := QUESTION.match(line):
            number = int(match[1]) - 1
            if number >= len(questions):
                raise ValueError(f"{path}: answer {match[1]}, but there are {len(questions)} questions")
            questions[number].answer = line[match.end() :]
        elif number >= 0 and line.startswith("   "):
            questions[number].answer += " " + line.strip()
    for place, question in enumerate(questions, 1):
        if not question.answer:
            raise ValueError(f"{path}: no answer to question {place}")
