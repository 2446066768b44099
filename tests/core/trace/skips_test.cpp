#include "core/trace/skips.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "core/base/counts.h"

namespace trace_skips_test {

using namespace dmpc::core;

TEST_CASE("every skip has a name, a switch and a counter of its own, and the table has them all") {
  for (std::size_t i = 0; i < all_skips.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      CHECK(std::string(all_skips[i].name) != all_skips[j].name);
      CHECK(all_skips[i].is_on != all_skips[j].is_on);
      CHECK(all_skips[i].avoided != all_skips[j].avoided);
    }
  }
  CHECK(all_skips.size() == sizeof(Skips));
  CHECK(all_skips.size() * sizeof(std::uint64_t) == sizeof(SkippedWork));
}

TEST_CASE("all skips are on by default, all but one without it, none with all off") {
  for (const Skip& skip : all_skips) {
    CHECK(Skips().*skip.is_on);
    CHECK_FALSE(no_skips().*skip.is_on);
    Skips one_off = without(skip);
    CHECK_FALSE(one_off.*skip.is_on);
    one_off.*skip.is_on = true;
    CHECK(one_off == Skips());
  }
}

TEST_CASE("work left out is summed one by one") {
  SkippedWork sum{.unlit = 2, .empty_regions = 1};
  add_counts(sum, {.empty_regions = 3, .background = 4});
  CHECK(sum.empty_regions == 4);
  CHECK(sum.unlit == 2);
  CHECK(sum.background == 4);
  CHECK(sum.any_hit == 0);
}

}  // namespace trace_skips_test
