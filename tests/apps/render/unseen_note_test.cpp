#include "apps/render/unseen_note.h"

#include <doctest/doctest.h>

#include <string>

#include "apps/scene/staging.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::unseen_note_test {

using core::Vec3d;

TEST_CASE("a camera that sees nothing is told where the scene lies, and one that shows the whole") {
  const std::string note = unseen_note({{-1, -2, -3}, {1, 2, 3}}, {});
  CHECK(tests::contains(note, "which lies between -1,-2,-3 and 1,2,3: "));
  const CameraChoice camera = parse_camera(note.substr(note.find("--camera=") + 9));
  CHECK(camera.at == Vec3d{});
  CHECK(camera.up == Vec3d{0, 1, 0});
  CHECK(dot(camera.from, Vec3d{1, 1, 1}) > 0);
}

TEST_CASE("a scene that is a single point has a camera before it") {
  const std::string note = unseen_note({{5, 5, 5}, {5, 5, 5}}, {2, true});
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
    return tests::contains(render.errors(), "the camera sees nothing of the scene");
  };
  for (const char* const strategy : {"svm", "dataflow", "replicated", "forest"}) {
    CAPTURE(strategy);
    CHECK(said(strategy, "9,0,0/10,0,0"));
    CHECK_FALSE(said(strategy, "9,0,0/0,0,0"));
  }
}

}  // namespace dmpc::apps::unseen_note_test
