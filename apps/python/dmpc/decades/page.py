"""The page: who wins where, by how much, how sure that is, and what was expected."""

import html
import json
import math
import statistics

from ..studies import page
from . import design, figures, predictions, prices, verdicts

_FAMILY_TEXT = ("<b>P</b> pages travel to the node whose pixel needs them; <b>Q</b> questions travel to the node that owns a part of the "
                "scene; <b>R</b> rays travel from region to region; <b>C</b> nothing travels, every node has the whole scene.")


def sentence(found):
    """How many cells are decided, who wins how many of the map, and by how much."""
    cells = [each for each in found if each.cell.set == "map"]
    decided = [each for each in cells if each.is_decided]
    won = {family: [each.lead for each in decided if each.winner.family == family] for family in design.FAMILIES}
    told = ", ".join(_won(family, won[family]) for family in sorted(won, key=lambda family: -len(won[family])) if won[family])
    return (f"{sum(each.is_decided for each in found)} of {len(found)} cells are decided. Of the {len(cells)} machines and memories below "
            f"{told or 'no family'} win; {len(cells) - len(decided)} are undecided.")


def _won(family, leads):
    finite = [lead for lead in leads if math.isfinite(lead)]
    alone = len(leads) - len(finite)
    least, most = f"{min(finite, default=0):.2f}", f"{max(finite, default=0):.2f}"
    parts = ([f"by {least if least == most else f'{least} to {most}'} times the time"] if finite else []) + ([f"{alone} alone"] if alone else [])
    return f"{family} {len(leads)} ({', '.join(parts)})"


def write(kept, plan, memories, found, checked, expected, priced, effort):
    drawn = figures.Figures(kept.folder)
    cells = [each for each in found if each.cell.set == "map"]
    lights = [each for each in found if each.cell.set == "light"] + [each for each in cells if each.cell.step in (1, 4, 6)]
    parts = [page.paragraph(sentence(found), "first"),
             _picture(figures.map_of(drawn, "map", f"{len(plan.scenes)} scenes, 64 nodes, Whitted, 4 samples a pixel", cells),
                      "Winners by machine and memory"),
             f"<p>{_FAMILY_TEXT} The number is how many times as long the runner-up takes (geometric mean over {', '.join(plan.scenes)}); "
             "<i>alone</i>: nobody else has room in every scene. The percentage is the share of draws of the machine's prices, each within "
             "the certainty of its source, in which the winner stays ahead; the fainter, the fewer. Dotted cells are undecided: the winner "
             f"stays in fewer than 80 of 100 draws, or the picture is too small. A cell has {plan.draws} draws, or fewer if the first "
             f"{plan.draws_least} all agree. Each system stands at the best of one search on {' and '.join(plan.scouts)} in the same memory.</p>",
             _command(memories, cells[0], kept)]
    parts += _scenes(drawn, plan, cells)
    parts += ["<h2>Time over memory</h2>", _picture(figures.fronts(drawn, "fronts", cells), "Time over memory, by machine and family"),
              "<p class=note>The time of each family at its best over that of whole copies, in which nothing travels: geometric mean of "
              "paired ratios over the scenes, with 95 % by bootstrap over them. A family has no point where it has no room.</p>",
              _command(memories, cells[-1], kept), "<h2>What the time is made of</h2>",
              _picture(figures.parts(drawn, "parts", cells), "Shares of the nodes' time"), _command(memories, cells[len(cells) // 2], kept),
              "<h2>What turns a cell</h2>", _turning(priced, found)]
    if any(each.cell.set == "light" for each in found):
        parts += ["<h2>Incoherence: does scattered light turn the winner?</h2>",
                  _picture(figures.bounces(drawn, "bounces", lights), "Bounces against winner"),
                  _command(memories, next(each for each in found if each.cell.set == "light"), kept)]
    parts += ["<h2>Other numbers of nodes, other sizes</h2>", _table_of(found)] if any(each.cell.set != "map" for each in found) else []
    parts += ["<h2>Too small, or undecided</h2>", _undecided(found), "<h2>What was expected</h2>", _expected(expected, found),
              "<h2>Held against reality</h2>", _reality(kept.folder / "reality.json"), "<h2>Controls</h2>",
              page.rows(("control", ""), [(one.text, "as it must be" if one.is_right else "NOT as it must be") for one in checked]),
              f"<p class=note>{html.escape(effort)}; all in runs.jsonl. Times are those of modelled machines (dmpc machine NAME prints each "
              "price with its source); memories are steps of equal factors from the least with which pages work to what whole copies "
              "need.</p>"]
    (kept.folder / "index.html").write_text(page.document("Thirty years later: what should travel?", parts))


def _picture(names, text):
    return (f'<picture><source srcset="{names["dark"]}" media="(prefers-color-scheme: dark)">'
            f'<img src="{names["light"]}" alt="{html.escape(text)}"></picture>')


def _command(memories, verdict, kept):
    scene = verdict.scenes[0]
    line = verdicts.line_of_winner(memories, verdict, scene)
    seconds = verdict.winner.best[scene][2]["seconds"]
    return (f"<p class=note>One run of {html.escape(place_of(verdict.cell))}, {scene}, {seconds:.4g} s (in the study's folder, after "
            f"it has run):</p><pre>dmpc {html.escape(line)} -o out.png</pre>")


def place_of(cell):
    """Machine and memory, and what is not as in the map."""
    nodes = f", {cell.nodes} nodes" if cell.nodes != 64 else ""
    light = f", {cell.light.replace('-', ' of ')} bounces" if cell.light != "whitted" else ""
    return f"{cell.machine}, memory {figures.step_text(cell.step)}{nodes}{light}"


def _scenes(drawn, plan, cells):
    """A map a scene, of the same runs."""
    parts = ["<h2>Scene by scene</h2>"]
    for scene in plan.scenes:
        single = [verdicts.of_scene(each, scene) for each in cells]
        memory = f"{design.SCENES[scene][0]:,} triangles"
        parts.append(_picture(figures.map_of(drawn, f"map-{scene}", f"{scene}, {memory}", single), f"Winners for {scene}"))
    parts.append("<p class=note>A cell has a share if its families were drawn, which were those of all scenes together.</p>")
    return parts


def _turning(priced, found):
    rows = []
    for each in found:
        turn = prices.turning(priced, each)
        if turn:
            name, exponent, factor = turn
            rows.append((place_of(each.cell), each.winner.family, f"{each.lead:.2f}", name, f"{exponent:+.2f}",
                         "-" if factor is None else f"{factor:.2g}"))
    if not rows:
        return "<p>There are too few draws to tell the prices apart.</p>"
    rows.sort(key=lambda row: float(row[2]))
    return ("<p>Least squares over the draws of each cell: the lead goes as the price to this power, and times this factor it is a tie. The "
            "price is the one whose doubt moves the lead most; cells with the smallest leads first.</p>"
            + page.rows(("cell", "winner", "lead", "price", "power", "tie at times"), rows[:20]))


def _table_of(found):
    return page.rows(("set", "cell", "scenes", "winner", "lead", "stays"),
                     [(each.cell.set, place_of(each.cell), ", ".join(each.cell.scenes), each.winner.family,
                       "alone" if math.isinf(each.lead) else f"{each.lead:.2f}", f"{100 * each.stays:.0f} % of {len(each.times)}")
                      for each in found if each.cell.set != "map"])


def _undecided(found):
    rows = [(place_of(each.cell), ", ".join(each.scenes), each.winner.family, each.rivals[0].family, f"{each.lead:.2f}",
             f"stays in {100 * each.stays:.0f} % of {len(each.times)} draws") for each in found if not each.is_decided and not each.is_too_small]
    small = [(place_of(each.cell), scene, each.winner.family, "", "", why) for each in found for scene, why in each.small.items()]
    told = (f"<p>{sum(each.is_too_small for each in found)} cells are too small in every scene. In others, scenes that are too small are left "
            "out: more samples a pixel would do there, as the way of the film does not grow with them.</p>")
    return told + (page.rows(("cell", "scenes", "ahead", "next", "lead", "why"), rows + small) if rows or small else "")


def _reality(path):
    """Cells that were predicted by prices of this computer and timed on it."""
    if not path.exists():
        return "<p>Not done: <code>dmpc study decades --part=hold -o FOLDER</code> does it, on a computer with MPI that is otherwise idle.</p>"
    held = json.loads(path.read_text())
    errors = [abs(row["predicted"] / row["timed"] - 1) for row in held["rows"]]
    median = statistics.median(errors)
    text = (f"Median error of the predicted time {100 * median:.0f} %, two nodes as two processes over TCP on one computer with "
            f"{held['processors']} processors, by prices that were fitted to four other renders (measured.json).")
    if held["processors"] < 4:
        text += (" That proves little: the host takes a processor, so that nodes share what is left, and fewer than four processors "
                 "time the scheduler of the system as much as the messages.")
    if median > 0.25:
        text += (" What the model lacks here: a process that waits sleeps, and is woken by the system later than a message comes; several "
                 "packets travel in one frame of a rank; and processes that share a processor wait for each other.")
    return f"<p>{text}</p>" + page.rows(("render", "predicted (s)", "took (s)", "of which least and most", "error"),
                                        [(row["line"], f"{row['predicted']:.4g}", f"{row['timed']:.4g}",
                                          f"{row['least']:.4g} to {row['most']:.4g}",
                                          f"{100 * (row['predicted'] / row['timed'] - 1):+.0f} %") for row in held["rows"]])


def _expected(expected, found):
    by_key = {each.cell.key: each for each in found}
    parts = []
    for one in expected:
        rows, winners, leads = [], 0, 0
        for key, (winner, lead) in one.cells.items():
            if key in by_key:
                verdict = by_key[key]
                is_winner, is_lead = predictions.held((winner, lead), verdict)
                winners, leads = winners + is_winner, leads + is_lead
                rows.append((place_of(verdict.cell), winner, "alone" if lead is None else f"{lead:.2f}", verdict.winner.family,
                             "alone" if math.isinf(verdict.lead) else f"{verdict.lead:.2f}",
                             "held" if is_lead else "winner held" if is_winner else "not held",
                             "" if verdict.is_decided else "undecided"))
        parts.append(f"<p>{html.escape(one.text)} File {one.name}, SHA-256 <code>{one.sha256}</code>. Of {len(rows)} predicted cells that "
                     f"were run, {winners} winners held, and {leads} also in their lead, within a factor of {predictions.NEAR}.</p>"
                     + page.rows(("cell", "expected", "lead", "came", "lead", "", ""), rows))
    return "".join(parts) or "<p>Nothing was predicted.</p>"
