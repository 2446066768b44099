"""Controls: runs that must differ from a cell's, and runs that must not."""

from dataclasses import dataclass

from . import design, verdicts


@dataclass
class Control:
    text: str
    is_right: bool
    line: str


def check(kept, memories, found):
    """For each set of cells: another scene and other samples give another film, another machine the same film at another time."""
    controls = []
    for name in dict.fromkeys(each.cell.set for each in found):
        verdict = next(each for each in found if each.cell.set == name)
        scene = verdict.scenes[0]
        line = verdicts.line_of_winner(memories, verdict, scene)
        result = verdict.winner.best[scene][2]
        samples = next(word for word in line.split() if word.startswith("--samples="))
        other = line.replace(samples, f"--samples={int(samples.split('=')[1]) + 1}")
        [drawn] = kept.get([other])
        controls.append(Control(f"{name}: other samples, another film", drawn.get("film") not in (None, result["film"]), other))
        alike = [each for each in found if each.cell.set == name and each.cell.light == verdict.cell.light]
        films = {each.winner.best[one][2]["film"] for each in alike for one in each.scenes}
        pictures = {(one, design.RESOLUTIONS[each.cell.nodes]) for each in alike for one in each.scenes}
        controls.append(Control(f"{name}: one film for each of {len(pictures)} scenes and sizes, whatever machine, memory and system: {len(films)}",
                                len(films) == len(pictures), line))
    return controls
