// R1: every vertex, edge and middle of closed bodies. R2: rays from inside, at random, at vertices, at edges. R3: scaled and
// moved bodies.
#include <cmath>
#include <memory>

#include "apps/lab/bench/stability/bodies.h"
#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/judge.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/targets.h"
#include "core/scene/frame.h"

namespace dmpc::apps {
namespace {

using core::Ray;
using core::Vec3d;
using Must = StabilityExpectation::Must;

/// One ray in this many is judged by the referee in any case, since that takes as long as hundreds of rays.
constexpr std::uint64_t referee_interval = 32;
constexpr std::uint64_t fine_referee_interval = 4096;

/// A body that has been transformed and built.
struct Placed {
  Placed(const ClosedBody& from, double by = 1, const Vec3d& to = {}, bool in_single = false)
      : body(from), factor(by), offset(to), subject(transformed(from.scene, by, to, in_single)) {}

  Vec3d inside(Random& random) const { return to_local(subject.frame(), body.inside(random) * factor + offset); }
  Must must() const { return body.is_mesh && !is_closed(subject.database.primitives()) ? Must::either : Must::hit; }

  ClosedBody body;
  double factor;
  Vec3d offset;
  StabilitySubject subject;
};

/// Returns every target in turn, then all again from the next origin.
Vec3d target_in_turn(const Placed& placed, std::uint64_t index, Random& random) {
  const auto primitives = placed.subject.database.primitives();
  const core::PrimitiveValues& primitive = primitives[index / targets_per_triangle % primitives.size()];
  return primitive.kind == core::PrimitiveKind::triangle ? target_of(primitive, index % targets_per_triangle)
                                                         : surface_point(primitive, random);
}

/// Returns the random numbers for the origin of a round of targets, the same for all its rays.
Random round_of(const Placed& placed, std::uint64_t index) {
  return Random(1 + index / (targets_per_triangle * placed.subject.database.primitives().size()));
}

Ray ray_in_turn(const Placed& placed, std::uint64_t index, Random& random) {
  Random round = round_of(placed, index);
  return ray_through(placed.inside(round), target_in_turn(placed, index, random));
}

template <class MakeRay>
ShootRays held_rays(const std::shared_ptr<const Placed>& placed, std::uint64_t interval, const MakeRay& make_ray) {
  return each_ray([placed, interval, make_ray, must = placed->must()](Random& random, std::uint64_t i, KernelCounts& counts) {
    const Ray ray = make_ray(*placed, i, random);
    judge(placed->subject, ray, ask_kernels(placed->subject, ray), {must, i % interval == 0}, counts);
  });
}

void add_closed_meshes(const StabilityAmount& amount, StabilityCases& cases) {
  const auto bodies = closed_bodies();
  for (const ClosedBody& body : bodies) {
    cases.push_back({"R1 closed bodies", body.name, amount.share(10'000'000, bodies.size()),
                     [body] { return held_rays(std::make_shared<const Placed>(body), referee_interval, ray_in_turn); }});
  }
}

const core::PrimitiveValues& any_of(const Placed& placed, Random& random) {
  const auto primitives = placed.subject.database.primitives();
  return primitives[random.below(primitives.size())];
}

void add_interior_rays(const StabilityAmount& amount, StabilityCases& cases) {
  const auto add = [&](const char* row, std::uint64_t rays, const auto& make_ray) {
    cases.push_back({row, "fine sphere", amount.share(rays, 1), [make_ray] {
                       return held_rays(std::make_shared<const Placed>(fine_sphere()), fine_referee_interval, make_ray);
                     }});
  };
  add("R2 rays from inside", 1'000'000'000, [](const Placed& placed, std::uint64_t, Random& random) {
    const Vec3d from = placed.inside(random);
    return ray_through(from, from + random.direction());
  });
  add("R2 at vertices", 100'000'000, [](const Placed& placed, std::uint64_t, Random& random) {
    const Vec3d from = placed.inside(random);
    return ray_through(from, target_of(any_of(placed, random), random.below(vertices_per_triangle)));
  });
  add("R2 at edges", 100'000'000, [](const Placed& placed, std::uint64_t, Random& random) {
    const Vec3d from = placed.inside(random);
    const auto& triangle = any_of(placed, random);
    return ray_through(from, on_edge(triangle, random.below(3), random.unit()));
  });
}

/// The grid's hit must have the same bits as on the unscaled body.
ShootRays scaled_rays(const ClosedBody& body, int exponent) {
  const auto plain = std::make_shared<const Placed>(body);
  const auto scaled = std::make_shared<const Placed>(body, std::ldexp(1.0, exponent));
  return each_ray([plain, scaled](Random& random, std::uint64_t i, KernelCounts& counts) {
    Random same = random;
    const core::Hit expected = shoot(plain->subject.database, ray_in_turn(*plain, i, same));
    const Ray ray = ray_in_turn(*scaled, i, random);
    judge(scaled->subject, ray, ask_kernels(scaled->subject, ray), {Must::hit, i % referee_interval == 0, &expected}, counts);
  });
}

void add_scales(const StabilityAmount& amount, StabilityCases& cases) {
  constexpr int exponent_max = 40;
  const auto bodies = closed_bodies();
  for (int exponent = -exponent_max; exponent <= exponent_max; ++exponent) {
    const ClosedBody& body = bodies[static_cast<std::size_t>(exponent + exponent_max) % bodies.size()];
    cases.push_back({"R3 scaled by 2^k", "2^" + std::to_string(exponent), amount.share(10'000'000, 2 * exponent_max + 1),
                     [body, exponent] { return scaled_rays(body, exponent); }});
  }
}

void add_offsets(const StabilityAmount& amount, StabilityCases& cases) {
  const auto bodies = closed_bodies();
  const std::vector<Vec3d> offsets{{2e5, 0, 0},        {148376, 1234, -223423},  {2e6, 0, 0},
                                   {1e6, -2e6, 1.5e6}, {0x1p10, 0x1p10, 0x1p10}, {0x1p20, -0x1p20, 0x1p19}};
  for (const ClosedBody& body : bodies) {
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const Vec3d to = offsets[i];
      cases.push_back({"R3 far from the origin", body.name + " " + std::to_string(i),
                       amount.share(10'000'000, bodies.size() * offsets.size()), [body, to] {
                         return held_rays(std::make_shared<const Placed>(body, 1, to, true), referee_interval, ray_in_turn);
                       }});
    }
  }
}

}  // namespace

StabilityCases mesh_cases(const StabilityAmount& amount) {
  StabilityCases cases;
  add_closed_meshes(amount, cases);
  add_interior_rays(amount, cases);
  add_scales(amount, cases);
  add_offsets(amount, cases);
  return cases;
}

}  // namespace dmpc::apps
