// Which things are there, by their numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmpc::tests {

/// Whether `ids` are 0, 1, ... count - 1 in some order.
inline bool are_all(std::vector<std::uint32_t> ids, std::size_t count) {
  std::sort(ids.begin(), ids.end());
  for (std::uint32_t id = 0; id < ids.size(); ++id) {
    if (ids[id] != id) {
      return false;
    }
  }
  return ids.size() == count;
}

}  // namespace dmpc::tests
