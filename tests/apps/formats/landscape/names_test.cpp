#include "apps/formats/landscape/names.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::apps::landscape_names_test {

TEST_CASE("a landscape's name says its size") {
  CHECK(landscape_size("landscape") == landscape_size_default);
  CHECK(landscape_size("landscape-1") == 1);
  CHECK(landscape_size("landscape-11") == 11);
  CHECK_FALSE(landscape_size("mount-4"));
  CHECK_FALSE(landscape_size(""));
  for (const char* name : {"landscape-0", "landscape-12", "landscape-", "landscape-1x", "landscape-01", "landscapes"}) {
    CHECK_THROWS_AS(landscape_size(name), core::InputError);
  }
}

TEST_CASE("a grove's name says its size") {
  CHECK(grove_size("grove") == grove_size_default);
  CHECK(grove_size("grove-10") == 10);
  CHECK_FALSE(grove_size("landscape-4"));
  for (const char* name : {"grove-0", "grove-11", "groves"}) {
    CHECK_THROWS_AS(grove_size(name), core::InputError);
  }
}

}  // namespace dmpc::apps::landscape_names_test
