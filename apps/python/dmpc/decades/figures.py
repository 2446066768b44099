"""The pictures of the page, by matplotlib, each for a light and a dark page; without colour they are told apart by letters and marks."""

import math

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

from . import design, verdicts  # noqa: E402

COLOURS = {"pages": "#2b7bba", "questions": "#c77b00", "rays": "#a8327d", "copies": "#5c8a3a"}
MARKS = {"pages": "o", "questions": "s", "rays": "^", "copies": "D"}
HATCHES = ("", "///", "...", "xx", "\\\\\\", "++")
PARTS = {"computing": ("computing",), "messages and services": ("messages", "service_busy", "service_idle"),
         "waiting": ("data_wait", "credit_wait", "starvation", "token_wait", "other_wait"), "film": ("film_wait",), "ends": ("idle_at_end",)}
THEMES = {"light": {"ink": "#222222", "paper": "#ffffff"}, "dark": {"ink": "#dddddd", "paper": "#17191c"}}


class Figures:
    """Draws into a folder; each call returns the names of its two files."""

    def __init__(self, folder):
        self._folder = folder

    def draw(self, name, width, height, rows, columns, paint, **grid):
        names = {}
        for theme, colours in THEMES.items():
            ink = colours["ink"]
            with pyplot.rc_context({"text.color": ink, "axes.edgecolor": ink, "axes.labelcolor": ink, "xtick.color": ink,
                                    "ytick.color": ink, "figure.facecolor": colours["paper"], "axes.facecolor": colours["paper"],
                                    "font.size": 9, "svg.hashsalt": "dmpc", "hatch.color": colours["paper"], "hatch.linewidth": 0.6}):
                figure, axes = pyplot.subplots(rows, columns, figsize=(width, height), squeeze=False, layout="constrained", **grid)
                paint(figure, axes, ink, colours["paper"])
                names[theme] = f"{name}-{theme}.svg"
                figure.savefig(self._folder / names[theme], metadata={"Date": None}, bbox_inches="tight")
                if theme == "light":
                    figure.savefig(self._folder / f"{name}.png", dpi=100, bbox_inches="tight")
                pyplot.close(figure)
        return names


def map_of(figures, name, title, found):
    """Machines by memories: the winner's colour and letter, fainter with the share of draws in which it stays, and its lead."""
    machines = [machine for machine in design.MACHINES if any(each.cell.machine == machine for each in found)]
    steps = sorted({each.cell.step for each in found})

    def paint(figure, axes, ink, paper):
        axis = axes[0][0]
        for each in found:
            x, y = machines.index(each.cell.machine), steps.index(each.cell.step)
            colour = COLOURS[each.winner.family]
            is_drawn = bool(each.times) or math.isinf(each.lead)
            strength = 0.15 + 0.85 * max(0.0, (each.stays - 0.4) / 0.6) if is_drawn else 0.4
            axis.add_patch(pyplot.Rectangle((x - 0.48, y - 0.48), 0.96, 0.96, facecolor=colour, alpha=strength, edgecolor="none"))
            if not each.is_decided:
                axis.add_patch(pyplot.Rectangle((x - 0.46, y - 0.46), 0.92, 0.92, fill=False, edgecolor=ink, linestyle=":", linewidth=1.2))
            on = "#ffffff" if strength > 0.6 else ink
            lead = "alone" if math.isinf(each.lead) else f"{each.lead:.2f}"
            axis.text(x, y + 0.1, f"{design.FAMILIES[each.winner.family]} {lead}", ha="center", va="center", color=on, fontsize=10)
            share = "too small" if each.is_too_small else "" if math.isinf(each.lead) else f"{100 * each.stays:.0f} %" if is_drawn else "not drawn"
            axis.text(x, y - 0.25, share, ha="center", va="center", color=on, fontsize=7)
        axis.set_xlim(-0.5, len(machines) - 0.5)
        axis.set_ylim(-0.5, len(steps) - 0.5)
        axis.set_xticks(range(len(machines)), [f"{machine}\n{design.MACHINES[machine]}" for machine in machines])
        axis.set_yticks(range(len(steps)), [step_text(step) for step in steps])
        axis.set_ylabel("memory of a node")
        axis.set_title(title, fontsize=10)
        axis.tick_params(length=0)
        for side in axis.spines.values():
            side.set_visible(False)
        marks = [pyplot.Line2D([], [], marker="s", linestyle="", color=COLOURS[family], label=f"{letter} {family}", markersize=9)
                 for family, letter in design.FAMILIES.items()]
        figure.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=4, frameon=False)

    return figures.draw(name, 1.15 * len(machines) + 1.3, 0.62 * len(steps) + 1.5, 1, 1, paint)


def step_text(step):
    return {0: "least of pages", design.WHOLE: "whole copies"}.get(step, f"{step}/{design.WHOLE}")


def fronts(figures, name, found):
    """Time over memory by machine, a curve a family: over that of whole copies, geometric mean over scenes with 95 % by bootstrap."""
    machines = list(dict.fromkeys(each.cell.machine for each in found))
    columns = min(3, len(machines))
    rows = math.ceil(len(machines) / columns)

    def paint(figure, axes, ink, paper):
        for index, machine in enumerate(machines):
            axis = axes[index // columns][index % columns]
            cells = sorted((each for each in found if each.cell.machine == machine), key=lambda each: each.cell.step)
            copies = next((each.best["copies"] for each in cells if each.cell.step == design.WHOLE and each.best["copies"].best), None)
            for family in design.FAMILIES:
                points = [(each.cell.step, *verdicts.interval([row.seconds(scene) / copies.seconds(scene) for scene in each.scenes]))
                          for each in cells for row in each.rows
                          if copies and row.family == family and math.isfinite(row.mean(each.scenes))]
                if points:
                    steps, means, lows, highs = zip(*points)
                    axis.errorbar([step + 0.06 * list(design.FAMILIES).index(family) for step in steps], means,
                                  yerr=([m - low for m, low in zip(means, lows)], [high - m for m, high in zip(means, highs)]),
                                  color=COLOURS[family], marker=MARKS[family], markersize=4, linewidth=1.2, elinewidth=0.8, capsize=2)
            axis.set_yscale("log")
            axis.set_title(f"{machine}, {design.MACHINES[machine]}", fontsize=9)
            axis.axhline(1, color=ink, linewidth=0.5)
            axis.set_xticks((0, design.WHOLE), ("least", "whole"))
            axis.set_yticks((1, 2, 5, 10, 20, 50), ("1", "2", "5", "10", "20", "50"))
            axis.minorticks_off()
        axes[0][0].set_ylabel("time over that of copies")
        marks = [pyplot.Line2D([], [], marker=MARKS[family], color=COLOURS[family], label=family) for family in design.FAMILIES]
        figure.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=4, frameon=False)

    return figures.draw(name, 2.7 * columns, 2.2 * rows + 0.4, rows, columns, paint, sharex=True, sharey=True)


def parts(figures, name, found):
    """What the winner's time is made of, by machine and memory."""
    steps = sorted({each.cell.step for each in found})
    chosen = [step for step in steps if step in (steps[0], steps[len(steps) // 2], steps[-1])]
    machines = list(dict.fromkeys(each.cell.machine for each in found))
    shades = ("#2b7bba", "#c77b00", "#b8b8b8", "#5c8a3a", "#a8327d")

    def paint(figure, axes, ink, paper):
        for column, step in enumerate(chosen):
            axis = axes[0][column]
            cells = {each.cell.machine: each for each in found if each.cell.step == step}
            left = [0.0] * len(machines)
            for (part, keys), shade, hatch in zip(PARTS.items(), shades, HATCHES):
                wide = [_mean_share(cells[machine], keys) if machine in cells else 0 for machine in machines]
                axis.barh(range(len(machines)), wide, left=left, color=shade, hatch=hatch, label=part, height=0.7)
                left = [before + width for before, width in zip(left, wide)]
            axis.set_title(step_text(step), fontsize=9)
            axis.set_yticks(range(len(machines)),
                            [f"{machine} {design.FAMILIES[cells[machine].winner.family] if machine in cells else ''}" for machine in machines])
            axis.invert_yaxis()
            axis.set_xlim(0, 100)
            axis.set_xlabel("% of the nodes' time")
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=5, frameon=False)

    return figures.draw(name, 2.9 * len(chosen), 0.34 * len(machines) + 1.4, 1, len(chosen), paint)


def _mean_share(verdict, keys):
    results = [verdict.winner.best[scene][2] for scene in verdict.scenes]
    return sum(one["share"][key] for one in results for key in keys) / len(results)


def bounces(figures, name, found):
    """Incoherence: the time of each family over the fastest, from Whitted's rays to three bounces."""
    lights = [light for light in design.LIGHTS if any(each.cell.light == light for each in found)]
    machines = list(dict.fromkeys(each.cell.machine for each in found))
    step = sorted({each.cell.step for each in found})[len({each.cell.step for each in found}) // 2]
    columns = min(3, len(machines))
    rows = math.ceil(len(machines) / columns)

    def paint(figure, axes, ink, paper):
        for index, machine in enumerate(machines):
            axis = axes[index // columns][index % columns]
            cells = {each.cell.light: each for each in found if each.cell.machine == machine and each.cell.step == step}
            for family in design.FAMILIES:
                points = [(place, row.mean(cells[light].scenes) / cells[light].winner.mean(cells[light].scenes))
                          for place, light in enumerate(lights) if light in cells for row in cells[light].rows
                          if row.family == family and math.isfinite(row.mean(cells[light].scenes))]
                if points:
                    axis.plot(*zip(*points), color=COLOURS[family], marker=MARKS[family], markersize=5, linewidth=1.2)
            axis.set_yscale("log")
            axis.set_yticks((1, 2, 5, 10), ("1", "2", "5", "10"))
            axis.minorticks_off()
            axis.set_title(f"{machine}, {design.MACHINES[machine]}", fontsize=9)
            axis.set_xticks(range(len(lights)), ["Whitted" if light == "whitted" else light.split("-")[1] for light in lights])
        axes[-1][0].set_xlabel("Whitted's rays, or paths of so many bounces")
        axes[0][0].set_ylabel("time over the winner's")
        marks = [pyplot.Line2D([], [], marker=MARKS[family], color=COLOURS[family], label=family) for family in design.FAMILIES]
        figure.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=4, frameon=False)

    return figures.draw(name, 2.7 * columns, 2.2 * rows + 0.5, rows, columns, paint, sharex=True, sharey=True)
