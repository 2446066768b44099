#include "core/base/refusal.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <string>

namespace dmpc::tests::refusal_test {

namespace {

struct Shoe {
  std::optional<std::uint32_t> size_mm = std::nullopt;
  int colour = 0;
};
struct Hat {
  int colour = 0;
};

constexpr core::Field size = core::field_of<&Shoe::size_mm>();

}  // namespace

TEST_CASE("a field is called as the member is, and is that of its own struct alone") {
  static_assert(size.name() == "size_mm");
  static_assert(core::field_of<&Shoe::colour>() == core::field_of<&Shoe::colour>());
  static_assert(core::field_of<&Shoe::colour>() != core::field_of<&Hat::colour>());
  CHECK(core::field_of<&Hat::colour>().name() == "colour");
}

TEST_CASE("a refusal says its fields by their own names, and whoever catches it by others") {
  CHECK_NOTHROW(core::check_use(true, size, "=0"));
  try {
    core::check_use(false, size, "=", 47U, ": from ", 200, " to ", std::uint64_t{330});
    FAIL("47 is no size");
  } catch (const core::Refusal<core::UsageError>& refusal) {
    CHECK(refusal.what() == std::string("size_mm=47: from 200 to 330"));
    CHECK(refusal.sentence.text([](const core::Field& field) { return field == size ? "--size" : "?"; }) ==
          "--size=47: from 200 to 330");
  }
}

}  // namespace dmpc::tests::refusal_test
