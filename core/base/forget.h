// Gives memory back before its owner ends.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dmpc::core {

/// Empties `items` and frees their room, which an assignment of {} or clear() would keep.
template <class T>
void forget(std::vector<T>& items) {
  std::vector<T>().swap(items);
}

/// Lets the operating system have the whole pages among bytes of the heap that nobody reads or writes any more, before their
/// owner frees them. Thread-safe.
void give_back(std::span<const std::byte> bytes);

/// Lets the operating system have what was freed, which the allocator else keeps for later where it lay in small pieces or
/// between others. Worth it after much was freed: it takes some milliseconds for a gigabyte. Thread-safe.
void give_back_freed();

}  // namespace dmpc::core
