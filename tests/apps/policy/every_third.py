class Mine:  # Takes in every third page.
  def __init__(self, frame_count, node): self.count = 0
  def victim(self, incoming):
    self.count += 1
    return self.count // 3 % 8 if self.count % 3 == 0 else 'bypass'
