import os, time
class Mine:  # Each number of frames does another thing wrong, where its process answers or should.
  def __init__(self, frame_count, node):
    self.frame_count, self.hits = frame_count, 0
    if frame_count == 2: raise ValueError('two are too few')
  def hit(self, page, frame):
    if self.frame_count > 12: raise ValueError('late')
  def victim(self, incoming):
    if self.frame_count == 3: return {}['none']
    if self.frame_count == 4: return '0'
    if self.frame_count == 5: raise SystemExit(0)
    if self.frame_count == 6: os._exit(0)
    if self.frame_count == 7:
      while True: pass
    if self.frame_count == 8: time.sleep(1000)
    if self.frame_count == 9: os.close(0), os.close(1), os.closerange(3, 100), time.sleep(1000)
    if self.frame_count == 10: os.abort()
    if self.frame_count == 11: os.write(0, bytes(8))
    if self.frame_count == 12: os.write(0, bytes([200] * 4)), time.sleep(1000)
    return 0
