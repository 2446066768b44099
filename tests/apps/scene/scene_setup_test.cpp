#include "apps/scene/scene_setup.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::scene_setup_test {

using core::UsageError;
using core::Vec3d;
using doctest::Contains;

namespace {

SceneSetup staged(std::initializer_list<std::string> options) { return tests::typed_render(options).picture.scene_setup; }

}  // namespace

TEST_CASE("a camera is two points, and up and degrees if wanted") {
  const CameraChoice camera = parse_camera("1,2,3/0,-1.5,1e1/0,0,1/30.5");
  CHECK(camera.from == Vec3d{1, 2, 3});
  CHECK(camera.at == Vec3d{0, -1.5, 10});
  CHECK(camera.up == Vec3d{0, 0, 1});
  CHECK(camera.degrees == 30.5);
  CHECK_FALSE(parse_camera("1,2,3/0,0,0").up);
  CHECK_FALSE(parse_camera("0,2,0/0,0,0").degrees);
  CHECK_FALSE(parse_camera("1,2,3/0,0,0/0,1,0").degrees);
}

TEST_CASE("a light is a point, and a colour if wanted") {
  CHECK(parse_light("1,2,3").position == Vec3d{1, 2, 3});
  CHECK_FALSE(parse_light("1,2,3").has_color);
  CHECK(parse_light("1,2,3/0.5,1,2").color == Vec3d{0.5, 1, 2});
  CHECK(parse_light("1,2,3/0.5,1,2").has_color);
}

TEST_CASE("a camera and a light are told as they are read, to the last bit") {
  for (const char* text : {"1,2,3/0,0,0", "0.1,1e-30,3/0,0,-0.3333333333333333/0,1,0", "1,2,3/0,-1.5,10/0,0,1/30.5"}) {
    CHECK(text_of(parse_camera(text)) == text);
  }
  for (const char* text : {"1,2,3", "-0.1,1e+30,3/0,0.3333333333333333,2"}) {
    CHECK(text_of(parse_light(text)) == text);
  }
}

TEST_CASE("the options of a mesh and of the stage are read") {
  const SceneSetup scene_setup =
      staged({"--light=1,2,3", "--light=4,5,6/1,1,1", "--scale=0.5", "--up=z", "--smooth=30", "--missing=plain"});
  CHECK(scene_setup.lights.size() == 2);
  CHECK(scene_setup.mesh.scale == 0.5);
  CHECK(scene_setup.mesh.up == UpAxis{2});
  CHECK(staged({"--up=-x"}).mesh.up == UpAxis{0, true});
  CHECK(scene_setup.mesh.smooth_degrees == 30);
  CHECK(scene_setup.mesh.allows_missing);
  CHECK_FALSE(staged({"--missing=error"}).mesh.allows_missing);
  CHECK_FALSE(staged({}).camera);
  CHECK_FALSE(staged({}).mesh.up);
}

TEST_CASE("a camera replaces what it names of the scene's view, lights replace all lights") {
  core::Scene scene{.view = {.from = {0, 0, 9}, .up = {1, 0, 0}, .angle_degrees = 20, .width = 64}};
  scene.lights.resize(5);
  apply({}, scene);
  CHECK(scene.view.from == Vec3d{0, 0, 9});
  CHECK(scene.lights.size() == 5);
  apply({.camera = parse_camera("0,1,2/0,0,0"), .lights = {parse_light("1,1,1")}}, scene);
  CHECK(scene.view.from == Vec3d{0, 1, 2});
  CHECK(scene.view.up == Vec3d{1, 0, 0});
  CHECK(scene.view.angle_degrees == 20);
  CHECK(scene.view.width == 64);
  CHECK(scene.lights.size() == 1);
}

TEST_CASE("a camera asked for of a mesh keeps what is up of it, or what --up says, and has 45 degrees") {
  core::Scene turned{.view = {.up = {0, 0, -1}}};
  CHECK(apply({.camera = parse_camera("0,9,0/0,0,0")}, turned, SceneKind::mesh).empty());
  CHECK(turned.view.up == Vec3d{0, 0, -1});
  core::Scene scene{.view = {.from = {0, 9, 0}, .up = {0, 1, 0}, .angle_degrees = 20, .width = 64}};
  CHECK(apply({.camera = parse_camera("0,0,5/0,0,0")}, scene, SceneKind::mesh).empty());
  CHECK(scene.view.up == Vec3d{0, 1, 0});
  CHECK(scene.view.angle_degrees == 45);
  CHECK(apply({.camera = parse_camera("0,9,0/0,0,0"), .mesh = {.up = UpAxis{2}}}, scene, SceneKind::mesh).empty());
  CHECK(scene.view.up == Vec3d{0, 0, 1});
  CHECK(apply({.camera = parse_camera("0,0,5/0,0,0/1,0,0/30")}, scene, SceneKind::mesh).empty());
  CHECK(scene.view.up == Vec3d{1, 0, 0});
  CHECK(scene.view.angle_degrees == 30);
}

TEST_CASE("a camera along what is up of a mesh is turned as who stands in front and looks up or down, and says so") {
  core::Scene scene;
  CHECK(apply({.camera = parse_camera("0,5,0/0,0,0")}, scene, SceneKind::mesh) ==
        "--camera looks along the axis that points up: upwards in the picture is 0,0,-1, as by --camera=0,5,0/0,0,0/0,0,-1");
  CHECK(scene.view.up == Vec3d{0, 0, -1});
  scene.view = {};
  CHECK_FALSE(apply({.camera = parse_camera("0,0,0/0,5,0")}, scene, SceneKind::mesh).empty());
  CHECK(scene.view.up == Vec3d{0, 0, 1});
  CHECK_FALSE(apply({.camera = parse_camera("0,0,5/0,0,0"), .mesh = {.up = UpAxis{2}}}, scene, SceneKind::mesh).empty());
  CHECK(scene.view.up == Vec3d{0, 1, 0});
}

TEST_CASE("a fill is one more light in the eye, and leaves the others as bright as they are") {
  core::Scene scene;
  scene.lights.resize(4);
  apply({.camera = parse_camera("0,1,2/0,0,0"), .fill = 0.25}, scene);
  REQUIRE(scene.lights.size() == 5);
  CHECK(scene.lights.back().position == Vec3d{0, 1, 2});
  CHECK(intensity_of(scene.lights.back(), scene) == Vec3d{0.25, 0.25, 0.25});
  CHECK(intensity_of(scene.lights.front(), scene) == Vec3d{0.5, 0.5, 0.5});
  apply({.fill = 0}, scene);
  CHECK(scene.lights.size() == 5);
}

TEST_CASE("an ambient light and a background are a colour or a grey, in place of the scene's") {
  const SceneSetup scene_setup = staged({"--fill=0.3", "--ambient=0.1", "--background=0,0.5,1"});
  CHECK(scene_setup.fill == 0.3);
  core::Scene scene{.background = {1, 1, 1}};
  apply(scene_setup, scene);
  CHECK(scene.ambient == Vec3d{0.1, 0.1, 0.1});
  CHECK(scene.background == Vec3d{0, 0.5, 1});
  apply(staged({"--ambient=0.1,0.2,0.3"}), scene);
  CHECK(scene.ambient == Vec3d{0.1, 0.2, 0.3});
  CHECK(scene.background == Vec3d{0, 0.5, 1});
}

TEST_CASE("a camera along the scene's own up asks for another up") {
  core::Scene scene;
  CHECK_THROWS_WITH_AS(apply({.camera = parse_camera("0,5,0/0,0,0")}, scene), Contains("give UP, too"), UsageError);
}

}  // namespace dmpc::apps::scene_setup_test
