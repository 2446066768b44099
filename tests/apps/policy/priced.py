class Mine:  # Keeps the pages that are dear.
  def __init__(self, frame_count, node): self.prices = [0] * frame_count
  def price(self, page, price): self.incoming = price
  def insert(self, page, frame): self.prices[frame] = self.incoming
  def victim(self, incoming):
    cheapest = self.prices.index(min(self.prices))
    return cheapest if self.incoming > self.prices[cheapest] else 'bypass'
