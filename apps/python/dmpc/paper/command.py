"""The command line of dmpc study paper: runs what its folder lacks, and writes the report."""

import argparse
import contextlib
import copy
import json
import pathlib
import re

from .. import program
from ..studies.output import INTERRUPTED, Messages, scratch_folder, take_signals
from ..studies.runs import CORES, Runs
from . import catalogue, price_tables, sensitivity, tables
from .claims import claims
from .data import RESOLUTION
from .fits import TIED
from .report import Report
from .results import Result, figures_of
from .summary import introduction

_FASTER = 7  # the article's figure for the processor of the iPSC/860


def main(words):
    options = _parser().parse_args(words)
    messages = Messages(options)
    take_signals()
    kept = ()
    with contextlib.ExitStack() as stack:
        try:
            folder = _own(options.output or stack.enter_context(scratch_folder()))
            kept = Runs(folder, options.jobs, figures_of, catalogue.database_words, messages.say, messages.progress)
            report = study(kept, options.resolution, options.sensitivity)
            print(report.markdown(), end="", flush=True)
            if options.output:
                report.write(folder)
            if options.report:
                pathlib.Path(options.report).write_text(report.html())
        except KeyboardInterrupt:
            messages.say(f"stopped; the same line continues after the {len(kept)} runs that {options.output} has"
                              if options.output else "stopped; with -o FOLDER the same line would continue")
            return INTERRUPTED
        except OSError as error:
            messages.say(f"{error.filename or 'the report'}: {error.strerror}")
            return program.status_of(program.InputError())
        except program.Error as error:
            messages.say(error)
            return program.status_of(error)
    if report.complaint:
        messages.say(report.complaint)
    return 0


def study(kept, side, has_sensitivity):
    """Runs what is missing; the Report. Raises a program.Error as Runs.get() does, or if two runs of a scene give different films."""
    old, new, faster = (json.loads(program.run(["machine", name])) for name in ("ipsc2-1994", "ipsc2", "ipsc860"))
    prices, new_prices = old["operation_ps"], new["operation_ps"]
    dearer = copy.deepcopy(new)
    dearer["operation_ps"]["cached_lookup"] *= 2
    faster["operation_ps"] |= {name: round(prices[name] / _FASTER) for names in TIED.values() for name in names}
    varied = sensitivity.variations(new) if has_sensitivity else {}
    machines = {"faster": faster, "dearer": dearer, **{f"varied-{number}": machine for number, machine in enumerate(varied.values())}}
    for name, machine in machines.items():
        (kept.folder / "machines" / f"{name}.json").write_text(json.dumps(machine, indent=1))
    pages = {key: result.database_pages for key, result in _found(kept, catalogue.sizes()).items()}
    found = _found(kept, catalogue.runs(side, pages) | sensitivity.runs(side, pages, len(varied)))
    named = {"summary": tables.at_a_glance(found), "claims": claims(found, side), "table_2": tables.table_2(found),
             "table_3": tables.table_3(found), "algorithms": tables.algorithms(found), "caches": tables.caches(found),
             "region_loads": tables.region_loads(found), "ray_ways": tables.ray_ways(found), "work_items": tables.work_items(found),
             "losses": tables.losses(found), "voxel_prices": price_tables.voxel_prices(found, prices),
             "voxel_pairs": price_tables.voxel_pairs(found, prices), "law": tables.law(found), "grid_table_3": tables.grid_table_3(found),
             "calibration": price_tables.calibration(found, new_prices)}
    if varied:
        named["sensitivity"] = sensitivity.sensitivity(found, varied)
    return Report(introduction(found, side, named["voxel_pairs"], named["claims"]), named)


def _found(kept, lines):
    """Results by what the runs are for."""
    results, films = {}, {}
    for (key, line), one in zip(lines.items(), kept.get(list(lines.values()))):
        if "misfit" in one:
            raise program.CapacityError(f"dmpc {line}: {one['misfit']}")
        results[key] = result = Result(**{name: value for name, value in one.items() if name not in ("line", "notes")})
        subject = (re.sub(r"^databases/|\.\w+\.pages$", "", line.split()[1]), *re.findall(r"--(?:resolution|light)=\S+", line))
        if films.setdefault(subject, result.film) != result.film:
            raise program.InternalError(f"this is a bug in dmpc, please report it: dmpc {line} gives another film than other runs")
    return results


def _own(path):
    """The folder, which is made if there is none. Raises a program.InputError for one with files of something else."""
    folder = pathlib.Path(path)
    folder.mkdir(parents=True, exist_ok=True)
    if {each.name for each in folder.iterdir()} - {"machines", "databases"} and not (folder / "runs.jsonl").is_file():
        raise program.InputError(f"-o {path}: has files, but none of this study (runs.jsonl); expected a new folder, or one of this study")
    return folder


def _parser():
    parser = argparse.ArgumentParser(prog="dmpc study paper")
    parser.add_argument("--output")
    parser.add_argument("--report")
    parser.add_argument("--resolution", type=int, default=RESOLUTION)
    parser.add_argument("--sensitivity", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--jobs", type=int, default=CORES)
    parser.set_defaults(format=None)  # no rows are shown meanwhile
    return parser
