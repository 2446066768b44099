// R6: every point of every primitive lies in boxes that lead to the primitive, with the pad and (up to rounding of the points)
// without.
#include <array>
#include <memory>
#include <utility>

#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/crowd.h"
#include "apps/lab/bench/stability/listing.h"
#include "apps/lab/bench/stability/targets.h"

namespace dmpc::apps {
namespace {

using core::Scene;
using core::Vec3d;

constexpr int primitive_count = 300;
/// Gives 300 primitives several macro cells.
constexpr double cells_per_primitive = 4;
/// Slightly more than the error of a sample point: without a pad a point may belong to the neighbour.
constexpr double sample_error = 1e-12;

template <class AddOne>
Scene scene_by(const AddOne& add_one) {
  Random random(5);
  Scene scene;
  core::SceneBuilder builder(scene);
  for (int i = 0; i < primitive_count; ++i) {
    add_one(builder, random);
  }
  return scene;
}

Scene small_triangles() {
  return scene_by([](core::SceneBuilder& builder, Random& random) {
    const Vec3d at = random.in_box(-1, 1);
    builder.polygon({at, at + random.in_box(-0.2, 0.2), at + random.in_box(-0.2, 0.2)});
  });
}

/// Returns triangles whose vertices share coordinates, as do the grid's planes.
Scene lattice_triangles() {
  return scene_by([](core::SceneBuilder& builder, Random& random) {
    const auto at = [&] { return random.below(9) / 4.0 - 1.0; };
    const auto corner = [&] {
      const double x = at(), y = at();
      return Vec3d{x, y, at()};
    };
    const Vec3d a = corner(), b = corner();
    builder.polygon({a, b, corner()});
  });
}

Scene needles() {
  return scene_by([](core::SceneBuilder& builder, Random& random) {
    const Vec3d at = random.in_box(-1, 1), to = random.in_box(-1, 1);
    builder.polygon({at, to, to + random.direction() * (length(to - at) * 1e-6)});
  });
}

Scene large_triangles() {
  return scene_by([](core::SceneBuilder& builder, Random& random) {
    const Vec3d a = random.direction(), b = random.direction();
    builder.polygon({a, b, random.direction()});
  });
}

bool listed_beside(const Listing& listing, const Vec3d& at, std::uint32_t id) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const auto towards = [&](std::size_t axis) { return (corner >> axis & 1U) != 0 ? sample_error : -sample_error; };
    if (listing.lists(at + Vec3d{towards(0), towards(1), towards(2)}, id)) {
      return true;
    }
  }
  return false;
}

ShootRays sample_points(const Scene& scene, bool padded) {
  const core::BuildOptions options{.cells_per_primitive = cells_per_primitive, .pad_share = padded ? 1.0 : 0.0};
  const auto database = std::make_shared<const core::Database>(core::build_database(scene, options));
  return [database, padded](Random& random, std::uint64_t first, std::uint64_t count) {
    const Listing listing(*database);
    KernelCounts counts{};
    StabilityCounts& points = counts[index_of(StabilityKernel::listing)];
    points.tried = count;
    for (std::uint64_t i = first; i < first + count; ++i) {
      const auto id = static_cast<std::uint32_t>(i % database->primitives().size());
      const Vec3d at = surface_point(database->primitives()[id], random);
      points.leaks += listing.lists(at, id) || (!padded && listed_beside(listing, at, id)) ? 0 : 1;
    }
    return counts;
  };
}

}  // namespace

StabilityCases insertion_cases(const StabilityAmount& amount) {
  const std::array<std::pair<const char*, Scene (*)()>, 5> scenes{{{"small triangles", small_triangles},
                                                                   {"triangles on a lattice", lattice_triangles},
                                                                   {"needles", needles},
                                                                   {"large triangles", large_triangles},
                                                                   {"all kinds", mixed_scene}}};
  StabilityCases cases;
  for (const auto& [name, make] : scenes) {
    for (const bool padded : {true, false}) {
      cases.push_back({padded ? "R6 points listed" : "R6 points listed, no pad", name, amount.share(50'000'000, scenes.size()),
                       [make = make, padded] { return sample_points(make(), padded); }});
    }
  }
  return cases;
}

}  // namespace dmpc::apps
