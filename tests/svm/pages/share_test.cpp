#include "svm/pages/share.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dmpc::svm::share_test {

namespace {

std::vector<std::uint32_t> keys_in(const Share& share, std::uint32_t key_count) {
  std::vector<std::uint32_t> keys;
  for (std::uint32_t key = 0; key < key_count; ++key) {
    if (share.has(key)) {
      keys.push_back(key);
    }
  }
  return keys;
}

}  // namespace

TEST_CASE("half a share is part of it and about half as large") {
  constexpr std::uint32_t key_count = 100'000;
  Share share;
  std::vector<std::uint32_t> keys = keys_in(share, key_count);
  CHECK(keys.size() == key_count);
  while (share.every() < 256) {
    share.halve();
    const std::vector<std::uint32_t> half = keys_in(share, key_count);
    CHECK(std::includes(keys.begin(), keys.end(), half.begin(), half.end()));
    CHECK(static_cast<double>(half.size()) == doctest::Approx(key_count / share.every()).epsilon(0.2));
    keys = half;
  }
}

TEST_CASE("no small key is in every share") {
  Share share;
  share.shrink_to(Share::every_max);
  CHECK(share.is_least());
  CHECK(keys_in(share, 1'000'000).empty());
}

}  // namespace dmpc::svm::share_test
