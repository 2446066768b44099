// R7: scenes of the SPD against Embree and the referee. R8: grazing rays among all kinds of primitives, every kernel. R12: scenes
// that are empty, flat, a single piece, coincident, or in two places far apart.
#include <array>
#include <memory>
#include <string>

#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/crowd.h"
#include "apps/lab/bench/stability/judge.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

using core::Ray;
using core::Scene;
using core::Vec3d;

/// Enough for several leaves in one place, and few enough for the referee, whose time grows with the square.
constexpr int coincident_copies = 40;

using MakeRay = Ray (*)(const StabilitySubject& subject, Random& random);

ShootRays rays_in(const Scene& scene, std::uint64_t referee_interval, MakeRay make_ray) {
  const auto subject = std::make_shared<const StabilitySubject>(scene);
  return each_ray([subject, referee_interval, make_ray](Random& random, std::uint64_t i, KernelCounts& counts) {
    const Ray ray = make_ray(*subject, random);
    judge(*subject, ray, ask_kernels(*subject, ray), {.to_referee = i % referee_interval == 0}, counts);
  });
}

/// Returns a point in the grid's box, enlarged by half of it on each side.
Vec3d anywhere(const StabilitySubject& subject, Random& random) {
  Vec3d at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = subject.frame().resolution[axis] * double{subject.frame().finest_cell} * core::finest_per_cell;
    at[axis] = core::plane_at(subject.frame(), axis, 0) + random.between(-0.5, 1.5) * extent;
  }
  return at;
}

/// Returns a ray from anywhere to anywhere, or to where a primitive begins.
Ray wild_ray(const StabilitySubject& subject, Random& random) {
  const Vec3d from = anywhere(subject, random);
  const auto primitives = subject.database.primitives();
  return ray_through(from, random.bits() % 2 == 0 || primitives.empty() ? anywhere(subject, random)
                                                                        : primitives[random.below(primitives.size())].vector(0));
}

Ray crowd_ray(const StabilitySubject& subject, Random& random) {
  return random.bits() % 2 == 0 ? random_ray(subject.database, random) : grazing_ray(subject.database, random);
}

void add_spd_scenes(const StabilityAmount& amount, StabilityCases& cases) {
  for (const char* name : {"balls-2", "gears-1", "jacks-2", "lattice-2", "mount-4", "rings-2", "rings-2-t1", "shells-2",
                           "sombrero-1", "teapot-6", "tetra-5", "tree-5"}) {
    cases.push_back({std::string("R7 ") + name, name, amount.share(100'000'000, 1),
                     [name] { return rays_in(core::built_in_scene(core::parse_scene_name(name)), 1024, wild_ray); }});
  }
}

Scene flat_scene() {
  Random random(3);
  Scene scene;
  core::SceneBuilder builder(scene);
  const auto corner = [&] {
    const double x = random.between(-1, 1);
    return Vec3d{x, 7, random.between(-1, 1)};
  };
  for (int i = 0; i < 200; ++i) {
    const Vec3d a = corner(), b = corner();
    builder.polygon({a, b, corner()});
  }
  return scene;
}

Scene one_triangle() { return scene_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}); }

Scene empty_scene() { return {}; }

Scene coincident_triangles() {
  Scene scene;
  for (int i = 0; i < coincident_copies; ++i) {
    add(scene, tetrahedron());
  }
  return scene;
}

Scene two_clusters() {
  Random random(33);
  Scene scene;
  for (const double x : {0.0, 1e6}) {
    for (int i = 0; i < 100; ++i) {
      add(scene, moved(tetrahedron(), 0.05, Vec3d{x, 0, 0} + random.in_box(-1, 1)));
    }
  }
  return scene;
}

}  // namespace

StabilityCases scene_cases(const StabilityAmount& amount) {
  StabilityCases cases;
  add_spd_scenes(amount, cases);
  cases.push_back({"R8 grazing, all kernels", "all kinds", amount.share(10'000'000, 1),
                   [] { return rays_in(mixed_scene(), 64, crowd_ray); }});
  const std::array<std::pair<const char*, Scene (*)()>, 5> scenes{{{"empty", empty_scene},
                                                                   {"one triangle", one_triangle},
                                                                   {"flat", flat_scene},
                                                                   {"coincident", coincident_triangles},
                                                                   {"two clusters", two_clusters}}};
  for (const auto& [name, make] : scenes) {
    cases.push_back({"R12 degenerate scenes", name, amount.share(1'000'000, scenes.size()),
                     [make = make] { return rays_in(make(), 64, wild_ray); }});
  }
  return cases;
}

}  // namespace dmpc::apps
