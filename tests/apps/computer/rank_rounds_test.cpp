// What ranks that all run one program tell each other between its runs.
#include "apps/computer/rank_rounds.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/frontend/ranks/parts.h"
#include "tests/support/loopback_ranks.h"

namespace dmpc::tests::rank_rounds_test {

namespace {

using apps::RankRounds;

constexpr nodes::RankSilence impatient{.heartbeat = std::chrono::milliseconds{10}, .longest = std::chrono::milliseconds{400}};

/// A rank plays its part; the status with which it ends.
template <class Act>
int play(nodes::Fabric& fabric, const Act& act, const nodes::RankSilence& silence = {}) {
  nodes::RankLinks links(fabric, silence);
  RankRounds rounds(links);
  const auto work = [&] {
    act(rounds);
    return 0;
  };
  return links.rank() == 0 ? apps::lead(links, work) : apps::follow(links, work);
}

}  // namespace

TEST_CASE("all ranks have rank 0's bytes, round after round, few or more than there is room for, whoever is ahead") {
  for (const std::uint32_t late_polls : {0U, 20U}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{3}, std::size_t{700'000}}) {
      const auto results = on_ranks(3, {.seed = 3, .late_polls_max = late_polls}, [&](nodes::Fabric& fabric) {
        return play(fabric, [&](RankRounds& rounds) {
          for (std::uint8_t round = 0; round < 4; ++round) {
            std::vector<std::byte> bytes(count, std::byte(rounds.is_first() ? round : 0xff));
            rounds.agree("round " + std::to_string(round));
            rounds.meet();
            rounds.share(bytes);
            core::expect(bytes == std::vector<std::byte>(count, std::byte(round)), "they are rank 0's");
          }
          rounds.agree("the end");
          rounds.meet();
        });
      });
      for (const auto& result : results) {
        CHECK(result.failure_text() == "");
        CHECK(result.value == 0);
      }
    }
  }
}

TEST_CASE("a rank that comes to something else than rank 0 is named, and all end") {
  const auto results = on_ranks(3, {}, [&](nodes::Fabric& fabric) {
    return play(fabric, [&](RankRounds& rounds) {
      rounds.agree(rounds.links().rank() == 2 ? "the end" : "round 1");
      rounds.meet();
    });
  });
  CHECK(results[0].failure_text().find("the ranks have parted: here comes the end, on ") != std::string::npos);
  CHECK(results[0].failure_text().find(" round 1: a program must do the same on all of them") != std::string::npos);
  CHECK(results[1].value == 3);
  CHECK(results[2].value == 3);
}

TEST_CASE("a rank that works apart for longer than silence may last is not taken for lost, and its forwarded calls are done") {
  const auto results = on_ranks(3, {}, [&](nodes::Fabric& fabric) {
    return play(
        fabric,
        [&](RankRounds& rounds) {
          rounds.apart([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(rounds.is_first() ? 0 : 900));
            rounds.here([&] { rounds.agree("round 1"); });
            std::this_thread::sleep_for(std::chrono::milliseconds(rounds.is_first() ? 900 : 0));
            rounds.here([&] { rounds.meet(); });
            return 0;
          });
        },
        impatient);
  });
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
    CHECK(result.value == 0);
  }
}

TEST_CASE("a forwarded call that fails on one rank ends all, though its work goes on as if nothing was") {
  const auto results = on_ranks(2, {}, [&](nodes::Fabric& fabric) {
    return play(fabric, [&](RankRounds& rounds) {
      rounds.apart([&] {
        rounds.here([&] { rounds.agree("round 1"); });
        try {
          rounds.here([&] {
            core::expect(rounds.is_first(), "there is no room here");
            rounds.meet();
          });
        } catch (const core::InternalError&) {
        }
        rounds.here([&] { rounds.agree("round 2"); });
        return 0;
      });
    });
  });
  CHECK(results[0].failure_text().find("there is no room here") != std::string::npos);
  CHECK(results[1].value == 3);
}

TEST_CASE("what has failed on a rank is told, though rank 0 works on for longer than silence may last") {
  const auto results = on_ranks(2, {}, [&](nodes::Fabric& fabric) {
    return play(
        fabric,
        [&](RankRounds& rounds) {
          rounds.apart([&] {
            core::expect(rounds.is_first(), "this rank cannot go on");
            std::this_thread::sleep_for(std::chrono::milliseconds(1000));
            return 0;
          });
        },
        impatient);
  });
  CHECK(results[0].failure_text().find("this rank cannot go on") != std::string::npos);
  CHECK(results[1].failure_text() == "");
  CHECK(results[1].value == 3);
}

TEST_CASE("one rank alone agrees with itself") {
  const auto results = on_ranks(1, {}, [&](nodes::Fabric& fabric) {
    return play(fabric, [&](RankRounds& rounds) {
      std::byte byte{7};
      rounds.agree("round 1");
      rounds.share({&byte, 1});
      rounds.meet();
      core::expect(byte == std::byte{7}, "it stays");
    });
  });
  CHECK(results[0].failure_text() == "");
}

}  // namespace dmpc::tests::rank_rounds_test
