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
import sys


class PolicyError(Exception):
    """A policy that cannot be asked, or says what makes no sense."""


def simulate(policy, references, frame_count, node=0, prices=None):
    """How often a cache of `frame_count` pages misses; with `prices`, one for each reference, a pair: the misses, and the sum of their
    prices. `policy` is a class, made as policy(frame_count, node); `references` are pages, as whole numbers, in order. Raises what the
    policy raises, and a PolicyError if victim() names no frame that there is."""
    count, cost = _priced(policy, references, frame_count, node, prices)
    return count if prices is None else (count, cost)


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
        frames, pages, last, cost = {}, [], None, 0
        for page, price in zip(references, itertools.repeat(1) if prices is None else prices):
            if page == last:
                continue
            last = page
            frame = frames.get(page)
            if frame is not None:
                if self.hit is not None:
                    self.call = ("hit", page)
                    self.hit(page, frame)
                continue
            self.misses += 1
            cost += price
            if self.price is not None:
                self.call = ("price", page)
                self.price(page, price)
            if len(pages) < self.frame_count:
                frame = len(pages)
                pages.append(page)
            else:
                self.call = ("victim", page)
                frame = self.victim(page)
                if isinstance(frame, str) and frame == "bypass":
                    continue
                if type(frame) is not int or not 0 <= frame < self.frame_count:
                    frame = self._checked(frame)
                del frames[pages[frame]]
                pages[frame] = page
            frames[page] = frame
            if self.insert is not None:
                self.call = ("insert", page)
                self.insert(page, frame)
        return self.misses, cost

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


def _serve(path, name):
    """What dmpc has it do: apps/policy/request.h says what it is asked, and how it answers."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what the policy prints is no answer
    node, cache_count, source_bytes, reference_count, price_count = _numbers(sys.stdin.buffer, 5)
    caches, references, prices = (_numbers(sys.stdin.buffer, count) for count in (cache_count, reference_count, price_count))
    at = ""
    try:
        policy = _class_in(sys.stdin.buffer.read(source_bytes), path, name)
        print(name, file=answers, flush=True)
        for frame_count in caches:
            cache = None
            if frame_count == 0:
                print(reference_count, sum(prices) if prices else reference_count, file=answers, flush=True)
                continue
            at = f"making it for {frame_count} frames of node {node}: "
            cache = _Cache(policy, frame_count, node)
            at = None
            print(*cache.feed(references, prices or None), file=answers, flush=True)
    except BaseException as error:  # a policy's exit, too
        sys.stderr.write((f"{cache}: " if at is None else at) + _said(error, path))
        sys.stderr.flush()
        os._exit(1)
    os._exit(0)


if __name__ == "__main__":
    _serve(*sys.argv[1:3])
