#include "apps/foreign/mesh/lights.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "apps/formats/mesh_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::lights_test {

using core::Scene;
using core::Vec3d;
using doctest::Approx;

namespace {

/// The triangle, and a node (of `placed`) with the first of `lights`.
MeshFile lit(const std::string& lights, const std::string& placed = R"("translation":[0,0,7])", const MeshOptions& options = {}) {
  tests::Gltf gltf{.nodes = R"([{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}},)" + placed + "}]",
                   .roots = "[0,1]"};
  gltf.more = R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":)" + lights + "}}";
  return tests::read_mesh("a.gltf", gltf.text(), options);
}

const double pi = std::acos(-1);
const std::string at_seven = R"("translation":[0,0,7])";

/// The triangle seen by the first of `cameras`.
MeshFile seen(const std::string& cameras, const std::string& placed = R"("translation":[0,0,5])",
              const MeshOptions& options = {}) {
  tests::Gltf gltf{.nodes = R"([{"mesh":0},{"camera":0,)" + placed + "}]", .roots = "[0,1]"};
  gltf.more = R"("cameras":)" + cameras;
  return tests::read_mesh("a.gltf", gltf.text(), options);
}

}  // namespace

TEST_CASE("a point light stands where its node is, and that it has fall-off is said") {
  const MeshFile file = lit(R"([{"type":"point","color":[0.5,0.25,0],"intensity":1}])");
  REQUIRE(file.scene.lights.size() == 1);
  CHECK(file.scene.lights[0].position == Vec3d{0, 0, 7});
  CHECK(file.scene.lights[0].color == Vec3d{0.5, 0.25, 0});
  CHECK(tests::notes(file, "fall-off with distance is ignored: 1"));
}

TEST_CASE("a light of a thousand candela is as bright as one can be") {
  CHECK(lit(R"([{"type":"point","color":[1,0.5,0],"intensity":1000}])").scene.lights[0].color.x == Approx(1));
}

TEST_CASE("a directional light stands far away on the side that it comes from") {
  const MeshFile file = lit(R"([{"type":"directional"}])");
  REQUIRE(file.scene.lights.size() == 1);
  CHECK(file.scene.lights[0].position.z > 1000);
  CHECK(file.scene.lights[0].position.x == Approx(1));
  CHECK(tests::notes(file, "far away: 1"));
}

// An intensity of 1 candela shows pi times what ours do of a colour of 1. The sky is that of paths.
TEST_CASE("by paths points and spots fall off from their candela, and directional lights have their lux") {
  const MeshOptions by_paths{.is_below_sky = true, .is_by_paths = true};
  const auto light = [&](const std::string& one) { return lit("[" + one + "]", at_seven, by_paths).scene.lights.at(0); };
  const core::PointLight point = light(R"({"type":"point","color":[1,0.5,0],"intensity":6,"range":9})");
  CHECK(point.falls_off_from > 0);
  CHECK(length(point.color * pi - Vec3d{6, 3, 0}) < 1e-12);
  CHECK(point.cone.none_degrees == 0);
  CHECK(light(R"({"type":"directional","intensity":3})").color.x * pi == Approx(3));
  CHECK(light(R"({"type":"directional","intensity":3})").falls_off_from == 0);
  CHECK(tests::notes(lit(R"([{"type":"point","range":9}])", at_seven, by_paths), "lights with a range, beyond which they go on"));
  // In millimetres the same scene is as bright.
  MeshOptions large = by_paths;
  large.scale = 1000;
  CHECK(lit(R"([{"type":"point"}])", at_seven, large).scene.lights.at(0).color.x * pi == Approx(1e6));
}

TEST_CASE("a spot has the cone that it says, along its node's -z, and what is out of range is brought into it") {
  const auto spot = [&](const std::string& cone, const std::string& placed = at_seven) {
    return lit(R"([{"type":"spot","spot":{)" + cone + "}}]", placed).scene.lights;
  };
  const core::LightCone known = spot(R"("innerConeAngle":0.25,"outerConeAngle":0.5)").at(0).cone;
  CHECK(known.ahead == Vec3d{0, 0, -1});
  CHECK(known.full_degrees == Approx(0.25 * 180 / pi));
  CHECK(known.none_degrees == Approx(0.5 * 180 / pi));
  CHECK(known.edge == core::ConeEdge::square);
  CHECK(spot("").at(0).cone.full_degrees == 0);
  CHECK(spot("").at(0).cone.none_degrees == Approx(45));
  CHECK(spot("", R"("rotation":[0.6,0,0,0.8],"scale":[2,2,2])").at(0).cone.ahead.y == Approx(0.96));
  CHECK(spot(R"("innerConeAngle":2,"outerConeAngle":1)").at(0).cone.full_degrees == Approx(180 / pi));
  CHECK(spot(R"("innerConeAngle":-1,"outerConeAngle":9)").at(0).cone.none_degrees == 180);
  CHECK(spot(R"("outerConeAngle":-1)").size() == 2);  // dark, so that plain ones take its place
  CHECK(spot("", R"("scale":[0,0,0])").size() == 2);
  CHECK(tests::notes(lit(R"([{"type":"spot"}])"), "spot lights whose fall-off with distance is ignored: 1"));
}

// The triangle's corners are some 7 away; the middle one gets 54,351 / 50 / pi.
TEST_CASE("by paths lights that are too bright for a picture are weakened together, in an animation as they were at first") {
  MeshOptions options{.is_by_paths = true};
  const std::string lamps = R"([{"type":"point","intensity":54351}])";
  const MeshFile file = lit(lamps, at_seven, options);
  CHECK(file.scene.lights.at(0).color.x == Approx(50));
  CHECK(tests::notes(file, "the file's lights are too bright for a picture, and are shown by 0.00289"));
  CHECK_FALSE(tests::notes(lit(R"([{"type":"point","intensity":150}])", at_seven, options), "too bright"));
  CHECK(lit(R"([{"type":"point","intensity":1e300}])", at_seven, options).scene.lights.at(0).color.x == Approx(50));
  CHECK(lit(R"([{"type":"point","intensity":-1}])", at_seven, options).scene.lights.size() == 2);
  CHECK(lit(lamps, R"("translation":[2,0,0])", options).scene.lights.size() == 1);
}

TEST_CASE("nothing is said of a file's lights where others take their place, nor of its view") {
  const std::string lamp = R"([{"type":"point","color":[0.5,0.25,0],"intensity":1}])", place = R"("translation":[0,0,7])";
  CHECK(lit(lamp, place, {.is_seen_otherwise = true}).notes.size() == 1);
  CHECK(lit(lamp, place, {.is_lit_otherwise = true}).notes.size() == 1);
  CHECK(lit(lamp, place, {.is_seen_otherwise = true, .is_lit_otherwise = true}).notes.empty());
}

TEST_CASE("a light that is dark does not count, and that is said") {
  const MeshFile file = lit(R"([{"type":"point","intensity":0}])");
  CHECK(file.scene.lights.size() == 2);
  CHECK(tests::notes(file, "lights without any brightness left out, so that plain ones take their place: 1"));
  CHECK_FALSE(tests::notes(file, "fall-off"));
}

TEST_CASE("below a sky a file's own lights shine, and no plain ones") {
  const std::string place = R"("translation":[0,0,7])";
  const MeshFile file = lit(R"([{"type":"point","intensity":0}])", place, {.is_below_sky = true});
  CHECK(file.scene.lights.empty());
  CHECK(tests::notes(file, "lights without any brightness left out: 1"));
  CHECK(lit(R"([{"type":"point"}])", place, {.is_below_sky = true}).scene.lights.size() == 1);
}

TEST_CASE("what shines is a light by paths, so that no plain ones take the place of those that are not there") {
  const tests::Gltf gltf{.materials = R"([{"emissiveFactor":[1,0.5,0]}])"};
  const auto read = [&](const MeshOptions& options) { return tests::read_mesh("a.gltf", gltf.text(), options).scene; };
  CHECK(read({.is_by_paths = true}).lights.empty());
  CHECK(read({}).lights.size() == 2);
  CHECK(lit(R"([{"type":"point","intensity":0}])", R"("translation":[0,0,7])", {.is_by_paths = true}).scene.lights.size() == 2);
}

TEST_CASE("a sky's zenith is the axis that points up, however the file's camera is turned") {
  const std::string camera = R"([{"type":"perspective","perspective":{"yfov":1}}])", leaning = R"("rotation":[-0.6,0,0,0.8])";
  const Scene scene = seen(camera, leaning).scene;
  CHECK(scene.view.up.y < 0.5);
  CHECK(scene.zenith == Vec3d{0, 1, 0});
  CHECK(seen(camera, leaning, {.up = UpAxis{2, true}}).scene.zenith == Vec3d{0, 0, -1});
}

TEST_CASE("a light that several nodes have stands at each of them") {
  const MeshFile file =
      lit(R"([{"type":"point"}])", R"("translation":[0,0,7],"children":[2]},)"
                                   R"({"translation":[1,0,0],"extensions":{"KHR_lights_punctual":{"light":0}})");
  REQUIRE(file.scene.lights.size() == 2);
  CHECK(file.scene.lights[1].position == Vec3d{1, 0, 7});
}

TEST_CASE("the camera looks along its node's -z with its node's y up") {
  const Scene scene = seen(R"([{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":1}}])",
                           R"("translation":[0,0,5],"rotation":[0,1,0,0])")
                          .scene;
  CHECK(scene.view.from == Vec3d{0, 0, 5});
  CHECK(length(scene.view.at - Vec3d{0, 0, 6}) < 1e-6);
  CHECK(length(scene.view.up - Vec3d{0, 1, 0}) < 1e-6);
  CHECK(scene.view.angle_degrees == Approx(57.201571742));  // 2 atan(tan(0.5) 511/512): between the middles of pixels
}

TEST_CASE("the angle spans the shorter side, and the aspect decides the size") {
  const Scene wide = seen(R"([{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":2}}])").scene;
  CHECK(wide.view.angle_degrees == Approx(57.201571742));
  CHECK(wide.view.width == 1024);
  CHECK(wide.view.height == 512);
  const Scene tall = seen(R"([{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":0.5}}])").scene;
  CHECK(tall.view.width == 512);
  CHECK(tall.view.height == 1024);
  CHECK(tall.view.angle_degrees == Approx(30.498555189));  // 2 atan(tan(0.5) 511/1024)
}

TEST_CASE("the vertical angle spans the rows of the picture that is asked for, from edge to edge") {
  const std::string camera = R"([{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])",
                    place = R"("translation":[0,0,5])";
  const auto degrees = [&](int width, int height) {
    return seen(camera, place, {.size = Resolution{width, height}}).scene.view.angle_degrees;
  };
  CHECK(degrees(32, 32) == Approx(55.778320010));  // 2 atan(tan(0.5) 31/32)
  CHECK(degrees(64, 32) == Approx(55.778320010));
  CHECK(degrees(16, 32) == Approx(28.727200284));  // 2 atan(tan(0.5) 15/32)
  CHECK(degrees(1, 1) == Approx(57.29578));
}

TEST_CASE("a camera without perspective is not taken, and that is said") {
  const MeshFile file = seen(R"([{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":0.1}}])");
  CHECK(tests::notes(file, "camera is not taken"));
  CHECK(file.scene.view.up == Vec3d{0, 1, 0});
}

TEST_CASE("of several cameras the first that makes a picture is taken, and which is said") {
  const std::string camera = R"({"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":1}})";
  const std::string flat = R"({"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":0.1}})";
  const std::string second = R"("translation":[0,0,5],"children":[2]},{"name":"eye","translation":[0,0,2],"camera":1)";
  const MeshFile file = seen("[" + flat + "," + camera + "]", second);
  CHECK(tests::notes(file, "camera 2 of 2 is taken, the first that has a perspective and a direction, 'eye'"));
  CHECK(file.scene.view.from == Vec3d{0, 0, 7});
  CHECK(tests::notes(seen("[" + flat + "," + flat + "]", second), "none of the file's 2 cameras is taken"));
  CHECK(tests::notes(seen("[" + camera + "," + camera + "]", R"("children":[2]},{"camera":1)"), "the first of 2 cameras"));
}

TEST_CASE("what shines with more than 1e12 is brought down to that in all formats, in its colour, and said") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.mtl", "newmtl a\nKe 4e14 2e14 0\n");
  tests::write_text(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  tests::Gltf gltf;
  gltf.materials = R"([{"emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e30}}}])";
  tests::write_text(folder / "a.gltf", gltf.text());
  tests::write_text(
      folder / "a.pbrt",
      "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"rgb L\" "
      "[2e11 1e11 0] \"float scale\" 100\nShape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n");
  for (const char* const name : {"a.obj", "a.gltf", "a.pbrt"}) {
    CAPTURE(name);
    const MeshFile file = read_mesh_file(folder / name, {.is_by_paths = true});
    CHECK(tests::notes(file, "materials that shine with more than 1e12, the brightest light there is, brought down to it: 1"));
    const Vec3d light = file.scene.materials.at(file.scene.objects.at(0).material).emission;
    CHECK(light.x == Approx(1e12).epsilon(1e-12));
    CHECK(light.y == Approx(5e11).epsilon(1e-12));
    CHECK(light.z == 0);
  }
}

}  // namespace dmpc::apps::lights_test
