#include "apps/lab/oracle/accurate/reference.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/difference/picture_error.h"
#include "apps/lab/oracle/accurate/reference_key.h"
#include "core/base/expect.h"
#include "tests/support/checked_floor.h"
#include "tests/support/small_scenes.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::reference_test {
namespace {

namespace fs = std::filesystem;
using apps::PictureOptions;
using apps::Reference;
using apps::ReferenceOptions;

PictureOptions small_picture() {
  PictureOptions picture;
  picture.resolution = apps::Resolution{24, 16};
  return picture;
}

Reference reference(const fs::path& folder, std::uint32_t samples_a_side = 4, std::uint64_t seed = 1) {
  return apps::reference_for(mirrors_and_glass(), small_picture(),
                             {.samples_a_side = samples_a_side, .seed = seed, .folder = folder});
}

fs::path file_with(const fs::path& folder, const std::string& extension) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) {
      return entry.path();
    }
  }
  return {};
}

std::string key_of(const core::Scene& scene, const PictureOptions& picture = small_picture(),
                   const ReferenceOptions& options = {}) {
  return apps::reference_key(scene, *picture.resolution, picture, options);
}

TEST_CASE("a reference is computed once and found again with the same bits") {
  const TemporaryFolder folder;
  const Reference computed = reference(folder.path()), kept = reference(folder.path());
  CHECK_FALSE(computed.from_cache);
  CHECK(kept.from_cache);
  CHECK(kept.picture.rgb == computed.picture.rgb);
  CHECK(kept.own_error == computed.own_error);
  CHECK(kept.own_relative_mean_square == computed.own_relative_mean_square);
  CHECK(kept.rays == computed.rays);
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("a reference says how far it is from one with many more samples") {
  const TemporaryFolder folder;
  const Reference rough = reference(folder.path(), 4), fine = reference(folder.path(), 24, 7);
  const double error = apps::measure_error(rough.picture, fine.picture).root_mean_square;
  CHECK(fine.own_error < rough.own_error / 3);
  CHECK(error > rough.own_error / 1.5);
  CHECK(error < rough.own_error * 1.5);
}

TEST_CASE("a damaged picture is computed again") {
  const TemporaryFolder folder;
  const Reference computed = reference(folder.path());
  fs::resize_file(file_with(folder.path(), ".exr"), 300);
  const Reference again = reference(folder.path());
  CHECK_FALSE(again.from_cache);
  CHECK(again.picture.rgb == computed.picture.rgb);
  CHECK(reference(folder.path()).from_cache);
}

TEST_CASE("figures that are damaged, of another key or without their picture are not believed") {
  const TemporaryFolder folder;
  reference(folder.path());
  const fs::path figures = file_with(folder.path(), ".json");
  const std::string text = file_text(figures);
  for (const std::string& bad : {std::string("{"), std::string("{}"), std::string(), "[" + text + "]"}) {
    write_text(figures, bad);
    CHECK_FALSE(reference(folder.path()).from_cache);
  }
  fs::remove(file_with(folder.path(), ".exr"));
  CHECK_FALSE(reference(folder.path()).from_cache);
}

TEST_CASE("another reference's picture under this key is not believed") {
  const TemporaryFolder folder, other;
  reference(folder.path());
  reference(other.path(), 4, 2);
  fs::copy_file(file_with(other.path(), ".exr"), file_with(folder.path(), ".exr"), fs::copy_options::overwrite_existing);
  CHECK_FALSE(reference(folder.path()).from_cache);
}

TEST_CASE("the key follows all that the picture depends on and nothing else") {
  const core::Scene scene = mirrors_and_glass();
  const std::string key = key_of(scene);
  CHECK(key.size() == 32);
  core::Scene renamed = scene;
  renamed.name = "another name";
  CHECK(key_of(renamed) == key);
  PictureOptions more = small_picture();
  more.samples = 9;
  CHECK(key_of(scene, more) == key);

  core::Scene moved = scene;
  moved.vertices[0].x = std::nextafter(moved.vertices[0].x, 9.0);
  CHECK(key_of(moved) != key);
  core::Scene turned = scene;
  turned.view.angle_degrees += 1;
  CHECK(key_of(turned) != key);
  core::Scene lit = scene;
  lit.lights[0].has_color = true;
  CHECK(key_of(lit) != key);
  core::Scene painted = scene;
  painted.materials[1].shine += 1;
  CHECK(key_of(painted) != key);
  core::Scene smoothed = scene;
  smoothed.normals[0].x += 1;
  CHECK(key_of(smoothed) != key);
}

TEST_CASE("the key follows textures and the places on them") {
  const core::Scene scene = everything();
  const std::string key = key_of(scene);
  core::Scene repainted = scene, shifted = scene, wrapped = scene;
  repainted.textures[1].levels[0].texels[5] ^= 1U;
  shifted.corners[2].place[1] += 0.5F;
  wrapped.textures[0].wrap_s = core::TextureWrap::clamp;
  CHECK(key_of(repainted) != key);
  CHECK(key_of(shifted) != key);
  CHECK(key_of(wrapped) != key);
}

TEST_CASE("a reference sees textures as they are, without cones") {
  PictureOptions picture = small_picture();
  const ReferenceOptions options{.samples_a_side = 8, .folder = TemporaryFolder().path()};
  const Reference painted = apps::reference_for(CheckedFloor::painted(), picture, options);
  const Reference laid = apps::reference_for(CheckedFloor::laid(), picture, options);
  CHECK(apps::measure_error(painted.picture, laid.picture).root_mean_square < 0.004);  // blurred by a texel
}

TEST_CASE("the key follows the picture's options and the samples") {
  const core::Scene scene = mirrors_and_glass();
  const std::string key = key_of(scene);
  PictureOptions deeper = small_picture(), paper = small_picture(), wider = small_picture();
  deeper.depth = 6;
  paper.convention = core::Convention::paper;
  wider.resolution->width = 25;
  CHECK(key_of(scene, deeper) != key);
  CHECK(key_of(scene, paper) != key);
  CHECK(key_of(scene, wider) != key);
  CHECK(key_of(scene, small_picture(), {.samples_a_side = 8}) != key);
  CHECK(key_of(scene, small_picture(), {.seed = 2}) != key);
}

TEST_CASE("a folder is made where it is missing, and refused before any work where it cannot be") {
  const TemporaryFolder folder;
  CHECK_FALSE(reference(folder.path() / "a" / "b").from_cache);
  write_text(folder / "file", "x");
  bool asked = false;
  const apps::Attendance watch{.progress = [&](std::uint64_t, std::uint64_t) { asked = true; }};
  CHECK_THROWS_AS(apps::reference_for(mirrors_and_glass(), small_picture(), {.folder = folder / "file"}, watch),
                  core::InputError);
  CHECK_FALSE(asked);
}

TEST_CASE("a stop leaves no file") {
  const TemporaryFolder folder;
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(
      apps::reference_for(mirrors_and_glass(), small_picture(), {.folder = folder.path()}, {.stop = source.get_token()}),
      apps::Interrupted);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("progress counts both halves and nothing for what was kept") {
  const TemporaryFolder folder;
  std::uint64_t last = 0, total = 0, calls = 0;
  const apps::Attendance watch{.progress = [&](std::uint64_t done, std::uint64_t all) { last = done, total = all, ++calls; }};
  const ReferenceOptions options{.samples_a_side = 2, .folder = folder.path()};
  apps::reference_for(mirrors_and_glass(), small_picture(), options, watch);
  CHECK(last == 32);
  CHECK(total == 32);
  calls = 0;
  apps::reference_for(mirrors_and_glass(), small_picture(), options, watch);
  CHECK(calls == 0);
}

TEST_CASE("samples that have no two halves are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(reference(folder.path(), 3), core::InternalError);
  CHECK_THROWS_AS(reference(folder.path(), 0), core::InternalError);
}

}  // namespace
}  // namespace dmpc::tests::reference_test
