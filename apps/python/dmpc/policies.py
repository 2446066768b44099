"""Replacement policies of one's own: what a cache would miss whose pages leave as a class decides.

    class Oldest:                                  # a policy
        def __init__(self, frame_count, node): self.frame_count, self.next = frame_count, -1
        def hit(self, page, frame): ...            # may be missing, as may insert()
        def insert(self, page, frame): ...
        def price(self, page, price): ...          # may be missing, too
        def victim(self, incoming):
            self.next = (self.next + 1) % self.frame_count
            return self.next

    dmpc.simulate(Oldest, references, 64)
    dmpc study references trace.csv --policy=python:/home/me/oldest.py:Oldest
    dmpc render teapot-12 --runner=virtual --replacement=python:/home/me/oldest.py:Oldest -o teapot.png

Frames are numbered from 0 and filled in their order; no page leaves before all have one. hit() is told of a page in a frame that is
referenced again, where references of one page in a row are one; insert() of a page that has come into a frame, which was empty or
victim()'s; victim() says which frame's page leaves for `incoming`, or "bypass": then none leaves, and the page is used once and not
kept. price() comes before victim() and insert(), with the price of the miss, which is 1 unless prices are given. Pages are whole
numbers that say nothing else.

dmpc starts this file by itself (apps/policy), so it needs nothing beyond Python.
"""

import array
import itertools
import linecache
import os
import signal
import sys

_BYPASS = 2**32 - 1


class PolicyError(Exception):
    """A policy that cannot be asked, or says what makes no sense."""


def simulate(policy, references, frame_count, node=0, prices=None):
    """How often a cache of `frame_count` pages misses; with `prices`, one for each reference, a pair: the misses, and the sum of their
    prices. `policy` is a class, made as policy(frame_count, node); `references` are pages, as whole numbers, in order. Of the frame of
    dmpc.references(), or another with a column page, each node (column node, if there is one) has a cache of its own: then misses, and
    costs, are a series, or a pair of them, by node. Raises what the policy raises, a PolicyError if victim() names no frame that there
    is, and a ValueError for a reference that is no page."""
    if hasattr(references, "columns"):
        return _simulate_nodes(policy, references, frame_count, node, prices)
    pages = [_page(page, number) for number, page in enumerate(references)]
    if prices is not None and len(prices) != len(pages):
        raise ValueError(f"{len(prices)} prices for {len(pages)} references: expected one for each")
    count, cost = _priced(policy, pages, frame_count, node, prices)
    return count if prices is None else (count, cost)


def _simulate_nodes(policy, frame, frame_count, node, prices):
    if "page" not in frame.columns:
        raise ValueError(f"the frame's columns are {', '.join(map(str, frame.columns))}: expected page, and perhaps node")
    nodes = frame["node"] if "node" in frame.columns else frame["page"] * 0 + node
    if prices is not None:
        prices = type(nodes)(list(prices), index=frame.index)  # or a ValueError, if they are more or fewer
    found = {each: simulate(policy, of_node["page"].tolist(), frame_count, each, None if prices is None else prices[of_node.index].tolist())
             for each, of_node in frame.groupby(nodes)}
    def by_node(values):
        series = type(nodes)(list(values), index=list(found), dtype="int64")
        series.index.name = "node"
        return series
    return by_node(found.values()) if prices is None else tuple(by_node(pair[i] for pair in found.values()) for i in (0, 1))


_PAGE_MAX = 2**32 - 2


def _page(page, number):
    """A reference as a whole number: also numpy's, and 3.0, but nothing else."""
    try:
        is_truth = type(page).__name__ in ("bool", "bool_")
        whole = -1 if is_truth else int(page) if isinstance(page, float) else page.__index__()
    except (AttributeError, TypeError, ValueError, OverflowError):
        whole = -1
    if whole != page or not 0 <= whole <= _PAGE_MAX:
        raise ValueError(f"reference {number} is {page!r:.80}, expected a page: a whole number from 0 to {_PAGE_MAX:,}")
    return whole


def _priced(policy, references, frame_count, node, prices):
    if frame_count == 0:
        return len(references), len(references) if prices is None else sum(prices)
    return _Cache(policy, frame_count, node).feed(references, prices)


class _Cache:
    """One that remembers in which call of its policy it is, for complaints."""

    def __init__(self, policy, frame_count, node):
        self.frame_count, self.node, self.misses, self.call = frame_count, node, 0, "making the policy"
        made = policy(frame_count, node)
        self.hit, self.insert, self.price = (getattr(made, name, None) for name in ("hit", "insert", "price"))
        self.victim = getattr(made, "victim", None)
        if self.victim is None:
            raise PolicyError("it has no method victim(self, incoming), which says the frame whose page leaves")

    def feed(self, references, prices=None):
        frames, pages, last, cost, hit = {}, [], None, 0, self.hit
        for page, price in zip(references, itertools.repeat(1) if prices is None else prices):
            if page == last:
                continue
            last = page
            frame = frames.get(page)
            if frame is not None:
                if hit is not None:
                    self.call = ("hit", page)
                    hit(page, frame)
                continue
            cost += price
            self.miss(page, price)
            if len(pages) < self.frame_count:
                frame = len(pages)
                pages.append(page)
            else:
                frame = self.frame_for(page)
                if frame is None:
                    continue
                del frames[pages[frame]]
                pages[frame] = page
            frames[page] = frame
            self.put(page, frame)
        return self.misses, cost

    def touch(self, page, frame):
        if self.hit is not None:
            self.call = ("hit", page)
            self.hit(page, frame)

    def miss(self, page, price):
        self.misses += 1
        if self.price is not None:
            self.call = ("price", page)
            self.price(page, price)

    def frame_for(self, page):
        """The frame whose page leaves; None if the new one bypasses the cache."""
        self.call = ("victim", page)
        frame = self.victim(page)
        if isinstance(frame, str) and frame == "bypass":
            return None
        return frame if type(frame) is int and 0 <= frame < self.frame_count else self._checked(frame)

    def put(self, page, frame):
        if self.insert is not None:
            self.call = ("insert", page)
            self.insert(page, frame)

    def _checked(self, frame):
        """What is no int, but a whole number all the same, such as numpy's."""
        try:
            number = frame.__index__()
        except (AttributeError, TypeError):
            number = -1
        if isinstance(frame, bool) or not 0 <= number < self.frame_count:
            raise PolicyError(f"it says {frame!r:.80}, expected a frame from 0 to {self.frame_count - 1}, or 'bypass'")
        return number

    def __str__(self):
        if isinstance(self.call, str):
            call = self.call
        else:
            fault = self.misses + (self.call[0] == "hit")
            call = f"{self.call[0]}(page {self.call[1]}) of fault {fault}"
        return f"{call}, with {self.frame_count} frames of node {self.node}"


def _place(error, path):
    """" (FILE, line N)" of the policy's last line on the way to an error."""
    line = error.lineno if isinstance(error, SyntaxError) and error.filename == path else None
    trace = error.__traceback__
    while trace is not None:
        line = trace.tb_lineno if trace.tb_frame.f_code.co_filename == path else line
        trace = trace.tb_next
    return "" if line is None else f" ({path}, line {line})"


def _said(error, path):
    kind = "" if isinstance(error, PolicyError) else f"{type(error).__name__}: "
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    return f"{kind}{text}{_place(error, path)}"


def _class_in(source, path, name):
    linecache.cache[path] = (len(source), None, source.decode(errors="replace").splitlines(True), path)
    namespace = {"__name__": "policy", "__file__": path}
    exec(compile(source, path, "exec"), namespace)
    if not isinstance(namespace.get(name), type):
        found = [known for known, value in namespace.items() if isinstance(value, type) and value.__module__ == "policy"]
        raise PolicyError(f"it has no class {name}" + (f"; it has {', '.join(found)}" if found else ""))
    return namespace[name]


def _numbers(file, count):
    numbers = array.array("I")
    numbers.frombytes(file.read(4 * count))
    return numbers


class _Server:
    """What dmpc has a process do: apps/policy/request.h says what it is asked, and how it answers."""

    def __init__(self, path, name):
        self.path, self.asked, self.answers = path, sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)  # what the policy prints is no answer
        self.cache, self.at, self.seen = None, "", None
        try:
            self._serve(name)
        except BaseException as error:  # a policy's exit, too
            self._end((f"{self.cache}: " if self.at is None else self.at) + _said(error, path))
        os._exit(0)

    def _serve(self, name):
        node, is_of_run, seconds, cache_count, source_bytes, reference_count, price_count = _numbers(self.asked, 7)
        caches, references, prices = (_numbers(self.asked, count) for count in (cache_count, reference_count, price_count))
        signal.signal(signal.SIGPROF, self._look_for_hang)
        signal.setitimer(signal.ITIMER_PROF, seconds, seconds)
        policy = _class_in(self.asked.read(source_bytes), self.path, name)
        if is_of_run:
            self._follow_run(policy)
            return
        self._say(f"{name}\n".encode())
        for frame_count in caches:
            if frame_count == 0:
                count, cost = _priced(policy, references, 0, node, prices or None)
            else:
                count, cost = self._make(policy, frame_count, node).feed(references, prices or None)
            self._say(f"{count} {cost}\n".encode())

    def _follow_run(self, policy):
        """The caches of a run, by node: kinds of events are those of PolicyEvent."""
        caches, coming = {}, None
        while count := self.asked.read(4):
            events = _numbers(self.asked, 3 * int.from_bytes(count, sys.byteorder))
            for which, page, frame in zip(events[::3], events[1::3], events[2::3]):
                node, kind = which >> 3, which & 7
                if kind == 1:
                    self.cache = caches[node]
                    self.cache.touch(page, frame)
                elif kind == 2:
                    self.cache = caches[node]
                    if coming != which:  # it fills an empty frame
                        self.cache.miss(page, 1)
                    self.cache.put(page, frame)
                    coming = None
                elif kind == 3:
                    self.cache = caches[node]
                    self.cache.miss(page, 1)
                    frame = self.cache.frame_for(page)
                    coming = None if frame is None else which - 1
                    self._say((_BYPASS if frame is None else frame).to_bytes(4, sys.byteorder))
                elif kind == 0:
                    caches[node] = self._make(policy, page, node)
                else:
                    self._say(bytes(4))

    def _make(self, policy, frame_count, node):
        self.at = f"making it for {frame_count} frames of node {node}: "
        self.cache = _Cache(policy, frame_count, node)
        self.at = None
        return self.cache

    def _say(self, answer):
        self.answers.write(answer)
        self.answers.flush()

    def _look_for_hang(self, signal_number, frame):
        """Ends a policy that is still in the call in which it was at the last look."""
        while frame is not None and frame.f_code.co_filename != self.path:
            frame = frame.f_back
        before, self.seen = self.seen, (frame and self.at, self.cache and self.cache.call)
        if frame is not None and before is not None and before[0] is self.seen[0] and before[1] is self.seen[1]:
            self._end((f"{self.cache}: " if self.at is None else self.at) + f"it does not come back ({self.path}, line {frame.f_lineno})")

    def _end(self, complaint):
        sys.stderr.write(complaint)
        sys.stderr.flush()
        os._exit(1)


if __name__ == "__main__":
    _Server(*sys.argv[1:3])
