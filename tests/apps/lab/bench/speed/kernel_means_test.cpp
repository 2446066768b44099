#include "apps/lab/bench/speed/kernel_means.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::tests::kernel_means_test {

using apps::Comparison;
using apps::SpeedPart;

namespace {

Comparison kernel(const char* scene, const char* what, const char* detail, std::uint32_t threads, double ratio) {
  return {SpeedPart::kernel, scene, what, detail, threads, "grid", "Embree fast", "Mray/s", {ratio}, {1}};
}

}  // namespace

TEST_CASE("the kernel's means are over the scenes, by threads, query and class of rays") {
  const std::vector<Comparison> comparisons = {
      kernel("a", "closest hit", "primary", 1, 1), kernel("a", "closest hit", "shadow", 1, 2),
      kernel("b", "closest hit", "primary", 1, 4), kernel("a", "any hit", "primary", 1, 0.5),
      kernel("a", "closest hit", "primary", 2, 0.1)};
  CHECK(apps::kernel_means(comparisons) ==
        std::vector<std::string>{
            "grid over Embree fast, threads: 1; closest hit 2.000 (primary 2.000, shadow 2.000), any hit 0.500 (primary 0.500).",
            "grid over Embree fast, threads: 2; closest hit 0.100 (primary 0.100)."});
}

TEST_CASE("what is no kernel or not measured has no part in the kernel's means") {
  Comparison build = kernel("a", "build", "", 1, 1);
  build.part = SpeedPart::build;
  CHECK(apps::kernel_means(std::vector{build, Comparison{.part = SpeedPart::kernel}}).empty());
  CHECK(apps::kernel_means({}).empty());
}

}  // namespace dmpc::tests::kernel_means_test
