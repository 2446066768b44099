#include "apps/render/picture_identity.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/scene/base_meshes.h"
#include "core/scene/instances.h"
#include "tests/support/faceted_surfaces.h"
#include "tests/support/instanced_scene.h"
#include "tests/support/small_scenes.h"
#include "tests/support/text.h"

namespace dmpc::apps::picture_identity_test {

using tests::contains;
using tests::mirrors_and_glass;

namespace {

using ChangeScene = std::function<void(core::Scene&)>;
using ChangeOptions = std::function<void(RenderOptions&)>;

/// How a picture that was changed differs from the one that was not.
std::string difference(const ChangeScene& change_scene, const ChangeOptions& change_options = {}) {
  RenderOptions options;
  core::Scene scene = mirrors_and_glass();
  tests::add_textured_walls(scene);
  const PictureIdentity here = identity_of(options, scene);
  if (change_scene) {
    change_scene(scene);
  }
  if (change_options) {
    change_options(options);
  }
  return difference_text(identity_of(options, scene).facts, here.facts);
}

std::string difference_by_options(const ChangeOptions& change) { return difference({}, change); }

}  // namespace

TEST_CASE("the same picture has the same facts") { CHECK(difference({}).empty()); }

TEST_CASE("whatever of the scene is changed, it is another picture") {
  CHECK(difference([](auto& scene) { scene.vertices[0].x += 1e-12; }) == "other objects");
  CHECK(difference([](auto& scene) { scene.normals[1].y = -scene.normals[1].y; }) == "other objects");
  CHECK(difference([](auto& scene) { scene.corners[0].place[1] += 0.25F; }) == "other objects");
  CHECK(difference([](auto& scene) { std::swap(scene.objects[0], scene.objects[1]); }) == "other objects");
  CHECK(difference([](auto& scene) { scene.spheres.back().radius *= 2; }) == "other objects");
  CHECK(difference([](auto& scene) { scene.cones.pop_back(); }) == "other objects");
  CHECK(difference([](auto& scene) { scene.materials[0].shine = 7; }) == "other materials");
  CHECK(difference([](auto& scene) { scene.textures[0].levels[0].texels[5] ^= 1U; }) == "other textures");
  CHECK(difference([](auto& scene) { scene.lights[0].has_color = true; }) == "other lights or background");
  CHECK(difference([](auto& scene) { scene.background.z = 0; }) == "other lights or background");
  CHECK(difference([](auto& scene) { scene.ambient.y = 0.1; }) == "other lights or background");
  CHECK(difference([](auto& scene) { scene.view.angle_degrees = 51; }) == "other view");
}

TEST_CASE("whatever of the settings is changed, the facts say so in words") {
  CHECK(difference_by_options([](auto& options) { options.picture.depth = 3; }) == "depth is 3, here 5");
  CHECK(difference_by_options([](auto& options) { options.picture.cutoff = 0.25; }) == "cutoff is 0.25, here 0");
  CHECK(difference_by_options([](auto& options) { options.picture.samples = 4; }) == "samples is 4, here 1");
  CHECK(difference_by_options([](auto& options) { options.picture.resolution = {8, 9}; }) == "resolution is 8x9, here 512x512");
  CHECK(difference_by_options([](auto& options) { options.picture.convention = core::Convention::paper; }) ==
        "convention is paper, here haines");
  CHECK(difference_by_options([](auto& options) { options.tracer = TracerChoice::embree; }) == "tracer is embree, here grid");
}

TEST_CASE("a picture that is refined has an error and a bound more") {
  const auto refine = [](RenderOptions& options) {
    options.picture.is_refined = true;
    options.picture.refinement.error = 0.5;
  };
  CHECK(difference_by_options(refine) ==
        "samples is auto, here 1; error is 0.5, here there is none; samples-max is 4096, here there is none");
  CHECK(difference_text({}, {{"error", "0.5"}}) == "no error");
  CHECK(contains(difference_by_options([&](RenderOptions& options) {
                   refine(options);
                   options.picture.refinement.kind = core::ErrorKind::noise;
                 }),
                 "estimate of noise is by former changes, too, here there is none"));
  CHECK(contains(difference_by_options([](RenderOptions& options) {
                   options.picture.transport.kind = core::TransportKind::paths;
                   options.picture.transport.clamp = 0.5;
                 }),
                 "clamp is 0.5, here there is none"));
}

TEST_CASE("a scene with meshes in several places is told from one in which all that was judged where it stands") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  for (int i = 0; i < 65; ++i) {
    builder.polygon({{i * 1.0, 0, 0}, {i + 1.0, 0, 0}, {i * 1.0, 1, 0}});
  }
  core::expand(scene, {.meshes = {{0, 65}}, .places = {{{}, 0, 65}, {{.shift = {0, 0, 1}}, 0, 65}}});
  core::Scene before = scene;
  before.kept.reset();
  CHECK(contains(difference_text(identity_of({}, before).facts, identity_of({}, scene).facts), "no meshes in several places"));
  CHECK(scene_digest(scene) != scene_digest(before));
}

TEST_CASE("whether a scene has copies of its meshes or leaves them out, it is the same picture, and with one more it is not") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    tests::InstancedScene made = tests::instanced_scene(seed);
    core::Scene expanded = made.scene, left = made.scene;
    core::expand(expanded, made.instances);
    core::leave(left, made.instances);
    REQUIRE(expanded.objects.size() > left.objects.size());
    CHECK(difference_text(identity_of({}, left).facts, identity_of({}, expanded).facts).empty());
    CHECK(scene_digest(left) == scene_digest(expanded));
    made.instances.places.push_back(made.instances.places.back());
    core::expand(made.scene, made.instances);
    CHECK(scene_digest(made.scene) != scene_digest(expanded));
  }
}

TEST_CASE("a picture by paths is told from Whitted's, which has the facts that it had before there were paths") {
  const auto by_paths = [](auto& options) { options.picture.transport.kind = core::TransportKind::paths; };
  CHECK(difference_by_options(by_paths) == "bounces is 4, here there is none; transport is paths, here there is none; no depth");
  CHECK(contains(difference_by_options([&](auto& options) {
                   by_paths(options);
                   options.picture.transport.sky = {.horizon = {1, 1, 1}, .zenith = core::Vec3d{0, 0, 2}};
                 }),
                 "sky is 1,1,1/0,0,2, here there is none"));
}

TEST_CASE("a picture below a sky's picture is told by what that shows, whatever its file is called") {
  const auto facts = [](float light, const char* file) {
    RenderOptions options;
    options.picture.transport = {.kind = core::TransportKind::paths, .sky = SkyChoice{{}, {}, file}};
    core::Scene scene = mirrors_and_glass();
    if (light > 0) {
      scene.sky = core::sky_texels(2, 1, std::vector<float>{light, light, light, 0, 0, 0});
    }
    return identity_of(options, scene).facts;
  };
  CHECK(difference_text(facts(1, "a.hdr"), facts(1, "b.hdr")).empty());
  CHECK(difference_text(facts(2, "a.hdr"), facts(1, "a.hdr")) == "other sky");
  CHECK(difference_text(facts(0, "a.hdr"), facts(0, "b.hdr")).empty());  // both have one colour, the background's
}

TEST_CASE("how many emitters paths aim at is a fact of a scene in which something shines") {
  const auto shine = [](core::Scene& scene) { scene.materials[0].emission = {1, 1, 1}; };
  const auto by_paths = [](RenderOptions& options) { options.picture.transport.kind = core::TransportKind::paths; };
  CHECK(contains(difference(shine, by_paths), "emitters is 1024, here there is none"));
  CHECK(contains(difference(shine, by_paths), "light sampling is by inversion, here there is none"));
  CHECK(!contains(difference({}, by_paths), "emitters"));
  CHECK(!contains(difference(shine), "emitters"));
}

TEST_CASE("what surfaces of tiny mirrors are is a fact of pictures by paths alone, and of scenes that have some") {
  const auto roughen = [](core::Scene& scene) { scene.materials[0].microfacets.roughness = 0.5; };
  const auto by_paths = [](RenderOptions& options) { options.picture.transport.kind = core::TransportKind::paths; };
  CHECK(contains(difference(roughen, by_paths), "metal and roughness of materials"));
  CHECK(!contains(difference({}, by_paths), "roughness"));
  CHECK(difference(roughen).empty());
}

TEST_CASE("a texture of metal and roughness is part of that fact, and none of colours' or of Whitted's") {
  core::Scene scene = tests::faceted_surfaces();
  RenderOptions options;
  const auto facts = [&] { return identity_of(options, scene).facts; };
  const auto before = facts();
  options.picture.transport.kind = core::TransportKind::paths;
  const auto by_paths = facts();
  scene.textures[2].levels[0].texels[5] ^= 1U << 9U;
  CHECK(difference_text(facts(), by_paths) == "other metal and roughness of materials");
  options.picture.transport.kind = core::TransportKind::whitted;
  CHECK(difference_text(facts(), before).empty());
}

TEST_CASE("the computer, the strategy and what is left out are no part of the picture") {
  CHECK(difference_by_options([](auto& options) {
          options.strategy = Strategy::dataflow;
          options.computer.node_count = 3;
          options.database.build.page_size_bytes = 4096;
          options.database.build.record_order = core::RecordOrder::scattered;
          options.picture.skips.background = false;
        }).empty());
}

}  // namespace dmpc::apps::picture_identity_test
