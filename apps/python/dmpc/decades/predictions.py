"""What was expected of cells before they were run: files that are committed first and never edited, and what became of them."""

import hashlib
import json
import math
import pathlib
from dataclasses import dataclass

NEAR = 1.5  # a lead within this factor of the predicted one is as predicted
FOLDER = pathlib.Path(__file__).parent / "predictions"


@dataclass
class Predicted:
    name: str
    sha256: str
    text: str
    cells: dict  # by a cell's key: the winner, and its lead or nothing if it alone has room


def read():
    """All files of predictions, the oldest first."""
    found = []
    for path in sorted(FOLDER.glob("*.json")):
        data = path.read_bytes()
        content = json.loads(data)
        found.append(Predicted(path.name, hashlib.sha256(data).hexdigest(), content["text"],
                               {cell["cell"]: (cell["winner"], cell["lead"]) for cell in content["cells"]}))
    return found


def held(predicted, verdict):
    """Whether the winner and, if it is that, the lead came as predicted."""
    winner, lead = predicted
    if winner != verdict.winner.family:
        return False, False
    if lead is None or not math.isfinite(verdict.lead):
        return True, lead is None and not math.isfinite(verdict.lead)
    return True, 1 / NEAR <= verdict.lead / lead <= NEAR
