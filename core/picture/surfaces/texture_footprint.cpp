#include "core/picture/surfaces/texture_footprint.h"

#include <algorithm>
#include <cmath>

namespace dmpc::core {
namespace {

/// The maximum footprint: far beyond the coarsest level, and small enough for coordinates to keep their precision.
constexpr double texels_max = 0x1p24;

/// By columns: the images of the ends of two perpendicular diameters.
struct Matrix {
  double a = 0, b = 0, c = 0, d = 0;  ///< (a, c) and (b, d) are its columns
};

/// The image of the unit circle under a matrix.
struct Ellipse {
  TexturePlace direction{1, 0};  ///< the longer axis, unit length
  double longer = 0, shorter = 0;
};

/// By the eigenvectors of the matrix times its transpose.
Ellipse ellipse_of(const Matrix& m) {
  const double first = m.a * m.a + m.b * m.b, second = m.c * m.c + m.d * m.d, mixed = m.a * m.c + m.b * m.d;
  const double half_difference = (first - second) / 2, root = std::sqrt(half_difference * half_difference + mixed * mixed);
  Ellipse ellipse;
  ellipse.longer = std::sqrt((first + second) / 2 + root);
  if (ellipse.longer > 0) {
    ellipse.shorter = std::min(std::fabs(m.a * m.d - m.b * m.c) / ellipse.longer, ellipse.longer);
  }
  const TexturePlace along =
      first >= second ? TexturePlace{half_difference + root, mixed} : TexturePlace{mixed, root - half_difference};
  const double size = std::sqrt(along.s * along.s + along.t * along.t);
  if (size > 0) {  // not a circle
    ellipse.direction = {along.s / size, along.t / size};
  }
  return ellipse;
}

/// Clips a line about `middle` to the part between the two ends of `extent`, in lengths of the line.
void cut(double middle, double length, const std::array<double, 2>& extent, double& from, double& to) {
  if (length == 0) {
    return;
  }
  const double one = (extent[0] - middle) / length, other = (extent[1] - middle) / length;
  from = std::max(from, std::min(std::min(one, other), 0.0));
  to = std::min(to, std::max(std::max(one, other), 0.0));
}

/// The extent of a triangle's corners along one side of the texture.
std::array<double, 2> extent_of(const TexturedNormals& triangle, std::size_t side) {
  const auto [low, high] = std::minmax({triangle.place[0][side], triangle.place[1][side], triangle.place[2][side]});
  return {double{low}, double{high}};
}

/// Texels along a diameter of the ellipse, for a side of `size` texels.
double texels_along(const TexturedNormals& triangle, const std::array<float, 2>& axis, std::size_t side, double size) {
  const auto& place = triangle.place;
  const double along1 = double{place[1][side]} - double{place[0][side]}, along2 = double{place[2][side]} - double{place[0][side]};
  return (along1 * double{axis[0]} + along2 * double{axis[1]}) * size;
}

/// In texels of the finest level.
Ellipse covered_by(const TexturedNormals& triangle, const CutEllipse& cut, double cone_width) {
  const double columns = triangle.texture.width * cone_width, rows = triangle.texture.height * cone_width;
  Ellipse ellipse = ellipse_of({.a = texels_along(triangle, cut.axis[0], 0, columns),
                                .b = texels_along(triangle, cut.axis[1], 0, columns),
                                .c = texels_along(triangle, cut.axis[0], 1, rows),
                                .d = texels_along(triangle, cut.axis[1], 1, rows)});
  ellipse.longer = std::min(ellipse.longer, texels_max);
  ellipse.shorter = std::min(ellipse.shorter, texels_max);
  return ellipse;
}

TexturePlace place_on(const TexturedNormals& triangle, double u, double v) {
  const std::array<double, 3> weight{1.0 - u - v, u, v};
  TexturePlace place;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    place.s += weight[corner] * double{triangle.place[corner][0]};
    place.t += weight[corner] * double{triangle.place[corner][1]};
  }
  return place;
}

}  // namespace

TextureFootprint footprint_of(const TexturedNormals& triangle, double u, double v, const CutEllipse& ellipse, double cone_width) {
  const Ellipse covered = covered_by(triangle, ellipse, cone_width);
  const TexturePlace place = place_on(triangle, u, v);
  // From the middle of the first to that of the last probe, about the hit, clipped to the triangle's rectangle.
  const double probe = std::max(covered.shorter, 1.0), between = std::max(covered.longer - probe, 0.0);
  const TexturePlace texel{covered.direction.s / triangle.texture.width, covered.direction.t / triangle.texture.height};
  const TexturePlace line{texel.s * between, texel.t * between};
  double from = -0.5, to = 0.5;
  cut(place.s, line.s, extent_of(triangle, 0), from, to);
  cut(place.t, line.t, extent_of(triangle, 1), from, to);
  const double middle = (from + to) / 2, length = between * (to - from) + probe, stride = std::max(probe, length / probes_max);
  return {.middle = {place.s + line.s * middle, place.t + line.t * middle},
          .stride = {texel.s * stride, texel.t * stride},
          .width = stride > probe ? stride : covered.shorter,
          .strides = std::clamp(length / stride, 1.0, probes_max)};
}

}  // namespace dmpc::core
