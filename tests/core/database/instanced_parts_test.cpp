// Parts of a database in which meshes are kept once.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/extract.h"
#include "core/database/meshes/placed_boxes.h"
#include "core/database/meshes/stored_instances.h"
#include "core/database/proxy.h"
#include "core/database/region_records.h"
#include "core/record/coordinate.h"
#include "core/scene/base_meshes.h"
#include "core/scene/placing.h"
#include "core/trace/bundle_traversal.h"
#include "core/trace/instance_traversal.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/random_regions.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::instanced_parts_test {
namespace {

using apps::Random;
using core::DatabasePart;
using core::Ray;
using core::Region;
using core::Vec3d;

std::vector<Region> random_regions(const core::Database& database, std::size_t count, Random& random) {
  return tests::random_regions(core::grid_size(database.header().frame), count, [&random] { return random.bits(); });
}

struct Answer {
  core::Traced traced = core::Traced::miss;
  core::Hit hit;
  int regions = 0;
};

Answer trace_whole(const core::Database& database, const Ray& ray) {
  core::LocalRecords records(database.bytes());
  core::InstanceCursor cursor;
  core::Operations operations;
  const core::Traced traced = core::trace(ray, cursor, records, database.header(), {}, operations);
  return {traced, cursor.best, 1};
}

Answer trace_alone(const Ray& ray, const core::Passage& passage, const DatabasePart& part, core::Passage& next) {
  core::LocalRecords records(part.bytes);
  core::InstanceCursor cursor;
  static_cast<core::Cursor&>(cursor) = core::arrive(passage);
  core::Operations operations;
  const core::Traced traced = core::trace(ray, cursor, records, part.header, {}, operations);
  next = core::passage_of(cursor);
  return {traced, cursor.best};
}

/// As the only ray of a bundle.
Answer trace_in_bundle(const Ray& ray, const core::Passage& passage, const DatabasePart& part, core::Passage& next) {
  core::LocalRecords records(part.bytes);
  core::InstanceBundle bundle;
  bundle.rays[0] = ray;
  bundle.count = 1;
  bundle.start();
  bundle.arrive(0, passage);
  core::Operations operations;
  CHECK(core::trace(bundle, records, part.header, {}, operations));
  next = bundle.passage(0);
  return {bundle.left != 0 ? core::Traced::left : bundle.found != 0 ? core::Traced::hit : core::Traced::miss, bundle.hit(0)};
}

/// From owner to owner. A candidate that another owner has found is nothing that is in this part.
template <class Trace>
Answer travel(const Ray& ray, const std::vector<DatabasePart>& parts, const Trace& trace) {
  Answer answer;
  auto passage = core::first_passage(ray, parts[0].header.frame);
  for (int regions = 1; passage; ++regions) {
    const auto owner = std::find_if(parts.begin(), parts.end(),
                                    [&](const DatabasePart& part) { return part.header.region.contains(passage->cell); });
    REQUIRE(owner != parts.end());
    passage->best.leaf = core::no_address;
    core::Passage next;
    answer = trace(ray, *passage, *owner, next);
    answer.regions = regions;
    if (answer.traced != core::Traced::left) {
      break;
    }
    passage = next;
  }
  return answer;
}

std::vector<DatabasePart> parts_of(const core::Database& database, const std::vector<Region>& regions) {
  std::vector<DatabasePart> parts;
  for (const Region& region : regions) {
    parts.push_back(core::extract(database, region));
  }
  return parts;
}

/// Rays at corners and edges of what is kept, from all over; every third goes on behind it.
Ray ray_at_place(const core::Scene& scene, const core::Database& database, std::size_t i, Random& random) {
  const core::BaseMeshInstance& place = scene.kept->places[i % scene.kept->places.size()];
  const core::Scene& mesh = scene.kept->meshes[place.mesh];
  const core::Object& object = mesh.objects[random.below(mesh.objects.size())];
  const double share = i % 3 == 0 ? static_cast<double>(i % 2) : random.unit();
  const Vec3d at = place.world.point(mesh.vertices[object.first] * share + mesh.vertices[object.first + 1] * (1 - share));
  const auto local = [&](const Vec3d& point) { return core::to_local(database.header().frame, point); };
  const Vec3d start = random.in_box(-1, 1);
  Ray ray = apps::ray_through(local(i % 5 == 0 ? at + (start - at) * 0.01 : start), local(at));
  ray.kind = i % 7 == 0 ? core::RayKind::shadow : core::RayKind::reflected;
  return ray;
}

/// A strip of 2 x `squares` triangles from -1 to 1 along x, next to y = z = 0, in floats.
core::Scene strip(int squares) {
  core::Scene mesh;
  core::SceneBuilder builder(mesh);
  for (int i = 0; i < squares; ++i) {
    const double x = -1 + 2.0 * i / squares, next = -1 + 2.0 * (i + 1) / squares;
    builder.polygon({{x, 0, 0}, {next, 0, 0}, {next, 0.01, 0}});
    builder.polygon({{x, 0, 0}, {next, 0.01, 0}, {x, 0.01, 0}});
  }
  return mesh;
}

core::Transform at(const Vec3d& shift) { return {.shift = shift}; }

/// Records that a part has, by what they are.
struct Counts {
  std::size_t instances = 0, mesh_bvh_nodes = 0, mesh_leaves = 0;
};

class Counter {
 public:
  explicit Counter(const DatabasePart& part) : Counter(part.header, part.bytes) {}
  Counter(const core::DatabaseHeader& header, std::span<const std::byte> bytes) : records_(bytes) {
    const auto entry = core::read<core::DirectoryEntry>(records_.find(header.directory));
    if (!entry.empty()) {
      below(entry.bvh_node(), false);
    }
  }
  Counts counts() const { return {instances_.size(), bvh_nodes_.size(), leaves_.size()}; }
  const std::set<core::Address>& mesh_leaves() const { return leaves_; }

 private:
  void below(core::Address address, bool is_in_mesh) {
    if (is_in_mesh) {
      bvh_nodes_.insert(address);
    }
    const auto bvh_node = core::read<core::BvhNode>(records_.find(address));
    CHECK(bvh_node.child_count > 0);
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      const core::Address next = bvh_node.child[child].address();
      bvh_node.child[child].is_leaf() ? leaf(next, is_in_mesh) : below(next, is_in_mesh);
    }
  }
  void leaf(core::Address address, bool is_in_mesh) {
    const std::byte* const record = records_.find(address);
    const auto header = core::read<core::LeafHeader>(record);
    CHECK(header.count > 0);
    if (is_in_mesh) {
      leaves_.insert(address);
    }
    for (std::size_t lane = 0; header.kind == core::PrimitiveKind::instance && lane < header.count; ++lane) {
      const core::Address instance = core::instance_in(record, lane);
      CHECK(instances_.insert(instance).second);
      below(core::read<core::InstanceRecord>(records_.find(instance)).root, true);
    }
  }

  core::LocalRecords records_;
  std::set<core::Address> instances_, bvh_nodes_, leaves_;
};

/// The grid's lower and upper part along x, `share` of it being the lower one.
std::vector<Region> cut_along_x(const core::Database& database, double share) {
  Region low{.high = core::grid_size(database.header().frame)}, high = low;
  low.high[0] = high.low[0] = static_cast<std::int32_t>(share * high.high[0]);
  return {low, high};
}

/// Where a world's x lies among the grid's, from 0 to 1.
double share_at(const core::Database& database, double x) {
  const core::GridFrame& frame = database.header().frame;
  return (core::to_local(frame, {x, 0, 0}).x - frame.low.x) / (core::grid_high(frame).x - frame.low.x);
}

}  // namespace

TEST_CASE("rays that travel from region to region find of what is kept once what they find in the whole, alone and in bundles") {
  std::uint64_t seed = 0;
  for (const double size : {0.5, 0.05, 1e-3}) {
    for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other, Arrangement::coincident}) {
      CAPTURE(++seed);
      Random random(seed);
      const core::Scene scene = balls_in_places(size, arrangement, seed);
      const core::Database database = core::build_database(scene, with_instances());
      REQUIRE(database.records().instances == 18);
      for (const std::size_t count : {2U, 27U}) {
        const std::vector<DatabasePart> parts = parts_of(database, random_regions(database, count, random));
        int travellers = 0, hits = 0, others = 0;
        for (std::size_t i = 0; i < scaled(1000); ++i) {
          const Ray ray = ray_at_place(scene, database, i, random);
          const Answer whole = trace_whole(database, ray), alone = travel(ray, parts, trace_alone),
                       together = travel(ray, parts, trace_in_bundle);
          const bool is_any = ray.kind == core::RayKind::shadow;
          const auto differs = [&](const Answer& answer) {
            return answer.traced != whole.traced ||
                   (!is_any && (answer.hit.t != whole.hit.t || answer.hit.primitive != whole.hit.primitive));
          };
          const bool go_apart = !is_any && alone.regions != together.regions;  // any hit will do, and bundles look at more boxes
          others += differs(alone) || differs(together) || go_apart ? 1 : 0;
          travellers += alone.regions > 1 ? 1 : 0;
          hits += whole.hit.found() ? 1 : 0;
        }
        CHECK(others == 0);
        CHECK(hits > 0);
        CHECK((travellers > 0 || slowness > 1));
      }
    }
  }
}

TEST_CASE("of a hit that travelled as a candidate the part that has its record knows leaf and place, alone and in bundles") {
  const core::Scene scene = balls_in_places(0.5, Arrangement::apart, 3);
  const core::Database database = core::build_database(scene, with_instances());
  const DatabasePart part = core::extract(database, Region{.high = core::grid_size(database.header().frame)});
  Random random(4);
  int kept = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    Ray ray = ray_at_place(scene, database, i, random);
    ray.kind = core::RayKind::reflected;
    const Answer whole = trace_whole(database, ray);
    auto passage = core::first_passage(ray, database.header().frame);
    if (!passage || !whole.hit.found()) {
      continue;
    }
    passage->best = whole.hit;
    passage->best.leaf = core::no_address;
    core::Passage next;
    for (const core::Hit& hit : {trace_alone(ray, *passage, part, next).hit, trace_in_bundle(ray, *passage, part, next).hit}) {
      CHECK(apps::same_hit(hit, whole.hit));
      CHECK(hit.leaf != core::no_address);
      CHECK(core::is_in_instance(hit) == core::is_in_instance(whole.hit));
      CHECK((hit.lane & core::lane_mask) == (whole.hit.lane & core::lane_mask));
    }
    kept += core::is_in_instance(whole.hit) ? 1 : 0;
  }
  CHECK(kept > 50);
}

using Wide = std::array<long double, 3>;

long double determinant_of(const Wide& a, const Wide& b, const Wide& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// How far along an axis of the mesh a step of `pad` along each of the grid's axes, forth or back, goes at most, in units of
/// `unit`: by Cramer's rule.
long double furthest_in_mesh(const core::Transform& world, const core::GridFrame& frame, double unit, double pad) {
  std::array<Wide, 3> columns{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns[axis][row] = static_cast<long double>(world.rows[row][axis]) * unit * frame.scale;
    }
  }
  long double furthest = 0;
  for (unsigned signs = 0; signs < 8; ++signs) {
    Wide step{};
    for (std::size_t row = 0; row < 3; ++row) {
      step[row] = (signs >> row & 1U) != 0 ? pad : -pad;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<Wide, 3> replaced = columns;
      replaced[axis] = step;
      furthest = std::max(furthest, std::fabs(determinant_of(replaced[0], replaced[1], replaced[2]) /
                                              determinant_of(columns[0], columns[1], columns[2])));
    }
  }
  return furthest;
}

TEST_CASE(
    "a place's pad is how far the grid's reaches along the mesh's axes, however the place turns, mirrors, shears, flattens") {
  const core::GridFrame frame =
      core::build_database(balls_in_places(0.5, Arrangement::apart, 3), with_instances()).header().frame;
  core::StoredInstances kept;
  kept.meshes.resize(1);
  kept.meshes.front().unit = 4;
  Random random(21);
  for (int i = 0; i < 1000; ++i) {
    core::StoredInstance place;
    for (Vec3d& row : place.world.rows) {
      row = random.in_box(-1, 1);
    }
    place.world.rows[0] = place.world.rows[0] * (i % 5 == 0 ? 0x1p-20 : 1);
    constexpr double pad = 0x1p-18;
    const double has = double{kept.record_of(place, frame, pad).pad};
    const auto furthest = static_cast<double>(furthest_in_mesh(place.world, frame, 4, pad));
    CHECK(has >= furthest);
    CHECK(has <= 1.001 * furthest);
  }
}

TEST_CASE("a box in a place holds its corners as rounding leaves them, and the grid's pad around them") {
  Random random(9);
  for (const double size : {1.0, 0.01, 1e-4}) {
    const core::Scene scene = balls_in_places(size, Arrangement::apart, 6);
    const core::Database database = core::build_database(scene, with_instances());
    const core::GridFrame& frame = database.header().frame;
    for (int i = 0; i < 200; ++i) {
      core::InstanceRecord instance;
      const core::Transform world = turned_place(size, random.in_box(-1, 1), i % 2 == 0);
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          instance.world[3 * row + axis] = world.rows[row][axis];
        }
        instance.world[9 + row] = world.shift[row];
      }
      instance.unit = 2;
      const double pad = 1e-3 * size * frame.scale;
      instance.pad = static_cast<float>(1e-3);  // twice as far as that in the mesh, of which places shorten nothing
      core::BvhNode bvh_node{.origin = {-0.5F, -0.25F, -0.125F}, .unit = 1.0F / 256, .child_count = 1};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bvh_node.bounds[axis][0] = static_cast<std::uint8_t>(random.below(100));
        bvh_node.bounds[axis + 3][0] = static_cast<std::uint8_t>(100 + random.below(100));
      }
      const core::Box box = core::PlacedBoxes(instance, frame).box_of(bvh_node, 0);
      const core::Placing placing(world, frame);
      for (std::size_t corner = 0; corner < 8; ++corner) {
        Vec3d in_mesh;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          in_mesh[axis] = core::place_of(bvh_node, (corner >> axis & 1U) != 0 ? axis + 3 : axis, 0) * 2;
        }
        const Vec3d placed(core::coordinates_of(placing.corner(in_mesh)));
        CHECK(box.holds(placed + Vec3d{pad, pad, pad}));
        CHECK(box.holds(placed - Vec3d{pad, pad, pad}));
      }
      CHECK(length(box.half()) < 4 * size * frame.scale);
    }
  }
}

TEST_CASE("no ray hits what is kept before the first leaf of any proxy, and of a finer one some have a later one") {
  for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other}) {
    const core::Scene scene = balls_in_places(0.3, arrangement, 17);
    const core::Database database = core::build_database(scene, with_instances());
    Random random(18);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < scaled(2000); ++i) {
      Ray ray = ray_at_place(scene, database, i, random);
      ray.kind = core::RayKind::reflected;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ray.direction[axis] += static_cast<float>(random.between(-0.1, 0.1));
      }
      rays.push_back(ray);
    }
    std::vector<float> before(rays.size());
    for (const std::size_t bytes_max : {1024U, 4096U, 1U << 24U}) {
      CAPTURE(bytes_max);
      const DatabasePart proxy = core::proxy_of(database, bytes_max);
      REQUIRE(proxy.header.directory != core::no_address);
      CHECK(proxy.record_bytes <= bytes_max);
      core::LocalRecords records(proxy.bytes);
      std::size_t later = 0, early = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        const auto start = core::first_passage(ray, database.header().frame);
        if (!start) {
          continue;
        }
        core::Operations operations;
        core::Cursor cursor = core::arrive(*start);
        const core::CellTraversal walk(ray, proxy.header.frame, proxy.header.region);
        const float first = core::RayTraversal(ray, cursor, records, operations).first_leaf(walk, proxy.header);
        const Answer whole = trace_whole(database, ray);
        early += whole.hit.found() && whole.hit.t < first ? 1 : 0;
        later += first > std::exchange(before[i], first) ? 1 : 0;
      }
      CHECK(early == 0);
      CHECK(later > 0);
    }
  }
}

TEST_CASE("a part has the places that reach it and of their mesh each record once, however many there are") {
  // A mesh of 72 triangles, so of 9 leaves or more below two BVH nodes or more. On either side of x = 0 it stands so many times,
  // far from there.
  for (const int here : {1, 5, 40}) {
    const int there = 3;
    std::vector<core::Transform> places;
    for (int i = 0; i < here + there; ++i) {
      places.push_back({.rows = {{{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}},
                        .shift = {i < here ? -0.5 : 0.5, -0.9 + 1.8 * i / (here + there), 0.01 * i}});
    }
    core::Scene scene = placed(strip(36), places);
    add_far_specks(scene);
    const core::Database database = core::build_database(scene, with_instances());
    REQUIRE(database.records().instances == static_cast<std::uint64_t>(here + there));
    const Counts whole = Counter(database.header(), database.bytes()).counts();
    REQUIRE(whole.mesh_leaves >= 9);
    const std::size_t mesh_bytes = 72 * 44 + whole.mesh_leaves * 8 + whole.mesh_bvh_nodes * 104;
    const std::vector<DatabasePart> parts = parts_of(database, cut_along_x(database, share_at(database, 0)));
    for (std::size_t i = 0; i < 2; ++i) {
      const Counts counts = Counter(parts[i]).counts();
      CHECK(counts.instances == static_cast<std::size_t>(i == 0 ? here : there));
      CHECK(counts.mesh_bvh_nodes == whole.mesh_bvh_nodes);
      CHECK(counts.mesh_leaves == whole.mesh_leaves);
    }
    // Directory, places and mesh; of each place its share of a leaf of boxes, and of the BVH nodes above.
    const DatabasePart none = core::extract(database, Region{{0, 0, 0}, {1, 1, 1}});
    CHECK(Counter(none).counts().instances == 0);
    CHECK(none.record_bytes <= 1024);
    CHECK(parts[0].record_bytes >= static_cast<std::size_t>(here) * 128 + mesh_bytes);
    CHECK(parts[0].record_bytes <= static_cast<std::size_t>(here) * (128 + 32 + 8 + 104) + mesh_bytes * 5 / 4 + 4 * 512);
  }
}

TEST_CASE("of a mesh that is larger than regions a part has what lies there, of two that stand the other way round both ends") {
  // 64 leaves of 8 triangles in a row; 8 regions of equal width along it.
  const core::Transform mirrored{.rows = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .shift = {0, 0.5, 0}};
  for (const bool is_twice : {false, true}) {
    core::Scene scene = placed(strip(256), {at({0, -0.5, 0}), is_twice ? mirrored : at({0, 0.5, 0})});
    const core::Database database = core::build_database(scene, with_instances());
    REQUIRE(database.records().instances == 2);
    REQUIRE(database.records().leaves[0] >= 64);
    const double leaves = static_cast<double>(database.records().leaves[0]);
    std::size_t sum = 0;
    for (int i = 0; i < 8; ++i) {
      Region region{.high = core::grid_size(database.header().frame)};
      region.low[0] = region.high[0] * i / 8;
      region.high[0] = region.high[0] * (i + 1) / 8;
      const DatabasePart part = core::extract(database, region);
      const Counts counts = Counter(part).counts();
      CHECK(counts.instances == (counts.mesh_leaves > 0 ? 2 : 0));  // the grid reaches beyond the scene
      CHECK(static_cast<double>(counts.mesh_leaves) <= (is_twice ? 2 : 1) * (leaves / 8 + 3));
      sum += counts.mesh_leaves;
    }
    CHECK(static_cast<double>(sum) >= (is_twice ? 1.7 : 1.0) * leaves);
  }
}

TEST_CASE("a place whose box reaches a region, but none of whose boxes does, is not there") {
  // Two triangles far apart: the corner of their box is empty.
  core::Scene mesh;
  core::SceneBuilder builder(mesh);
  for (int i = 0; i < 40; ++i) {
    const double y = 0.0005 * i;
    builder.polygon({{-1, y, 0}, {-0.9, y, 0}, {-1, y + 0.0002, 0}});
    builder.polygon({{1, 1 + y, 0}, {0.9, 1 + y, 0}, {1, 1.0002 + y, 0}});
  }
  core::Scene scene = placed(mesh, {at({0, -0.5, 0}), at({0, -0.5, 0.3})});
  const core::Database database = core::build_database(scene, with_instances());
  REQUIRE(database.records().instances == 2);
  const core::Corner size = core::grid_size(database.header().frame);
  const Region corner{{size[0] / 2 + 1, 0, 0}, {size[0], size[1] / 2 - 1, size[2]}};
  const DatabasePart part = core::extract(database, corner);
  CHECK(Counter(part).counts().instances == 0);
  CHECK_FALSE(part.holds[0]);
  CHECK(Counter(core::extract(database, Region{{}, {size[0] / 2, size[1], size[2]}})).counts().instances == 2);
}

TEST_CASE("a part of several regions has what those have that it is of, each record once, and is measured as it is extracted") {
  Random random(12);
  const core::Scene scene = balls_in_places(0.4, Arrangement::apart, 9);
  const core::Database database = core::build_database(scene, with_instances());
  const std::vector<Region> all = random_regions(database, 24, random);
  std::vector<Region> some;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    some.push_back(all[i]);
  }
  const DatabasePart joint = core::extract(database, some), measured = core::measure_part(database, some);
  std::size_t bytes = 0, most = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const DatabasePart own = core::extract(database, some[i]);
    CHECK((joint.holds[i] || !own.holds[0]));
    bytes += own.record_bytes;
    most = std::max(most, own.record_bytes);
  }
  CHECK(joint.record_bytes < bytes);
  CHECK(joint.record_bytes >= most);
  CHECK(measured.record_bytes == joint.record_bytes);
  CHECK(measured.primitive_copies == joint.primitive_copies);
  CHECK(measured.holds == joint.holds);
}

TEST_CASE("of meshes a region is said to need the leaves that its part has copies of") {
  Random random(14);
  const core::Scene scene = balls_in_places(0.4, Arrangement::deep_in_each_other, 11);
  const core::Database database = core::build_database(scene, with_instances());
  const Counter whole(database.header(), database.bytes());
  std::size_t parts = 0;
  for (const Region& region : random_regions(database, 9, random)) {
    std::set<core::Address> visited;
    core::LocalRecords records(database.bytes());
    core::for_each_record_of(records, database.header(), region, [&](core::Address address) { visited.insert(address); });
    const auto is_visited = [&](core::Address address) { return visited.contains(address); };
    const auto leaves =
        static_cast<std::size_t>(std::count_if(whole.mesh_leaves().begin(), whole.mesh_leaves().end(), is_visited));
    CHECK(leaves == Counter(core::extract(database, region)).counts().mesh_leaves);
    parts += leaves > 0 && leaves < whole.mesh_leaves().size() ? 1 : 0;
  }
  CHECK(parts > 2);
}

}  // namespace dmpc::tests::instanced_parts_test
