class Mine:  # Each number of frames does another thing wrong.
  def __init__(self, frame_count, node):
    if frame_count == 2: raise ValueError('two are too few')
    self.frame_count = frame_count
  def victim(self, incoming):
    if self.frame_count == 3: return {}['none']
    if self.frame_count == 4: return 4
    if self.frame_count == 5: return None
    if self.frame_count == 6: raise SystemExit(0)
    if self.frame_count == 7: return True
    if self.frame_count == 8: return -1
    if self.frame_count == 9: return self.victim(incoming)
    import os; os.abort()
