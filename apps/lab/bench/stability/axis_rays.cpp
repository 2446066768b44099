// R4: the 26 axis and diagonal directions, with all substitutes for zero, from planes, faces, corners and far outside.
#include <array>
#include <memory>
#include <string>

#include "apps/lab/bench/stability/axes.h"
#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/judge.h"
#include "apps/lab/bench/stability/rays.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t direction_count = 26;

core::Vec3f any_direction(Random& random) {
  const float zero = zeros[random.below(zeros.size())];
  return axis_directions(zero)[random.below(direction_count)];
}

ShootRays axis_rays(double extents_back) {
  const auto subject = std::make_shared<const StabilitySubject>(seen_from(crowded_scene(), extents_back), crowded_options);
  return each_ray([subject, extents_back](Random& random, std::uint64_t, KernelCounts& counts) {
    const core::Vec3f at = awkward_point(subject->database, random), direction = any_direction(random);
    const core::Ray ray = ray_from(at - direction * static_cast<float>(extents_back), direction);
    judge(*subject, ray, ask_kernels(*subject, ray), {.to_referee = true}, counts);
  });
}

}  // namespace

StabilityCases axis_cases(const StabilityAmount& amount) {
  constexpr std::array<double, 6> extents_back{0, 1, 3, 10, 100, 1000};
  StabilityCases cases;
  for (const double back : extents_back) {
    cases.push_back({"R4 along axes and diagonals", std::to_string(static_cast<int>(back)) + " extents away",
                     amount.share(10'000'000, extents_back.size()), [back] { return axis_rays(back); }});
  }
  return cases;
}

}  // namespace dmpc::apps
