// Any bytes as a scene and rays: every kernel gives the same bits, and the referee can explain them.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>

#include "apps/lab/bench/stability/children.h"
#include "apps/lab/bench/stability/hearing.h"
#include "apps/lab/bench/stability/own_kernels.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/oracle/referee.h"
#include "core/base/expect.h"
#include "core/database/database.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/mesh_rays.h"
#include "tests/fuzz/mesh_scene.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using core::expect;
using core::Hit;
using core::Ray;
using core::RayKind;

constexpr std::size_t rays_max = 16;

struct Subject {
  core::Database database;
  apps::Referee referee{database};
};

bool is_valid(const Ray& ray, const Hit& hit) {
  return !hit.found() || (is_finite(ray.origin) && is_finite(ray.direction) && hit.t > 0.0F && hit.t < ray.t_max);
}

/// Whether boxes cannot miss this ray, so that the grid's answer can be checked by the referee: its direction is a unit vector,
/// and its origin is no farther away than the pad allows for (core/scene/frame.h). Other rays only have to end, and to give the
/// same result for every traversal of the same boxes.
bool is_ordinary(const core::Database& database, const Ray& ray) {
  const core::GridFrame& frame = database.header().frame;
  core::Vec3d size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size[axis] = double{frame.finest_cell} * core::finest_per_cell * frame.resolution[axis];
  }
  const double extent = std::max({size.x, size.y, size.z});
  const double distance_max = ((database.pad() / extent - 1e-6) * 0x1p21 - 1) * extent;
  const double distance = length(core::Vec3d(ray.origin) - frame.low - size * 0.5);
  return std::fabs(length(core::Vec3d(ray.direction)) - 1) < 1e-6 && distance <= distance_max;
}

void compare(const Ray& ray, const apps::OwnAnswers& answers) {
  const auto& [grid, scalar, plain, resumed, bundle, any_hit] = answers;
  expect(is_valid(ray, grid), "a hit lies within the ray");
  expect(apps::same_hit(scalar, grid), "the scalar twin has the same bits");
  expect(apps::same_hit(resumed, grid), "stopping before each record changes no bit");
}

void judge(const Subject& subject, const Ray& ray, const apps::OwnAnswers& answers) {
  const apps::Hearing nearest(subject.database, subject.referee, apps::of_kind(ray, RayKind::reflected)),
      any(subject.database, subject.referee, apps::of_kind(ray, RayKind::shadow));
  const auto& [grid, scalar, plain, resumed, bundle, any_hit] = answers;
  expect(apps::same_hit(plain, grid), "skipping empty space changes no bit");
  expect(apps::same_hit(bundle, grid), "other rays beside it change no bit");
  expect(any_hit.found() == grid.found(), "there is a nearest hit where there is any");
  expect(nearest.admissible(grid, apps::Renderer::grid), "rounding explains the nearest hit, or the miss");
  expect(any.admissible(any_hit, apps::Renderer::grid), "rounding explains any hit, or the miss");
  expect(!grid.found() || nearest.distance_explained(grid), "rounding explains the distance");
}

void describe(const Subject& subject, const Ray& ray, const Hit& hit) {
  std::cerr.precision(9);
  for (const core::PrimitiveValues& primitive : subject.database.primitives()) {
    std::cerr << "primitive of kind " << static_cast<int>(primitive.kind) << ':';
    for (const float value : primitive.value) {
      std::cerr << ' ' << value;
    }
    std::cerr << '\n';
  }
  std::cerr << "ray from " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z << " along " << ray.direction.x << ' '
            << ray.direction.y << ' ' << ray.direction.z << " to " << ray.t_max << ", ignores " << ray.ignored_primitive
            << "; hit " << hit.primitive << " at " << hit.t << '\n';
  for (const apps::ExactIntersection& seen : subject.referee.exact_intersections(ray)) {
    std::cerr << "may hit " << seen.primitive << " at " << seen.t << " +- " << seen.t_error << ", by " << seen.margin[0]
              << " times rounding\n";
  }
}

/// The nearest hit.
Hit try_ray(const Subject& subject, const Ray& ray) {
  const apps::OwnAnswers answers = apps::ask_own_kernels(subject.database, ray);
  try {
    compare(ray, answers);
    const bool is_judged = is_ordinary(subject.database, ray), is_hit = answers.front().found();
    covered().count("rays that the referee judges", is_judged);
    covered().count("rays that it does not", !is_judged);
    covered().count("hits", is_hit);
    covered().count("misses", !is_hit);
    if (is_judged) {
      judge(subject, ray, answers);
    }
  } catch (const core::InternalError&) {
    describe(subject, ray, answers.front());
    throw;
  }
  return answers.front();
}

}  // namespace

void try_mesh(const std::uint8_t* data, std::size_t size) {
  tests::Bytes bytes(data, size);
  const core::Scene scene = tests::mesh_scene(bytes);
  const Subject subject{core::build_database(scene, tests::mesh_options(bytes))};
  tests::MeshRays rays(bytes, subject.database);
  for (std::size_t i = 0; i < rays_max && !bytes.empty(); ++i) {
    const Ray ray = rays.next();
    for (const Ray& child : apps::children_of(subject.database, ray, try_ray(subject, ray))) {
      covered().count("children");
      try_ray(subject, child);
    }
  }
}

}  // namespace dmpc::fuzz
