#include "core/base/forget.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <fstream>
#include <span>

namespace forget_test {

TEST_CASE("what is forgotten takes no room") {
  std::vector<int> items(1000, 7);
  dmpc::core::forget(items);
  CHECK(items.empty());
  CHECK(items.capacity() == 0);
  dmpc::core::forget(items);
  CHECK(items.capacity() == 0);
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

/// Pages of memory that the process has.
std::size_t resident_pages() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident;
}

}  // namespace

TEST_CASE("bytes that nobody wants any more are given back while their owner is there") {
  std::vector<char> all(std::size_t{64} << 20U, 'a');
  const std::size_t before = resident_pages();
  dmpc::core::give_back(std::as_bytes(std::span(all)).subspan(1, all.size() - 2));
  CHECK(resident_pages() + 16'000 < before);
  CHECK(all.front() == 'a');
  CHECK(all.back() == 'a');
  all[5000] = 'b';
  CHECK(all[5000] == 'b');
}

TEST_CASE("small pieces that were freed between others go back, and the others stay") {
  std::vector<std::vector<char>> pieces, kept;
  for (char i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      pieces.emplace_back(8000, i);
    }
    kept.emplace_back(8000, i);
  }
  dmpc::core::forget(pieces);
  const std::size_t before = resident_pages();
  dmpc::core::give_back_freed();
  CHECK(resident_pages() + 10'000 < before);  // of some 20,000 of 4 KiB
  CHECK(kept[77] == std::vector<char>(8000, 77));
}
#endif

}  // namespace forget_test
