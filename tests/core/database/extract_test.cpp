#include "core/database/extract.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/bench/stability/random.h"
#include "core/database/address_map.h"
#include "core/picture/camera/camera.h"
#include "core/trace/traversal.h"
#include "tests/support/border_scene.h"
#include "tests/support/random_regions.h"
#include "tests/support/small_scenes.h"

namespace extract_test {

using namespace dmpc::core;

namespace {

using namespace dmpc;
using core::Corner;
using core::DatabasePart;
using core::Region;

struct Answer {
  core::Traced traced = core::Traced::miss;
  core::Hit hit;
  int passages = 0;
};

/// A computer of one region a node, without the computer: the ray goes from owner to owner.
class Parts {
 public:
  Parts(const core::Database& database, std::vector<Region> regions) : regions_(std::move(regions)) {
    for (const Region& region : regions_) {
      parts_.push_back(core::extract(database, region));
    }
  }

  Answer trace(const core::Ray& ray) const {
    Answer answer;
    auto passage = core::first_passage(ray, parts_[0].header.frame);
    while (passage) {
      const DatabasePart& part = owner_of(passage->cell);
      core::LocalRecords records(part.bytes);
      core::Cursor cursor = core::arrive(*passage);
      core::Operations operations;
      answer.traced = core::trace(ray, cursor, records, part.header, {}, operations);
      answer.hit = cursor.best;
      ++answer.passages;
      if (answer.traced != core::Traced::left) {
        break;
      }
      passage = core::passage_of(cursor);
    }
    return answer;
  }

  std::uint64_t primitive_copies() const {
    std::uint64_t sum = 0;
    for (const DatabasePart& part : parts_) {
      sum += part.primitive_copies;
    }
    return sum;
  }

 private:
  const DatabasePart& owner_of(const Corner& cell) const {
    std::size_t owner = parts_.size();
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      if (regions_[i].contains(cell)) {
        CHECK(owner == parts_.size());  // one owner
        owner = i;
      }
    }
    REQUIRE(owner < parts_.size());
    return parts_[owner];
  }

  std::vector<Region> regions_;
  std::vector<DatabasePart> parts_;
};

/// Whether the ray met more than one region on its way.
bool check_same_answer(const core::Database& database, const Parts& parts, const core::Ray& ray) {
  core::LocalRecords whole(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  const core::Traced expected = core::trace(ray, cursor, whole, database.header(), {}, operations);
  const Answer answer = parts.trace(ray);
  CHECK(answer.traced == expected);
  if (ray.kind != core::RayKind::shadow) {
    CHECK(answer.hit.primitive == cursor.best.primitive);
    CHECK(answer.hit.t == cursor.best.t);
  }
  return answer.passages > 1;
}

void check_same_answers(const core::Scene& scene, std::size_t region_count, std::uint32_t seed) {
  CAPTURE(seed);
  std::mt19937 random(seed);
  const core::Database database = core::build_database(scene, apps::several_macro_cells(scene));
  const Parts parts(database, tests::random_regions(core::grid_size(database.header().frame), region_count, random));
  const core::Camera camera(scene.view, database.header().frame, 40, 40, 1);
  int travellers = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    core::Ray ray = camera.primary_ray(i % camera.pixel_count(), 0);
    if (i >= camera.pixel_count()) {  // from anywhere inside, in any direction, to the planes of the cells as well
      const auto number = [&] { return static_cast<float>(random() % 4097) / 4096.0F; };
      ray.origin = {number(), number(), number()};
      const core::Vec3f towards{number() - 0.5F, number() - 0.5F, number() - 0.50001F};
      ray.direction = i % 7 == 0 ? core::Vec3f{0, 1, 0} : core::normalize(towards);
      ray.kind = i % 2 == 0 ? core::RayKind::shadow : core::RayKind::reflected;
    }
    CAPTURE(i);
    travellers += check_same_answer(database, parts, ray) ? 1 : 0;
  }
  CHECK((travellers > 1000) == (region_count > 1));
}

/// In the border scene, from a corner of cells, straight along an axis, or diagonally: in planes between cells, along their
/// edges, through corners.
core::Ray ray_along_borders(float finest_cell, std::mt19937& random) {
  core::Ray ray;
  ray.kind = core::RayKind::reflected;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = static_cast<float>(random() % 9) * static_cast<float>(tests::BorderScene::size / 8) * finest_cell;
    ray.direction[axis] = static_cast<float>(random() % 3) - 1.0F;
  }
  return ray;
}

}  // namespace

TEST_CASE("rays that travel from region to region find what they find in the whole scene") {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    check_same_answers(tests::mirrors_and_glass(), 13, seed);
  }
  check_same_answers(tests::built_in("teapot-4"), 40, 4);
  check_same_answers(tests::built_in("tetra-5"), 24, 5);
  check_same_answers(tests::built_in("gears-2"), 17, 6);
}

TEST_CASE("rays in border planes, along edges and through corners find in parts what they find in the whole scene") {
  const core::Database database = core::build_database(tests::BorderScene().scene(), tests::BorderScene::options());
  const core::GridFrame& frame = database.header().frame;
  std::mt19937 random(8);
  for (const std::size_t region_count : {2U, 8U, 30U}) {
    const Parts parts(database,
                      tests::random_regions(core::grid_size(frame), region_count, random, tests::BorderScene::size / 16));
    int travellers = 0;
    for (int i = 0; i < 8000; ++i) {
      CAPTURE(i);
      travellers += check_same_answer(database, parts, ray_along_borders(frame.finest_cell, random)) ? 1 : 0;
    }
    CHECK(travellers > 500);
  }
}

TEST_CASE("a part of the whole grid answers like the whole") { check_same_answers(tests::built_in("rings-1"), 1, 1); }

TEST_CASE("parts hold together at least every copy of the whole, and each only its own") {
  const core::Database database = core::build_database(tests::built_in("teapot-6"), {});
  std::mt19937 random(7);
  const Parts one(database, {{.high = core::grid_size(database.header().frame)}});
  CHECK(one.primitive_copies() == database.references());
  const Parts many(database, tests::random_regions(core::grid_size(database.header().frame), 8, random));
  CHECK(many.primitive_copies() >= database.references());
  CHECK(many.primitive_copies() < 3 * database.references());
}

TEST_CASE("a region without primitives takes next to nothing") {
  const core::Database database = core::build_database(tests::built_in("balls-2"), {});
  const Corner size = core::grid_size(database.header().frame);
  const DatabasePart part = core::extract(database, {{0, 0, size[2] - 1}, {1, 1, size[2]}});
  CHECK(part.record_bytes < 4096);
}

TEST_CASE("a part is measured as it is extracted, and nothing is copied") {
  for (const core::Scene& scene : {tests::everything(), tests::built_in("teapot-4"), core::Scene()}) {
    std::mt19937 random(3);
    const core::Database database = core::build_database(scene, apps::several_macro_cells(scene));
    for (const Region& region : tests::random_regions(core::grid_size(database.header().frame), 12, random)) {
      const DatabasePart part = core::extract(database, region), measured = core::measure_part(database, std::span(&region, 1));
      CHECK(measured.record_bytes == part.record_bytes);
      CHECK(part.bytes.size() == part.record_bytes + core::overread_bytes);
      CHECK(measured.primitive_copies == part.primitive_copies);
      CHECK(measured.header.region == region);
      CHECK(measured.bytes.capacity() == 0);
    }
  }
}

TEST_CASE("a part of several regions answers in each of them as that region's own part does, and holds what they share once") {
  std::mt19937 random(5);
  const core::Scene scene = tests::everything();
  const core::Database database = core::build_database(scene, apps::several_macro_cells(scene));
  const std::vector<Region> all = tests::random_regions(core::grid_size(database.header().frame), 24, random);
  std::vector<Region> some;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    some.push_back(all[i]);
  }
  const DatabasePart joint = core::extract(database, some);
  REQUIRE(joint.holds.size() == some.size());
  std::uint64_t copies = 0;
  std::size_t bytes = 0, holding = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const DatabasePart own = core::extract(database, some[i]);
    CHECK(joint.holds[i] == (own.primitive_copies > 0));
    CHECK(own.holds[0] == joint.holds[i]);
    copies += own.primitive_copies;
    bytes += own.record_bytes;
    holding += joint.holds[i] ? 1 : 0;
  }
  CHECK(holding > 0);
  CHECK(joint.primitive_copies <= copies);
  CHECK(joint.primitive_copies <= database.references());
  CHECK(joint.record_bytes < bytes);
  CHECK(joint.header.region == some[0]);
  CHECK(core::measure_part(database, some).record_bytes == joint.record_bytes);
  CHECK(core::measure_part(database, some).holds == joint.holds);
}

TEST_CASE("an address keeps the place that it was given, among thousands") {
  AddressMap map;
  std::map<std::uint32_t, Address> twin;
  dmpc::apps::Random random(7);
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    // Neighbours by 5, as records of 40 bytes lie, and others.
    const auto from = static_cast<std::uint32_t>(i % 2 == 0 ? 5 * random.below(3000) : random.below(0x7fffffff));
    const auto [to, is_new] = map.find_or_add(Address{from});
    CHECK(is_new == !twin.contains(from));
    if (is_new) {
      CHECK(to == no_address);
      to = twin[from] = Address{i};
    }
    CHECK(to == twin.at(from));
  }
  CHECK(map.size() == twin.size());
}

}  // namespace extract_test
