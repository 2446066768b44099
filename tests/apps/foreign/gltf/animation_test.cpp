// Animations of glTF: where what is on paper says that nodes stand, and what does not hold together.
#include "apps/foreign/gltf/animation.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/formats/whole_view.h"
#include "core/base/expect.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"

namespace dmpc::tests::animation_test {

namespace {

using apps::AnimationMoment;
using apps::MeshFile;
using core::Vec3d;

using Floats = std::vector<float>;

/// The triangle (0 0 0) (2 0 0) (0 1 0) at a node that one channel moves.
struct Film {
  std::vector<float> times = {0, 2};
  std::vector<float> values = {0, 0, 0, 4, 0, -2};
  std::string path = "translation", interpolation = "LINEAR";
  std::string node = R"({"mesh":0})";
  std::string target = R"("node":0)";
  std::string name = R"("name":"walk",)";
  std::string more_channels, more_animations, more;

  std::string text() const {
    GltfDocument document;
    const std::size_t width = path == "rotation" ? 4 : 3;
    const std::string corners = document.add(triangle_corners, 3), input = document.add(times, 1),
                      output = document.add(values, width);
    document.node = node;
    return document.text(R"({"attributes":{"POSITION":)" + corners + "}}",
                         R"("animations":[{)" + name + R"("samplers":[{"input":)" + input + R"(,"output":)" + output +
                             R"(,"interpolation":")" + interpolation + R"("}],"channels":[{"sampler":0,"target":{)" + target +
                             (target.empty() ? "" : ",") + R"("path":")" + path + R"("}})" + more_channels + "]}" +
                             more_animations + "]" + more);
  }
  MeshFile read(double seconds, const std::string& asked = "") const {
    return read_mesh("a.gltf", text(), {.animation = AnimationMoment{asked, seconds, 24, {}}});
  }
  /// Where the triangle's corners are.
  std::vector<Vec3d> at(double seconds) const { return read(seconds).scene.vertices; }
  std::string complaint(const std::string& asked = "") const {
    return complaint_of([&] { read(1, asked); });
  }
};

void check_at(const Vec3d& point, const Vec3d& expected) {
  INFO(point.x, " ", point.y, " ", point.z);
  CHECK(core::length(point - expected) < 1e-6);
}

}  // namespace

TEST_CASE("a node that moves straight is where its time says, and stands still before the first keyframe and behind the last") {
  const Film film{.times = {1, 3}};
  check_at(film.at(2)[0], {2, 0, -1});
  check_at(film.at(2)[1], {4, 0, -1});
  check_at(film.at(1.5)[0], {1, 0, -0.5});
  check_at(film.at(0)[0], {0, 0, 0});
  check_at(film.at(99)[0], {4, 0, -2});
}

TEST_CASE("what no channel moves stays as the node says, and no animation is played unasked") {
  const Film film{.node = R"({"mesh":0,"translation":[7,7,7],"scale":[3,3,3]})"};
  check_at(film.at(2)[1], {10, 0, -2});
  const MeshFile still = read_mesh("a.gltf", film.text());
  check_at(still.scene.vertices[0], {7, 7, 7});
  CHECK(notes(still, "animations not played: 1"));
}

TEST_CASE("half of a turn by 90 degrees is 45 degrees, a third is 30, and the shorter way round is taken") {
  const auto half = static_cast<float>(std::sqrt(0.5));
  Film film{.values = {0, 0, 0, 1, 0, 0, half, half}, .path = "rotation"};
  check_at(film.at(1)[1], {std::sqrt(2.0), std::sqrt(2.0), 0});
  check_at(film.at(2.0 / 3)[1], {std::sqrt(3.0), 1, 0});
  film.values = {0, 0, 0, 1, 0, 0, -half, -half};  // the same rotation as a quaternion of the other sign
  check_at(film.at(1)[1], {std::sqrt(2.0), std::sqrt(2.0), 0});
}

TEST_CASE("a step keeps the value of the keyframe before it") {
  const Film film{.interpolation = "STEP"};
  check_at(film.at(1.999)[0], {0, 0, 0});
  check_at(film.at(2)[0], {4, 0, -2});
}

TEST_CASE("a spline goes through its values by its slopes, which are those of a second") {
  // Per keyframe: the slope before it, its value, the slope behind it.
  Film film{.values = {9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 0, 3, 4, 8, 0, 9, 9, 9}, .interpolation = "CUBICSPLINE"};
  check_at(film.at(0)[0], {0, 0, 0});
  check_at(film.at(2)[0], {4, 8, 0});
  // Half way: (p0 + p1) / 2 + 2 s (m0 - m1) / 8.
  check_at(film.at(1)[0], {2.25, 4, -0.75});
  film.path = "rotation";
  film.values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
  check_at(film.at(1)[1], {0, 2, 0});  // half of a half turn, of length 1 again
}

TEST_CASE("a scale of 0 hides what it is of") {
  CHECK(contains(mesh_refusal("a.gltf", Film{.node = R"({"mesh":0,"scale":[0,0,0]})"}.text()), "no triangle in it that has an"));
  check_at(Film{.values = {1, 1, 1, 3, 1, 1}, .path = "scale"}.at(1)[1], {4, 0, 0});
}

TEST_CASE("a frame of an animation may show nothing, and a whole that is but a point is seen as one of unit size") {
  const Film film{.values = {0, 0, 0, 1, 1, 1}, .path = "scale"};
  const MeshFile nothing = film.read(0);
  CHECK(nothing.scene.objects.empty());
  CHECK(nothing.still.bounds.radius == 1);
  CHECK(length(nothing.scene.view.from - nothing.scene.view.at) > 1);
  const AnimationMoment later{"", 2, 24, apps::StillScene{nothing.still.bounds, nothing.scene.view}};
  check_at(read_mesh("a.gltf", film.text(), {.animation = later}).scene.vertices.at(1), {2, 0, 0});
}

TEST_CASE("values in normalised bytes are those that they stand for") {
  GltfDocument document;
  const std::string corners = document.add(triangle_corners, 3);
  document.add(Floats{0, 1}, 1);
  document.add(std::array<std::int8_t, 8>{0, 0, 0, 127, 0, 0, 127, 0}, 4, R"("normalized":true)");
  const std::string text = document.text(
      R"({"attributes":{"POSITION":)" + corners + "}}",
      R"("animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}]}])");
  const MeshFile file = read_mesh("a.gltf", text, {.animation = AnimationMoment{.seconds = 0.5}});
  check_at(file.scene.vertices[1], {0, 2, 0});
}

TEST_CASE("joints move what their skin holds, and a camera goes with its node") {
  GltfDocument document;
  const std::string corners = document.add(triangle_corners, 3), joints = document.add(std::array<std::uint8_t, 12>{}, 4);
  const std::string weights = document.add(Floats{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4), input = document.add(Floats{0, 2}, 1);
  const std::string output = document.add(Floats{0, 0, 9, 0, 6, 9}, 3);
  document.node = R"({"children":[1,2,3]},{"mesh":0,"skin":0},{},{"camera":0})";
  const std::string text =
      document.text(R"({"attributes":{"POSITION":)" + corners + R"(,"JOINTS_0":)" + joints + R"(,"WEIGHTS_0":)" + weights + "}}",
                    R"("skins":[{"joints":[2]}],"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],)"
                    R"("animations":[{"samplers":[{"input":)" +
                        input + R"(,"output":)" + output +
                        R"(}],"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}},)"
                        R"({"sampler":0,"target":{"node":3,"path":"translation"}}]}])");
  const MeshFile file = read_mesh("a.gltf", text, {.animation = AnimationMoment{.seconds = 1}});
  check_at(file.scene.vertices[1], {2, 3, 9});
  check_at(file.scene.view.from, {0, 3, 9});
  check_at(file.scene.view.at - file.scene.view.from, {0, 0, -1});
}

TEST_CASE("a file without camera and lights is seen and lit as the still scene is, wherever its parts have gone") {
  const Film film;
  const MeshFile still = film.read(0);
  check_at(still.still.bounds.center, {1, 0.5, 0});
  CHECK(still.still.bounds.radius == doctest::Approx(std::sqrt(1.25)).epsilon(1e-9));
  const AnimationMoment later{"", 2, 24, apps::StillScene{still.still.bounds, still.scene.view}};
  const MeshFile moved = read_mesh("a.gltf", film.text(), {.animation = later});
  CHECK(moved.scene.view.from == still.scene.view.from);
  CHECK(moved.scene.view.at == still.scene.view.at);
  REQUIRE(moved.scene.lights.size() == still.scene.lights.size());
  for (std::size_t i = 0; i < moved.scene.lights.size(); ++i) {
    CHECK(moved.scene.lights[i].position == still.scene.lights[i].position);
  }
  CHECK(film.read(2).scene.view.from != still.scene.view.from);  // by itself it would follow
}

TEST_CASE("an animation is known by its name, the first needs none, and one that is not there is refused with those that are") {
  const Film film{.more_animations = R"(,{"name":"run","samplers":[],"channels":[]},{"samplers":[],"channels":[]})"};
  check_at(film.read(2, "walk").scene.vertices[0], {4, 0, -2});
  check_at(film.read(2, "run").scene.vertices[0], {0, 0, 0});
  check_at(film.read(2, "animations[2]").scene.vertices[0], {0, 0, 0});
  CHECK(contains(film.complaint("fly"), "no animation in it is called fly, expected one of walk, run, animations[2]"));
  CHECK(notes(film.read(0), "animation walk takes 2 seconds: at 24 frames a second frame 49 shows its end"));
  CHECK(notes(film.read(0), "animations not played: 2"));
  CHECK(contains(Film{.name = R"("nam":"walk",)"}.complaint("walk"), "expected one of animations[0]"));
}

TEST_CASE("a file without animations is refused where one is asked for") {
  const AnimationMoment moment;
  GltfDocument document;
  const std::string text = document.text(R"({"attributes":{"POSITION":)" + document.add(triangle_corners, 3) + "}}");
  CHECK(contains(mesh_refusal("a.gltf", text, {.animation = moment}), "no animation is in it: leave out --animation"));
}

TEST_CASE("what is animated and not played is said with its count") {
  const Film film{.more_channels = R"(,{"sampler":0,"target":{"node":0,"path":"weights"}},)"
                                   R"({"sampler":0,"target":{"path":"pointer"}},{"sampler":0,"target":{"path":"scale"}})"};
  const MeshFile file = film.read(1);
  CHECK(notes(file, "channels of the animation that change morph weights, not played: 1"));
  CHECK(notes(file, "channels of the animation that change what extensions name, not played: 1"));
  check_at(file.scene.vertices[1], {4, 0, -1});
}

// The lamp goes from 7 away to 3: by itself the share would grow smaller.
TEST_CASE("lights that are too bright are weakened in all frames as in the first") {
  const Film film{.values = {0, 0, 7, 0, 0, 3},
                  .node = R"({"mesh":0,"children":[1]},{"extensions":{"KHR_lights_punctual":{"light":0}}})",
                  .target = R"("node":1)",
                  .more = R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":54351}]}})"};
  const auto read = [&](double seconds, const std::optional<apps::StillScene>& still) {
    return read_mesh("a.gltf", film.text(), {.is_by_paths = true, .animation = AnimationMoment{"", seconds, 24, still}});
  };
  const MeshFile first = read(0, std::nullopt);
  CHECK(first.still.light_share < 0.01);
  const MeshFile moved = read(2, apps::StillScene{first.still.bounds, first.scene.view, first.still.light_share});
  CHECK(moved.scene.lights.at(0).color == first.scene.lights.at(0).color);
  CHECK(read(2, std::nullopt).still.light_share < first.still.light_share / 2);
}

TEST_CASE("a camera that an animation takes out of all reach is an error of that frame, and not another view") {
  const Film film{.values = {0, 0, 10, 0, 0, 3e32F},
                  .node = R"({"mesh":0,"children":[1]},{"camera":0})",
                  .target = R"("node":1)",
                  .more = R"(,"cameras":[{"type":"perspective","perspective":{"yfov":0.6,"znear":0.1}}])"};
  const core::View first = film.read(0).scene.view;
  check_at(first.from, {0, 0, 10});
  const apps::BoundingSphere bounds{{1, 0.5, 0}, 2};
  const auto complaint = [&](double seconds, const core::View& still) {
    const AnimationMoment moment{"", seconds, 24, apps::StillScene{bounds, still}};
    return mesh_refusal("a.gltf", film.text(), {.animation = moment});
  };
  CHECK(contains(complaint(1, first), "the animation takes the camera beyond 1e30"));
  CHECK(complaint(1e-32, first).empty());
  CHECK(complaint(1, apps::whole_view(bounds, {})).empty());  // which the film began with
}

TEST_CASE("an animation that does not hold together is refused, with its place") {
  constexpr float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  struct Refusal {
    Film film;
    const char* says;
  };
  const std::vector<Refusal> refusals = {
      {{.times = {2, 1}}, "animations[0].samplers[0].input: keyframe 1 is at 1 seconds, expected times"},
      {{.times = {1, 1}}, "keyframe 1 is at 1 seconds"},
      {{.times = {nan, 1}}, "keyframe 0 is at nan seconds"},
      {{.times = {0, infinite}}, "keyframe 1 is at inf seconds"},
      {{.times = {-1, 1}}, "keyframe 0 is at -1 seconds"},
      {{.times = {}}, "has no keyframe"},
      {{.times = {0, 1, 2}}, "samplers[0].output: has 2 values for 3 keyframes, expected 3"},
      {{.interpolation = "CUBICSPLINE"}, "has 2 values for 2 keyframes, expected 6"},
      {{.values = {0, 0, 0, nan, 0, 0}}, "samplers[0].output: has a value that is not finite"},
      {{.interpolation = "CUBIC"}, "samplers[0].interpolation: is 'CUBIC', expected STEP, LINEAR or CUBICSPLINE"},
      {{.values = {0, 0, 0, 0, 0, 0, 0, 1}, .path = "rotation"}, "a rotation is a quaternion of length 0, which turns nowhere"},
      {{.target = R"("node":5)"}, "animations[0].channels[0].target.node: refers to nodes[5], which does not exist"},
      {{.node = R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})"},
       "animations[0].channels[0].target: moves nodes[0], which has a matrix"},
      {{.more_channels = R"(,{"sampler":0,"target":{"node":0,"path":"translation"}})"},
       "animations[0].channels[1].target: moves nodes[0] by its translation, which another channel does, too"},
      {{.more_channels = R"(,{"sampler":3,"target":{"node":0,"path":"scale"}})"}, "refers to samplers[3], which does not exist"},
      {{.more_channels = R"(,{"sampler":0,"target":{"node":0,"path":"rotation"}})"}, "whose type is VEC3; expected 4 numbers"},
      {{.more_channels = R"(,{"sampler":0})"}, "animations[0].channels[1]: has no \"target\""}};
  for (const Refusal& refusal : refusals) {
    const std::string complaint = refusal.film.complaint();
    CHECK_MESSAGE(contains(complaint, refusal.says), refusal.says << " / " << complaint);
  }
}

}  // namespace dmpc::tests::animation_test
