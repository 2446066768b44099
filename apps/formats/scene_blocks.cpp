#include "apps/formats/scene_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "apps/formats/nff_reader.h"
#include "apps/formats/view_faults.h"
#include "core/base/expect.h"
#include "core/base/forget.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double coordinate_max = 1e30;
constexpr std::size_t lights_a_message = 1000;
/// More than any scene has: whoever sends more wants nothing but our memory.
constexpr std::size_t lights_max = std::size_t{1} << 20U, textures_max = std::size_t{1} << 16U;
constexpr std::uint64_t materials_max = std::uint64_t{1} << 24U;

/// dmpc gets what this process gives back, so that a scene is there but once.
template <class T>
bool send_block(std::vector<T>& pool, Saying saying, Line& line) {
  constexpr std::size_t most = message_bytes_max / sizeof(T) * sizeof(T), page = 4096;
  const auto all = std::as_bytes(std::span(pool));
  for (std::size_t first = 0; first < all.size(); first += most) {
    const auto part = all.subspan(first, std::min(most, all.size() - first));
    if (!line.send(saying, {reinterpret_cast<const char*>(part.data()), part.size()})) {
      return false;
    }
    const std::size_t before = std::min(first, page);  // of the page that the last part ended in
    core::give_back(all.subspan(first - before, before + part.size()));
  }
  core::forget(pool);
  return true;
}

bool send_lights(const std::vector<core::PointLight>& lights, Line& line) {
  for (std::size_t first = 0; first < lights.size(); first += lights_a_message) {
    Packer fields;
    for (const core::PointLight& light : std::span(lights).subspan(first, std::min(lights_a_message, lights.size() - first))) {
      fields.add(light.position).add(light.color).add(static_cast<std::uint8_t>(light.has_color));
    }
    if (!line.send(Saying::lights, fields)) {
      return false;
    }
  }
  return true;
}

std::uint64_t count_of(const auto& pool) { return pool.size(); }

bool is_point(const Vec3d& point) {
  return std::abs(point.x) < coordinate_max && std::abs(point.y) < coordinate_max && std::abs(point.z) < coordinate_max;
}

bool is_light(const Vec3d& color) { return is_point(color) && std::min({color.x, color.y, color.z}) >= 0; }

bool is_weight(double value) { return value >= 0 && value < coordinate_max; }

}  // namespace

bool send_scene(core::Scene& scene, Line& line) {
  const Packer head = Packer()
                          .add(scene.view)
                          .add(scene.background)
                          .add(scene.coordinate_rounding)
                          .add(count_of(scene.materials))
                          .add(count_of(scene.objects))
                          .add(count_of(scene.vertices))
                          .add(count_of(scene.normals))
                          .add(count_of(scene.corners));
  return line.send(Saying::scene, head) && send_lights(scene.lights, line) &&
         send_block(scene.materials, Saying::materials, line) && send_block(scene.objects, Saying::objects, line) &&
         send_block(scene.vertices, Saying::vertices, line) && send_block(scene.normals, Saying::normals, line) &&
         send_block(scene.corners, Saying::corners, line);
}

bool SceneReceiver::take(const Message& message) {
  Unpacker::require(has_head_ || message.saying < Saying::lights || message.saying > Saying::corners);
  switch (message.saying) {
    case Saying::scene:
      take_head(Unpacker(message.bytes));
      return true;
    case Saying::lights:
      take_lights(Unpacker(message.bytes));
      return true;
    case Saying::materials:
      append(scene_.materials, announced_.materials, message.bytes);
      return true;
    case Saying::objects:
      append(scene_.objects, announced_.objects, message.bytes);
      return true;
    case Saying::vertices:
      append(scene_.vertices, announced_.vertices, message.bytes);
      return true;
    case Saying::normals:
      append(scene_.normals, announced_.normals, message.bytes);
      return true;
    case Saying::corners:
      append(scene_.corners, announced_.corners, message.bytes);
      return true;
    default:
      return false;
  }
}

void SceneReceiver::add(core::Texture texture) {
  Unpacker::require(scene_.textures.size() < textures_max);
  scene_.textures.push_back(std::move(texture));
}

void SceneReceiver::take_head(Unpacker fields) {
  Unpacker::require(!std::exchange(has_head_, true));
  scene_.view = fields.take<core::View>();
  scene_.background = fields.take<Vec3d>();
  scene_.coordinate_rounding = fields.take<double>();
  Unpacker::require(scene_.coordinate_rounding >= 0 && scene_.coordinate_rounding < 1);
  const auto reserve = [&fields](auto& pool) {
    const auto count = fields.take<std::uint64_t>();
    Unpacker::require(count < std::numeric_limits<std::uint32_t>::max());
    pool.reserve(std::min(count, believed_bytes_max / sizeof(pool[0])));
    return count;
  };
  announced_.materials = reserve(scene_.materials);
  Unpacker::require(announced_.materials <= materials_max);
  announced_.objects = reserve(scene_.objects);
  announced_.vertices = reserve(scene_.vertices);
  announced_.normals = reserve(scene_.normals);
  announced_.corners = reserve(scene_.corners);
  fields.finish();
}

void SceneReceiver::take_lights(Unpacker fields) {
  for (std::size_t i = 0; i < lights_a_message && !fields.is_empty(); ++i) {
    core::PointLight light{.position = fields.take<Vec3d>(), .color = fields.take<Vec3d>()};
    light.has_color = fields.take_flag();
    Unpacker::require(is_point(light.position) && is_light(light.color) && scene_.lights.size() < lights_max);
    scene_.lights.push_back(light);
  }
  fields.finish();
}

/// Within what was announced.
template <class T>
void SceneReceiver::append(std::vector<T>& pool, std::uint64_t announced, const std::string& bytes) {
  const std::size_t count = bytes.size() / sizeof(T), before = pool.size();
  Unpacker::require(count > 0 && bytes.size() % sizeof(T) == 0 && count <= announced - before);
  pool.resize(before + count);
  std::memcpy(static_cast<void*>(pool.data() + before), bytes.data(), bytes.size());
}

void SceneReceiver::check_object(const core::Object& object) const {
  using core::ObjectKind;
  Unpacker::require(object.kind == ObjectKind::polygon || object.kind == ObjectKind::patch ||
                    object.kind == ObjectKind::textured);
  Unpacker::require(object.material < scene_.materials.size());
  Unpacker::require(object.vertex_count >= 3 && object.vertex_count <= polygon_vertices_max);
  const auto fits = [&object](std::uint32_t first, const auto& pool) {
    return std::uint64_t{first} + object.vertex_count <= pool.size();
  };
  Unpacker::require(fits(object.first, scene_.vertices));
  Unpacker::require(object.kind != ObjectKind::patch || fits(object.first_normal, scene_.normals));
  Unpacker::require(object.kind != ObjectKind::textured || fits(object.first_normal, scene_.corners));
}

void SceneReceiver::check_material(const core::Material& material) const {
  Unpacker::require(is_light(material.color) && is_weight(material.diffuse) && is_weight(material.specular) &&
                    is_weight(material.shine) && is_weight(material.transmittance) && is_weight(material.refraction_index));
  Unpacker::require(is_light(material.specular_color) && is_light(material.emission) && is_weight(material.tinted_specular) &&
                    is_weight(material.mirror) && is_weight(material.alpha_cutoff) && material.alpha <= core::AlphaUse::cut);
  Unpacker::require(material.texture == core::Material::no_texture || material.texture < scene_.textures.size());
  Unpacker::require(material.mirror <= 1 && material.alpha_cutoff <= 1 && is_light(material.specular_color * material.specular) &&
                    is_light(material.color * material.tinted_specular));  // what a record keeps of them is finite, too
}

/// A reader does not know whether a texture has alpha, which it asks dmpc to read.
void SceneReceiver::drop_needless_alpha(core::Material& material) const {
  if (material.texture != core::Material::no_texture &&
      scene_.textures[material.texture].format != core::TexelFormat::srgb_alpha) {
    material.alpha = core::AlphaUse::none;
    material.alpha_cutoff = 0;
  }
}

/// Normals and places on textures, or colours of corners, may have any bits (core/database/conversion.cpp).
core::Scene SceneReceiver::finish() {
  const core::View& view = scene_.view;
  Unpacker::require(has_head_ && view.width >= 1 && view.height >= 1 && view.width <= resolution_max &&
                    view.height <= resolution_max && std::int64_t{view.width} * view.height <= picture_pixels_max);
  Unpacker::require(!fault_of(view) && is_point(view.from) && is_point(view.at) && is_point(view.up) && is_weight(view.hither));
  Unpacker::require(is_light(scene_.background));
  for (core::Material& material : scene_.materials) {
    check_material(material);
    drop_needless_alpha(material);
  }
  for (const core::Object& object : scene_.objects) {
    check_object(object);
  }
  Unpacker::require(std::all_of(scene_.vertices.begin(), scene_.vertices.end(), is_point));
  return std::exchange(scene_, {});
}

}  // namespace dmpc::apps
