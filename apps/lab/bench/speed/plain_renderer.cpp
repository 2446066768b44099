#include "apps/lab/bench/speed/plain_renderer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "apps/edge/line/number_text.h"
#include "apps/lab/bench/speed/crew.h"
#include "apps/lab/bench/speed/plain_stage.h"
#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::apps {

namespace {

using core::Color;
using core::Vec3d;
using core::Vec3f;

Vec3f mirrored(const Vec3f& direction, const Vec3f& normal) { return direction - normal * (2 * dot(direction, normal)); }

Color highlight_of(const PlainMaterial& material, float lobe) {
  return material.is_glossy() ? material.highlight * std::pow(std::clamp(lobe, 0.0F, 1.0F), material.shine) : Color{};
}

}  // namespace

/// One thread at work.
class PlainRenderer::Painter {
 public:
  explicit Painter(const PlainStage& stage) : stage_(stage) { embree::start(context_); }

  Color light_along(const Vec3f& origin, const Vec3f& direction, int depth) {
    ++rays_;
    RTCRayHit asked;
    asked.ray = embree::ray_of(origin, direction, std::numeric_limits<float>::infinity());
    asked.hit.geomID = asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(stage_.tree().library(), stage_.tree().scene(), context_, asked);
    if (asked.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
      return stage_.settings().header.background;
    }
    const PlainSurface surface = stage_.is_triangle(asked.hit.geomID)
                                     ? triangle_at(asked, origin, direction)
                                     : stage_.curved_at(asked.hit.primID, origin, direction, asked.ray.tfar);
    Color light = direct_light(surface, direction);
    if (depth < stage_.settings().shade.depth_max) {
      light = light + passed_on(surface, direction, depth);
    }
    return light;
  }

  std::uint64_t rays() const { return rays_; }

 private:
  PlainSurface triangle_at(const RTCRayHit& asked, const Vec3f& origin, const Vec3f& direction) const {
    PlainSurface surface;
    surface.point = origin + direction * asked.ray.tfar;
    surface.geometric_normal = normalize(Vec3f{asked.hit.Ng_x, asked.hit.Ng_y, asked.hit.Ng_z});
    surface.is_leaving = dot(direction, surface.geometric_normal) > 0;
    surface.normal = surface.is_leaving ? -surface.geometric_normal : surface.geometric_normal;
    if (const core::PatchNormals* const normals = stage_.normals_of(asked.hit.primID)) {
      surface.material = normals->material();
      blend(surface, *normals, asked.hit.u, asked.hit.v);
    } else {
      surface.material = stage_.flat_material_of(asked.hit.primID);
    }
    return surface;
  }

  /// Vertex normals.
  static void blend(PlainSurface& surface, const core::PatchNormals& normals, float u, float v) {
    const Vec3f blended = normals.normal[0] * (1 - u - v) + normals.normal[1] * u + normals.normal[2] * v;
    const float square = dot(blended, blended);
    if (square > 0) {
      surface.normal = blended * ((dot(blended, surface.normal) < 0 ? -1.0F : 1.0F) / std::sqrt(square));
    }
  }

  /// Beside the surface, on the side that a ray goes to.
  static Vec3f start_of(const PlainSurface& surface, const Vec3f& towards) {
    const float side = dot(towards, surface.geometric_normal) < 0 ? -plain_offset : plain_offset;
    return surface.point + surface.geometric_normal * side;
  }

  Color direct_light(const PlainSurface& surface, const Vec3f& direction) {
    const PlainMaterial& material = stage_.materials()[surface.material];
    Color sum = material.emission + stage_.settings().header.ambient * (material.color * material.diffuse);
    const Vec3f mirror = mirrored(direction, surface.normal);
    for (const core::LightRecord& light : stage_.lights()) {
      const Vec3f towards = light.position - surface.point;
      const float cosine = dot(towards, surface.normal);
      if (!(cosine > 0)) {
        continue;
      }
      const float scale = 1 / length(towards);
      const Color brought = light.intensity * (material.color * (material.diffuse * cosine * scale) +
                                               highlight_of(material, dot(mirror, towards) * scale));
      if (!(brought == Color{}) && !is_blocked(start_of(surface, towards), light.position)) {
        sum = sum + brought;
      }
    }
    return sum;
  }

  bool is_blocked(const Vec3f& start, const Vec3f& light) {
    ++rays_;
    RTCRay ray = embree::ray_of(start, light - start, plain_light_end);
    embree::occlude(stage_.tree().library(), stage_.tree().scene(), context_, ray);
    return ray.tfar < 0;
  }

  /// What comes by reflection and refraction.
  Color passed_on(const PlainSurface& surface, const Vec3f& direction, int depth) {
    const PlainMaterial& material = stage_.materials()[surface.material];
    const float inside = material.inside_index();
    const float index = surface.is_leaving ? inside : 1 / inside, cosine = -dot(direction, surface.normal);
    const float behind = 1 - index * index * (1 - cosine * cosine);
    const bool is_total = index > 1 && behind < 0;
    const float total = is_total ? material.transmittance : 0;
    const Color share = material.highlight * material.mirror + Color{total, total, total};
    Color light{};
    if (!(share == Color{})) {
      const Vec3f towards = normalize(mirrored(direction, surface.normal));
      light = light_along(start_of(surface, towards), towards, depth + 1) * share;
    }
    if (!is_total && material.transmittance > 0) {
      const Vec3f bent = direction * index + surface.normal * (index * cosine - std::sqrt(std::max(behind, 0.0F)));
      const Vec3f towards = normalize(bent);
      light = light + light_along(start_of(surface, towards), towards, depth + 1) * material.transmittance;
    }
    return light;
  }

  const PlainStage& stage_;
  embree::Context context_;
  std::uint64_t rays_ = 0;
};

PlainRenderer::PlainRenderer(const Subject& subject) : stage_(std::make_unique<PlainStage>(subject, EmbreeMode::robust)) {}
PlainRenderer::~PlainRenderer() = default;

const Times& PlainRenderer::build_times() const { return stage_->tree().build_times(); }

PlainPicture PlainRenderer::render(std::uint32_t thread_count) const {
  const int width = stage_->settings().camera.width(), height = stage_->settings().camera.height();
  const int columns = core::ceil_divide(width, plain_tile_side), tiles = columns * core::ceil_divide(height, plain_tile_side);
  PlainPicture picture{.pixels = core::ZeroedArray<Color>(stage_->settings().camera.pixel_count())};
  std::vector<std::uint64_t> rays(thread_count);
  std::atomic<int> next_tile = 0;
  on_threads(thread_count, [&](std::size_t thread) {
    Painter painter(*stage_);
    for (int tile = next_tile++; tile < tiles; tile = next_tile++) {
      const int left = tile % columns * plain_tile_side, top = tile / columns * plain_tile_side;
      for (int y = top; y < std::min(top + plain_tile_side, height); ++y) {
        for (int x = left; x < std::min(left + plain_tile_side, width); ++x) {
          picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
              painter.light_along(stage_->camera().eye, stage_->camera().towards(x, y), 1);
        }
      }
    }
    rays[thread] = painter.rays();
  });
  picture.rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  return picture;
}

double distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
    const core::Vec3d apart = core::Vec3d(picture.pixels[pixel]) - film.radiance(pixel);
    sum += dot(apart, apart);
  }
  const double distance = std::sqrt(sum / (3.0 * static_cast<double>(picture.pixels.size())));
  if (!(distance <= plain_error_max)) {
    throw core::InternalError("the plain renderer's picture of " + scene + " is " + fixed(255 * distance, 2) +
                              "/255 from ours, root mean square: expected 1/255 at most");
  }
  return distance;
}

}  // namespace dmpc::apps
