"""The studies of one scene on several computers: `dmpc study speedup`, `traffic`, `balance` and `frames`."""
