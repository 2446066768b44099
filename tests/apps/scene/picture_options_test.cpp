#include "apps/scene/picture_options.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"
#include "tests/support/checked_floor.h"

namespace dmpc::apps::picture_options_test {

using core::UsageError;

TEST_CASE("a resolution is two numbers with an x between them") {
  CHECK(parse_resolution("1x1").width == 1);
  CHECK(parse_resolution("640x480").height == 480);
  CHECK(parse_resolution("65536x4096").width == 65536);
}

TEST_CASE("cones are as wide as pixels where there is a texture, half as wide where a picture is refined, and else nothing") {
  const core::Scene painted = tests::CheckedFloor::painted(), laid = tests::CheckedFloor::laid();
  const core::Database database = core::build_database(painted, {});
  PictureOptions picture{.resolution = Resolution{16, 16}, .samples = 9};
  const core::RenderSettings plain = render_settings(picture, painted, database);
  CHECK(plain.shade.pixel_share == 1);
  CHECK(plain.shade.first_samples == 9);
  picture.is_refined = true;
  CHECK(render_settings(picture, painted, database).shade.pixel_share == 0.5);
  CHECK(render_settings(picture, laid, core::build_database(laid, {})).shade.pixel_share == 0);
}

TEST_CASE(
    "bounces are those that the scene's file says, unless they are asked for, or there are none by what transport there is") {
  core::Scene scene;
  PictureOptions picture{.scene = "a.pbrt"};
  picture.transport.kind = core::TransportKind::paths;
  picture.depth = picture.transport.depth();
  CHECK(depth_of(picture, scene) == 9);
  scene.bounces = 4;
  CHECK(depth_of(picture, scene) == 5);
  picture.transport.are_bounces_unasked = false;
  CHECK(depth_of(picture, scene) == 9);
  picture.transport = {};
  picture.depth = 3;
  CHECK(depth_of(picture, scene) == 3);
}

}  // namespace dmpc::apps::picture_options_test
