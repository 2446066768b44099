#include "apps/scene/transport_options.h"

#include <doctest/doctest.h>

#include "tests/support/small_scenes.h"
#include "tests/support/text.h"

namespace dmpc::apps::transport_options_test {

using tests::contains;

TEST_CASE("a sky is one colour or two, as it is told") {
  for (const char* const text : {"1,1,1", "0.5,0.25,0/0,0,1.5"}) {
    CHECK(text_of(parse_sky(text)) == text);
  }
  CHECK(text_of(parse_sky("0.5/1")) == "0.5,0.5,0.5/1,1,1");
}

TEST_CASE("what has letters that no colour has is the file of a sky's picture") {
  for (const char* const text : {"noon.exr", "skies/1.hdr", "blue", "information"}) {
    CHECK(text_of(parse_sky(text)) == text);
    CHECK(parse_sky(text).is_picture());
  }
  CHECK_FALSE(parse_sky("1e3").is_picture());
}

TEST_CASE("nodes have the zenith where the scene's up points, of length 1") {
  core::Scene scene = tests::mirrors_and_glass();
  scene.view.up = {0, 0, 4};
  const TransportOptions sky{.kind = core::TransportKind::paths, .sky = SkyChoice{{1, 1, 1}, core::Vec3d{0, 0, 2}}};
  const core::Transport transport = transport_of(sky, zenith_of(scene));
  CHECK(transport.has_sky);
  CHECK(transport.has_gradient);
  CHECK(transport.up == core::Vec3f{0, 0, 1});
  CHECK(sky_light(transport, {1, 1, 1}, {0, 0, 1}) == core::Color{0, 0, 2});
  CHECK(sky_light(transport, {1, 1, 1}, {0, 0, -1}) == core::Color{1, 1, 1});
  CHECK(sky_light(transport, {1, 1, 1}, {1, 0, 0}) == core::Color{1, 1, 1});
  CHECK_FALSE(transport_of({}, zenith_of(scene)).is_by_paths());
}

TEST_CASE("a transport is told in a few words") {
  CHECK(text_of(TransportOptions{}) == "whitted");
  TransportOptions transport{.kind = core::TransportKind::paths};
  CHECK(text_of(transport) == "paths, 8 bounces");
  transport.sky = SkyChoice{{1, 0.5, 0}, {}};
  transport.bounces = 1;
  CHECK(text_of(transport) == "paths, 1 bounce, sky 1,0.5,0");
}

TEST_CASE("lights that are balls are told with the radius, and only paths aim at what shines") {
  TransportOptions transport{.kind = core::TransportKind::paths, .light_radius = 0.25};
  CHECK(text_of(transport) == "paths, 8 bounces, lights of radius 0.25");
  CHECK(transport.emitters_max() == 1024);
  CHECK(TransportOptions{}.emitters_max() == 0);
}

TEST_CASE("what shines and is met by chance alone is told of, with why") {
  const TransportOptions paths{.kind = core::TransportKind::paths, .emitters = 100};
  CHECK(emitters_text({7, 0, 0}, paths).empty());
  CHECK(emitters_text({0, 3, 1}, {}).empty());
  CHECK(contains(emitters_text({100, 3, 0}, paths),
                 "3 primitives shine and are found by BSDF sampling alone, which is noisy: --emitters=100"));
  CHECK(
      contains(emitters_text({7, 1, 0}, paths), "1 primitive shines and is found by BSDF sampling alone, which is noisy: cones"));
  CHECK(emitters_text({7, 0, 2}, paths) ==
        "2 primitives shine in the plane of faces that show before: what these leave of that, if anything, is found by BSDF "
        "sampling alone");
}

TEST_CASE("materials that give more light than they get are told of, where something scatters it") {
  const TransportOptions paths{.kind = core::TransportKind::paths};
  const std::vector<core::Material> materials{{.color = {1, 1, 1}, .diffuse = 0.75, .specular = 0.5}, {.color = {1, 1, 1}}};
  CHECK(contains(gain_text(materials, paths), "1 material sends on more light than arrives, up to 1.25 times as much"));
  CHECK(gain_text(materials, {}).empty());
  CHECK(gain_text({{.color = {1, 1, 1}}, {.color = {0.5, 0.5, 0.5}, .specular = 0.5}}, paths).empty());
}

}  // namespace dmpc::apps::transport_options_test
