#include "core/picture/sampling/sample_pass.h"

#include <doctest/doctest.h>

namespace sample_pass_test {

using namespace dmpc::core;

TEST_CASE("a mask has the pixels that were added, or all, and none beyond") {
  PixelMask none(70), all(70, true);
  CHECK(none.count() == 0);
  CHECK(all.count() == 70);
  none.add(69);
  none.add(69);
  CHECK(none.has(69));
  CHECK_FALSE(none.has(68));
  CHECK(none.count() == 1);
}

TEST_CASE("a step brings the samples between two levels, each of which has twice those of the one below") {
  CHECK(SampleStep::first().samples(3) == SampleRange{0, 3});
  CHECK(SampleStep(1, 2).samples(2) == SampleRange{2, 2});
  CHECK(SampleStep(2, 4).samples(2) == SampleRange{4, 12});
  CHECK(SampleStep(14, 15).samples(2) == SampleRange{16384, 16384});
  CHECK(SampleStep(3, 3).is_none());
  CHECK(SampleStep(3, 3).samples(2).count == 0);
  CHECK(SampleStep(4, 3).samples(2).count == 0);
  CHECK(SampleStep().is_none());
}

TEST_CASE("a step is its bits") {
  for (std::uint32_t bits = 0; bits < 256; ++bits) {
    CHECK(SampleStep::of_bits(static_cast<std::uint8_t>(bits)).bits() == bits);
  }
}

TEST_CASE("the first pass has all pixels, a later one those whose steps bring samples") {
  Pass pass(5, 2);
  CHECK(pass.pixel_count() == 5);
  CHECK(pass.samples_end() == 2);
  CHECK(pass.is_first());
  CHECK(pass.pixels() == PixelMask(5, true));
  for (SampleStep& step : pass.steps()) {
    step = {1, 1};
  }
  CHECK(pass.samples_end() == 0);
  CHECK_FALSE(pass.is_first());
  pass.steps()[3] = {1, 3};
  CHECK(pass.pixel_count() == 1);
  CHECK(pass.samples(3) == SampleRange{2, 6});
  CHECK(pass.samples_end() == 8);
  CHECK(pass.has(3));
  CHECK_FALSE(pass.has(2));
}

}  // namespace sample_pass_test
