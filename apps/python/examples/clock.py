"""The clock as a replacement policy of one's own: a hand goes round the frames and takes the mark of a reference from each that has
one, until it finds one without. A page that has just come has a mark.

    dmpc study references trace.csv --policy=python:$PWD/clock.py:Clock
"""


class Clock:
    def __init__(self, frame_count, node):
        self.marks, self.hand = [False] * frame_count, 0

    def hit(self, page, frame):
        self.marks[frame] = True

    insert = hit

    def victim(self, incoming):
        while self.marks[self.hand]:
            self.marks[self.hand] = False
            self._go_on()
        frame = self.hand
        self._go_on()
        return frame

    def _go_on(self):
        self.hand = (self.hand + 1) % len(self.marks)
