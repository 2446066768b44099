// R11: rays and vertices with NaN, infinite, huge and denormal numbers give a miss or a valid hit, without more work than other
// rays.
#include <array>
#include <limits>
#include <memory>
#include <numeric>

#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {
namespace {

using core::Hit;
using core::Ray;
using core::Vec3d;
using core::Vec3f;

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

/// Limit as a multiple of the work of usual rays.
constexpr double hostile_work_max = 2.5;

float odd_number(Random& random) {
  constexpr std::array<float, 16> odd{0.0F,    -0.0F,  no_number, infinite, -infinite, 3e38F, -3e38F, 1e-40F,
                                      -1e-40F, 1e-30F, 1e-18F,    -1e-17F,  0.5F,      1.0F,  1e10F,  -1e20F};
  return random.bits() % 3 == 0 ? static_cast<float>(random.unit()) : odd[random.below(odd.size())];
}

Vec3f odd_vector(Random& random) {
  const float x = odd_number(random), y = odd_number(random);
  return {x, y, odd_number(random)};
}

/// Returns triangles, spheres and cones with ordinary numbers, and some with odd ones.
core::Scene scene_with_odd_numbers() {
  Random random(9);
  core::Scene scene = scene_of(sphere_mesh(6, 8, 0.1));
  core::SceneBuilder builder(scene);
  builder.sphere({1.5, 0, 0}, 0.3);
  builder.cone({0, 1.5, 0}, 0.3, {0, 2, 0}, 0.1);
  for (int i = 0; i < 200; ++i) {
    const auto odd = [&] { return Vec3d(odd_vector(random)); };
    const auto scale = [](const Vec3d& v) { return v * 1e-10; };
    const Vec3d a = odd(), b = odd();
    builder.polygon({a, b, odd()});
    builder.sphere(random.in_box(-1, 1), double{odd_number(random)});
    builder.cone(scale(odd()), double{odd_number(random)}, odd(), double{odd_number(random)});
  }
  scene.view.from = {0, 0, 5};
  return scene;
}

bool is_valid(const Ray& ray, const Hit& hit) {
  return !hit.found() || (is_finite(ray.origin) && is_finite(ray.direction) && hit.t > 0.0F && hit.t < ray.t_max);
}

void count_answers(const Ray& ray, const StabilityAnswers& answers, KernelCounts& counts) {
  const Hit& grid = answers[index_of(StabilityKernel::grid)];
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const auto kernel = static_cast<StabilityKernel>(k);
    if (is_embree(kernel) && !embree_takes(ray)) {
      continue;
    }
    const bool any_hit = kernel == StabilityKernel::any_hit;
    // Pads of boxes cover no ray from 1e10 extents away, so the grid's rays may miss what lists of voxels, which have no boxes,
    // hit.
    const bool must_agree = !is_embree(kernel) && !is_of_voxels(kernel);
    ++counts[k].tried;
    if (!is_valid(ray, answers[k])) {
      ++counts[k].wrong_hits;
    } else if (must_agree && !(any_hit ? answers[k].found() == grid.found() : same_hit(answers[k], grid))) {
      ++counts[k].unexplained;
    } else if (!must_agree && answers[k].primitive != grid.primitive) {
      ++counts[k].explained;  // if numbers overflow, there is no right answer
    }
  }
}

Ray odd_ray(Random& random) {
  const Vec3f origin = odd_vector(random);
  Ray ray = ray_from(origin, odd_vector(random));
  ray.t_max = random.bits() % 2 == 0 ? infinite : odd_number(random);
  return ray;
}

/// Returns a ray through two points of the grid.
Ray usual_ray(const core::Database& database, Random& random) {
  const core::GridFrame& frame = database.header().frame;
  const auto point = [&] {
    Vec3d at = random.in_box(0, double{frame.finest_cell} * core::finest_per_cell);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = core::plane_at(frame, axis, 0) + at[axis] * frame.resolution[axis];
    }
    return at;
  };
  const Vec3d origin = point();
  return ray_through(origin, point());
}

/// Returns the steps of the traversal and tests of primitives.
double work_of(const core::Database& database, const Ray& ray) {
  core::LocalRecords records(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  core::trace(ray, cursor, records, database.header(), {}, operations);
  const auto& tests = operations.primitive_tests;
  return static_cast<double>(std::accumulate(tests.begin(), tests.end(), operations.cell_steps));
}

double usual_work(const core::Database& database) {
  constexpr int rays = 4096;
  Random random(11);
  double sum = 0;
  for (int i = 0; i < rays; ++i) {
    sum += work_of(database, usual_ray(database, random));
  }
  return sum / rays;
}

ShootRays odd_rays() {
  const auto subject = std::make_shared<const StabilitySubject>(scene_with_odd_numbers());
  const double work_max = hostile_work_max * usual_work(subject->database);
  return [subject, work_max](Random& random, std::uint64_t, std::uint64_t count) {
    KernelCounts counts{};
    double work = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Ray ray = odd_ray(random);
      count_answers(ray, ask_kernels(*subject, ray), counts);
      work += work_of(subject->database, ray);
    }
    counts[index_of(StabilityKernel::grid)].unexplained += work > work_max * static_cast<double>(count) ? 1 : 0;
    return counts;
  };
}

}  // namespace

StabilityCases hostile_cases(const StabilityAmount& amount) {
  return {{"R11 hostile numbers", "rays and vertices", amount.share(10'000'000, 1), odd_rays}};
}

}  // namespace dmpc::apps
