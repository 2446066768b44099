#include "dataflow/rays/buffered_rays.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace buffered_rays_test {

using namespace dmpc;
using dataflow::BufferedRays;

namespace {

dataflow::RayMessage ray(std::uint32_t pixel) {
  dataflow::RayMessage message;
  message.ray.pixel = pixel;
  return message;
}

}  // namespace

TEST_CASE("the host keeps rays by owner and gives the newest back first") {
  BufferedRays kept(3);
  CHECK(kept.size() == 0);
  kept.put(0, ray(1));
  kept.put(2, ray(2));
  kept.put(0, ray(3));
  CHECK(kept.count(0) == 2);
  CHECK(kept.count(1) == 0);
  CHECK(kept.take(0).ray.pixel == 3);
  kept.put(0, ray(4));
  CHECK(kept.take(0).ray.pixel == 4);
  CHECK(kept.take(0).ray.pixel == 1);
  CHECK(kept.take(2).ray.pixel == 2);
  CHECK(kept.size() == 0);
  CHECK(kept.high_water() == 3);
}

TEST_CASE("the host has no ray that it was not given") {
  BufferedRays kept(2);
  kept.put(1, ray(1));
  CHECK_THROWS_AS(kept.take(0), core::InternalError);
  CHECK_THROWS(kept.put(2, ray(1)));
}

TEST_CASE("the places of buffered rays are counted in bytes, which never get fewer") {
  BufferedRays kept(1);
  CHECK(kept.store_bytes() == 0);
  for (std::uint32_t i = 0; i < 100; ++i) {
    kept.put(0, ray(i));
  }
  const std::size_t bytes = kept.store_bytes();
  CHECK(bytes >= 100 * dataflow::ray_message_bytes(0));
  CHECK(bytes <= 2 * 100 * (dataflow::ray_message_bytes(0) + 8));
  for (std::uint32_t i = 0; i < 100; ++i) {
    kept.take(0);
  }
  CHECK(kept.store_bytes() == bytes);
  kept.put(0, ray(1));
  CHECK(kept.store_bytes() == bytes);
}

TEST_CASE("the host keeps as many rays as come") {
  BufferedRays kept(2);
  for (std::uint32_t i = 0; i < 10000; ++i) {
    kept.put(i % 2, ray(i));
  }
  for (std::uint32_t i = 10000; i > 0; --i) {
    CHECK(kept.take((i - 1) % 2).ray.pixel == i - 1);
  }
}

}  // namespace buffered_rays_test
