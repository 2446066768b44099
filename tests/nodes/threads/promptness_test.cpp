#include "nodes/threads/promptness.h"

#include <doctest/doctest.h>
#include <sys/prctl.h>

#include <thread>

namespace dmpc::tests::promptness_test {

namespace {

int slack_of_a_new_thread_ns() {
  int slack_ns = 0;
  std::thread([&] { slack_ns = prctl(PR_GET_TIMERSLACK); }).join();
  return slack_ns;
}

}  // namespace

TEST_CASE("a prompt thread and those that it starts wake on time, and it is as before in the end") {
  const int before_ns = prctl(PR_GET_TIMERSLACK);
  REQUIRE(before_ns > 1);
  {
    const nodes::Promptness promptness;
    CHECK(prctl(PR_GET_TIMERSLACK) == 1);
    CHECK(slack_of_a_new_thread_ns() == 1);
  }
  CHECK(prctl(PR_GET_TIMERSLACK) == before_ns);
  CHECK(slack_of_a_new_thread_ns() == before_ns);
}

}  // namespace dmpc::tests::promptness_test
