// Where on a texture a mesh's coordinates lie.
#pragma once

#include <array>

namespace dmpc::apps {

/// An affine map of texture coordinates, t downwards: s' = rows[0] (s, t, 1), t' = rows[1] (s, t, 1).
struct TexturePlace {
  std::array<std::array<double, 3>, 2> rows{{{1, 0, 0}, {0, 1, 0}}};

  bool is_plain() const { return *this == TexturePlace{}; }
  std::array<double, 2> operator()(double s, double t) const {
    return {rows[0][0] * s + rows[0][1] * t + rows[0][2], rows[1][0] * s + rows[1][1] * t + rows[1][2]};
  }
  bool operator==(const TexturePlace&) const = default;
};

}  // namespace dmpc::apps
