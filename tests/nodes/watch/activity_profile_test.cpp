#include "nodes/watch/activity_profile.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>

#include "nodes/program.h"

namespace dmpc::nodes {

namespace {

/// Only its presence matters.
class SilentProgram final : public Program {
 public:
  void receive(const Packet& /*packet*/) override {}
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return ""; }
};

/// Two nodes and a host that tell a profile what the test says.
struct ProfiledNodes {
  explicit ProfiledNodes(std::size_t step_count_max = 128) : profile(3, step_count_max) {}

  void span(std::uint32_t node, std::uint64_t begin_ns, std::uint64_t end_ns, std::uint64_t own_ns,
            Activity activity = Activity::work, std::initializer_list<Charge> charges = {}) {
    Span told{.node = NodeId{node}, .activity = activity, .begin_ns = begin_ns, .end_ns = end_ns, .own_ns = own_ns};
    for (const Charge charge : charges) {
      ++told.after[charge];
    }
    profile.ended(told, program);
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

/// What a span of this kind counts as.
Work work_told(Activity activity, std::initializer_list<Charge> charges) {
  ProfiledNodes told;
  told.span(0, 0, 10, 10, activity, charges);
  const WorkTimes times = told.profile.take().nodes[0].at(0);
  std::size_t work = 0;
  while (times.at(work) == 0) {
    ++work;
  }
  return static_cast<Work>(work);
}

}  // namespace

TEST_CASE("a profile of nothing has no steps") {
  const ActivitySteps steps = ProfiledNodes().profile.take();
  CHECK(steps.nodes.size() == 3);
  CHECK(steps.nodes[0].empty());
}

TEST_CASE("a span is spread over the steps in which it lies") {
  ProfiledNodes told;
  told.span(0, 512, 2560, 1000);
  const ActivitySteps steps = told.profile.take();
  CHECK(steps.step_ns == 1024);
  REQUIRE(steps.nodes[0].size() == 3);
  const auto control = static_cast<std::size_t>(Work::control);
  CHECK(steps.nodes[0][0][control] == 250);
  CHECK(steps.nodes[0][1][control] == 500);
  CHECK(steps.nodes[0][2][control] == 250);
  CHECK(sum_of_steps(steps, 1) == 0);
  CHECK(steps.nodes[1].size() == 3);
}

TEST_CASE("a longer run has longer steps, and loses nothing by them") {
  ProfiledNodes told(4);
  std::uint64_t given_ns = 0;
  for (std::uint64_t begin_ns = 0; begin_ns < 100'000; begin_ns += 777) {
    told.span(0, begin_ns, begin_ns + 700, 333);
    given_ns += 333;
  }
  told.span(1, 5, 5, 0);
  told.span(2, 1, 1, 7);
  const ActivitySteps steps = told.profile.take();
  CHECK(steps.step_ns == 32768);
  CHECK(steps.nodes[0].size() == 4);
  CHECK(sum_of_steps(steps, 0) == given_ns);
  CHECK(sum_of_steps(steps, 1) == 0);
  CHECK(sum_of_steps(steps, 2) == 7);
}

TEST_CASE("a span counts as what it was charged for, or as messages or pages of its kind") {
  CHECK(work_told(Activity::work, {Charge::cell_step}) == Work::tracing);
  CHECK(work_told(Activity::work, {Charge::shading, Charge::cell_step}) == Work::shading);
  CHECK(work_told(Activity::receive, {Charge::page_install}) == Work::paging);
  CHECK(work_told(Activity::receive, {Charge::ray_packing}) == Work::packing);
  CHECK(work_told(Activity::receive, {}) == Work::control);
  CHECK(work_told(Activity::serve, {}) == Work::paging);
  CHECK(work_told(Activity::send, {}) == Work::messages);
  CHECK(work_told(Activity::take_over, {}) == Work::messages);
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
  CHECK(steps.nodes[1].at(3)[static_cast<std::size_t>(Work::control)] == 200);
}

}  // namespace dmpc::nodes
