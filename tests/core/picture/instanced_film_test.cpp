// Base meshes show what their copies show, to the bit.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/database/database.h"
#include "core/families/scenes.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/film_of.h"
#include "tests/support/scaled.h"
#include "tests/support/subject.h"

namespace dmpc::tests::instanced_film_test {
namespace {

using core::Scene;

constexpr Arrangement arrangements[] = {Arrangement::apart, Arrangement::deep_in_each_other, Arrangement::coincident};

/// Has a page, and loses it as soon as another one is asked for.
class OnePage {
 public:
  explicit OnePage(const core::Database& database) : bytes_(database.bytes()), page_size_(database.page_size()) {}

  const std::byte* find(core::Address address) {
    const std::uint64_t page = core::byte_offset(address) / page_size_;
    const bool is_there = page == page_;
    page_ = page;
    return is_there ? bytes_.data() + core::byte_offset(address) : nullptr;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t page_size_;
  std::uint64_t page_ = ~std::uint64_t{0};
};

std::uint64_t film_by_one_page(const core::Database& database, const core::RenderSettings& settings) {
  OnePage records(database);
  core::GridTracer<OnePage> tracer(records, settings.header, settings.skips);
  core::Operations operations;
  std::vector<core::HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  core::Film film(settings.camera.width(), settings.camera.height(), settings.shade.film_scale,
                  core::planes_for(settings.first_samples().count));
  core::InstancePixelTask task(stack);
  for (std::uint32_t pixel = 0; pixel < settings.camera.pixel_count(); ++pixel) {
    task.start(pixel, settings.first_samples(), settings, operations);
    while (task.run(tracer, settings, operations) != core::TaskState::finished) {
    }
    film.deposit(pixel, task.sums());
  }
  return film.hash();
}

/// A built-in scene's polygons, in four places of the scene, one of them its own and one a mirror; seen and lit as it is.
Scene family_in_places(const std::string& name) {
  Scene mesh = core::built_in_scene(core::parse_scene_name(name));
  std::erase_if(mesh.objects, [](const core::Object& object) { return object.vertex_count == 0; });
  for (core::Vec3d& normal : mesh.normals) {
    normal = core::Vec3d(core::Vec3f(normal));
  }
  const core::Vec3d middle = mesh.view.at;
  const double reach = length(mesh.view.from - middle);
  std::vector<core::Transform> places{{}};
  for (const double side : {-0.2, 0.1, 0.3}) {
    core::Transform world = turned_place(0.3, {}, side > 0.2);
    world.shift = middle + core::Vec3d{side, 0.5 * side, std::fabs(side)} * reach - world.direction(middle);
    places.push_back(world);
  }
  return placed(mesh, places);
}

std::uint64_t path_film(const Scene& scene, core::BuildOptions options) {
  options.for_paths = true;
  options.emitters_max = 16;
  const int side = scaled_edge(24);
  const core::Database database = core::build_database(scene, options);
  return film_of(database, scene.view, {{.kind = core::TransportKind::paths, .has_sky = true}, side, side, 2, 3}).hash();
}

}  // namespace

TEST_CASE("what is kept once shows what its copies show, to the bit, small and large, apart, deep in each other, coincident") {
  std::uint64_t seed = 0;
  for (const double size : {0.4, 0.05, 1e-3, 1e-5}) {
    for (const Arrangement arrangement : arrangements) {
      CAPTURE(++seed);
      const Scene scene = balls_in_places(size, arrangement, seed);
      const int side = scaled_edge(32);
      const Subject copies(scene, {side, side, 2}, with_copies()), kept(scene, {side, side, 2}, with_instances());
      CHECK(kept.outcome() == copies.outcome());
      CHECK(kept.outcome().primary_hits > 0);
      CHECK(kept.database().records().instances == 18);
      CHECK(kept.database().records().base_meshes == 2);
      CHECK(kept.database().page_count() < copies.database().page_count());
    }
  }
}

TEST_CASE("each of the eleven families shows in several places, kept once, what its copies show") {
  for (const char* const name : {"balls-2-t2", "gears-1", "jacks-1-t3", "lattice-2-t1", "mount-4", "rings-1-t1", "shells-1-t1",
                                 "sombrero-1", "teapot-4", "tetra-5", "tree-3-t2"}) {
    CAPTURE(std::string(name));
    const Scene scene = family_in_places(name);
    const int side = scaled_edge(32);
    const Subject copies(scene, {side, side}, with_copies()), kept(scene, {side, side}, with_instances());
    CHECK(kept.outcome() == copies.outcome());
    CHECK(kept.outcome().primary_hits > 0);
    CHECK(kept.database().records().instances == 4);
    CHECK(kept.database().records().base_meshes == 1);
  }
}

TEST_CASE("a camera next to what is small sees it kept as it sees its copies") {
  for (const double size : {1e-2, 1e-3, 1e-4}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      Scene scene = balls_in_places(size, Arrangement::deep_in_each_other, seed);
      scene.view.from = core::Vec3d{0.1, 0.2, 0.5} + core::Vec3d{1, -3, 1} * (1.5 * size);
      scene.view.at = {0.1, 0.2, 0.5};
      const int side = scaled_edge(24);
      const Subject copies(scene, {side, side}, with_copies()), kept(scene, {side, side}, with_instances());
      CHECK(kept.outcome() == copies.outcome());
      CHECK(kept.database().records().instances == 18);
    }
  }
}

TEST_CASE("the grid's film is that of what is kept, too") {
  const Scene scene = balls_in_places(0.2, Arrangement::apart, 3);
  const int side = scaled_edge(32);
  CHECK(Subject(scene, {side, side}, with_instances()).outcome() == Subject(scene, {side, side}).outcome());
}

TEST_CASE("what is kept is refined as its copies are: its fine detail is known, too") {
  for (const double size : {0.3, 0.01}) {
    const Scene scene = balls_in_places(size, Arrangement::apart, 8);
    const int side = scaled_edge(24);
    const Subject::Size picture{side, side, 2, {.error = 0.01, .samples_max = 64}};
    const Subject copies(scene, picture, with_copies()), kept(scene, picture, with_instances());
    CHECK(kept.outcome() == copies.outcome());
    CHECK(kept.outcome().rays[0] > 2U * static_cast<unsigned>(side) * static_cast<unsigned>(side));
  }
}

TEST_CASE("paths show the same of what is kept") {
  for (const Arrangement arrangement : arrangements) {
    const Scene scene = balls_in_places(0.3, arrangement, 5);
    CHECK(path_film(scene, with_instances()) == path_film(scene, with_copies()));
  }
}

TEST_CASE("where only one page is there at a time, what is kept shows the same") {
  for (const std::size_t page_size : {512U, 4096U}) {
    const Scene scene = balls_in_places(0.3, Arrangement::deep_in_each_other, 7);
    const int side = scaled_edge(16);
    const Subject kept(scene, {side, side}, with_instances(page_size));
    CHECK(film_by_one_page(kept.database(), kept.settings()) == kept.outcome().film_hash);
  }
}

TEST_CASE("a mesh whose numbers floats do not hold, or that shines, is copied") {
  Scene mesh = rug_on_floor(true, true, 6);
  const std::vector<core::Transform> places{turned_place(0.3, {0.5, 0, 0}, false), turned_place(0.3, {-0.5, 0, 0}, true)};
  CHECK(core::build_database(placed(mesh, places), with_instances()).records().instances == 2);
  Scene shining = mesh;
  shining.materials[0].emission = {1, 1, 1};
  CHECK(core::build_database(placed(shining, places), with_instances()).records().instances == 0);
  Scene odd = mesh;
  const auto count = static_cast<std::uint32_t>(odd.objects.size());
  odd.vertices[0].x += 1e-12;
  core::expand(odd, {.meshes = {{0, count}}, .places = {{places[0], 0, count}, {places[1], 0, count}}});
  REQUIRE(odd.kept != nullptr);
  CHECK(core::build_database(odd, with_instances()).records().instances == 0);
}

TEST_CASE("a scene without places has the same bytes whether instances are to be kept or not") {
  const Scene scene = rug_on_floor(true, true, 6);
  const core::Database one = core::build_database(scene, with_copies()), other = core::build_database(scene, with_instances());
  CHECK(std::equal(one.bytes().begin(), one.bytes().end(), other.bytes().begin(), other.bytes().end()));
  CHECK(other.header().has_instances == 0);
}

}  // namespace dmpc::tests::instanced_film_test
