// What is said on stderr of scenes whose picture would be a riddle.

#include <doctest/doctest.h>

#include <iostream>
#include <sstream>
#include <string>

#include "apps/scene/load_scene.h"
#include "apps/scene/scene_setup.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::said_test {

namespace {

const std::string nff_view = "v\nfrom 0 0 9\nat 0 0 0\nup 0 1 0\nangle 45\nhither 0\nresolution 8 8\n";

/// On stderr, when the scene is loaded.
std::string said_of(const PictureOptions& picture) {
  std::ostringstream said;
  std::streambuf* const usual = std::cerr.rdbuf(said.rdbuf());
  load_scene(picture);
  std::cerr.rdbuf(usual);
  return said.str();
}

/// Notes about an NFF file of this text, with these lights of the command line, or with this transport.
std::string said_of(const std::string& text, const std::vector<core::PointLight>& lights = {},
                    const TransportOptions& transport = {}) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.nff", text);
  PictureOptions picture{.scene = folder / "a.nff"};
  picture.scene_setup.lights = lights;
  picture.transport = transport;
  return said_of(picture);
}

}  // namespace

TEST_CASE("a scene without a light is said, unless a light is given") {
  const std::string sphere = nff_view + "f 1 1 1 1 0 0 0 0\ns 0 0 0 1\n";
  CHECK(tests::contains(said_of(sphere), "a.nff: it has no light"));
  CHECK(said_of(sphere, {parse_light("1,2,3")}).empty());
  CHECK(said_of(nff_view + "l 1 2 3\nf 1 1 1 1 0 0 0 0\ns 0 0 0 1\n").empty());
}

TEST_CASE("by paths a sky lights a scene") {
  const std::string sphere = nff_view + "f 1 1 1 1 0 0 0 0\ns 0 0 0.5 1\n";
  TransportOptions paths{.kind = core::TransportKind::paths};
  CHECK(tests::contains(said_of(sphere, {}, paths), "--light=X,Y,Z adds one, --sky=1 a sky"));
  paths.sky = SkyChoice{{1, 1, 1}, {}};
  CHECK(said_of(sphere, {}, paths).empty());
  paths.sky = SkyChoice{{}, {}};
  CHECK(tests::contains(said_of(sphere, {}, paths), "a.nff: it has no light"));
  paths.sky = SkyChoice{{}, core::Vec3d{0, 0, 1}};
  CHECK(said_of(sphere, {}, paths).empty());
}

TEST_CASE("of a scene that has no light but what shines by itself it is said which transport shows what that lights") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.pbrt",
                    "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\nWorldBegin\nAttributeBegin\n"
                    "AreaLightSource \"diffuse\" \"rgb L\" [4 4 4]\nShape \"sphere\"\nAttributeEnd\n");
  PictureOptions picture{.scene = folder / "a.pbrt"};
  CHECK(tests::contains(said_of(picture),
                        "its only lights are emissive surfaces, which light other things with --transport=paths only"));
  picture.transport.kind = core::TransportKind::paths;
  CHECK(!tests::contains(said_of(picture), "no light"));
}

TEST_CASE("of a whole scene in the dark by Whitted's transport it is said which transport shows its own sky") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.pbrt",
                    "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\nWorldBegin\n"
                    "LightSource \"infinite\" \"rgb L\" [1 1 1]\nShape \"sphere\"\n");
  CHECK(tests::contains(said_of(PictureOptions{.scene = folder / "a.pbrt"}), "--transport=paths the sky that its file may have"));
}

TEST_CASE("lights that no radius makes larger are said") {
  const std::string sphere = nff_view + "f 1 1 1 1 0 0 0 0\ns 0 0 0.5 1\n";
  const TransportOptions balls{.kind = core::TransportKind::paths, .light_radius = 0.1};
  CHECK(said_of(sphere, {parse_light("1,2,3")}, balls).empty());
  CHECK(tests::contains(said_of(sphere, {parse_light("1,2,3"), parse_light("1e6,0,0")}, balls),
                        "1 light stays a point: as spheres of --light-radius they would contain the camera, or be too small or "
                        "too far away to be seen"));
}

TEST_CASE("a scene with nothing in it is said") {
  CHECK(tests::contains(said_of(nff_view + "l 1 2 3\n"), "a.nff: the scene is empty"));
}

}  // namespace dmpc::apps::said_test
