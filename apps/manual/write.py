"""Writes the manual page, the completion script and the calls of the module for Python from what dmpc_manual_writer says that the command
line declares: python3 write.py FOLDER/declared.json FOLDER."""

import json
import pathlib
import sys

import calls
import completion
import man_page


def write(source, folder):
    declared = json.loads(pathlib.Path(source).read_text(encoding="utf-8"))
    texts = {"dmpc.1": man_page.man_page(declared), "dmpc.bash": completion.bash_completion(declared)}
    if any(command["name"] == "study" for command in declared["program"]["commands"]):
        texts |= {"calls.py": calls.calls(declared["program"]), "study.py": calls.studies(declared["program"]),
                  "commas.py": calls.commas(declared["program"])}
    for name, text in texts.items():
        pathlib.Path(folder, name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: write.py FILE.json FOLDER")
    write(*sys.argv[1:])
