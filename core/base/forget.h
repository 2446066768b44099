// Releases memory before its owner's lifetime ends.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dmpc::core {

/// Empties `items` and frees their memory, which an assignment of {} or clear() would keep.
template <class T>
void forget(std::vector<T>& items) {
  std::vector<T>().swap(items);
}

/// Returns the whole pages in `bytes` to the operating system before their owner frees them. `bytes` lie on the heap, and nobody
/// reads or writes them any more. Thread-safe.
void give_back(std::span<const std::byte> bytes);

/// Returns freed memory to the operating system that the allocator would keep for later because it lay in small pieces or between
/// others. Call it after much was freed: it takes some milliseconds for a gigabyte. Thread-safe.
void give_back_freed();

}  // namespace dmpc::core
