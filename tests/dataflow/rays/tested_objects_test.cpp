#include "dataflow/rays/tested_objects.h"

#include <doctest/doctest.h>

#include "dataflow/packets.h"

namespace tested_objects_test {

using namespace dmpc;
using dataflow::TestedObjects;

TEST_CASE("a list of tested objects has the newest names, as many as it has room for") {
  TestedObjects list(2);
  CHECK_FALSE(list.has(7));
  list.add(7);
  list.add(8);
  CHECK(list.has(7));
  CHECK(list.has(8));
  list.add(9);
  CHECK_FALSE(list.has(7));
  CHECK(list.names()[0] == 9);
  TestedObjects next(2);
  next.set(list.names());
  CHECK(next.has(8));
}

TEST_CASE("what has no name is on no list, and a list without room stays empty") {
  TestedObjects list(8), none(0);
  list.add(0);
  CHECK_FALSE(list.has(0));
  none.add(5);
  CHECK_FALSE(none.has(5));
  CHECK(none.names() == dataflow::TestedNames{});
}

TEST_CASE("each name on a ray's list lengthens its message by four bytes") {
  CHECK(dataflow::ray_message_bytes(0) == 120);
  CHECK(dataflow::ray_message_bytes(3) == 132);
  CHECK(dataflow::ray_packet_bytes(10, 8) == 8 + 10 * 152);
  CHECK(dataflow::rays_in(dataflow::packet_bytes, 0) == 8);
  CHECK(dataflow::rays_in(dataflow::packet_bytes, 8) == 6);
}

}  // namespace tested_objects_test
