#include "apps/formats/landscape/grove.h"

#include <algorithm>
#include <cstdint>

#include "apps/formats/landscape/chance.h"
#include "apps/formats/landscape/terrain.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Trees grow from here up to there, where the ground is no steeper than its normal's y says.
constexpr double shore = lake_height + 0.004, tree_line = 0.22, upright_least = 0.6;
constexpr double height_max = 0.03;
/// Nothing stands so near to the camera, which sees over the lake.
constexpr double clearing = 0.05, camera_x = -0.12, camera_z = 0.52;

bool is_clear(double x, double z) {
  return (x - camera_x) * (x - camera_x) + (z - camera_z) * (z - camera_z) > clearing * clearing;
}

/// `t` is the tangent of a quarter of the angle: from -1 to 1 for all that there are.
std::array<float, 4> turn_about_y(double t) {
  const double whole = 1 + t * t;
  return {0, static_cast<float>(2 * t / whole), 0, static_cast<float>((1 - t * t) / whole)};
}

}  // namespace

Grove grove(int size) {
  core::expect(size >= 1 && size <= 12, "a grove has a size from 1 to 12");
  Grove result;
  for (std::size_t kind = 0; kind < tree_kinds; ++kind) {
    result.trees[kind] = tree(kind);
  }
  const std::uint32_t rows = 1U << static_cast<unsigned>(size), columns = 2 * rows;
  const double step = 1.0 / rows;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      Chance chance((std::uint64_t{row} << 32U) + column);
      const double x = (column + 0.1 + 0.8 * chance.share()) * step - 1, z = (row + 0.1 + 0.8 * chance.share()) * step - 0.5;
      const double ground = ground_height(x, z);
      if (ground < shore || ground > tree_line || ground_normal(x, z, step / 4).y < upright_least || !is_clear(x, z)) {
        continue;
      }
      TreePlaces& places = result.places[static_cast<std::size_t>(chance.share() * tree_kinds)];
      const auto height = static_cast<float>(std::min(1.6 * step, height_max) * (0.6 + 0.6 * chance.share()));
      places.translations.push_back({static_cast<float>(x), static_cast<float>(ground), static_cast<float>(z)});
      places.rotations.push_back(turn_about_y(chance.signed_share()));
      places.scales.push_back({height, height, height});
    }
  }
  return result;
}

}  // namespace dmpc::apps
