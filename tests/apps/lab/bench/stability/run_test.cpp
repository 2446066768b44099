#include "apps/lab/bench/stability/run.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::tests::stability_run_test {

using apps::index_of;
using apps::KernelCounts;
using apps::Random;
using apps::StabilityCases;
using apps::StabilityKernel;
using apps::StabilityState;

namespace {

/// Thrown to stop a run.
struct Stop {};

/// Leaks one ray in seven, by what it draws.
KernelCounts leaky(Random& random, std::uint64_t, std::uint64_t count) {
  KernelCounts counts{};
  counts[index_of(StabilityKernel::grid)].tried = count;
  for (std::uint64_t i = 0; i < count; ++i) {
    counts[index_of(StabilityKernel::grid)].leaks += random.below(7) == 0 ? 1 : 0;
    counts[index_of(StabilityKernel::embree_fast)].leaks += 1;
  }
  return counts;
}

StabilityCases three_cases() {
  const auto prepare = [] { return apps::ShootRays(leaky); };
  return {{"R1 one", "a", 5000, prepare}, {"R1 one", "b", 1, prepare}, {"R2 two", "c", 3000, prepare}};
}

StabilityState finished(const StabilityCases& cases, std::uint64_t seed = 1) {
  StabilityState state;
  apps::run_stability(cases, seed, state);
  return state;
}

bool same_rows(const StabilityState& a, const StabilityState& b) {
  bool same = a.rows.size() == b.rows.size();
  for (std::size_t i = 0; same && i < a.rows.size(); ++i) {
    same = a.rows[i].name == b.rows[i].name && a.rows[i].counts == b.rows[i].counts;
  }
  return same;
}

}  // namespace

TEST_CASE("a stability run tries the rays of every case once and sums them up by row") {
  const StabilityState state = finished(three_cases());
  REQUIRE(state.rows.size() == 2);
  CHECK(state.rows[0].counts[index_of(StabilityKernel::grid)].tried == 5001);
  CHECK(state.rows[1].counts[index_of(StabilityKernel::grid)].tried == 3000);
  CHECK(state.rays_done == apps::total_rays(three_cases()));
}

TEST_CASE("a stability run that is stopped has counted what was tried before") {
  StabilityState state;
  int left = 6;  // the five batches of the first case, one of the second and three of the last
  CHECK_THROWS_AS(apps::run_stability(three_cases(), 1, state, [&] { left-- > 1 ? void() : throw Stop(); }), Stop);
  CHECK(state.rays_done == 5001);
  CHECK(state.cases_done == 1);
  REQUIRE(state.rows.size() == 1);
  CHECK(state.rows[0].counts == finished(three_cases()).rows[0].counts);
}

TEST_CASE("another seed draws other rays") {
  CHECK_FALSE(same_rows(finished(three_cases(), 1), finished(three_cases(), 2)));
  CHECK(same_rows(finished(three_cases(), 1), finished(three_cases(), 1)));
}

TEST_CASE("what our kernels fail counts and what Embree fails does not") {
  const StabilityState state = finished(three_cases());
  CHECK(state.own_failures() == state.rows[0].counts[index_of(StabilityKernel::grid)].leaks +
                                    state.rows[1].counts[index_of(StabilityKernel::grid)].leaks);
}

TEST_CASE("a stability run says what each case has tried, and which has tried nothing") {
  StabilityCases cases = three_cases();
  cases.push_back({"R3 three", "misses all", 10,
                   [] { return apps::ShootRays([](Random&, std::uint64_t, std::uint64_t) { return KernelCounts{}; }); }});
  const StabilityState state = finished(cases);
  REQUIRE(state.trials.size() == 4);
  CHECK(state.trials[1].counts.tried == 1);
  CHECK(state.trials[2].counts.tried == 3000);
  CHECK(state.blind_cases() == std::vector<std::string>{"R3 three, misses all"});
}

TEST_CASE("the long run has a billion rays from inside, and every test can be asked for alone") {
  for (const std::string test :
       {"R1", "R2", "R3", "R4", "R5", "R6", "R7", "R8", "R9", "R10", "R11", "R12", "R14", "R16", "quadrics"}) {
    CAPTURE(test);
    const StabilityCases cases = apps::stability_cases({100}, {test});
    CHECK_FALSE(cases.empty());
    for (const auto& one : cases) {
      CHECK(one.test() == test);
    }
  }
  CHECK(apps::stability_cases({}, {"R2"}).front().rays == 1'000'000'000);
}

}  // namespace dmpc::tests::stability_run_test
