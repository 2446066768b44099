#include "apps/scene/subject.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/scene/load_scene.h"
#include "tests/support/placed_meshes.h"

namespace dmpc::apps::subject_test {

TEST_CASE("a subject has the scene's records and the picture that was asked for") {
  const PictureOptions picture{.scene = "tetra-3", .resolution = Resolution{20, 10}, .samples = 2, .depth = 3};
  const Subject subject = build_subject(load_scene(picture), picture);
  CHECK(subject.database.header().primitive_count == 64);
  CHECK(subject.database.page_size() == 1024);
  CHECK(subject.settings.camera.width() == 20);
  CHECK(subject.settings.camera.height() == 10);
  CHECK(subject.settings.shade.depth_max == 3);
}

TEST_CASE("a subject's page size and order of records are those asked for") {
  const PictureOptions picture{.scene = "tetra-3"};
  const core::Scene scene = load_scene(picture);
  const Subject small_pages = build_subject(scene, picture, {.build = {.page_size_bytes = 512}});
  const Subject scattered = build_subject(scene, picture, {.build = {.record_order = core::RecordOrder::scattered}});
  CHECK(small_pages.database.page_size() == 512);
  CHECK_FALSE(std::ranges::equal(small_pages.database.bytes(), scattered.database.bytes()));
}

TEST_CASE("how much is kept once is told where that was asked for, and what keeps the rest from it") {
  core::RecordCounts records{{.instances = 67, .base_meshes = 29, .base_mesh_triangles = 1234, .triangles_in_places = 56789}, {}};
  CHECK(kept_text(records) == "kept 29 meshes in 67 places: 1,234 triangles for 56,789");
  records.copied = {{core::Obstacle::shining, 1200}, {core::Obstacle::far_away, 1}};
  CHECK(kept_text(records) ==
        "kept 29 meshes in 67 places: 1,234 triangles for 56,789; copied is what shines, in 1,200 places, and what reaches too "
        "far out, in 1 place");
  CHECK(kept_text({{.instances = 1, .base_meshes = 1, .base_mesh_triangles = 70, .triangles_in_places = 70}, {}}) ==
        "kept 1 mesh in 1 place: 70 triangles for 70");
  CHECK(kept_text({}) == "no mesh is kept once: none of more than 64 triangles stands in several places as the file has it");
  CHECK(kept_text({{}, {{core::Obstacle::shining, 5}}}) == "no mesh is kept once: copied is what shines, in 5 places");
}

TEST_CASE("what is kept without having been asked for is told, and why copies are there where something else was open") {
  const core::RecordCounts records{
      {.instances = 67, .base_meshes = 29, .base_mesh_triangles = 1234, .triangles_in_places = 56789}, {}};
  const core::InstancingShare share{.seen = 3 * 56789, .stored = 3 * 1368, .places = 67};
  const DatabaseOptions open{.instances = InstancesChoice::automatic};
  CHECK(instances_text({}, false, {}, share).empty());
  CHECK(instances_text(open, false, {}, {.seen = 30, .stored = 30}) == kept_text({}));
  CHECK(instances_text(open, true, records, share) == kept_text(records));
  CHECK(
      instances_text(open, false, {}, {.seen = 600, .stored = 450, .places = 2}) ==
      "meshes have a copy in each of 2 places: with each once the scene would still take about 150 triangles of 200, a place for "
      "two, and --instances=auto keeps them once below half of these");
  CHECK(instances_text(open, false, {}, {.seen = 60'000'000, .stored = 9'000'000, .places = 2, .own = 2'999'990}) ==
        "meshes have a copy in each of 2 places: beside places a tree has room for 2,097,152 primitives, and the scene has about "
        "2,999,990 that are in no mesh that is kept");
  CHECK(instances_text({.instances = InstancesChoice::automatic, .why_copied = "--structure=grid"}, false, {}, share) ==
        "meshes have a copy in each of 67 places: none is kept once with --structure=grid");
}

TEST_CASE("what is open is kept where that leaves less than half of the scene to store, and else has the database asked for") {
  const auto instances_with = [](std::uint32_t places, const std::string& hindrance, bool shines = false) {
    core::Scene scene = tests::in_floats(tests::rug_on_floor(false, true, 6));
    for (core::Material& material : scene.materials) {
      material.emission = shines ? core::Vec3d{1, 1, 1} : core::Vec3d{};
    }
    const auto end = static_cast<std::uint32_t>(scene.objects.size());
    const std::vector<core::Instance> at(places, {tests::turned_place(0.3, {0, 0, 1}, false), 0, end});
    core::settle(scene, {.meshes = {{0, end}}, .places = at}, core::Copies::left_out);
    const DatabaseOptions options{.instances = InstancesChoice::automatic, .why_copied = hindrance};
    const Subject subject = build_subject_quietly(scene, {.resolution = Resolution{8, 8}}, options);
    CHECK(subject.built.keeps_instances == (subject.built.structure == core::Structure::extents));
    return subject.database.records().instances;
  };
  CHECK(instances_with(2, "") == 0);
  CHECK(instances_with(3, "") == 3);
  CHECK(instances_with(3, "--tested-objects") == 0);
  CHECK(instances_with(3, "", true) == 0);
}

TEST_CASE("a tree with places in its leaves has no room for more than 2^21 primitives and places") {
  CHECK(core::InstancingShare{.places = 152, .own = 2'097'000}.has_room());
  CHECK_FALSE(core::InstancingShare{.places = 153, .own = 2'097'000}.has_room());
}

TEST_CASE("of so many copies that none is made, it is told that nobody looked at their rounding") {
  constexpr std::uint32_t triangles = 4096, places = 520;  // more than 2^21 in all
  core::Scene scene = tests::lit_scene();
  core::SceneBuilder builder(scene);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const double x = i % 64 / 64.0, y = i / 64 / 64.0;
    builder.polygon({{x, y, 0}, {x + 0x1p-6, y, 0}, {x, y + 0x1p-6, 0x1p-8}});
  }
  core::Instances instances{.meshes = {{0, triangles}}};
  for (std::uint32_t i = 0; i < places; ++i) {
    instances.places.push_back({tests::turned_place(0.5, {0, 0, i / 100.0}, false), 0, triangles});
  }
  core::settle(scene, instances, core::Copies::left_out);
  const DatabaseOptions options{.build = {.structure = core::Structure::extents, .keeps_instances = true}};
  const Subject subject = build_subject_quietly(scene, {.resolution = Resolution{8, 8}}, options);
  CHECK(
      subject.kept ==
      "kept 1 mesh in 520 places: 4,096 triangles for 2,129,920; the effects of rounding were determined outside of these only");
}

TEST_CASE("what rounding takes is told in pixels") {
  CHECK(loss_text({}).empty());
  CHECK(loss_text({.moved = 2, .moved_pixels = 0.25}) ==
        "2 primitives may be off by up to 0.25 pixels, as coordinates are rounded beside something so large: bring the scene's "
        "parts nearer to each other or nearer in size, or view it from farther away");
  CHECK(loss_text({.collapsed = 1, .collapsed_pixels = 3}).find("1 primitive is left out, too small") == 0);
  CHECK(loss_text({.moved = 1, .moved_pixels = 1, .collapsed = 2, .collapsed_pixels = 3})
            .find("up to 3 pixels across; 1 primitive may") != std::string::npos);
  CHECK(
      loss_text({.swapped = 2, .swapped_pixels = 20})
          .find("2 faces may show where others are nearer, or be hidden, as they lie too close together to be told apart: up to "
                "20 pixels across: bring") == 0);
}

TEST_CASE("what was left out is told in good grammar") {
  CHECK(dropped_text(0).empty());
  CHECK(dropped_text(1) == "1 degenerate primitive was left out");
  CHECK(dropped_text(2) == "2 degenerate primitives were left out");
  CHECK(duplicates_text(0).empty());
  CHECK(duplicates_text(1) == "1 triangle was left out: there twice");
  CHECK(duplicates_text(2) == "2 triangles were left out: there twice");
}

}  // namespace dmpc::apps::subject_test
