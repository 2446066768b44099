// R9: space cut into regions, with triangles in the cutting planes: each nearest hit is claimed by one owner, and the traversal
// from owner to owner ends with the same bits.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/crowd.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/base/expect.h"
#include "core/database/extract.h"
#include "core/scene/frame.h"

namespace dmpc::apps {
namespace {

using core::Corner;
using core::Hit;
using core::Passage;
using core::Ray;
using core::Region;
using core::Traced;
using core::Vec3d;

/// A sixteenth of a macro cell, in finest cells.
constexpr std::int32_t slice = core::finest_per_macro / 16;
constexpr std::size_t slices_per_cell = core::finest_per_cell / slice;

/// Cuts the grid into `count` boxes at random planes between slices.
std::vector<Region> random_regions(const Corner& size, std::size_t count, Random& random) {
  std::vector<Region> regions{{.high = size}};
  while (regions.size() < count) {
    Region& low = regions[random.below(regions.size())];
    const std::size_t axis = random.below(3);
    const std::int32_t slices = (low.high[axis] - low.low[axis]) / slice;
    if (slices < 2) {
      continue;
    }
    Region high = low;
    const auto cut = static_cast<std::int32_t>(1 + random.below(static_cast<std::size_t>(slices - 1)));
    low.high[axis] = high.low[axis] = low.low[axis] + slice * cut;
    regions.push_back(high);
  }
  return regions;
}

/// Returns squares in planes between slices, within single precision, in the bounds of mixed_scene(), and that scene.
core::Scene walls_in_planes(const core::GridFrame& frame) {
  Random random(77);
  core::Scene scene = mixed_scene();
  core::SceneBuilder builder(scene);
  for (int wall = 0; wall < 60; ++wall) {
    const std::size_t axis = random.below(3), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto plane =
        slice * static_cast<std::int32_t>(random.below(slices_per_cell * static_cast<std::size_t>(frame.resolution[axis])));
    Vec3d corner{random.between(-1, 1), random.between(-1, 1), random.between(0, 0.3)};
    corner[axis] = frame.origin[axis] + core::plane_at(frame, axis, plane) / frame.scale;
    const auto at = [&](double along_u, double along_v) {
      Vec3d p = corner;
      p[u] += along_u;
      p[v] += along_v;
      return p;
    };
    builder.polygon({at(0, 0), at(0.1, 0), at(0.1, 0.1), at(0, 0.1)});
  }
  return scene;
}

/// Gives several macro cells. The grid's resolution must not depend on the walls, so it does not depend on their number, either.
core::BuildOptions options_for(std::size_t region_count) { return {.cells_per_primitive = region_count > 8 ? 4.0 : 1.0}; }

core::Scene scene_with_walls(const core::BuildOptions& options) {
  // Built twice: the first grid's planes determine the walls' positions, and the same number of walls anywhere gives the final
  // grid.
  const core::Database first =
      core::build_database(walls_in_planes(core::build_database(mixed_scene(), options).header().frame), options);
  return walls_in_planes(first.header().frame);
}

/// Emulates a computer with one region a node.
class Owners {
 public:
  Owners(const core::Database& database, std::size_t count) : frame_(database.header().frame) {
    Random random(count);
    for (const Region& region : random_regions(core::grid_size(frame_), count, random)) {
      parts_.push_back(core::extract(database, region));
    }
  }

  /// Returns the hit of the first owner on the ray's way that claims one.
  Hit journey(const Ray& ray) const {
    auto passage = core::first_passage(ray, frame_);
    while (passage) {
      core::Cursor cursor;
      if (visit(ray, *passage, cursor) != Traced::left) {
        return cursor.best;
      }
      passage = core::passage_of(cursor);
    }
    return {};
  }

  /// Returns how many owners claim `hit` independently: the ray comes to each without a candidate, and hits before it enters are
  /// not theirs.
  std::uint64_t claims(const Ray& ray, const Hit& hit) const {
    std::uint64_t count = 0;
    core::Operations operations;
    auto passage = core::first_passage(ray, frame_);
    for (Traced on_its_way = Traced::left; passage && on_its_way == Traced::left;) {
      core::Cursor cursor;
      const bool reaches = double{hit.t} >= passage->t_enter;
      count += reaches && visit(ray, *passage, cursor) == Traced::hit && same_hit(cursor.best, hit) ? 1 : 0;
      on_its_way = core::pass(ray, frame_, owner_of(passage->cell).header.region, *passage, operations);
    }
    return count;
  }

 private:
  Traced visit(const Ray& ray, const Passage& passage, core::Cursor& cursor) const {
    const core::DatabasePart& part = owner_of(passage.cell);
    core::LocalRecords records(part.bytes);
    core::Operations operations;
    cursor = core::arrive(passage);
    return core::trace(ray, cursor, records, part.header, {}, operations);
  }

  const core::DatabasePart& owner_of(const Corner& cell) const {
    const core::DatabasePart* owner = nullptr;
    for (const core::DatabasePart& part : parts_) {
      owner = part.header.region.contains(cell) ? &part : owner;
    }
    core::expect(owner != nullptr, "every finest cell has an owner");
    return *owner;
  }

  core::GridFrame frame_;
  std::vector<core::DatabasePart> parts_;
};

struct CutScene {
  explicit CutScene(std::size_t region_count)
      : database(core::build_database(scene_with_walls(options_for(region_count)), options_for(region_count))),
        owners(database, region_count) {}

  core::Database database;
  Owners owners;
};

void judge_claims(const CutScene& cut, const Ray& ray, StabilityCounts& count) {
  ++count.tried;
  const Hit hit = shoot(cut.database, ray);
  const std::uint64_t claims = hit.found() ? cut.owners.claims(ray, hit) : 1;
  if (claims != 1) {
    ++(claims == 0 ? count.leaks : count.double_claims);
  } else if (!same_hit(cut.owners.journey(ray), hit)) {
    ++count.unexplained;
  }
}

ShootRays rays_among_owners(std::size_t region_count) {
  const auto cut = std::make_shared<const CutScene>(region_count);
  return each_ray([cut](Random& random, std::uint64_t, KernelCounts& counts) {
    const Ray ray = random.bits() % 2 == 0 ? random_ray(cut->database, random) : grazing_ray(cut->database, random);
    judge_claims(*cut, ray, counts[index_of(StabilityKernel::regions)]);
  });
}

}  // namespace

StabilityCases region_cases(const StabilityAmount& amount) {
  constexpr std::array<std::size_t, 6> region_counts{1, 2, 3, 7, 8, 64};
  StabilityCases cases;
  for (const std::size_t count : region_counts) {
    cases.push_back({"R9 one owner a hit", std::to_string(count) + " regions", amount.share(10'000'000, region_counts.size()),
                     [count] { return rays_among_owners(count); }});
  }
  return cases;
}

}  // namespace dmpc::apps
