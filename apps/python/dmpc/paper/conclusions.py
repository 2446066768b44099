"""A sentence on each table, for the page."""

from collections import Counter
from statistics import mean

from ..studies.texts import counted


def _on_claims(rows):
    verdicts = Counter(row["verdict"] for row in rows)
    judged = f", {verdicts['not judged']} were not judged" if verdicts["not judged"] else ""
    return f"{verdicts['held']} of {counted(len(rows), 'claim')} held{judged}."


def _on_pages(rows):
    ratios = [row["pages a pixel"] / row["pages a pixel printed"] for row in rows]
    return f"A pixel takes {min(ratios):.2f} to {max(ratios):.2f} times the pages that the article prints."


def _on_times(rows):
    rows = [row for row in rows if row["use"] == "predicted"]
    worst = max(rows, key=lambda row: abs(row["difference"]))
    return (f"The efficiencies that were predicted lie {mean(abs(row['difference']) for row in rows):.1f} points from the printed ones in "
            f"the mean, at worst {abs(worst['difference']):.1f} points ({worst['scene']}, nodes {worst['nodes']}).")


def _on_algorithms(rows):
    told = ", ".join(f"{row['pages travel'] / row['rays travel']:.2f} times as long as rays ({row['scene']})"
                     for row in rows if row["nodes"] == 64)
    return f"On 64 nodes pages that travel take {told}."


def _on_caches(rows):
    worst, best = (chosen(rows, key=lambda row: row["efficiency"]) for chosen in (min, max))
    return (f"The efficiency goes from {worst['efficiency']:.1f} % with caches of {worst['of the database']:.2f} % of the database to "
            f"{best['efficiency']:.1f} % with {best['of the database']:.2f} %.")


def _on_loads(rows):
    best = max(rows, key=lambda row: row["average load"])
    return (f"Nodes are loaded most evenly, to {best['average load']:.1f} % of the busiest, by regions that are {best['regions']} on "
            f"{best['nodes']} nodes.")


def _on_ways(rows):
    best = max(rows, key=lambda row: row["efficiency"])
    return f"Rays travel best, with an efficiency of {best['efficiency']:.1f} %, on {best['scene']} by {best['way']}."


def _on_items(rows):
    least, most = (chosen(rows, key=lambda row: row["seconds"]) for chosen in (min, max))
    told = (f"{row['seconds']:.0f} s with {row['item']} asked of {row['asked of']}" for row in (least, most))
    return f"The picture takes from {' to '.join(told)}."


def _on_losses(rows):
    rows = [row for row in rows if row["nodes"] == 64]
    losses = {part: mean(row[part] for row in rows) for part in rows[0] if part not in ("scene", "nodes", "computing")}
    largest = max(losses, key=losses.get)
    return (f"On 64 nodes the largest loss is {largest.replace('_', ' ')}: {losses[largest]:.1f} % of the nodes' time in the mean over "
            "scenes.")


def _on_fit(rows):
    if not rows:
        return ""
    most = max(rows, key=lambda row: abs(row["change"]))
    return f"The fit changes a figure of the machine by {abs(most['change']):.1f} % at most ({most['figure']})."


def _on_pairs(rows):
    best, worst = (chosen(rows, key=lambda row: row["mean error"]) for chosen in (min, max))
    return (f"Times of a ray are met to {best['mean error']:.1f} % in the mean by prices fitted to {best['fitted to']}, and to "
            f"{worst['mean error']:.1f} % by those fitted to {worst['fitted to']}.")


def _on_law(rows):
    ours, law = rows[0]["our mean error"], rows[0]["the law's mean error"]
    return (f"Over {rows[0]['cells']} {'we are' if ours < law else 'the law is'} nearer: {min(ours, law):.1f} points off in the mean, "
            f"against {max(ours, law):.1f} points.")


def _on_sensitivity(rows):
    most = max(rows, key=lambda row: abs(row["mean error"]))
    return f"The mean error is largest, {abs(most['mean error']):.1f} points, where \"{most['figure']}\" is changed."


_CONCLUSIONS = {"claims": _on_claims, "table_2": _on_pages, "table_3": _on_times, "algorithms": _on_algorithms, "caches": _on_caches,
                "region_loads": _on_loads, "ray_ways": _on_ways, "work_items": _on_items, "losses": _on_losses, "voxel_prices": _on_fit,
                "voxel_pairs": _on_pairs, "law": _on_law, "grid_table_3": _on_times, "calibration": _on_fit, "sensitivity": _on_sensitivity}


def conclusion(name, table):
    return _CONCLUSIONS[name](table.named_rows()) if name in _CONCLUSIONS else ""
