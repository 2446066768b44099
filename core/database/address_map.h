// From old addresses of records to new ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/record/record.h"

namespace dmpc::core {

/// A hash table by linear probing (D. E. Knuth, "The Art of Computer Programming", volume 3, 6.4): extract() asks it about every
/// smooth triangle of every region, for which a tree of nodes on the heap is slow. Not thread-safe.
class AddressMap {
 public:
  /// The value for `from`, and whether it is new: then it is no_address. Valid until the next call.
  std::pair<Address&, bool> find_or_add(Address from) {
    if (2 * (count_ + 1) > entries_.size()) {
      grow();
    }
    Entry& entry = entry_of(from);
    const bool is_new = entry.from == no_address;
    entry.from = from;
    count_ += is_new ? 1 : 0;
    return {entry.to, is_new};
  }
  std::size_t size() const { return count_; }

 private:
  struct Entry {
    Address from = no_address, to = no_address;
  };

  /// The entry of `from`, or a free one for it. At least half of all are free.
  Entry& entry_of(Address from) {
    // Fibonacci hashing: addresses of neighbours differ in their low bits.
    std::size_t place =
        static_cast<std::size_t>(static_cast<std::uint32_t>(from) * 0x9e3779b97f4a7c15U >> 32U) & (entries_.size() - 1);
    while (entries_[place].from != from && entries_[place].from != no_address) {
      place = (place + 1) & (entries_.size() - 1);
    }
    return entries_[place];
  }
  void grow() {
    constexpr std::size_t least = 64;
    std::vector<Entry> old(entries_.empty() ? least : 2 * entries_.size());
    std::swap(old, entries_);
    for (const Entry& entry : old) {
      if (entry.from != no_address) {
        entry_of(entry.from) = entry;
      }
    }
  }

  std::vector<Entry> entries_;  ///< the number is a power of two
  std::size_t count_ = 0;
};

}  // namespace dmpc::core
