#include "nodes/ranks/rank_links.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "tests/support/loopback_ranks.h"

namespace dmpc::nodes::rank_links_test {

using namespace std::chrono_literals;

TEST_CASE("who was stopped himself takes nobody for silent, and who runs finds out who is") {
  Loopback loopback(2);
  const RankSilence silence{.life_sign = 20ms, .longest = 200ms};
  RankLinks links(loopback.rank(0), silence);
  for (int stops = 0; stops < 3; ++stops) {
    std::this_thread::sleep_for(2 * silence.longest);
    links.look_after();
  }
  const auto look_long = [&] {
    for (;;) {
      std::this_thread::sleep_for(1ms);
      links.look_after();
    }
  };
  CHECK_THROWS_AS(look_long(), LostRank);
}

}  // namespace dmpc::nodes::rank_links_test
