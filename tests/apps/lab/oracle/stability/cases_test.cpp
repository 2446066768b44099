// Every stress test of `bench stability`, at a small size: our grid fails none.
#include <doctest/doctest.h>

#include "apps/lab/bench/stability/command.h"
#include "apps/lab/bench/stability/run.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::cases_test {
namespace {

/// Runs these tests, or all.
void check_none_fails(std::uint64_t rays, const std::vector<std::string>& tests) {
  apps::StabilityState state;
  apps::run_stability(apps::stability_cases({rays}, tests), 7, state);
  CHECK(state.blind_cases().empty());
  for (const apps::StabilityRow& row : state.rows) {
    for (std::size_t k = 0; k < row.counts.size(); ++k) {
      const auto kernel = static_cast<apps::StabilityKernel>(k);
      CAPTURE(row.name);
      CAPTURE(std::string(apps::name_of(kernel)));
      CHECK((apps::is_embree(kernel) || row.counts[k].failures() == 0));
    }
  }
}

}  // namespace

TEST_CASE("our grid fails no stress test of numerical stability") { check_none_fails(ray_count(500), {}); }

TEST_CASE("nor, with more rays, those of closed bodies, axes, lists, grazing rays, children and odd numbers") {
  check_none_fails(ray_count(5'000), {"R1", "R2", "R4", "R8", "R10", "R11", "R12"});
  check_none_fails(ray_count(200'000), {"R6"});
}

TEST_CASE("nor as many rays as the command shoots by itself" * doctest::test_suite("slow")) {
  apps::StabilityState state;
  apps::run_stability(apps::stability_cases({apps::StabilityOptions::standard_rays}, {}), 1, state);
  CHECK(state.own_failures() == 0);
  CHECK(state.blind_cases().empty());
}

}  // namespace dmpc::tests::cases_test
