#include "apps/formats/landscape/files.h"

#include <doctest/doctest.h>

#include <string>

#include "apps/formats/landscape/gltf.h"
#include "apps/formats/landscape/grove.h"
#include "apps/info/scene_figures.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::landscape_files_test {

using tests::file_text;
using tests::TemporaryFolder;

namespace {

core::Scene written(const std::filesystem::path& path, int size) {
  write_landscape(size, path);
  return load_scene(PictureOptions{.scene = path}, LoadNotes::said);
}

std::uint64_t film_hash(const std::filesystem::path& scene, Strategy strategy) {
  RenderOptions options = small(strategy);
  options.picture.scene = scene;
  const Rendered rendered(options);
  CHECK(account_of(*rendered.report).operations.tile_reads > 0);
  return account_of(*rendered.report).film.hash();
}

}  // namespace

TEST_CASE("a landscape's name says its size") {
  CHECK(landscape_size("landscape") == landscape_size_default);
  CHECK(landscape_size("landscape-1") == 1);
  CHECK(landscape_size("landscape-11") == 11);
  CHECK_FALSE(landscape_size("mount-4"));
  CHECK_FALSE(landscape_size(""));
  for (const char* name : {"landscape-0", "landscape-12", "landscape-", "landscape-1x", "landscape-01", "landscapes"}) {
    CHECK_THROWS_AS(landscape_size(name), core::InputError);
  }
}

TEST_CASE("a landscape is read as it was written: triangles with a texture, a lake that mirrors, a camera") {
  const TemporaryFolder folder;
  const core::Scene scene = written(folder / "land.gltf", 3);
  CHECK(folder.entry_count() == 3);
  const SceneFigures figures = figures_of(scene);
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::textured)] == 64);
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::polygon)] == 2);
  CHECK(figures.materials.mirroring == 1);
  REQUIRE(figures.textures.size() == 1);
  CHECK(figures.textures[0].width == 32);
  CHECK(scene.view.from.z == doctest::Approx(0.52));
}

TEST_CASE("a landscape has the same bytes every time and the same picture in every strategy") {
  const TemporaryFolder folder;
  write_landscape(3, folder / "a.gltf");
  const std::string numbers = file_text(folder / "a.bin"), picture = file_text(folder / "a-ground.png");
  write_landscape(3, folder / "a.gltf");
  CHECK(file_text(folder / "a.bin") == numbers);
  CHECK(file_text(folder / "a-ground.png") == picture);
  const std::uint64_t film = film_hash(folder / "a.gltf", Strategy::svm);
  CHECK(film_hash(folder / "a.gltf", Strategy::replicated) == film);
  CHECK(film_hash(folder / "a.gltf", Strategy::dataflow) == film);
}

TEST_CASE("a grove's name says its size") {
  CHECK(grove_size("grove") == grove_size_default);
  CHECK(grove_size("grove-10") == 10);
  CHECK_FALSE(grove_size("landscape-4"));
  for (const char* name : {"grove-0", "grove-11", "groves"}) {
    CHECK_THROWS_AS(grove_size(name), core::InputError);
  }
}

TEST_CASE("a grove is a landscape with a tree in each of its places, whose files have each kind of tree but once") {
  const TemporaryFolder folder;
  constexpr int size = 4;
  write_grove(size, folder / "grove.gltf");
  const Grove trees = grove(size);
  std::size_t count = 0;
  for (const TreePlaces& places : trees.places) {
    count += places.translations.size();
  }
  REQUIRE(count > 100);
  const core::Scene scene = load_scene(PictureOptions{.scene = folder / "grove.gltf"}, LoadNotes::silent);
  const SceneFigures figures = figures_of(scene);
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::textured)] == std::size_t{1} << 14U);
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::patch)] == count * (bark_triangles + leaf_triangles));
  CHECK(std::filesystem::file_size(folder / "grove.bin") < 2'000'000);  // instead of some 20 million bytes of triangles
}

TEST_CASE("a grove has the same bytes on every machine, and the same picture in every strategy") {
  const Grove trees = grove(2);
  std::uint64_t hash = 0;
  for (const char c : landscape_gltf(ground_mesh(1), lake_mesh(), "a.bin", "a.png", &trees).numbers) {
    hash = core::mix(hash + static_cast<unsigned char>(c));
  }
  CHECK(hash == 342687646631564199U);
  const TemporaryFolder folder;
  write_grove(2, folder / "a.gltf");
  const std::uint64_t film = film_hash(folder / "a.gltf", Strategy::svm);
  CHECK(film_hash(folder / "a.gltf", Strategy::replicated) == film);
  CHECK(film_hash(folder / "a.gltf", Strategy::dataflow) == film);
}

TEST_CASE("what cannot be a landscape's name is refused, and then there are no files") {
  const TemporaryFolder folder;
  for (const char* name : {"a.nff", "a", "a b.gltf", "a%.gltf", ".gltf", "a.GLTF"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(write_landscape(1, folder / name), core::UsageError);
    CHECK_THROWS_AS(write_grove(1, folder / name), core::UsageError);
  }
  CHECK_THROWS_AS(write_landscape(1, folder / "none" / "a.gltf"), core::InputError);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("scene writes a landscape where it is told, and nowhere else") {
  const TemporaryFolder folder;
  const auto status = [](const std::vector<std::string>& more) {
    std::vector<std::string> command = {DMPC_PROGRAM, "scene"};
    command.insert(command.end(), more.begin(), more.end());
    return tests::ChildProcess(command).status();
  };
  CHECK(status({"landscape-2", "-o", folder / "land.gltf"}) == 0);
  CHECK(folder.entry_count() == 3);
  CHECK(status({"grove-1", "-o", folder / "land.gltf"}) == 0);
  CHECK(folder.entry_count() == 3);
  CHECK(status({"landscape-2"}) == 2);
  CHECK(status({"grove-1"}) == 2);
  CHECK(status({"landscape-99", "-o", folder / "b.gltf"}) == 1);
  CHECK(status({"landscape-2", "-o", folder / "none" / "b.gltf"}) == 1);
}

}  // namespace dmpc::apps::landscape_files_test
