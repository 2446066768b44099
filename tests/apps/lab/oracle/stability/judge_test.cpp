#include "apps/lab/bench/stability/judge.h"

#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/bodies.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/scene/frame.h"

namespace dmpc::tests::judge_test {

using namespace dmpc::apps;
using core::Hit;
using core::Ray;
using Must = StabilityExpectation::Must;

namespace {

/// A cube with a ray from its middle to a face's inside, or to a vertex.
struct Inside {
  StabilitySubject cube{closed_bodies()[0].scene};
  Ray at_face = ray_through(to_local(cube.frame(), {0, 0, 0}), to_local(cube.frame(), {1, 0.3, 0.2}));
  Ray at_vertex = ray_through(to_local(cube.frame(), {0, 0, 0}), cube.database.primitives()[0].vector(0));
};

KernelCounts counts_of(const StabilitySubject& subject, const Ray& ray, const StabilityAnswers& answers,
                       const StabilityExpectation& expectation = {}) {
  KernelCounts counts{};
  judge(subject, ray, answers, expectation, counts);
  return counts;
}

std::uint64_t failures(const KernelCounts& counts) {
  std::uint64_t sum = 0;
  for (const StabilityCounts& count : counts) {
    sum += count.failures();
  }
  return sum;
}

}  // namespace

TEST_CASE("right answers are no failures") {
  const Inside inside;
  for (const Ray& ray : {inside.at_face, inside.at_vertex}) {
    const KernelCounts counts = counts_of(inside.cube, ray, ask_kernels(inside.cube, ray), {.to_referee = true});
    CHECK(failures(counts) == 0);
    CHECK(counts[index_of(StabilityKernel::grid)].tried == 1);
  }
}

TEST_CASE("one kernel that misses what the others hit leaks, from inside and by the referee") {
  const Inside inside;
  for (const Ray& ray : {inside.at_face, inside.at_vertex}) {
    for (const Must must : {Must::hit, Must::either}) {
      for (std::size_t kernel = 0; kernel < compared_kernel_count; ++kernel) {
        StabilityAnswers answers = ask_kernels(inside.cube, ray);
        answers[kernel] = {};
        CHECK(counts_of(inside.cube, ray, answers, {must})[kernel].leaks == 1);
      }
    }
  }
}

TEST_CASE("a hit on a triangle elsewhere is wrong") {
  const Inside inside;
  StabilityAnswers answers = ask_kernels(inside.cube, inside.at_face);
  const auto away = static_cast<std::uint32_t>((answers[0].primitive + 6) % 12);
  answers[index_of(StabilityKernel::embree_robust)].primitive = away;
  const KernelCounts counts = counts_of(inside.cube, inside.at_face, answers);
  CHECK(counts[index_of(StabilityKernel::embree_robust)].wrong_hits == 1);
  CHECK(failures(counts) == 1);
}

TEST_CASE("a hit where nothing may be is wrong") {
  const Inside inside;
  const KernelCounts counts =
      counts_of(inside.cube, inside.at_face, ask_kernels(inside.cube, inside.at_face), {.must = Must::miss});
  CHECK(failures(counts) == compared_kernel_count);
}

TEST_CASE("another bit than the grid's is unexplained in our kernels and not in Embree") {
  const Inside inside;
  for (const auto kernel : {StabilityKernel::scalar, StabilityKernel::plain, StabilityKernel::resumed, StabilityKernel::voxels}) {
    StabilityAnswers answers = ask_kernels(inside.cube, inside.at_face);
    answers[index_of(kernel)].t = std::nextafter(answers[index_of(kernel)].t, 9.0F);
    CHECK(counts_of(inside.cube, inside.at_face, answers)[index_of(kernel)].unexplained == 1);
  }
  StabilityAnswers answers = ask_kernels(inside.cube, inside.at_face);
  Hit& robust = answers[index_of(StabilityKernel::embree_robust)];
  robust.t = std::nextafter(robust.t, 9.0F);
  CHECK(failures(counts_of(inside.cube, inside.at_face, answers)) == 0);
  robust.t *= 1.001F;
  CHECK(counts_of(inside.cube, inside.at_face, answers)[index_of(StabilityKernel::embree_robust)].unexplained == 1);
}

TEST_CASE("bits that are expected are held against all our kernels") {
  const Inside inside;
  const StabilityAnswers answers = ask_kernels(inside.cube, inside.at_face);
  Hit expected = answers[0];
  CHECK(failures(counts_of(inside.cube, inside.at_face, answers, {.bits = &expected})) == 0);
  expected.t = std::nextafter(expected.t, 9.0F);
  CHECK(failures(counts_of(inside.cube, inside.at_face, answers, {.bits = &expected})) == 7);
}

}  // namespace dmpc::tests::judge_test
