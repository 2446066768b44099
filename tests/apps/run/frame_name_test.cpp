#include "apps/run/frame_name.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::apps::frame_name_test {

TEST_CASE("a name has a place for the frame's number where it has # or %d, with as many digits as it says or needs") {
  const auto of = [](const char* name, std::uint64_t frame) { return FrameName::in(name, "-o")->of(frame).string(); };
  CHECK(of("out.####.png", 7) == "out.0007.png");
  CHECK(of("out.%04d.png", 7) == "out.0007.png");
  CHECK(of("out#.exr", 7) == "out7.exr");
  CHECK(of("out%d.exr", 1234567) == "out1234567.exr");
  CHECK(of("##", 123) == "123");
  CHECK(of("a#b/c.##.png", 3) == "a#b/c.03.png");
}

TEST_CASE("a name without such a place has none, and one with two is refused") {
  for (const char* const name :
       {"out.png", "100%.png", "%4d.png", "%x.png", "a%", "%000000000000000000099d.png", "####/out.png"}) {
    CHECK_FALSE_MESSAGE(FrameName::in(name, "-o"), name);
  }
  CHECK_THROWS_WITH_AS(static_cast<void>(FrameName::in("a#b#.png", "-o")),
                       "-o=a#b#.png: expected one place for the frame's number, such as in out.####.png: this has two",
                       core::UsageError);
  CHECK_THROWS_AS(static_cast<void>(FrameName::in("a#%d.png", "-o")), core::UsageError);
}

TEST_CASE("the frame of a file is told by its name, and by no other way of writing the number") {
  const FrameName name = *FrameName::in("f/out.####.png", "-o");
  CHECK(name.frame_of("out.0007.png") == 7);
  CHECK(name.frame_of("out.12345.png") == 12345);
  for (const char* const other : {"out.007.png", "out.00012345.png", "out.7.png", "out..png", "out.png", "out.00x7.png",
                                  "out.0007.png.bak", "out.-007.png", "out.99999999999999999999.png"}) {
    CHECK_FALSE_MESSAGE(name.frame_of(other), other);
  }
  CHECK(name.folder() == "f");
}

}  // namespace dmpc::apps::frame_name_test
