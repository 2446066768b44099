#include "nodes/size_text.h"

#include <doctest/doctest.h>

#include "core/base/units.h"

namespace dmpc::tests::size_text_test {

using core::operator""_KiB;
using core::operator""_MiB;

TEST_CASE("sizes are written exactly, in the largest unit that divides them") {
  CHECK(nodes::size_text(0) == "0B");
  CHECK(nodes::size_text(1000) == "1000B");
  CHECK(nodes::size_text(300_KiB) == "300KiB");
  CHECK(nodes::size_text(4_MiB) == "4MiB");
  CHECK(nodes::size_text(4_MiB + 1) == "4194305B");
  CHECK(nodes::size_text(2048_MiB) == "2GiB");
}

}  // namespace dmpc::tests::size_text_test
