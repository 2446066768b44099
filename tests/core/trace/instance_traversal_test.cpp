// A base mesh is met where its copies are, to the bit.
#include "core/trace/instance_traversal.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/families/scenes.h"
#include "core/scene/base_meshes.h"
#include "core/scene/frame.h"
#include "core/trace/bundle_traversal.h"
#include "core/trace/instance_bundle.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::instance_traversal_test {
namespace {

using apps::Random;
using core::Hit;
using core::Ray;
using core::Scene;
using core::Transform;
using core::Vec3d;

template <class RayCursor>
Hit met(const Ray& ray, const core::Database& database, bool any_hit) {
  core::LocalRecords records(database.bytes());
  RayCursor cursor;
  core::Operations operations;
  core::trace(ray, cursor, records, database.header(), {.any_hit = any_hit}, operations);
  return cursor.best;
}

Scene polygons_of(const std::string& name) {
  const Scene family = core::built_in_scene(core::parse_scene_name(name));
  Scene mesh;
  core::SceneBuilder builder(mesh);
  for (const core::Object& object : family.objects) {
    if (object.vertex_count > 0) {
      const auto first = family.vertices.begin() + object.first;
      builder.polygon({first, first + object.vertex_count});
    }
  }
  return mesh;
}

/// `size`: of the scene; a third of the places are mirrors, and their sizes differ by factors of up to 16.
std::vector<Transform> places_apart(double size, Random& random) {
  std::vector<Transform> places;
  for (int i = 0; i < 24; ++i) {
    places.push_back(turned_place(size * std::exp2(random.in_box(-2, 2).x), random.in_box(-0.7, 0.7), i % 3 == 0));
  }
  return places;
}

struct Differences {
  int rays = 0, hits = 0, others = 0, any_hits = 0;
};

/// Rays from all over and from next to a mesh, at anything and at corners and edges.
Differences compare(const Scene& scene, double size, Random& random) {
  const core::Database copies = core::build_database(scene, with_copies()), kept = core::build_database(scene, with_instances());
  REQUIRE(kept.records().instances == scene.kept->places.size());
  Differences result;
  for (std::size_t i = 0; i < scaled(600); ++i) {
    const core::BaseMeshInstance& place = scene.kept->places[i % scene.kept->places.size()];
    const Scene& own = scene.kept->meshes[place.mesh];
    const auto& object = own.objects[random.below(own.objects.size())];
    const double share = i % 3 == 0 ? static_cast<double>(i % 2) : random.unit();
    const Vec3d at = own.vertices[object.first] * share + own.vertices[object.first + 1] * (1 - share);
    const Vec3d target = i % 4 == 0 ? random.in_box(-1, 1) : place.world.point(at), start = random.in_box(-1, 1);
    const Vec3d from = i % 5 == 0 || size < 1e-5 ? target + (start - target) * (3 * size) : start;
    const auto local = [&](const Vec3d& point) { return core::to_local(copies.header().frame, point); };
    Ray ray = apps::ray_through(local(from), local(target));
    ray.kind = i % 7 == 0 ? core::RayKind::shadow : core::RayKind::primary;
    const Hit expected = met<core::Cursor>(ray, copies, false), found = met<core::InstanceCursor>(ray, kept, false);
    const auto object_of = [](const core::Database& database, const Hit& hit) {
      return hit.found() ? database.sources()[hit.primitive].object : 0;
    };
    ++result.rays;
    result.hits += expected.found() ? 1 : 0;
    result.others += found.t != expected.t || object_of(kept, found) != object_of(copies, expected) ? 1 : 0;
    result.any_hits += met<core::InstanceCursor>(ray, kept, true).found() == expected.found() ? 0 : 1;
  }
  return result;
}

}  // namespace

TEST_CASE("rays meet what is kept where they meet its copies, in the same object at the same t, and any hit alike") {
  Random random(11);
  for (const Scene& mesh : {rug_on_floor(true, true, 6), rug_on_floor(false, true, 6), polygons_of("teapot-3"),
                            polygons_of("gears-1"), polygons_of("mount-3")}) {
    double reach = 0;
    for (const Vec3d& vertex : mesh.vertices) {
      reach = std::max(reach, largest_component(vertex));
    }
    for (const double size : {0.5, 0.05, 1e-3, 1e-6}) {  // the last about as small as the pad
      for (const bool are_apart : {true, false}) {
        CAPTURE(size);
        Scene scene = placed(mesh, are_apart ? places_apart(size / reach, random)
                                             : std::vector<Transform>(6, turned_place(size / reach, {0.1, 0.2, 0.3}, true)));
        add_far_specks(scene);
        const Differences found = compare(scene, size, random);
        CHECK(found.hits > found.rays / (size < 1e-5 ? 20 : 3));
        CHECK(found.others == 0);
        CHECK(found.any_hits == 0);
      }
    }
  }
}

TEST_CASE(
    "a ray's ways into base meshes and the triangles that are placed for it are counted, in a bundle the latter once for all") {
  Scene scene = placed(rug_on_floor(true, true, 6), {turned_place(0.5, {}, false), turned_place(0.01, {-0.9, -0.9, -0.9}, true)});
  add_far_specks(scene);
  const core::Database kept = core::build_database(scene, with_instances());
  const core::BaseMeshInstance& place = scene.kept->places[0];
  const Vec3d target = place.world.point(scene.kept->meshes[0].vertices[0] * 0.9);
  const auto local = [&](const Vec3d& point) { return core::to_local(kept.header().frame, point); };
  const Ray ray = apps::ray_through(local(target + Vec3d{0.1, 0.2, 1.5}), local(target)),
            away = apps::ray_through(local({0.9, 0.9, 0.9}), local({1, 1, 0.9}));
  const auto walked = [&](const Ray& one) {
    core::LocalRecords records(kept.bytes());
    core::InstanceCursor cursor;
    core::Operations operations;
    core::trace(one, cursor, records, kept.header(), {}, operations);
    return operations;
  };
  const core::Operations alone = walked(ray);
  CHECK(alone.instance_entries == 1);
  CHECK(alone.placed_triangles > 0);
  CHECK(alone.placed_triangles == alone.primitive_tests[0]);  // nothing is tested but what is placed
  CHECK(walked(away).instance_entries == 0);
  CHECK(walked(away).placed_triangles == 0);
  auto bundle = std::make_unique<core::InstanceBundle>();
  bundle->count = 16;
  std::fill_n(std::begin(bundle->rays), 16, ray);
  bundle->start();
  core::LocalRecords records(kept.bytes());
  core::Operations together;
  CHECK(core::trace(*bundle, records, kept.header(), {}, together));
  CHECK(together.instance_entries == 16);
  CHECK(together.placed_triangles == alone.placed_triangles);
  CHECK(together.primitive_tests[0] == 16 * alone.primitive_tests[0]);
  CHECK(together.bvh_node_reads == 16 * alone.bvh_node_reads);
}

TEST_CASE("no ray hits a base mesh's triangle that rounding leaves nothing of, as no copy has it") {
  for (const double side : {1e-2, 1e-4}) {
    Scene mesh = rug_on_floor(true, true, 6);
    const Vec3d at{0.3, 0.2, 0.9};
    core::SceneBuilder(mesh).polygon({at, at + Vec3d{side, 0, 0}, at + Vec3d{0, side, 0}});
    const auto speck = static_cast<std::uint32_t>(mesh.objects.size() - 1);
    Scene scene = placed(mesh, {turned_place(0x1p-27, {0.1, 0.2, 0.3}, false), turned_place(0x1p-27, {0.1, 0.2, 0.3}, true)});
    add_far_specks(scene);
    const core::Database copies = core::build_database(scene, with_copies()),
                         kept = core::build_database(scene, with_instances());
    REQUIRE(kept.records().instances == 2);
    int hits = 0, others = 0;
    Random random(5);
    for (int i = 0; i < 200; ++i) {
      const core::BaseMeshInstance& place = scene.kept->places[static_cast<std::size_t>(i % 2)];
      const auto local = [&](const Vec3d& point) { return core::to_local(kept.header().frame, place.world.point(point)); };
      const Vec3d target = at + Vec3d{side, side, 0} * 0.3, off = random.in_box(-1, 1);
      const Ray ray = apps::ray_through(local(target + off + Vec3d{0, 0, 1.5}), local(target));
      const Hit found = met<core::InstanceCursor>(ray, kept, false), expected = met<core::Cursor>(ray, copies, false);
      hits += found.found() && kept.sources()[found.primitive].object == place.first + speck ? 1 : 0;
      others += found.t != expected.t ? 1 : 0;
    }
    CHECK((hits > 0) == (side > 1e-3));
    CHECK(others == 0);
  }
}

TEST_CASE("a padded BVH node's boxes are larger by the pad on all sides, however large that is beside them") {
  Random random(3);
  for (const double pad : {0.0, 1e-9, 0.001, 0.2, 3.0, 1e3}) {
    for (int i = 0; i < 200; ++i) {
      core::BvhNode bvh_node{
          .origin = core::Vec3f(random.in_box(-1, 1)), .unit = std::ldexp(1.0F, -8 - i % 20), .child_count = 8};
      for (std::size_t child = 0; child < 8; ++child) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::uint8_t>(random.below(256)), b = static_cast<std::uint8_t>(random.below(256));
          bvh_node.bounds[axis][child] = std::min(a, b);
          bvh_node.bounds[axis + 3][child] = std::max(a, b);
        }
      }
      const core::BvhNode larger = core::padded(bvh_node, pad);
      bool holds = true, is_tight = true;
      for (std::size_t child = 0; child < 8; ++child) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double slack = 1e-6 * (1 + pad), low = place_of(bvh_node, axis, child) - place_of(larger, axis, child),
                       high = place_of(larger, axis + 3, child) - place_of(bvh_node, axis + 3, child);
          holds = holds && low >= pad - slack && high >= pad - slack;
          is_tight = is_tight && std::max(low, high) <= pad + slack + 4 * double{larger.unit};
        }
      }
      CHECK(holds);
      CHECK(is_tight);
    }
  }
}

TEST_CASE("a database tells of every triangle of a base mesh where it lies, and whose it is: there its copy's corners come out") {
  for (const Arrangement arrangement : {Arrangement::apart, Arrangement::coincident}) {
    const core::Database kept = core::build_database(balls_in_places(0.3, arrangement, 4), with_instances());
    core::LocalRecords records(kept.bytes());
    const std::vector<core::Database::Place> places = kept.find_places();
    REQUIRE(places.size() == kept.primitives().size());
    std::size_t of_instances = 0, others = 0;
    for (std::size_t id = 0; id < places.size(); ++id) {
      const core::PrimitiveValues& expected = kept.primitives()[id];
      const Hit hit{.leaf = places[id].leaf, .lane = places[id].lane};
      const std::byte* record = records.find(hit.leaf);
      core::PlacedLeaf placed;
      if (is_in_instance(hit)) {
        ++of_instances;
        const auto instance = core::read<core::InstanceRecord>(records.find(instance_of(hit)));
        placed.place(record, core::PlacedMesh(instance, kept.header().frame));
        record = placed.record();
      }
      const auto header = core::read<core::LeafHeader>(record);
      const std::uint32_t lane = hit.lane & core::lane_mask;
      bool is_same = core::read<std::uint32_t>(core::ids_of(header, record) + std::size_t{4} * lane) == id;
      for (std::size_t row = 0; row < core::value_count(header.kind); ++row) {
        const auto value = core::read<float>(record + sizeof(header) + sizeof(float) * (row * header.count + lane));
        is_same = is_same && value == expected.value[row];
      }
      others += is_same ? 0 : 1;
    }
    CHECK(of_instances == kept.records().triangles_in_places);
    CHECK(others == 0);
  }
}

TEST_CASE("a hit's lane tells the instance and the lane of the leaf") {
  for (const std::uint32_t at : {0U, 16U, 0x7ffffff0U}) {
    for (std::uint32_t lane = 0; lane < core::leaf_lanes; ++lane) {
      const Hit hit{.lane = core::lane_in_instance(lane, core::Address{at})};
      CHECK(core::is_in_instance(hit));
      CHECK(core::instance_of(hit) == core::Address{at});
      CHECK((hit.lane & core::lane_mask) == lane);
    }
  }
  CHECK(!core::is_in_instance(Hit{.lane = 7}));
}

}  // namespace dmpc::tests::instance_traversal_test
