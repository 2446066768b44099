// What the page of `view` may send.
#include "apps/view/wishes.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/text.h"

namespace dmpc::apps::wishes_test {

namespace {

/// The sentence by which it is refused; empty if it is a wish.
std::string refusal(const std::string& json) {
  return tests::complaint_of<core::UsageError>([&] { wish_in(json); });
}

std::string wish_for(const std::string& camera) { return R"({"camera": ")" + camera + R"(", "moving": false})"; }

}  // namespace

TEST_CASE("a wish is a camera as --camera takes it, to the last bit, and whether it moves") {
  const Wish wish = wish_in(R"({"camera": "0.1,2,3e-5/0,0,0/0,1,0/45.5", "moving": true})");
  CHECK(wish.camera.from == core::Vec3d{0.1, 2, 3e-5});
  CHECK(wish.camera.degrees == 45.5);
  CHECK(wish.is_moving);
  CHECK(text_of(wish.camera) == "0.1,2,3e-05/0,0,0/0,1,0/45.5");
}

TEST_CASE("a wish may be final, and then stays the newest") {
  const std::string final_wish = R"({"camera": "0,0,1/0,0,0/0,1,0/45", "moving": false, "render": true})";
  CHECK(wish_in(final_wish).is_final);
  CHECK_FALSE(wish_in(wish_for("0,0,1/0,0,0/0,1,0/45")).is_final);
  CHECK(tests::contains(refusal(R"({"camera": "0,0,1/0,0,0/0,1,0/45", "moving": false, "render": false})"), "expected JSON"));
  Wishes wishes;
  wishes.take(final_wish);
  CHECK(wishes.take(wish_for("0,0,2/0,0,0/0,1,0/45")).status == 200);
  const std::optional<Wish> next = wishes.next({});
  REQUIRE(next);
  CHECK(next->is_final);
  CHECK(next->camera.from == core::Vec3d{0, 0, 1});
}

TEST_CASE("a camera that shows nothing is refused by a sentence") {
  CHECK(tests::contains(refusal(wish_for("1,2,3/1,2,3/0,1,0/45")), "FROM and AT at different points"));
  CHECK(tests::contains(refusal(wish_for("0,0,1/0,0,0/0,0,1/45")), "not parallel to the line from FROM to AT"));
  CHECK(tests::contains(refusal(wish_for("0,0,1/0,0,0/0,1,0/180")), "an angle between 0 and 180 degrees"));
  CHECK(tests::contains(refusal(wish_for("1e31,0,1/0,0,0/0,1,0/45")), "coordinates from -1e30 to 1e30"));
  for (const char* const camera : {"nan,0,1/0,0,0/0,1,0/45", "inf,0,1/0,0,0/0,1,0/45", "0,0,1/0,0,0/0,1,0/nan", "1e999,0,1/0,0,0",
                                   "0,0/0,0,0/0,1,0/45", "", "/", "0,0,1/0,0,0/0,1,0/45/1"}) {
    CHECK_MESSAGE(tests::contains(refusal(wish_for(camera)), "camera=" + std::string(camera) + ": expected "), camera);
  }
}

TEST_CASE("what leaves something open, or is no wish, is refused with the form of one") {
  CHECK(tests::contains(refusal(wish_for("0,0,1/0,0,0")), "the camera lacks its up or its angle"));
  CHECK(tests::contains(refusal(wish_for("0,0,1/0,0,0/0,1,0")), "the camera lacks its up or its angle"));
  const std::string deep(4000, '[');
  for (const std::string& json :
       {std::string(), std::string("{}"), std::string("null"), deep, std::string("{\"camera\": 1, \"moving\": false}"),
        std::string(R"({"camera": "0,0,1/0,0,0/0,1,0/45", "moving": 1})"), std::string(R"({"camera": "0,0,1/0,0,0/0,1,0/45"})"),
        std::string(R"({"camera": "0,0,1/0,0,0/0,1,0/45", "moving": true, "more": 1})"), std::string("\xff\xfe")}) {
    CHECK_MESSAGE(tests::contains(refusal(json), "expected JSON such as "), json);
  }
}

}  // namespace dmpc::apps::wishes_test
