#include "nodes/observers/activity_profile.h"

#include <doctest/doctest.h>

#include <cstddef>

#include "tests/nodes/observers/silent_program.h"

namespace dmpc::nodes::activity_profile_test {

namespace {

/// Kinds of work.
constexpr std::size_t other = 1, taken = 2, received = work_count - 1;

std::size_t work_of_span(const Span& span) {
  return span.activity == Activity::receive ? received : span.activity == Activity::take_over ? taken : other;
}

/// Waits for packets of kind 2 are numbered 3, others 0.
WaitOf wait_numbers() {
  WaitOf numbers{};
  numbers[2] = 3;
  return numbers;
}

/// Two nodes and a host that tell a profile what the test says.
struct ProfiledNodes {
  explicit ProfiledNodes(std::size_t step_count_max = 128) : profile(3, work_of_span, wait_numbers(), step_count_max) {}

  void span(std::uint32_t node, std::uint64_t begin_ns, std::uint64_t end_ns, std::uint64_t own_ns,
            Activity activity = Activity::work) {
    profile.ended({.node = NodeId{node}, .activity = activity, .begin_ns = begin_ns, .end_ns = end_ns, .own_ns = own_ns},
                  program);
  }

  ActivityProfile profile;
  SilentProgram program;
};

std::uint64_t sum_of_steps(const ActivitySteps& steps, std::size_t node) {
  std::uint64_t sum_ns = 0;
  for (const WorkTimes& times : steps.nodes[node]) {
    for (const std::uint64_t time_ns : times) {
      sum_ns += time_ns;
    }
  }
  return sum_ns;
}

}  // namespace

TEST_CASE("a profile of nothing has no steps") {
  const ActivitySteps steps = ProfiledNodes().profile.take();
  CHECK(steps.nodes.size() == 3);
  CHECK(steps.nodes[0].empty());
}

TEST_CASE("a span is spread over the steps in which it lies") {
  ProfiledNodes reported;
  reported.span(0, 512, 2560, 1000);
  const ActivitySteps steps = reported.profile.take();
  CHECK(steps.step_ns == 1024);
  REQUIRE(steps.nodes[0].size() == 3);
  CHECK(steps.nodes[0][0][other] == 250);
  CHECK(steps.nodes[0][1][other] == 500);
  CHECK(steps.nodes[0][2][other] == 250);
  CHECK(sum_of_steps(steps, 1) == 0);
  CHECK(steps.nodes[1].size() == 3);
}

TEST_CASE("a longer run has longer steps, and loses nothing by them") {
  ProfiledNodes reported(4);
  std::uint64_t given_ns = 0;
  for (std::uint64_t begin_ns = 0; begin_ns < 100'000; begin_ns += 777) {
    reported.span(0, begin_ns, begin_ns + 700, 333);
    given_ns += 333;
  }
  reported.span(1, 5, 5, 0);
  reported.span(2, 1, 1, 7);
  const ActivitySteps steps = reported.profile.take();
  CHECK(steps.step_ns == 32768);
  CHECK(steps.nodes[0].size() == 4);
  CHECK(sum_of_steps(steps, 0) == given_ns);
  CHECK(sum_of_steps(steps, 1) == 0);
  CHECK(sum_of_steps(steps, 2) == 7);
}

TEST_CASE("a span counts as whoever made the profile says") {
  ProfiledNodes reported;
  reported.span(0, 0, 10, 10, Activity::receive);
  reported.span(0, 10, 15, 5, Activity::work);
  const WorkTimes times = reported.profile.take().nodes[0].at(0);
  CHECK(times[received] == 10);
  CHECK(times[other] == 5);
}

TEST_CASE("packets that are taken during a span are messages over its time, and the run ends with the last span") {
  ProfiledNodes reported;
  reported.profile.ended(
      {.node = NodeId{0}, .activity = Activity::work, .begin_ns = 512, .end_ns = 1536, .own_ns = 600, .received_ns = 424},
      reported.program);
  const ActivitySteps steps = reported.profile.take();
  REQUIRE(steps.nodes[0].size() == 2);
  CHECK(steps.nodes[0][0][other] + steps.nodes[0][1][other] == 600);
  CHECK(steps.nodes[0][0][taken] == 212);
  CHECK(steps.nodes[0][1][taken] == 212);
  CHECK(steps.end_ns == 1536);
  CHECK(steps.length_ns(0) == 1024);
  CHECK(steps.length_ns(1) == 512);
}

TEST_CASE("work of a kind that there is not is an error") {
  ActivityProfile profile(1, [](const Span&) { return work_count; });
  CHECK_THROWS(profile.ended({.end_ns = 1, .own_ns = 1}, SilentProgram()));
}

TEST_CASE("what a profile on another rank has seen is taken over, in steps of one length for all") {
  ProfiledNodes here(4), elsewhere(4);
  here.span(0, 0, 1024, 1000);
  elsewhere.span(1, 0, 4 * 2048, 800);  // too long for steps of 1024 ns
  here.profile.add(elsewhere.profile.bytes());
  const ActivitySteps steps = here.profile.take();
  CHECK(steps.step_ns == 2048);
  CHECK(sum_of_steps(steps, 0) == 1000);
  CHECK(sum_of_steps(steps, 1) == 800);
  CHECK(steps.nodes[1].at(3)[other] == 200);
}

TEST_CASE("a wait is spread over its steps by the packet that ends it, without what was served meanwhile") {
  ProfiledNodes reported;
  reported.profile.waited({.node = NodeId{0}, .kind = 2, .begin_ns = 512, .end_ns = 2560, .own_ns = 1000});
  reported.profile.waited({.node = NodeId{0}, .kind = 5, .begin_ns = 2560, .end_ns = 2570, .own_ns = 10});
  const ActivitySteps steps = reported.profile.take();
  REQUIRE(steps.waits[0].size() == 3);
  CHECK(steps.waits[0][0][3] == 250);
  CHECK(steps.waits[0][1][3] == 500);
  CHECK(steps.waits[0][2][3] == 250);
  CHECK(steps.waits[0][2][0] == 10);
  CHECK(sum_of_steps(steps, 0) == 0);
  CHECK(steps.nodes[0].size() == 3);
  CHECK(steps.waits[1].size() == 3);
}

TEST_CASE("what ranks saw of waits is put together") {
  ProfiledNodes here, there;
  here.span(0, 0, 100, 100);
  there.profile.waited({.node = NodeId{1}, .kind = 2, .begin_ns = 0, .end_ns = 500'000, .own_ns = 77});
  here.profile.add(there.profile.bytes());
  const ActivitySteps steps = here.profile.take();
  CHECK(steps.step_ns * 128 >= 500'000);
  std::uint64_t sum_ns = 0;
  for (const WaitTimes& times : steps.waits[1]) {
    sum_ns += times[3];
  }
  CHECK(sum_ns == 77);
}

}  // namespace dmpc::nodes::activity_profile_test
