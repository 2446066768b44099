// Teapot: M. Newell's teapot of 32 bicubic Bezier patches (1975) on a checkerboard.
#include <array>
#include <cmath>
#include <cstdint>
#include <locale>
#include <sstream>
#include <vector>

#include "core/base/expect.h"
#include "core/families/families.h"

namespace dmpc::core {
extern const char* const teapot_file;  // defined in a source that CMake generates from teapot.txt
}

namespace dmpc::core::scenes {
namespace {

/// Indices of a Bezier patch into points: 4 r + c is row r along s, column c along t.
using TeapotPatch = std::array<std::uint16_t, 16>;

/// Public domain: measured by Martin Newell at the University of Utah, 1975. z up, the foot at z = 0, the lid's tip at z = 3.15.
/// Patches: 4 of the rim, 8 of the body, 4 of the handle, 4 of the spout, 8 of the lid, 4 of the (added) bottom.
struct Teapot {
  std::array<Vec3d, 290> points;
  std::array<TeapotPatch, 32> patches;
};

Teapot read_teapot() {
  Teapot teapot;
  std::istringstream text(teapot_file);
  text.imbue(std::locale::classic());
  for (Vec3d& point : teapot.points) {
    text >> point.x >> point.y >> point.z;
  }
  for (TeapotPatch& patch : teapot.patches) {
    for (std::uint16_t& index : patch) {
      text >> index;
      expect(index < teapot.points.size(), "a teapot's patch has its points");
    }
  }
  expect(!text.fail() && (text >> std::ws).eof(), "a teapot has so many numbers");
  return teapot;
}

const Teapot& teapot() {
  static const Teapot only = read_teapot();
  return only;
}

using Weights = std::array<double, 4>;

Weights bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}

Weights bernstein_derivative(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t};
}

Vec3d blend(const TeapotPatch& patch, const Weights& rows, const Weights& columns) {
  const auto& points = teapot().points;
  Vec3d sum;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      sum = sum + rows[r] * columns[c] * points[patch[4 * r + c]];
    }
  }
  return sum;
}

struct Corner {
  Vec3d point, normal;
  bool is_cusp = false;  ///< on the axis: the lid's tip or the bottom's centre, where a patch has no normal of its own
};

Corner corner_at(const TeapotPatch& patch, double s, double t) {
  const Vec3d point = blend(patch, bernstein(s), bernstein(t));
  if (std::abs(point.x) < 1e-4 && std::abs(point.y) < 1e-4) {
    return {point, {0, 0, point.z > 1.5 ? 1.0 : -1.0}, true};
  }
  const Vec3d along_s = blend(patch, bernstein_derivative(s), bernstein(t));
  const Vec3d along_t = blend(patch, bernstein(s), bernstein_derivative(t));
  return {point, normalize(cross(along_t, along_s)), false};
}

/// Omits a triangle with two corners at a cusp, which has no area.
void add_triangle(const Corner& a, const Corner& b, const Corner& c, SceneSink& sink) {
  if (int{a.is_cusp} + int{b.is_cusp} + int{c.is_cusp} < 2) {
    sink.patch({a.point, b.point, c.point}, {a.normal, b.normal, c.normal});
  }
}

void add_patch(const TeapotPatch& patch, int size, SceneSink& sink) {
  const auto side = static_cast<std::size_t>(size) + 1;
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      corners.push_back(corner_at(patch, static_cast<double>(i) / size, static_cast<double>(j) / size));
    }
  }
  for (std::size_t i = 0; i + 1 < side; ++i) {
    for (std::size_t j = 0; j + 1 < side; ++j) {
      const Corner* row = &corners[i * side + j];
      add_triangle(row[0], row[1], row[side + 1], sink);
      add_triangle(row[side + 1], row[side], row[0], sink);
    }
  }
}

void add_squares(int size, int parity, SceneSink& sink) {
  const auto place = [size](int i) { return -4 + 8.0 * i / size; };
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      if ((i + j) % 2 == parity) {
        const double x0 = place(i), x1 = place(i + 1), y0 = place(j), y1 = place(j + 1);
        sink.polygon({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
      }
    }
  }
}

}  // namespace

void make_teapot(int size, SceneSink& sink) {
  set_stage(sink, {.from = {4.86, 7.2, 5.4}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 1},
            {{-3.1, 9.8, 12.1}, {11.3, 5.1, 8.8}});
  sink.material({.color = {1, 1, 1}, .diffuse = 0.5, .specular = 0.5, .shine = 4.81884, .refraction_index = 0});
  add_squares(size, 1, sink);
  sink.material({.color = {0.5, 0.5, 0.5}, .diffuse = 0.5, .specular = 0.5, .shine = 4.81884, .refraction_index = 0});
  add_squares(size, 0, sink);
  sink.material({.color = {1, 0.5, 0.1}, .diffuse = 0.75, .specular = 0.25, .shine = soft_highlight, .refraction_index = 0});
  for (const TeapotPatch& patch : teapot().patches) {
    add_patch(patch, size, sink);
  }
}

}  // namespace dmpc::core::scenes
