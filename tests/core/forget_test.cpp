#include "core/forget.h"

#include <doctest/doctest.h>

TEST_CASE("what is forgotten takes no room") {
  std::vector<int> items(1000, 7);
  dmpc::core::forget(items);
  CHECK(items.empty());
  CHECK(items.capacity() == 0);
  dmpc::core::forget(items);
  CHECK(items.capacity() == 0);
}
