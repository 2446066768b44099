#include "apps/run/frame_options.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::frame_options_test {

using tests::TemporaryFolder;
using tests::write_text;

TEST_CASE("frames are told by their number, or by the first and the last of them") {
  CHECK(parse_frames("24").first == 1);
  CHECK(parse_frames("24").last == 24);
  CHECK(parse_frames("3..7").first == 3);
  CHECK(parse_frames("3..7").count() == 5);
  CHECK(parse_frames("5..5").count() == 1);
  CHECK(parse_frames("1000000000").count() == 1'000'000'000);
}

TEST_CASE("a path that lacks one of the frames is refused, and says which it has") {
  const TemporaryFolder folder;
  write_text(folder / "path", "5 0,0,9/0,0,0\n9 0,9,9/0,0,0\n");
  const FrameOptions asked{.range = FrameRange{4, 9}, .camera_path = folder / "path"};
  CHECK_THROWS_WITH_AS(
      camera_path_of(asked),
      ((folder / "path").string() + ": its keyframes reach from frame 5 to 9, and --frames asks for 4 to 9").c_str(),
      core::InputError);
  CHECK(camera_path_of({.range = FrameRange{5, 9}, .camera_path = folder / "path"}).last() == 9);
}

}  // namespace dmpc::apps::frame_options_test
