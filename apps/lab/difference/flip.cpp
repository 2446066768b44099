#include "apps/lab/difference/picture_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Color = std::array<double, 3>;
using Plane = std::vector<double>;

/// Linear sRGB to XYZ of a white at (1, 1, 1) under D65, and that white.
constexpr std::array<Color, 3> to_xyz = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                          {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                          {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};
constexpr std::array<Color, 3> to_rgb = {{{3.241003275, -1.537398934, -0.498615861},
                                          {-0.969224334, 1.875930071, 0.041554224},
                                          {0.055639423, -0.204011202, 1.057148933}}};

constexpr Color times(const std::array<Color, 3>& matrix, const Color& v) {
  Color product{};
  for (std::size_t row = 0; row < 3; ++row) {
    product[row] = matrix[row][0] * v[0] + matrix[row][1] * v[1] + matrix[row][2] * v[2];
  }
  return product;
}

constexpr Color white = times(to_xyz, {1, 1, 1});

/// Returns the opponent colours, for which the eye's contrast sensitivity is known.
Color ycxcz_of(const Color& rgb) {
  const Color xyz = times(to_xyz, rgb);
  const double x = xyz[0] / white[0], y = xyz[1] / white[1], z = xyz[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color rgb_of(const Color& ycxcz) {
  const double y = (ycxcz[0] + 16) / 116;
  return times(to_rgb, {(y + ycxcz[1] / 500) * white[0], y * white[1], (y - ycxcz[2] / 200) * white[2]});
}

double lab_curve(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

/// Returns L*a*b* with reduced chroma of dark colours, after the Hunt effect.
Color appearance_of(const Color& rgb) {
  const Color xyz = times(to_xyz, rgb);
  const double x = lab_curve(xyz[0] / white[0]), y = lab_curve(xyz[1] / white[1]), z = lab_curve(xyz[2] / white[2]);
  const double lightness = 116 * y - 16, hunt = 0.01 * lightness;
  return {lightness, hunt * 500 * (x - y), hunt * 200 * (y - z)};
}

/// Distance for large differences of colour (Abasi and others 2020), compressed.
double color_distance(const Color& a, const Color& b) {
  return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

/// Maps small differences to most of the range from 0 to 1.
double spread(double distance) {
  static const double most = color_distance(appearance_of({0, 1, 0}), appearance_of({0, 0, 1}));
  constexpr double knee = 0.4, at_knee = 0.95;
  const double low = knee * most;
  return distance < low ? at_knee * distance / low : at_knee + (distance - low) / (most - low) * (1 - at_knee);
}

/// An odd number of weights, the middle one for the pixel itself.
using Kernel = std::vector<double>;

/// Returns weight(x) for every pixel's distance x up to `radius`.
template <class Weight>
Kernel kernel_of(int radius, const Weight& weight) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) {
    kernel.push_back(weight(static_cast<double>(x)));
  }
  return kernel;
}

/// Scales positive weights to sum to 1, and negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double weight : kernel) {
    (weight > 0 ? positive : negative) += std::abs(weight);
  }
  for (double& weight : kernel) {
    weight /= weight > 0 ? positive : negative;
  }
  return kernel;
}

/// Filters planes of one size; pixels beyond the border equal those at the border.
class Filter {
 public:
  Filter(int width, int height) : width_(width), height_(height) {}

  Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down) const {
    return pass(pass(plane, across, true), down, false);
  }

 private:
  Plane pass(const Plane& plane, const Kernel& kernel, bool is_across) const {
    const int radius = static_cast<int>(kernel.size() / 2), last = (is_across ? width_ : height_) - 1;
    Plane result(plane.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        double sum = 0;
        for (int step = -radius; step <= radius; ++step) {
          const int at = std::clamp((is_across ? x : y) + step, 0, last);
          sum += kernel[static_cast<std::size_t>(step + radius)] * plane[is_across ? index(at, y) : index(x, at)];
        }
        result[index(x, y)] = sum;
      }
    }
    return result;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_, height_;
};

/// The eye's contrast sensitivity for one opponent colour: two Gaussians, a sqrt(pi / b) exp(-pi^2 x^2 / b) with x in degrees.
struct Sharpness {
  double a_1, b_1, a_2, b_2;
};
constexpr std::array<Sharpness, 3> sharpness = {{{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};

Kernel gaussian(double b, int radius, double pixels_per_degree) {
  return kernel_of(radius, [&](double x) {
    const double degrees = x / pixels_per_degree;
    return std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / b);
  });
}

double sum_of(const Kernel& kernel) { return std::accumulate(kernel.begin(), kernel.end(), 0.0); }

/// Returns the plane as the eye sees it: the weights of both Gaussians together sum to 1 over the plane of pixels.
Plane blurred(const Plane& plane, const Sharpness& eye, const Filter& filter, double pixels_per_degree) {
  const double widest = 0.04 / (2 * std::numbers::pi * std::numbers::pi);
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest) * pixels_per_degree));
  const Kernel first = gaussian(eye.b_1, radius, pixels_per_degree), second = gaussian(eye.b_2, radius, pixels_per_degree);
  const double weight_1 = eye.a_1 * std::sqrt(std::numbers::pi / eye.b_1),
               weight_2 = eye.a_2 * std::sqrt(std::numbers::pi / eye.b_2);
  const double whole = weight_1 * sum_of(first) * sum_of(first) + weight_2 * sum_of(second) * sum_of(second);
  Plane result = filter.filtered(plane, first, first);
  for (double& value : result) {
    value *= weight_1 / whole;
  }
  if (weight_2 > 0) {
    const Plane more = filter.filtered(plane, second, second);
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] += weight_2 / whole * more[i];
    }
  }
  return result;
}

/// Returns the three opponent planes of a picture.
std::array<Plane, 3> planes_of(const Image& image) {
  std::array<Plane, 3> planes;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    Color rgb{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double value = image.rgb[i + channel];
      rgb[channel] = std::isnan(value) ? 0 : std::clamp(value, 0.0, 1.0);
    }
    const Color opponent = ycxcz_of(rgb);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      planes[channel].push_back(opponent[channel]);
    }
  }
  return planes;
}

/// Returns a picture's colours as seen from afar.
std::vector<Color> seen_colors(const std::array<Plane, 3>& planes, const Filter& filter, double pixels_per_degree) {
  std::array<Plane, 3> seen;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    seen[channel] = blurred(planes[channel], sharpness[channel], filter, pixels_per_degree);
  }
  std::vector<Color> colors;
  for (std::size_t i = 0; i < seen[0].size(); ++i) {
    Color rgb = rgb_of({seen[0][i], seen[1][i], seen[2][i]});
    for (double& value : rgb) {
      value = std::clamp(value, 0.0, 1.0);
    }
    colors.push_back(appearance_of(rgb));
  }
  return colors;
}

/// Returns how strongly every pixel is part of an edge, or of a point.
Plane features(const Plane& lightness, const Filter& filter, const Kernel& detecting, const Kernel& smoothing) {
  const Plane across = filter.filtered(lightness, detecting, smoothing), down = filter.filtered(lightness, smoothing, detecting);
  Plane strength(lightness.size());
  for (std::size_t i = 0; i < strength.size(); ++i) {
    strength[i] = std::hypot(across[i], down[i]);
  }
  return strength;
}

/// Returns the larger of the differences in edges and in points (the paper, section 4.2).
Plane feature_differences(Plane picture, Plane reference, const Filter& filter, double pixels_per_degree) {
  for (Plane* plane : {&picture, &reference}) {
    for (double& value : *plane) {
      value = (value + 16) / 116;
    }
  }
  const double deviation = 0.5 * 0.082 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto bell = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  const Kernel smoothing = balanced(kernel_of(radius, bell));
  const Kernel edge = balanced(kernel_of(radius, [&](double x) { return -x * bell(x); }));
  const Kernel point = balanced(kernel_of(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * bell(x); }));
  Plane difference(picture.size(), 0);
  for (const Kernel* detecting : {&edge, &point}) {
    const Plane a = features(picture, filter, *detecting, smoothing), b = features(reference, filter, *detecting, smoothing);
    for (std::size_t i = 0; i < difference.size(); ++i) {
      difference[i] = std::max(difference[i], std::abs(a[i] - b[i]));
    }
  }
  return difference;
}

}  // namespace

std::vector<float> flip(const Image& picture, const Image& reference, double pixels_per_degree) {
  core::expect(picture.width == reference.width && picture.height == reference.height, "pictures of one size are compared");
  const Filter filter(picture.width, picture.height);
  const std::array<Plane, 3> planes_a = planes_of(picture), planes_b = planes_of(reference);
  const std::vector<Color> a = seen_colors(planes_a, filter, pixels_per_degree),
                           b = seen_colors(planes_b, filter, pixels_per_degree);
  const Plane features_apart = feature_differences(planes_a[0], planes_b[0], filter, pixels_per_degree);
  std::vector<float> result(a.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double feature = std::sqrt(features_apart[i] / std::numbers::sqrt2);
    result[i] = static_cast<float>(std::pow(spread(color_distance(a[i], b[i])), 1 - feature));
  }
  return result;
}

}  // namespace dmpc::apps
