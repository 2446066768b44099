#include "nodes/ranks/rank_links.h"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/loopback_ranks.h"

namespace dmpc::nodes::rank_links_test {

using namespace std::chrono_literals;

TEST_CASE("who was stopped himself takes nobody for silent, and who runs finds out who is") {
  Loopback loopback(2);
  const RankSilence silence{.heartbeat = 20ms, .longest = 200ms};
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

TEST_CASE("a rank that is waited for is told of again and again, by rank 0 alone, until it is lost") {
  Loopback loopback(3);
  const RankSilence silence{.heartbeat = 20ms, .longest = 350ms, .reported = 100ms};
  RankLinks first(loopback.rank(0), silence), second(loopback.rank(1), silence);
  std::vector<std::string> reported, by_second;
  first.report_to([&](const std::string& text) { reported.push_back(text); });
  second.report_to([&](const std::string& text) { by_second.push_back(text); });
  const auto look_long = [](RankLinks& links) {
    for (;;) {
      std::this_thread::sleep_for(1ms);
      links.look_after();
    }
  };
  CHECK_THROWS_AS(look_long(first), LostRank);
  CHECK(reported.size() == 6);  // three times each of two
  CHECK(reported.at(0).ends_with(": nothing has been heard of it for 0 s; it is waited for until that is 0 s"));
  CHECK_THROWS_AS(look_long(second), LostRank);
  CHECK(by_second.size() == 3);  // of rank 0
}

}  // namespace dmpc::nodes::rank_links_test
