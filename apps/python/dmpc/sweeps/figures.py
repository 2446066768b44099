"""The figures of --stats by their keys, with dots between: those that its schema knows, which is meant by a word, and their values."""

import difflib
import json
import math

from .. import program

_KINDS = ("by_kind", "waiting")  # what is in them differs from strategy to strategy


def known(schema):
    """Whether a figure of a render is a number where it is there, by its name; lists have no figures."""
    whole = json.loads(schema)

    def meant(place):
        while "anyOf" in place or "$ref" in place:
            place = place["anyOf"][0] if "anyOf" in place else whole["$defs"][place["$ref"].removeprefix("#/$defs/")]
        return place

    def walk(place, name):
        place = meant(place)
        if "properties" in place:
            for key, value in place["properties"].items():
                yield from walk(value, f"{name}.{key}" if name else key)
        elif "propertyNames" in place:
            for key in meant(place["propertyNames"])["enum"]:
                yield from walk(place["additionalProperties"], f"{name}.{key}")
        else:
            kinds = place.get("type", type(place.get("const")).__name__)
            yield name, kinds[0] if isinstance(kinds, list) else kinds

    found = {name: kind for name, kind in walk(whole["$defs"]["render"], "") if kind not in ("array", "list")}
    return {name: kind in ("integer", "number") for name, kind in found.items()}


def figure_meant(typed, figures, option="--columns"):
    """The name of which these are the last words, or the total of these; those of all nodes go before those of the host and of what was
    asked for. Raises a program.UsageError if there is none, or several."""
    if found := [name for name in (typed, typed + ".total") if name in figures]:
        return found[0]
    for are_aside in (False, True):
        found = [name for name in figures if _is_aside(name) == are_aside and name.endswith((f".{typed}", f".{typed}.total"))]
        if len(found) > 1:
            raise program.UsageError(f"{option}={typed}: this may be any of {', '.join(found)}; expected one of them")
        if found:
            return found[0]
    raise program.UsageError(f"{option}={typed}: there is no such figure in what --stats writes; expected its keys with dots between, such "
                             f"as pages.faults.{_question(typed, figures)}")


def _is_aside(name):
    return name.startswith(("host.", "options."))


def _question(typed, figures):
    """Of the figure that is nearest by its name or its last word."""
    names = [name for name in figures if not _is_aside(name)]
    near = difflib.get_close_matches(typed, names, 1) or difflib.get_close_matches(typed, [name.split(".")[-1] for name in names], 1)
    return f" Did you mean {near[0]}?" if near else ""


def value(stats, name):
    """None if it is told to be none, or of another strategy's kind. Raises a KeyError, TypeError or ValueError if counters do not have it
    as a text, a whole number or a finite one."""
    found, above = stats, ""
    for key in name.split("."):
        if found is None or above in _KINDS and found and key not in found:
            return None
        found, above = found[key], key
    if isinstance(found, bool):
        return str(found).lower()
    if found is not None and (not isinstance(found, (str, int, float)) or isinstance(found, float) and not math.isfinite(found)):
        raise ValueError(name)
    return found


def unit(name):
    words = name.split(".")
    if {"seconds", "virtual_seconds"} & set(words):
        return "s"
    if "time_percent" in words:
        return "%"
    is_of_bytes = words[-1] in ("bytes", "page_size") or words[-1].endswith("_bytes") or "memory" in words
    return "bytes" if is_of_bytes else "ps" if name.endswith("_ps") else ""
