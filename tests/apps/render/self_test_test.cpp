#include "apps/render/self_test.h"

#include <doctest/doctest.h>

namespace dmpc::tests::self_test_test {

// Literal numbers, since it is other computers and builds that have to agree with this one.
TEST_CASE("databases and pictures of the self-test have the same bits on every computer and in every build") {
  const apps::SelfTest test = apps::self_test();
  CHECK(test.databases == 0xd045e35dc9bd771bU);
  CHECK(test.pictures == 0xc77b1f6f7407a4a1U);
}

}  // namespace dmpc::tests::self_test_test
