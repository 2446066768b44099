#include "apps/lab/crowd/side_by_side.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace dmpc::apps::side_by_side_test {

TEST_CASE("no work, no call") {
  side_by_side(0, [](std::size_t) -> std::function<void()> { throw std::runtime_error("called"); });
}

TEST_CASE("every piece is worked on once, and they are finished in order, one at a time") {
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{500}}) {
    std::vector<std::size_t> finished;
    std::atomic<std::size_t> worked = 0;
    side_by_side(count, [&](std::size_t index) {
      ++worked;
      return [&finished, index] { finished.push_back(index); };
    });
    CHECK(worked == count);
    REQUIRE(finished.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(finished[i] == i);
    }
  }
}

TEST_CASE("an exception of a piece or its finish comes out, and not all others are begun") {
  for (const bool in_extension : {false, true}) {
    std::atomic<int> worked = 0;
    CHECK_THROWS_AS(side_by_side(10'000,
                                 [&](std::size_t index) -> std::function<void()> {
                                   ++worked;
                                   if (index == 5 && !in_extension) {
                                     throw std::out_of_range("five");
                                   }
                                   return [index] {
                                     if (index == 5) {
                                       throw std::out_of_range("five");
                                     }
                                   };
                                 }),
                    std::out_of_range);
    CHECK(worked < 10'000);
  }
}

TEST_CASE("what pieces have made is gone when an exception comes out") {
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto made = std::make_shared<int>(0);
    CHECK_THROWS_AS(side_by_side(1000,
                                 [&made](std::size_t index) -> std::function<void()> {
                                   if (index == 5) {  // where there are several cores, later ones wait for this one
                                     std::this_thread::sleep_for(std::chrono::milliseconds(10));
                                   }
                                   return [index, mine = made] {
                                     if (index == 5) {
                                       throw std::out_of_range("five");
                                     }
                                   };
                                 }),
                    std::out_of_range);
    CHECK(made.use_count() == 1);
  }
}

}  // namespace dmpc::apps::side_by_side_test
