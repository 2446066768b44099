#include "apps/frontend/picture/color_map.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <doctest/doctest.h>

#include <array>
#include <cstddef>

namespace dmpc::tests::modules_color_map_test {

TEST_CASE("the colours are those of OpenImageIO's map of that name") {
  constexpr int steps = 400;
  const auto at = [](int step) { return static_cast<double>(step) / steps; };
  OIIO::ImageBuf positions(OIIO::ImageSpec(steps + 1, 1, 1, OIIO::TypeDesc::FLOAT));
  for (int i = 0; i <= steps; ++i) {
    const auto position = static_cast<float>(at(i));
    positions.setpixel(i, 0, OIIO::cspan<float>(&position, 1));
  }
  const OIIO::ImageBuf theirs = OIIO::ImageBufAlgo::color_map(positions, 0, "inferno", {}, 1);
  for (int i = 0; i <= steps; ++i) {
    std::array<float, 3> color{};
    theirs.getpixel(i, 0, color.data(), 3);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      CHECK(apps::color_map(at(i))[channel] == doctest::Approx(double{color[channel]}).epsilon(1e-5));
    }
  }
}

}  // namespace dmpc::tests::modules_color_map_test
