#include "apps/scene/camera_path.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::camera_path_test {

using core::Vec3d;
using core::View;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

bool is_near(const Vec3d& a, const Vec3d& b) { return length(a - b) < 1e-12; }

CameraPath with(CameraPath path, const View& own, const core::Box& bounds = {}) {
  path.set_scene(own, bounds);
  return path;
}

Keyframe key(std::uint64_t frame, const Vec3d& from) { return {frame, {.from = from, .at = {0, 0, 0}}}; }

/// What reading a path of this text says, behind the file's name.
std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / "p", text);
  const std::string path = folder / "p", said = tests::complaint_of([&] { static_cast<void>(read_camera_path(path)); });
  return said.starts_with("--camera-path=" + path) ? said.substr(("--camera-path=" + path).size()) : said;
}

}  // namespace

TEST_CASE("a turntable starts at the scene's own view, goes round what that looks at, and comes back to it, bit by bit") {
  const View own{.from = {1, 2, 5}, .at = {1, 2, 3}, .up = {0, 3, 0}};
  const CameraPath quarter = with(CameraPath::turntable(90), own);
  CHECK(quarter.view(1).from == own.from);
  CHECK(is_near(quarter.view(2).from, {3, 2, 3}));
  CHECK(is_near(quarter.view(3).from, {1, 2, 1}));
  CHECK(is_near(quarter.view(4).from, {-1, 2, 3}));
  CHECK(quarter.view(5).from == own.from);
  CHECK(quarter.view(999'999'997).from == own.from);
  CHECK(is_near(quarter.view(2).at, own.at));
  CHECK(quarter.view(2).up == own.up);
  CHECK(is_near(with(CameraPath::turntable(-90), own).view(2).from, {-1, 2, 3}));
}

TEST_CASE("a turntable goes round the middle of the scene, as far as that lies before the camera, whatever it looks at") {
  const View own{.from = {0, 0, 5}, .at = {0, 0, 4}};
  const core::Box bounds{{-1, 0, -1}, {1, 4, 1}};
  const View quarter = with(CameraPath::turntable(90), own, bounds).view(2);
  CHECK(is_near(quarter.from, {5, 0, 0}));
  CHECK(is_near(quarter.at, {4, 0, 0}));
  const core::Box behind{{-1, 0, 7}, {1, 4, 9}};
  CHECK(is_near(with(CameraPath::turntable(90), own, behind).view(2).from, {1, 0, 4}));
}

TEST_CASE("at its keyframes a camera is where they say, to the bit, and what they leave open is the scene's") {
  const View own{.up = {0, 0, 1}, .angle_degrees = 30};
  const CameraPath path = with(CameraPath({key(1, {0, 1, 0.1}), key(4, {3, 0.3, 7}), key(6, {5, 5, 5})}), own);
  CHECK(path.first() == 1);
  CHECK(path.last() == 6);
  CHECK(path.view(1).from == Vec3d{0, 1, 0.1});
  CHECK(path.view(4).from == Vec3d{3, 0.3, 7});
  CHECK(path.view(6).from == Vec3d{5, 5, 5});
  CHECK(path.view(5).up == own.up);
  CHECK(path.view(5).angle_degrees == 30);
}

TEST_CASE("between keyframes that lie evenly on a line the camera goes along it evenly") {
  const CameraPath path({key(1, {0, 0, 9}), key(3, {2, 0, 9}), key(7, {6, 0, 9})});
  for (std::uint64_t frame = 1; frame <= 7; ++frame) {
    CHECK(is_near(path.view(frame).from, {static_cast<double>(frame) - 1, 0, 9}));
  }
}

TEST_CASE("halfway between the middle ones of four even keyframes a coordinate is (9 (b + c) - (a + d)) / 16") {
  const CameraPath path({key(1, {1, 0, 9}), key(3, {0, 0, 9}), key(5, {4, 0, 9}), key(7, {2, 0, 9})});
  CHECK(is_near(path.view(4).from, {(9.0 * 4 - 3) / 16, 0, 9}));
}

TEST_CASE("a path is lines of a frame and a camera; remarks and blank lines are left out") {
  const TemporaryFolder folder;
  write_text(folder / "p", "# a walk\r\n\n  1 0,0,9/0,0,0/0,1,0/45  # begins\n\t24\t9,0,0/0,0,0\r\n");
  const CameraPath path = with(read_camera_path(folder / "p"), View{.angle_degrees = 30});
  CHECK(path.last() == 24);
  CHECK(path.view(24).from == Vec3d{9, 0, 0});
  CHECK(path.view(24).angle_degrees == 30);
  CHECK(path.view(1).angle_degrees == 45);
}

TEST_CASE("what is wrong in a path is told with file and line") {
  CHECK(complaint("1 0,0,9/0,0,0\n2 what\n").starts_with(":2: the camera=what: expected FROM/AT"));
  CHECK(complaint("1 0,0,9/0,0,0\n1 0,0,8/0,0,0\n") == ":2: frame 1 does not follow frame 1, the keyframe before it");
  CHECK(complaint("\n0 0,0,9/0,0,0\n").starts_with(":2: \"0 0,0,9/0,0,0\": expected FRAME CAMERA such as"));
  CHECK(complaint("7\n").starts_with(":1: \"7\": expected FRAME CAMERA"));
  CHECK(complaint("1.5 0,0,9/0,0,0\n").starts_with(":1: "));
  CHECK(complaint("1 0,0,9/0,0,9\n").starts_with(":1: the camera=0,0,9/0,0,9: expected FROM and AT at different points"));
  CHECK(complaint("2000000000 0,0,9/0,0,0\n").starts_with(":1: "));
  CHECK(complaint("# nothing\n") == ": expected a keyframe, a line such as 1 4,3,5/0,0,0/0,1,0/45");
  CHECK(complaint("1 0,0,9/0,0,0" + std::string(5000, ' ') + "\n").starts_with(":1: this line has 5,013 bytes"));
  CHECK_THROWS_AS(read_camera_path("/nonexistent/path"), core::InputError);
}

TEST_CASE("a frame between keyframes at which the camera shows nothing is named before anything is rendered") {
  const CameraPath path({{1, {.from = {0, 0, 1}, .at = {0, 0, 0}}}, {3, {.from = {0, 0, 0}, .at = {0, 0, 1}}}});
  CHECK_NOTHROW(path.check(1, 1));
  CHECK_THROWS_AS(path.check(1, 3), core::InputError);
}

}  // namespace dmpc::apps::camera_path_test
