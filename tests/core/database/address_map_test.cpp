#include "core/database/address_map.h"

#include <doctest/doctest.h>

#include <map>

#include "apps/lab/bench/stability/random.h"

namespace address_map_test {

using namespace dmpc::core;

TEST_CASE("an address keeps the place that it was given, among thousands") {
  AddressMap map;
  std::map<std::uint32_t, Address> twin;
  dmpc::apps::Random random(7);
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    // Neighbours by 5, as records of 40 bytes lie, and others.
    const auto from = static_cast<std::uint32_t>(i % 2 == 0 ? 5 * random.below(3000) : random.below(0x7fffffff));
    const auto [to, is_new] = map.find_or_add(Address{from});
    CHECK(is_new == !twin.contains(from));
    if (is_new) {
      CHECK(to == no_address);
      to = twin[from] = Address{i};
    }
    CHECK(to == twin.at(from));
  }
  CHECK(map.size() == twin.size());
}

}  // namespace address_map_test
