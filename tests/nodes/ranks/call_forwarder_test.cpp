// Work on a thread of its own, for which this thread does forwarded calls.
#include "nodes/ranks/call_forwarder.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/fabric.h"
#include "tests/support/complaint.h"

namespace call_forwarder_test {

namespace {

using namespace dmpc;
using nodes::CallForwarder;

const std::function<void()> nothing = [] {};

void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

TEST_CASE("work returns what it comes to, on another thread, while this one looks after something") {
  std::atomic<int> looks = 0;
  const std::thread::id here = std::this_thread::get_id();
  const std::thread::id there = CallForwarder().while_working(
      [&] {
        for (int waited = 0; looks == 0 && waited < 60'000; ++waited) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return std::this_thread::get_id();
      },
      [&] {
        ++looks;
        wait_a_little();
      },
      nothing);
  CHECK(there != here);
  CHECK(looks > 0);
}

TEST_CASE("forwarded calls are done on this thread, one after the other, as many as work sends") {
  CallForwarder call_forwarder;
  const std::thread::id here = std::this_thread::get_id();
  for (const int count : {0, 1, 1000}) {
    int done_here = 0;
    const int sent = call_forwarder.while_working(
        [&] {
          for (int i = 0; i < count; ++i) {
            call_forwarder.send([&] { done_here += std::this_thread::get_id() == here ? 1 : 0; });
          }
          return count;
        },
        nothing, nothing);
    CHECK(sent == count);
    CHECK(done_here == count);
  }
}

TEST_CASE("what a forwarded call throws is thrown where it was sent, and work may go on") {
  CallForwarder call_forwarder;
  std::string caught;
  CHECK(call_forwarder.while_working(
            [&] {
              caught = tests::complaint_of<std::runtime_error>(
                  [&] { call_forwarder.send([] { throw std::runtime_error("no way"); }); });
              return 7;
            },
            nothing, nothing) == 7);
  CHECK(caught == "no way");
}

TEST_CASE("what work throws is thrown here") {
  CHECK(tests::complaint_of<std::runtime_error>([] {
          CallForwarder().while_working([]() -> int { throw std::runtime_error("no use"); }, nothing, nothing);
        }) == "no use");
}

TEST_CASE("when looking after fails, forwarded calls fail so, those that wait and those to come, and work is waited for") {
  CallForwarder call_forwarder;
  bool is_over = false;
  std::string first, second;
  const auto work = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    first = tests::complaint_of<std::runtime_error>([&] { call_forwarder.send(nothing); });
    second = tests::complaint_of<std::runtime_error>([&] { call_forwarder.send(nothing); });
    is_over = true;
    return 0;
  };
  const auto look_after = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the first forwarded call waits meanwhile
    throw std::runtime_error("lost");
  };
  int shown = 0;
  CHECK(tests::complaint_of<std::runtime_error>([&] { call_forwarder.while_working(work, look_after, [&] { ++shown; }); }) ==
        "lost");
  CHECK(is_over);
  CHECK(first == "lost");
  CHECK(second == "lost");
}

TEST_CASE("when looking after fails, life is shown until the work is done, and what that throws itself comes first") {
  int shown = 0;
  const auto work = []() -> int {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    throw std::runtime_error("no use");
  };
  const auto count_life = [&] { ++shown; };
  CHECK(tests::complaint_of<std::runtime_error>([&] {
          CallForwarder().while_working(
              work, [] { throw std::runtime_error("bad news"); }, count_life);
        }) == "no use");
  CHECK(shown > 1);
  CHECK_THROWS_AS(CallForwarder().while_working(
                      work, [] { throw nodes::Dismissed{3}; }, nothing),
                  nodes::Dismissed);
  CHECK_THROWS_AS(CallForwarder().while_working(
                      work, [] { throw nodes::LostRank("gone"); }, nothing),
                  nodes::LostRank);
}

}  // namespace

}  // namespace call_forwarder_test
