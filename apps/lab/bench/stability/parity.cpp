// R14: the number of triangles that a whole ray hits is odd from inside a closed mesh, even from outside.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "apps/lab/bench/stability/bodies.h"
#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/kernels.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/walk.h"
#include "core/scene/frame.h"
#include "core/trace/kernel.h"

namespace dmpc::apps {
namespace {

using core::Ray;
using core::Vec3d;

struct Kernels {
  core::BvhNodeKernel meet;
  core::TriangleKernel hit;
};

/// Returns the triangles that the kernels hit along the ray, each once.
std::size_t hits_on_way(const core::Database& database, const Ray& ray, const Kernels& kernels) {
  std::vector<std::uint32_t> ids;
  const core::ShearedRay sheared(ray);
  walk_leaves(database, ray, kernels.meet, [&](const LeafView& leaf, core::Hit&) {
    std::array<float, core::leaf_lanes> times{};
    const std::uint32_t hits =
        kernels.hit(sheared, {leaf.rows, leaf.count}, core::no_primitive, std::numeric_limits<float>::infinity(), times.data());
    for (std::size_t lane = 0; lane < leaf.count; ++lane) {
      if ((hits >> lane & 1U) != 0) {
        ids.push_back(leaf.ids[lane]);
      }
    }
  });
  std::sort(ids.begin(), ids.end());
  return static_cast<std::size_t>(std::unique(ids.begin(), ids.end()) - ids.begin());
}

/// Returns whether rounding decides nothing: a ray within rounding of an edge may hit both its triangles.
bool is_generic(const Referee& referee, const Ray& ray) {
  const std::vector<ExactIntersection> met = referee.exact_intersections(ray);
  return std::all_of(met.begin(), met.end(), [](const ExactIntersection& seen) { return seen.certain(Renderer::grid); });
}

void judge_parity(const StabilitySubject& subject, const Ray& ray, bool inside, const Kernels& kernels, StabilityCounts& count) {
  ++count.tried;
  if (hits_on_way(subject.database, ray, kernels) % 2 == (inside ? 1 : 0)) {
    return;
  }
  ++(is_generic(subject.referee, ray) ? count.unexplained : count.explained);
}

ShootRays crossing_rays(const ClosedBody& body) {
  const auto subject = std::make_shared<const StabilitySubject>(body.scene);
  return each_ray([subject, body](Random& random, std::uint64_t i, KernelCounts& counts) {
    const bool inside = i % 2 == 0;
    const Vec3d from = inside ? body.inside(random) : ClosedBody::outside(random);
    const Vec3d to = inside ? from + random.direction() : random.in_box(-1, 1);
    const Ray ray = ray_through(to_local(subject->frame(), from), to_local(subject->frame(), to));
    judge_parity(*subject, ray, inside, {core::meet_children, core::hit_triangles}, counts[index_of(StabilityKernel::grid)]);
    judge_parity(*subject, ray, inside, {core::meet_children_scalar, core::hit_triangles_scalar},
                 counts[index_of(StabilityKernel::scalar)]);
  });
}

}  // namespace

StabilityCases parity_cases(const StabilityAmount& amount) {
  std::vector<ClosedBody> bodies = closed_bodies();
  std::erase_if(bodies, [](const ClosedBody& body) { return !body.is_mesh; });
  StabilityCases cases;
  for (const ClosedBody& body : bodies) {
    cases.push_back(
        {"R14 parity of crossings", body.name, amount.share(1'000'000, bodies.size()), [body] { return crossing_rays(body); }});
  }
  return cases;
}

}  // namespace dmpc::apps
