#include "apps/lab/oracle/reference/texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dmpc::apps {
namespace {

using core::TextureWrap;
using core::Vec3d;

/// Maximum number of probes of a look-up; a longer line has wider ones.
constexpr double strides_max = 15;
/// The least cosine between a cone and a surface that is distinguished from 0.
constexpr double cosine_min = 1e-6;

/// IEC 61966-2-1.
double light_of_signal(double signal) { return signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4); }

/// Three channels of 10 bits, 1020 steps along the curve.
Vec3d light_of_steps(std::uint32_t texel) {
  const auto light = [](std::uint32_t step) { return light_of_signal(std::min(step, 1020U) / 1020.0); };
  return {light(texel % 1024), light(texel / 1024 % 1024), light(texel / 1048576 % 1024)};
}

std::array<double, 256> light_of_bytes() {
  std::array<double, 256> light{};
  for (std::uint32_t byte = 0; byte < light.size(); ++byte) {
    light[byte] = light_of_signal(byte / 255.0);
  }
  return light;
}

/// EXT_texture_shared_exponent: three mantissas of 9 bits, an exponent of 5 bits with a bias of 15.
Vec3d light_of_exponent(std::uint32_t texel) {
  const int exponent = static_cast<int>(texel / (1U << 27U)) - 24;
  return Vec3d{static_cast<double>(texel % 512), static_cast<double>(texel / 512 % 512),
               static_cast<double>(texel / 262144 % 512)} *
         std::ldexp(1.0, exponent);
}

ReferenceTexel texel_of(const core::Texture& texture, std::uint32_t texel) {
  static const std::array<double, 256> light = light_of_bytes();
  if (texture.format == core::TexelFormat::fine_srgb) {
    return {light_of_steps(texel), 1};
  }
  if (texture.format == core::TexelFormat::shared_exponent) {
    return {light_of_exponent(texel), 1};
  }
  if (texture.format == core::TexelFormat::linear) {
    return {Vec3d{texel % 256 / 255.0, texel / 256 % 256 / 255.0, texel / 65536 % 256 / 255.0}, 1};
  }
  const double alpha = texture.format == core::TexelFormat::srgb_alpha ? texel / (1U << 24U) / 255.0 : 1;
  return ReferenceTexel{Vec3d{light[texel % 256], light[texel / 256 % 256], light[texel / 65536 % 256]} * alpha, alpha};
}

/// Returns the index of the texel at `place`, in texels, on or beyond the texture.
std::size_t texel_at(double place, std::uint32_t size, TextureWrap wrap) {
  const double period = size;
  if (wrap == TextureWrap::clamp) {
    return static_cast<std::size_t>(std::clamp(place, 0.0, period - 1));
  }
  const double turn = std::floor(place / period), within = std::clamp(place - turn * period, 0.0, period - 1);
  const bool is_turned = wrap == TextureWrap::mirror && std::fmod(turn, 2.0) != 0;
  return static_cast<std::size_t>(is_turned ? period - 1 - within : within);
}

/// Interpolates between the four texels about a point.
ReferenceTexel blend(const core::Texture& texture, const core::TextureLevel& level, const ReferencePlace& place) {
  const double x = place[0] * level.width - 0.5, y = place[1] * level.height - 0.5;
  ReferenceTexel sum;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 2; ++column) {
      const double left = std::floor(x) + column, top = std::floor(y) + row;
      const std::size_t index =
          texel_at(top, level.height, texture.wrap_t) * level.width + texel_at(left, level.width, texture.wrap_s);
      sum = sum + texel_of(texture, level.texels[index]) * ((1 - std::fabs(x - left)) * (1 - std::fabs(y - top)));
    }
  }
  return sum;
}

/// Interpolates between the two levels whose texels are next in size to `width` of the finest level's.
ReferenceTexel probe(const core::Texture& texture, double width, const ReferencePlace& place) {
  const double coarsest = static_cast<double>(texture.levels.size()) - 1;
  const double detail = std::clamp(std::log2(std::max(width, 1.0)), 0.0, coarsest), level = std::floor(detail);
  const auto finer = static_cast<std::size_t>(level);
  const ReferenceTexel fine = blend(texture, texture.levels[finer], place);
  return detail > level ? fine * (1 - (detail - level)) + blend(texture, texture.levels[finer + 1], place) * (detail - level)
                        : fine;
}

/// The longer axis of a cone's ellipse on the texture, in texels from its middle.
struct Axes {
  double angle = 0;  ///< angle of the longer axis on the texture
  double longer = 0, shorter = 0;
};

/// Returns the singular values of the matrix with the columns (a, c) and (b, d), from the sum of a similarity and a reflected
/// one.
Axes axes_of(double a, double b, double c, double d) {
  const double similar = std::hypot(a + d, c - b) / 2, reflected = std::hypot(a - d, c + b) / 2;
  const double one = std::atan2(c - b, a + d), other = std::atan2(c + b, a - d);
  return {(one + other) / 2, similar + reflected, std::fabs(similar - reflected)};
}

/// Returns how far from `middle` one may go by steps of `length`, at most `reach` of them, until `low` or `high`.
double reach_to(double middle, double length, double low, double high, double reach) {
  if (length == 0) {
    return reach;
  }
  const double border = (length > 0) == (reach > 0) ? high : low, steps = (border - middle) / length;
  return reach > 0 ? std::clamp(steps, 0.0, reach) : std::clamp(steps, reach, 0.0);
}

/// Returns the change of (s, t) over a step from the ray to one beside it; the triangle's plane is then searched along that ray.
ReferencePlace change_over(const ReferencePaint& paint, const Vec3d& aside, const Vec3d& direction) {
  const Vec3d normal = cross(paint.corner[1] - paint.corner[0], paint.corner[2] - paint.corner[0]);
  const double approach = dot(direction, normal), least = cosine_min * length(normal);
  const double height = dot(aside, normal) / (std::fabs(approach) < least ? std::copysign(least, approach) : approach);
  const Vec3d step = aside - direction * height;
  ReferencePlace change{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d opposite = paint.corner[(k + 2) % 3] - paint.corner[(k + 1) % 3];
    const double share = dot(cross(normal, opposite), step) / dot(normal, normal);
    change[0] += share * paint.place[k][0];
    change[1] += share * paint.place[k][1];
  }
  return change;
}

}  // namespace

ReferenceReach cone_about(const Vec3d& direction, double width) {
  const Vec3d aside = std::fabs(direction.x) < std::fabs(direction.y) ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d one = normalize(cross(direction, aside));
  return {one * width, cross(direction, one) * width};
}

ReferenceFootprint footprint_of(const ReferencePaint& paint, const core::Texture& texture, const std::array<double, 3>& weight,
                                const Vec3d& direction, const ReferenceReach& reach) {
  ReferenceFootprint footprint;
  for (std::size_t k = 0; k < 3; ++k) {
    footprint.middle[0] += weight[k] * paint.place[k][0];
    footprint.middle[1] += weight[k] * paint.place[k][1];
  }
  if (reach == ReferenceReach{}) {
    return footprint;
  }
  const ReferencePlace one = change_over(paint, reach[0], direction), other = change_over(paint, reach[1], direction);
  const double columns = texture.levels[0].width, rows = texture.levels[0].height;
  const Axes axes = axes_of(one[0] * columns, other[0] * columns, one[1] * rows, other[1] * rows);
  const double texel = std::max(axes.shorter, 1.0), between = std::max(axes.longer - texel, 0.0);
  const ReferencePlace step{std::cos(axes.angle) / columns, std::sin(axes.angle) / rows};
  double from = -between / 2, to = between / 2;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto [low, high] = std::minmax({paint.place[0][side], paint.place[1][side], paint.place[2][side]});
    from = reach_to(footprint.middle[side], step[side], low, high, from);
    to = reach_to(footprint.middle[side], step[side], low, high, to);
  }
  const double all = to - from + texel, stride = std::max(texel, all / strides_max);
  for (std::size_t side = 0; side < 2; ++side) {
    footprint.middle[side] += step[side] * (from + to) / 2;
    footprint.stride[side] = step[side] * stride;
  }
  footprint.width = stride > texel ? stride : axes.shorter;
  footprint.strides = all / stride;
  return footprint;
}

/// Probes lie one stride apart from the middle outwards; a shorter rest at the ends counts in proportion, with its outer edge at
/// the end.
ReferenceTexel texture_sum(const core::Texture& texture, const ReferenceFootprint& footprint) {
  const auto at = [&](double offset) {
    return probe(texture, footprint.width,
                 {footprint.middle[0] + footprint.stride[0] * offset, footprint.middle[1] + footprint.stride[1] * offset});
  };
  ReferenceTexel sum = at(0);
  const double half = footprint.strides / 2;
  for (double begin = 0.5; begin < half; begin += 1) {
    const double end = std::min(begin + 1, half);
    sum = sum + (at(end - 0.5) + at(0.5 - end)) * (end - begin);
  }
  return sum * (1 / footprint.strides);
}

}  // namespace dmpc::apps
