#include "apps/lab/bench/speed/plain_renderer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "apps/edge/line/number_text.h"
#include "apps/lab/bench/speed/crew.h"
#include "apps/lab/bench/speed/embree_tree.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/hit_geometry.h"

namespace dmpc::apps {

namespace {

using core::Color;
using core::Vec3d;
using core::Vec3f;

/// As ours (core/picture/shade.cpp).
constexpr float surface_offset = 0x1p-21F, light_end = 1 - 1e-6F;
constexpr int tile_side = 16;

/// The camera in single precision.
struct Pinhole {
  Vec3f eye, corner, right, down;  ///< from the eye to the first pixel; from a pixel to the next

  /// What on_film() makes of the axes is the camera, for it is linear.
  explicit Pinhole(const core::Camera& camera) : eye(camera.eye()) {
    const double middle_x = 0.5 * (camera.width() - 1), middle_y = 0.5 * (camera.height() - 1);
    Vec3d forward, rightward, downward;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3d unit;
      unit[axis] = 1;
      const Vec3d seen = camera.on_film(unit);
      forward[axis] = seen.z;
      rightward[axis] = seen.x - middle_x * seen.z;
      downward[axis] = seen.y - middle_y * seen.z;
    }
    rightward = rightward * (1 / dot(rightward, rightward));
    downward = downward * (1 / dot(downward, downward));
    right = Vec3f(rightward);
    down = Vec3f(downward);
    corner = Vec3f(forward - rightward * middle_x - downward * middle_y);
  }
  Vec3f towards(int x, int y) const { return normalize(corner + right * static_cast<float>(x) + down * static_cast<float>(y)); }
};

template <class Record>
std::vector<Record> records_at(const core::LocalRecords& records, core::Address first, std::uint32_t count) {
  std::vector<Record> copies(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    copies[i] = core::read<Record>(records.find(core::advance(first, i * sizeof(Record))));
  }
  return copies;
}

/// A surface with what its finish says of it. Where alpha tells, the picture is textured, and is compared with none.
struct PlainMaterial : core::MaterialRecord {
  Color highlight;  ///< of which `mirror` mirrors
  float mirror = 1;
  Color emission;

  explicit PlainMaterial(const core::MaterialRecord& record)
      : core::MaterialRecord(record), highlight{specular, specular, specular} {}
  void add(const core::FinishRecord& finish) {
    highlight = finish.specular + color * specular;
    mirror = static_cast<float>(finish.mirror) / float{core::FinishRecord::share_max};
    emission = finish.emission;
    refraction_index = finish.refraction_index;
  }
  bool is_glossy() const { return !(highlight == Color{}); }
};

/// Of all records, finishes included, which nobody asks for by their number.
std::vector<PlainMaterial> materials_in(const core::LocalRecords& records, const core::DatabaseHeader& header) {
  std::vector<PlainMaterial> materials;
  for (const auto& record : records_at<core::MaterialRecord>(records, header.materials, header.material_count)) {
    materials.emplace_back(record);
  }
  std::size_t count = materials.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (materials[i].has_finish()) {
      const std::uint32_t place = materials[i].finish();
      count = std::min<std::size_t>(count, place);
      materials[i].add(
          core::read<core::FinishRecord>(records.find(core::advance(header.materials, place * sizeof(core::FinishRecord)))));
    }
  }
  return materials;
}

/// What shading knows of a hit.
struct Surface {
  Vec3f point;
  Vec3f geometric_normal, normal;  ///< of unit length; the latter the one to shade with, on the ray's side
  const PlainMaterial* material = nullptr;
  bool is_leaving = false;
};

Vec3f mirrored(const Vec3f& direction, const Vec3f& normal) { return direction - normal * (2 * dot(direction, normal)); }

Color highlight_of(const PlainMaterial& material, float lobe) {
  return material.is_glossy() ? material.highlight * std::pow(std::clamp(lobe, 0.0F, 1.0F), material.shine) : Color{};
}

}  // namespace

/// What all threads read.
struct PlainRenderer::Stage {
  explicit Stage(const Subject& subject)
      : settings(subject.settings),
        records(subject.database.bytes()),
        tree(subject.database.primitives(), EmbreeMode::robust, EmbreeQuality::high, 0),
        places(subject.database.find_places()),
        pinhole(settings.camera),
        materials(materials_in(records, settings.header)),
        lights(records_at<core::LightRecord>(records, settings.header.lights, settings.header.light_count)) {
    shading.reserve(tree.shapes().triangles.size());
    for (const std::uint32_t id : tree.shapes().triangles) {
      core::HitState state;
      state.hit.lane = places[id].lane;
      core::read_geometry(state, records.find(places[id].block));
      shading.push_back(state.shading);
    }
  }

  const core::RenderSettings& settings;
  core::LocalRecords records;
  EmbreeTree tree;
  std::vector<core::Database::Place> places;
  Pinhole pinhole;
  std::vector<PlainMaterial> materials;
  std::vector<core::LightRecord> lights;
  std::vector<core::ShadingReference> shading;  ///< of each triangle, as Embree numbers them
};

/// One thread at work.
class PlainRenderer::Painter {
 public:
  explicit Painter(const Stage& stage) : stage_(stage) { embree::start(context_); }

  Color light_along(const Vec3f& origin, const Vec3f& direction, int depth) {
    ++rays_;
    RTCRayHit asked;
    asked.ray = embree::ray_of(origin, direction, std::numeric_limits<float>::infinity());
    asked.hit.geomID = asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(stage_.tree.library(), stage_.tree.scene(), context_, asked);
    if (asked.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
      return stage_.settings.header.background;
    }
    const bool is_triangle = asked.hit.geomID == 0 && !stage_.shading.empty();
    const Surface surface = is_triangle ? triangle_at(asked, origin, direction) : curved_at(asked, origin, direction);
    Color light = direct_light(surface, direction);
    if (depth < stage_.settings.shade.depth_max) {
      light = light + passed_on(surface, direction, depth);
    }
    return light;
  }

  std::uint64_t rays() const { return rays_; }

 private:
  Surface triangle_at(const RTCRayHit& asked, const Vec3f& origin, const Vec3f& direction) const {
    Surface surface;
    surface.point = origin + direction * asked.ray.tfar;
    surface.geometric_normal = normalize(Vec3f{asked.hit.Ng_x, asked.hit.Ng_y, asked.hit.Ng_z});
    surface.is_leaving = dot(direction, surface.geometric_normal) > 0;
    surface.normal = surface.is_leaving ? -surface.geometric_normal : surface.geometric_normal;
    blend(surface, stage_.shading[asked.hit.primID], asked.hit.u, asked.hit.v);
    return surface;
  }

  /// Vertex normals, where the triangle has them, and the material.
  void blend(Surface& surface, core::ShadingReference shading, float u, float v) const {
    if (!shading.is_smooth()) {
      surface.material = &stage_.materials[shading.material()];
      return;
    }
    const auto& normals = *reinterpret_cast<const core::PatchNormals*>(stage_.records.find(shading.normals()));
    const Vec3f blended = normals.normal[0] * (1 - u - v) + normals.normal[1] * u + normals.normal[2] * v;
    const float square = dot(blended, blended);
    if (square > 0) {
      surface.normal = blended * ((dot(blended, surface.normal) < 0 ? -1.0F : 1.0F) / std::sqrt(square));
    }
    surface.material = &stage_.materials[normals.material()];
  }

  Surface curved_at(const RTCRayHit& asked, const Vec3f& origin, const Vec3f& direction) const {
    const core::Database::Place place = stage_.places[stage_.tree.shapes().curved[asked.hit.primID]];
    core::HitState state;
    state.ray.origin = origin;
    state.ray.direction = direction;
    state.hit.t = asked.ray.tfar;
    state.hit.lane = place.lane;
    core::read_geometry(state, stage_.records.find(place.block));
    return {Vec3f(state.point), Vec3f(state.geometric_normal), Vec3f(state.normal), &stage_.materials[state.shading.material()],
            state.leaving};
  }

  /// Beside the surface, on the side that a ray goes to.
  static Vec3f start_of(const Surface& surface, const Vec3f& towards) {
    const float side = dot(towards, surface.geometric_normal) < 0 ? -surface_offset : surface_offset;
    return surface.point + surface.geometric_normal * side;
  }

  Color direct_light(const Surface& surface, const Vec3f& direction) {
    const PlainMaterial& material = *surface.material;
    Color sum = material.emission + stage_.settings.header.ambient * (material.color * material.diffuse);
    const Vec3f mirror = mirrored(direction, surface.normal);
    for (const core::LightRecord& light : stage_.lights) {
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
    RTCRay ray = embree::ray_of(start, light - start, light_end);
    embree::occlude(stage_.tree.library(), stage_.tree.scene(), context_, ray);
    return ray.tfar < 0;
  }

  /// What comes by reflection and refraction.
  Color passed_on(const Surface& surface, const Vec3f& direction, int depth) {
    const PlainMaterial& material = *surface.material;
    const float inside = material.refraction_index > 0 ? material.refraction_index : 1;
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

  const Stage& stage_;
  embree::Context context_;
  std::uint64_t rays_ = 0;
};

PlainRenderer::PlainRenderer(const Subject& subject) : stage_(std::make_unique<Stage>(subject)) {}
PlainRenderer::~PlainRenderer() = default;

const Times& PlainRenderer::build_times() const { return stage_->tree.build_times(); }

PlainPicture PlainRenderer::render(std::uint32_t thread_count) const {
  const int width = stage_->settings.camera.width(), height = stage_->settings.camera.height();
  const int columns = core::ceil_divide(width, tile_side), tiles = columns * core::ceil_divide(height, tile_side);
  PlainPicture picture{.pixels = core::ZeroedArray<Color>(stage_->settings.camera.pixel_count())};
  std::vector<std::uint64_t> rays(thread_count);
  std::atomic<int> next_tile = 0;
  on_threads(thread_count, [&](std::size_t thread) {
    Painter painter(*stage_);
    for (int tile = next_tile++; tile < tiles; tile = next_tile++) {
      const int left = tile % columns * tile_side, top = tile / columns * tile_side;
      for (int y = top; y < std::min(top + tile_side, height); ++y) {
        for (int x = left; x < std::min(left + tile_side, width); ++x) {
          picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
              painter.light_along(stage_->pinhole.eye, stage_->pinhole.towards(x, y), 1);
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
