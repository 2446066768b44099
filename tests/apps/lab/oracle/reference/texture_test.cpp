#include "apps/lab/oracle/reference/texture.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>

#include "core/picture/hits/hit_geometry.h"
#include "core/picture/surfaces/texture_footprint.h"
#include "tests/support/noise_texture.h"
#include "tests/support/shown_texture.h"

namespace dmpc::tests::reference_texture_test {
namespace {

using core::TextureWrap;
using core::Vec3d;

TEST_CASE("a look-up in double is the one by the records but for rounding, for every format and way to go on beyond an edge") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(-2.5, 3.5), step(-0.1, 0.1), detail(-1, 6), strides(1, core::probes_max);
  for (const core::TexelFormat format :
       {core::TexelFormat::srgb, core::TexelFormat::shared_exponent, core::TexelFormat::fine_srgb}) {
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
      ShownTexture shown(noise_texture(37, 20, wrap, wrap, format));
      for (int i = 0; i < 200; ++i) {
        const core::TextureFootprint line{
            {place(random), place(random)}, {step(random), step(random)}, std::exp2(detail(random)), strides(random)};
        const Vec3d light =
            apps::texture_sum(shown.texture(),
                              {{line.middle.s, line.middle.t}, {line.stride.s, line.stride.t}, line.width, line.strides})
                .light;
        REQUIRE(length(Vec3d(shown.look_up(line)) - light) <= 1e-4 * (1 + shown.texture().brightest));
      }
    }
  }
}

/// A triangle's record, with the same numbers in double.
struct TwoTriangles {
  apps::ReferencePaint paint;
  core::TexturedNormals textured{.texture = {.width = 40, .height = 70}};
  std::array<float, 9> rows{};

  explicit TwoTriangles(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-1, 1);
    for (std::size_t k = 0; k < 3; ++k) {
      textured.place[k] = {place(random), place(random)};
      paint.place[k] = {textured.place[k][0], textured.place[k][1]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rows[3 * k + axis] = place(random);
        paint.corner[k][axis] = rows[3 * k + axis];
      }
    }
  }
  std::array<std::byte, core::leaf_bytes(core::PrimitiveKind::triangle, 1)> leaf() const {
    std::array<std::byte, core::leaf_bytes(core::PrimitiveKind::triangle, 1)> bytes{};
    const core::LeafHeader header{.kind = core::PrimitiveKind::triangle, .count = 1};
    std::memcpy(bytes.data(), &header, sizeof(header));
    std::memcpy(bytes.data() + sizeof(header), rows.data(), sizeof(rows));
    return bytes;
  }
};

/// A ray in single precision that hits a triangle.
struct Met {
  core::Ray ray;
  core::HitState state;

  Met(const TwoTriangles& triangle, const Vec3d& from, double u, double v) {
    const Vec3d hit = triangle.paint.corner[0] * (1 - u - v) + triangle.paint.corner[1] * u + triangle.paint.corner[2] * v;
    ray.origin = core::Vec3f(hit + from);
    ray.direction = core::Vec3f(normalize(hit - Vec3d(ray.origin)));
    state = core::begin_shading(ray, {.t = 1, .primitive = 0, .lane = 0});
    core::read_geometry(state, triangle.leaf().data());
  }
  Vec3d direction() const { return normalize(Vec3d(ray.direction)); }
  std::array<double, 3> weight() const { return {1 - state.u - state.v, state.u, state.v}; }
};

void check_alike(const core::TextureFootprint& ours, const apps::ReferenceFootprint& theirs) {
  REQUIRE(ours.width == doctest::Approx(theirs.width).epsilon(1e-3));
  REQUIRE(ours.strides == doctest::Approx(theirs.strides).epsilon(1e-3));
  REQUIRE(std::fabs(ours.middle.s - theirs.middle[0]) < 1e-3);
  REQUIRE(std::fabs(ours.middle.t - theirs.middle[1]) < 1e-3);
}

TEST_CASE("a pixel covers in double what it covers by the records but for rounding, wherever it is on the film") {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> share(0, 1), exponent(-12, -2), aside(-3, 3);
  const core::Texture texture = noise_texture(40, 70);
  for (int i = 0; i < 2000; ++i) {
    const TwoTriangles triangle(random);
    const double u = share(random), width = std::exp2(exponent(random));
    const Met met(triangle, {share(random) - 0.5, share(random) - 0.5, share(random) - 0.5}, u, share(random) * (1 - u));
    // A camera that sees the ray at this place of its film, one pixel of which is so wide where the ray hits.
    const Vec3d one = normalize(cross(met.direction(), {0.36, 0.48, 0.8})), other = cross(met.direction(), one);
    const Vec3d forward = normalize(met.direction() + one * aside(random) + other * aside(random));
    const Vec3d column = normalize(cross(forward, {0.6, 0.8, 0})) * width, row = cross(forward, column);
    const core::TextureFootprint ours = core::footprint_of(triangle.textured, met.state.u, met.state.v,
                                                           core::cut_ellipse(met.state, triangle.leaf().data(), forward), width);
    CAPTURE(i);
    check_alike(ours, apps::footprint_of(triangle.paint, texture, met.weight(), met.direction(), {column, row}));
  }
}

TEST_CASE("a cone covers in double what it covers by the records but for rounding") {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> share(0, 1), exponent(-12, 2);
  const core::Texture texture = noise_texture(40, 70);
  for (int i = 0; i < 2000; ++i) {
    const TwoTriangles triangle(random);
    const double u = share(random), v = share(random) * (1 - u), cone = std::exp2(exponent(random));
    const Met met(triangle, {share(random) - 0.5, share(random) - 0.5, share(random) - 0.5}, u, v);
    const core::CutEllipse ellipse = core::cut_ellipse(met.state, triangle.leaf().data(), Vec3d(met.ray.direction));
    CAPTURE(i);
    check_alike(
        core::footprint_of(triangle.textured, met.state.u, met.state.v, ellipse, cone),
        apps::footprint_of(triangle.paint, texture, met.weight(), met.direction(), apps::cone_about(met.direction(), cone)));
  }
}

}  // namespace
}  // namespace dmpc::tests::reference_texture_test
