// Gives memory back before its owner ends.
#pragma once

#include <vector>

namespace dmpc::core {

/// Empties `items` and frees their room, which an assignment of {} or clear() would keep.
template <class T>
void forget(std::vector<T>& items) {
  std::vector<T>().swap(items);
}

}  // namespace dmpc::core
