"""Controls: runs that must differ from a cell's, and runs that must not."""

from dataclasses import dataclass

from . import verdicts


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
        films = {each.winner.best[one][2]["film"]: one for each in found if each.cell.set == name and each.cell.light == verdict.cell.light
                 for one in each.scenes}
        scenes = {one for each in found if each.cell.set == name and each.cell.light == verdict.cell.light for one in each.scenes}
        nodes = {each.cell.nodes for each in found if each.cell.set == name}
        controls.append(Control(f"{name}: one film a scene, whatever machine, memory and system: {len(films)} of {len(scenes)}",
                                len(films) == len(scenes) * (1 if 512 not in nodes else 2), line))
    return controls
