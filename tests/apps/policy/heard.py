import sys
class Mine:  # Says what it has heard.
  def __init__(self, frame_count, node): self.heard = f'{frame_count} {node}:'
  def hit(self, page, frame): self.heard += f' hit {page} {frame}'
  def insert(self, page, frame): self.heard += f' insert {page} {frame}'
  def victim(self, incoming): raise Exception(self.heard)
