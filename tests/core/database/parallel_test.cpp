#include "core/database/parallel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace parallel_test {

using namespace dmpc::core;

TEST_CASE("every part is done once, whatever the number of threads") {
  for (const std::uint32_t threads : {0U, 1U, 2U, 8U}) {
    const Parallel parallel(threads);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
      std::vector<int> done(count);
      parallel.for_each(count, [&](std::size_t i) { ++done[i]; });
      CHECK(std::all_of(done.begin(), done.end(), [](int times) { return times == 1; }));
    }
  }
}

TEST_CASE("no more parts are done at a time than there are threads, of which there is always one") {
  CHECK(Parallel(1).threads() == 1);
  CHECK(Parallel(0).threads() >= 1);
  CHECK((Parallel(8).threads() == 8 || Parallel(8).threads() == 1));  // 1: under the thread sanitizer
}

TEST_CASE("a part may share out parts of its own") {
  for (const std::uint32_t threads : {1U, 2U, 8U}) {
    const Parallel parallel(threads);
    std::vector<int> done(100);
    parallel.for_each(10, [&](std::size_t i) { parallel.for_each(10, [&](std::size_t j) { ++done[10 * i + j]; }); });
    CHECK(std::all_of(done.begin(), done.end(), [](int times) { return times == 1; }));
  }
}

TEST_CASE("the end of every part is told once, never two ends at a time") {
  for (const std::uint32_t threads : {1U, 2U, 8U}) {
    const Parallel parallel(threads);
    std::vector<int> done(1000);
    std::size_t ended = 0, untimely = 0;
    parallel.for_each(
        done.size(), [&](std::size_t i) { ++done[i]; },
        [&](std::size_t i) {
          ++ended;
          untimely += done[i] == 1 ? 0 : 1;
        });
    CHECK(ended == done.size());
    CHECK(untimely == 0);
  }
}

TEST_CASE("what a part throws arrives") {
  for (const std::uint32_t threads : {1U, 2U}) {
    const Parallel parallel(threads);
    const auto part = [](std::size_t i) {
      if (i == 7) {
        throw std::runtime_error("seven");
      }
    };
    CHECK_THROWS_AS(parallel.for_each(10, part), std::runtime_error);
  }
}

}  // namespace parallel_test
