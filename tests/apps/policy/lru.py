class Lru:
  def __init__(self, frame_count, node): self.order = {}
  def hit(self, page, frame): self.order[frame] = self.order.pop(frame, None)
  insert = hit
  def victim(self, incoming): return next(iter(self.order))
