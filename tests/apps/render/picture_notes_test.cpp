#include "apps/render/picture_notes.h"

#include <doctest/doctest.h>

#include <string>

#include "apps/scene/scene_setup.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::picture_notes_test {

using core::Vec3d;
using tests::contains;

namespace {

core::Film film_of(const core::Color& light) {
  core::Film film(2, 1);
  for (const std::uint32_t pixel : {0U, 1U}) {
    film.deposit(pixel, {{core::to_fixed(light), core::FixedColor{}}});
    film.add_samples(pixel, 1);
  }
  return film;
}

}  // namespace

TEST_CASE("nothing is said of light that a film can hold, and of the dark") {
  CHECK(film_notes(film_of({1, 0.5F, 0}), 7).empty());
  CHECK(film_notes(film_of({1e-6F, 0, 0}), 7).empty());
  CHECK(film_notes(film_of({}), 0).empty());
}

TEST_CASE("light that was cut is said, with how many pixels and from where on") {
  const auto notes = film_notes(film_of({1e12F, 0, 0}), 7);
  REQUIRE(notes.size() == 1);
  CHECK(contains(notes[0],
                 "2 of 2 pixels are brighter than the film can hold and were clipped, from a radiance of 2.14748e+09 on"));
}

TEST_CASE("a picture so dark that the film's steps show in it says so, and a black one that light has reached") {
  const auto dark = film_notes(film_of({1e-8F, 0, 0}), 7);
  REQUIRE(dark.size() == 1);
  CHECK(contains(dark[0], "no pixel is brighter than 1.00117e-08, and the film counts light in steps of 2.32831e-10"));
  CHECK(contains(dark[0], "off by 1.2 % and more"));
  const auto black = film_notes(film_of({}), 7);
  REQUIRE(black.size() == 1);
  CHECK(contains(black[0], "the picture is black, though 7 shadow rays reached a light"));
}

TEST_CASE("a camera that sees nothing is told where the scene lies, and one that shows the whole") {
  const std::string note = small_note(0, {{-1, -2, -3}, {1, 2, 3}}, {});
  CHECK(contains(note, "which lies between -1,-2,-3 and 1,2,3: "));
  const CameraChoice camera = parse_camera(note.substr(note.find("--camera=") + 9));
  CHECK(camera.at == Vec3d{});
  CHECK(camera.up == Vec3d{0, 1, 0});
  CHECK(dot(camera.from, Vec3d{1, 1, 1}) > 0);
}

TEST_CASE("a scene that is a single point has a camera before it") {
  const std::string note = small_note(0, {{5, 5, 5}, {5, 5, 5}}, {2, true});
  const CameraChoice camera = parse_camera(note.substr(note.find("--camera=") + 9));
  CHECK(length(camera.from - camera.at) > 1);
  CHECK(camera.up == Vec3d{0, 0, -1});
}

TEST_CASE("up is the axis that is nearest to a view's") {
  CHECK(up_of({.up = {0, 1, 0}}) == UpAxis{1});
  CHECK(up_of({.up = {0.1, -0.2, -0.9}}) == UpAxis{2, true});
  CHECK(up_of({.up = {-1, 0.5, 0}}) == UpAxis{0, true});
}

TEST_CASE("a render says so by every strategy, of any scene, and only if no ray from the eye meets anything") {
  const tests::TemporaryFolder folder;
  const auto said = [&](const std::string& strategy, const std::string& camera) {
    tests::ChildProcess render({DMPC_PROGRAM, "render", "tetra-2", "--resolution=8x8", "--nodes=2", "--strategy=" + strategy,
                                "--camera=" + camera, "-o", folder / "a.png"});
    CHECK(render.status() == 0);
    return contains(render.errors(), "the camera sees nothing of the scene");
  };
  for (const char* const strategy : {"svm", "dataflow", "replicated", "forest"}) {
    CAPTURE(strategy);
    CHECK(said(strategy, "9,0,0/10,0,0"));
    CHECK_FALSE(said(strategy, "9,0,0/0,0,0"));
  }
}

}  // namespace dmpc::apps::picture_notes_test
