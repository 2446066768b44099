#include "apps/show/page/typed_array.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "apps/frontend/show/page/data_url.h"
#include "core/base/expect.h"
#include "tests/apps/show/page/numbers_in.h"

namespace dmpc::apps::html::typed_array_test {

namespace {

using Numbers = std::vector<std::uint64_t>;

nlohmann::json array_of(const Numbers& values) { return typed_array(values); }

}  // namespace

TEST_CASE("numbers take the smallest type that has them all") {
  CHECK(array_of({})["type"] == "u1");
  CHECK(array_of({1, 255})["type"] == "u1");
  CHECK(array_of({1, 256})["type"] == "u2");
  CHECK(array_of({65'535})["type"] == "u2");
  CHECK(array_of({65'536})["type"] == "u4");
  CHECK(array_of({0xffff'ffffU})["type"] == "u4");
  CHECK(array_of({0x1'0000'0000U})["type"] == "f8");
}

TEST_CASE("numbers lie with their lowest byte first, doubles as IEEE 754 has them") {
  CHECK(array_of({1, 255})["data"] == base64("\x01\xff"));
  CHECK(array_of({0x102})["data"] == base64("\x02\x01"));
  CHECK(array_of({0x1020304})["data"] == base64("\x04\x03\x02\x01"));
  CHECK(array_of({std::uint64_t{1} << 32U})["data"] == base64(std::string_view("\0\0\0\0\0\0\xf0\x41", 8)));
}

TEST_CASE("what was written is read again, up to the largest number that a script has exactly") {
  for (const Numbers& values : {Numbers{}, Numbers{7}, Numbers{0, 255, 3}, Numbers{65'535, 1}, Numbers{1, 4'000'000'000U, 2},
                                Numbers{std::uint64_t{1} << 53U, 5}}) {
    CHECK(tests::numbers_in(array_of(values)) == values);
  }
  CHECK_THROWS_AS(array_of({(std::uint64_t{1} << 53U) + 1}), core::InternalError);
}

}  // namespace dmpc::apps::html::typed_array_test
