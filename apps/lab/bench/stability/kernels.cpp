#include "apps/lab/bench/stability/kernels.h"

#include <algorithm>
#include <cmath>

#include "apps/lab/bench/stability/own_kernels.h"
#include "apps/lab/bench/stability/rays.h"

namespace dmpc::apps {
namespace {

constexpr std::array<std::string_view, stability_kernel_count> kernel_names{
    "grid",           "grid, scalar", "grid, no skipping", "grid, resumed", "grid, bundle", "grid, any hit", "voxels",
    "voxels, bundle", "Embree fast",  "Embree robust",     "grid, regions", "grid, planes", "grid, listing", "grid, certified"};

}  // namespace

std::string_view name_of(StabilityKernel kernel) { return kernel_names[index_of(kernel)]; }

bool embree_takes(const core::Ray& ray) {
  constexpr float most = 1e18F;
  bool takes = ray.t_max > 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    takes = takes && std::fabs(ray.origin[axis]) < most && std::fabs(ray.direction[axis]) < most;
  }
  return takes;
}

StabilityAnswers ask_kernels(const StabilitySubject& subject, const core::Ray& ray) {
  StabilityAnswers answers;
  const OwnAnswers own = ask_own_kernels(subject.database, ray);
  std::copy(own.begin(), own.end(), answers.begin());
  const core::Ray nearest = of_kind(ray, core::RayKind::reflected);
  answers[index_of(StabilityKernel::voxels)] = shoot(subject.voxels, nearest);
  answers[index_of(StabilityKernel::voxels_bundle)] = shoot_in_bundle(subject.voxels, nearest);
  if (embree_takes(ray)) {
    answers[index_of(StabilityKernel::embree_fast)] = subject.embree_fast.closest(nearest);
    answers[index_of(StabilityKernel::embree_robust)] = subject.embree_robust.closest(nearest);
  }
  return answers;
}

}  // namespace dmpc::apps
