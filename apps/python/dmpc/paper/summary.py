"""What opens the report: how well Table 3 is predicted, two reservations, and which claims are held."""

from collections import Counter
from statistics import mean, median

from .claims import HELD, NOT_HELD, NOT_JUDGED, TIE
from .data import CELLS, RESOLUTION
from .tables import cells_of, errors_of, errors_text

TITLE = "The tables of 1994, regenerated"


def introduction(found, resolution, pairs, claims):
    """Paragraphs. `pairs` and `claims` are those tables."""
    texts = ['D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and Control for Ray Tracing in Parallel", on the modelled iPSC/2 '
             f"(`dmpc machine ipsc2-1994`) and the article's own structure, a plain grid of voxels, pictures of {resolution}x{resolution} "
             "pixels. As in 1994 a node has one pixel in flight, travelling rays have no backpressure, and nothing is skipped that later "
             "programs skip."]
    if resolution == RESOLUTION:
        texts += [_predicted(found), _chosen(pairs), _on_grid(found)]
    else:
        texts.append(f"The machine's prices are fitted to pictures of {RESOLUTION}x{RESOLUTION} pixels: those of another size show how the "
                     "study works, and no more.")
    return texts + _claimed(claims)


def _predicted(found):
    errors = errors_of(cells_of(found, "article"))
    return (f"Table 3 has {len(CELLS)} printed cells. Three prices are fitted to 4 of them, Mountain on 1 and 64 nodes and Rings4 on 2 and "
            f"64; the others are predicted. Predicted times of a ray lie off by {errors_text(errors.times)}; without Teapot, another scene "
            f"than theirs, by {errors_text(errors.times_without_teapot)}. Predicted efficiencies lie off by "
            f"{mean(errors.efficiencies):.1f} points in the mean and {max(errors.efficiencies):.1f} at worst.")


def _chosen(pairs):
    errors = {row[0]: pairs.value(row, "mean error") for row in pairs.rows}
    best = min(errors, key=errors.get)
    return ("First reservation: the structure and the two scenes were chosen by someone who had seen all 24 cells. Of the ten pairs of "
            f"scenes the best, {best}, is off by {errors[best]:.1f} % in the mean over all cells, fitted ones among them, the median pair by "
            f"{median(errors.values()):.1f} %, and the worst by {max(errors.values()):.1f} %.")


def _on_grid(found):
    ratios = [cell.found.seconds / cell.printed for cell in cells_of(found, "grid") if cell.scene.title != "Mountain"]
    return ("Second reservation: on dmpc's own grid, with the prices of ipsc2, the seconds of other scenes than Mountain are "
            f"{min(1, *ratios):.2f} to {max(ratios):.2f} of the printed ones: only the article's structure gives its seconds.")


def _claimed(claims):
    counts = Counter(verdict for _, verdict, _, _ in claims.rows)
    counted = ", ".join(f"{counts[each]} {each}" for each in (HELD, NOT_HELD, TIE, NOT_JUDGED) if counts[each])
    return [f"Claims of the text: {counted}.",
            *(f"{'A tie' if verdict == TIE else 'Not held'}: {claim}. Found: {text}{f' ({why})' if why else ''}."
              for claim, verdict, text, why in claims.rows if verdict in (NOT_HELD, TIE))]
