"""S4-FIFO as a replacement policy of one's own (H. Xia, W. Nixon, and others, "Learning-Augmented Heuristics: Simple yet Smart, Robust
and Interpretable Cache Eviction", OSDI 2026): S3-FIFO with five knobs. The paper has a trained model choose them for a cache; here a
subclass sets them. As they stand below this is S3-FIFO, and misses what dmpc's s3-fifo does.

    dmpc study references trace.csv --policy=python:$PWD/s4_fifo.py:S4Fifo --policy=python:$PWD/s4_fifo.py:Wary
"""

from collections import OrderedDict, deque


class S4Fifo:
    small = 0.1  # share of the frames in the small queue
    ghost = None  # names remembered, over the frames; None: as many as the main queue has frames
    skip = 0.0  # newest share of the small queue in which hits do not count
    hits_to_main = 2  # hits after which a page leaves the small queue for the main one
    returns_to_main = 0  # a page goes to the main queue as it comes back for more than so many times

    def __init__(self, frame_count, node):
        self.small_max = max(int(frame_count * self.small), 1)
        self.main_max = max(frame_count - self.small_max, 0)
        self.ghost_max = max(self.main_max if self.ghost is None else int(frame_count * self.ghost), 1)
        self.queues, self.ghosts = {"small": deque(), "main": deque()}, OrderedDict()
        self.pages, self.hits, self.queue = [0] * frame_count, [0] * frame_count, [""] * frame_count
        self.returns, self.came, self.clock = [0] * frame_count, [0] * frame_count, 0
        self.incoming_returns = 0

    def hit(self, page, frame):
        if self.queue[frame] == "main" or self.clock - self.came[frame] >= self.skip * self.small_max:
            self.hits[frame] = min(self.hits[frame] + 1, 3)

    def insert(self, page, frame):
        self.pages[frame], self.hits[frame], self.returns[frame] = page, 0, self.incoming_returns
        is_known = self.incoming_returns > self.returns_to_main
        self._push("main" if is_known else "small", frame)
        self.clock += not is_known
        self.came[frame], self.incoming_returns = self.clock, 0

    def victim(self, incoming):
        self.incoming_returns = self.ghosts.pop(incoming, -1) + 1
        return self._leave_small() if len(self.queues["small"]) >= self.small_max else self._leave_main()

    def _push(self, queue, frame):
        self.queue[frame] = queue
        self.queues[queue].append(frame)

    def _leave_small(self):
        while True:
            frame = self.queues["small"].popleft()
            if self.hits[frame] < self.hits_to_main:
                if len(self.ghosts) >= self.ghost_max:
                    self.ghosts.popitem(last=False)
                self.ghosts[self.pages[frame]] = self.returns[frame]
                return frame
            self.hits[frame] = 0
            self._push("main", frame)
            if len(self.queues["main"]) > self.main_max:
                return self._leave_main()

    def _leave_main(self):
        while True:
            frame = self.queues["main"].popleft()
            if self.hits[frame] == 0:
                return frame
            self.hits[frame] -= 1
            self._push("main", frame)


class Wary(S4Fifo):
    """For bursts, whose hits do not count at first, and for scans that come round: a page has to come back twice."""
    skip, returns_to_main = 0.25, 1
