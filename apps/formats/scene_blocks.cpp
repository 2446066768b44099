#include "apps/formats/scene_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <ranges>
#include <utility>

#include "apps/formats/nff_reader.h"
#include "apps/formats/view_faults.h"
#include "apps/frontend/line/number_text.h"
#include "core/base/box.h"
#include "core/base/expect.h"
#include "core/base/forget.h"
#include "core/base/ranges.h"
#include "core/scene/facet_texture.h"
#include "core/scene/placed_objects.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr std::size_t lights_a_message = 1000;
/// More than any scene has: whoever sends more wants nothing but our memory.
constexpr std::size_t lights_max = std::size_t{1} << 20U, textures_max = std::size_t{1} << 16U;
constexpr std::uint64_t materials_max = std::uint64_t{1} << 24U;

/// So much of a list is handed over at a time, which dmpc has while it is not yet given back here.
constexpr std::size_t handed_bytes_max = std::size_t{8} << 20U;
/// Room is made in pieces that are still in the processor's cache when they are filled.
constexpr std::size_t piece_bytes = std::size_t{256} << 10U, index_piece_bytes = std::size_t{32} << 10U;

/// Sends lists. dmpc gets what this process gives back, so that a scene is there but once.
class BlockSender {
 public:
  BlockSender(Line& line, Handing handing) : line_(line), handing_(handing) {}

  template <class T>
  bool send(std::vector<T>& pool, Saying saying) {
    constexpr std::size_t most = handed_bytes_max / sizeof(T) * sizeof(T), page = 4096;
    const auto all = std::as_bytes(std::span(pool));
    for (std::size_t first = 0; first < all.size(); first += most) {
      const auto part = all.subspan(first, std::min(most, all.size() - first));
      if (!migration(part, saying) && !send_messages(part, sizeof(T), saying)) {
        return false;
      }
      const std::size_t before = std::min(first, page);  // bytes in the page in which the last part ended
      core::give_back(all.subspan(first - before, before + part.size()));
    }
    core::forget(pool);
    return true;
  }

 private:
  /// Returns whether it has been taken from here; once it has not, nothing will be.
  bool migration(std::span<const std::byte> part, Saying saying) {
    if (handing_ == Handing::in_messages || part.size() <= message_bytes_max) {
      return false;
    }
    const Packer fields =
        Packer().add(saying).add(std::uint64_t{reinterpret_cast<std::uintptr_t>(part.data())}).add(std::uint64_t{part.size()});
    const auto answer = line_.send(Saying::lies_here, fields) ? line_.receive(false) : std::nullopt;
    handing_ = answer && answer->saying == Saying::yes ? Handing::from_memory : Handing::in_messages;
    return handing_ == Handing::from_memory;
  }

  bool send_messages(std::span<const std::byte> part, std::size_t entry_bytes, Saying saying) {
    const std::size_t most = message_bytes_max / entry_bytes * entry_bytes;
    for (std::size_t first = 0; first < part.size(); first += most) {
      const auto message = part.subspan(first, std::min(most, part.size() - first));
      if (!line_.send(saying, {reinterpret_cast<const char*>(message.data()), message.size()})) {
        return false;
      }
    }
    return true;
  }

  Line& line_;
  Handing handing_;
};

bool send_lights(const std::vector<core::PointLight>& lights, Line& line) {
  for (std::size_t first = 0; first < lights.size(); first += lights_a_message) {
    Packer fields;
    for (const core::PointLight& light : std::span(lights).subspan(first, std::min(lights_a_message, lights.size() - first))) {
      fields.add(light.position).add(light.color).add_flag(light.has_color);
      fields.add(light.falls_off_from).add(light.cone.ahead).add(light.cone.full_degrees).add(light.cone.none_degrees);
      fields.add(light.cone.edge);
    }
    if (!line.send(Saying::lights, fields)) {
      return false;
    }
  }
  return true;
}

/// For a file that does not say its number of bounces.
constexpr int no_bounces = -1;

/// Calls take(saying, list) for each that is announced, in order.
template <class Vertices, class Take>
void for_each_list(core::Scene& scene, std::vector<Vec3d>& points, std::vector<Vertices>& vertices, core::Instances& instances,
                   const Take& take) {
  take(Saying::materials, scene.materials);
  take(Saying::objects, scene.objects);
  take(Saying::points, points);
  take(Saying::vertices, vertices);
  take(Saying::normals, scene.normals);
  take(Saying::corners, scene.corners);
  take(Saying::meshes, instances.meshes);
  take(Saying::places, instances.places);
}

bool is_light(const Vec3d& color) { return is_in_reach(color) && std::min({color.x, color.y, color.z}) >= 0; }

bool is_angle(double degrees) { return degrees >= 0 && degrees <= 180; }
bool is_share(double value) { return value >= 0 && value <= 1; }
bool is_weight(double value) { return value >= 0 && value < view_coordinate_max; }

}  // namespace

bool send_scene(core::Scene& scene, IndexedVertices& vertices, core::Instances& instances, Line& line, Handing handing) {
  Packer head;
  head.add(scene.view).add(scene.zenith).add(scene.background).add(scene.coordinate_rounding);
  head.add(scene.bounces.value_or(no_bounces));
  const auto for_each = [&](const auto& take) { for_each_list(scene, vertices.points, vertices.indices, instances, take); };
  for_each([&head](Saying /*saying*/, const auto& list) { head.add(std::uint64_t{list.size()}); });
  BlockSender blocks(line, handing);
  bool is_taken = line.send(Saying::scene, head) && send_lights(scene.lights, line);
  for_each([&](Saying saying, auto& list) { is_taken = is_taken && blocks.send(list, saying); });
  return is_taken && blocks.send(scene.spheres, Saying::spheres);
}

bool SceneReceiver::take(const Message& message) {
  if ((message.saying < Saying::scene || message.saying > Saying::vertices) && message.saying != Saying::spheres) {
    return false;
  }
  if (message.saying == Saying::scene) {
    take_head(Unpacker(message.bytes));
  } else if (message.saying == Saying::lights) {
    Unpacker::require(has_head_);
    take_lights(Unpacker(message.bytes));
  } else {
    std::size_t taken = 0;
    take_from(message.saying, message.bytes.size(), [&](std::span<std::byte> room) {
      std::memcpy(room.data(), message.bytes.data() + std::exchange(taken, taken + room.size()), room.size());
      return true;
    });
  }
  return true;
}

bool SceneReceiver::take_from(Saying saying, std::uint64_t bytes, const Fill& fill) {
  Unpacker::require(has_head_ && ((saying >= Saying::materials && saying <= Saying::vertices) || saying == Saying::spheres));
  bool is_filled = saying == Saying::spheres    ? append(scene_.spheres, announced_[Saying::objects], bytes, fill)
                   : saying == Saying::vertices ? append_vertices(bytes, fill)
                                                : false;
  for_each_list(scene_, points_, scene_.vertices, instances_, [&](Saying each, auto& list) {
    if (each == saying && each != Saying::vertices) {
      is_filled = append(list, announced_[each], bytes, fill);
    }
  });
  return is_filled;
}

void SceneReceiver::add(core::Texture texture) {
  Unpacker::require(scene_.textures.size() < textures_max);
  scene_.textures.push_back(std::move(texture));
}

void SceneReceiver::take_head(Unpacker fields) {
  Unpacker::require(!std::exchange(has_head_, true));
  scene_.view = fields.take<core::View>();
  scene_.zenith = fields.take<Vec3d>();
  Unpacker::require(scene_.zenith == Vec3d{} || std::abs(length(scene_.zenith) - 1) < 1e-6);
  scene_.background = fields.take<Vec3d>();
  scene_.coordinate_rounding = fields.take<double>();
  Unpacker::require(scene_.coordinate_rounding >= 0 && scene_.coordinate_rounding < 1);
  const auto bounces = fields.take<int>();
  Unpacker::require(bounces >= no_bounces && bounces <= core::Scene::bounces_max);
  scene_.bounces = bounces == no_bounces ? std::nullopt : std::optional(bounces);
  for_each_list(scene_, points_, scene_.vertices, instances_, [&](Saying each, auto& list) {
    const auto count = announced_[each] = fields.take<std::uint64_t>();
    Unpacker::require(count < std::numeric_limits<std::uint32_t>::max());
    list.reserve(std::min(count, limits_.believed_bytes / sizeof(list[0])));
  });
  Unpacker::require(announced_[Saying::materials] <= materials_max);
  fields.finish();
}

void SceneReceiver::take_lights(Unpacker fields) {
  for (std::size_t i = 0; i < lights_a_message && !fields.is_empty(); ++i) {
    core::PointLight light{.position = fields.take<Vec3d>(), .color = fields.take<Vec3d>()};
    light.has_color = fields.take_flag();
    light.falls_off_from = fields.take<double>();
    light.cone.ahead = fields.take<Vec3d>();
    light.cone.full_degrees = fields.take<double>();
    light.cone.none_degrees = fields.take<double>();
    light.cone.edge = fields.take_choice(core::ConeEdge::square);
    const core::LightCone& cone = light.cone;
    Unpacker::require(is_weight(light.falls_off_from) && is_angle(cone.full_degrees) && is_angle(cone.none_degrees) &&
                      (cone.none_degrees == 0 || std::abs(length(cone.ahead) - 1) < 1e-6));
    Unpacker::require(is_in_reach(light.position) && is_light(light.color) && scene_.lights.size() < lights_max);
    scene_.lights.push_back(light);
  }
  fields.finish();
}

/// Within what was announced.
template <class T>
bool SceneReceiver::append(std::vector<T>& pool, std::uint64_t announced, std::uint64_t bytes, const Fill& fill) {
  const std::size_t before = pool.size();
  const std::uint64_t end = before + bytes / sizeof(T);
  Unpacker::require(end > before && bytes % sizeof(T) == 0 && end <= announced);
  while (pool.size() < end) {
    const std::size_t piece = std::min<std::size_t>(piece_bytes / sizeof(T), end - pool.size());
    pool.resize(pool.size() + piece);
    if (!fill(std::as_writable_bytes(std::span(pool).last(piece)))) {
      pool.resize(before);
      return false;
    }
  }
  return true;
}

/// As indices of points that are there, which are looked at in a copy.
bool SceneReceiver::append_vertices(std::uint64_t bytes, const Fill& fill) {
  std::vector<Vec3d>& vertices = scene_.vertices;
  const std::size_t before = vertices.size();
  const std::uint64_t end = before + bytes / sizeof(std::uint32_t);
  Unpacker::require(end > before && bytes % sizeof(std::uint32_t) == 0 && end <= announced_[Saying::vertices]);
  std::vector<std::uint32_t> piece;
  while (vertices.size() < end) {
    piece.resize(std::min<std::size_t>(index_piece_bytes / sizeof(std::uint32_t), end - vertices.size()));
    if (!fill(std::as_writable_bytes(std::span(piece)))) {
      vertices.resize(before);
      return false;
    }
    Unpacker::require(*std::max_element(piece.begin(), piece.end()) < points_.size());
    const auto placed = piece | std::views::transform([&](std::uint32_t index) -> const Vec3d& { return points_[index]; });
    vertices.insert(vertices.end(), placed.begin(), placed.end());
  }
  return true;
}

/// Most objects are triangles of one colour: a few comparisons replace check_object() for them.
void SceneReceiver::check_objects() const {
  const bool is_textured = std::any_of(scene_.materials.begin(), scene_.materials.end(),
                                       [](const core::Material& material) { return material.microfacets.have_texture(); });
  const std::uint64_t materials = scene_.materials.size(), vertices = scene_.vertices.size();
  const auto is_plain = [&](const core::Object& object) {
    return object.kind == core::ObjectKind::polygon && object.vertex_count == 3 && object.material < materials &&
           std::uint64_t{object.first} + 3 <= vertices;
  };
  for (const core::Object& object : scene_.objects) {
    if (is_textured || !is_plain(object)) {
      check_object(object);
    }
  }
}

void SceneReceiver::check_object(const core::Object& object) const {
  using core::ObjectKind;
  Unpacker::require(object.material < scene_.materials.size());
  if (object.kind == ObjectKind::sphere) {
    const auto is_there = [](const core::Sphere& sphere) {
      return is_in_reach(sphere.center) && std::abs(sphere.radius) < view_coordinate_max && sphere.radius != 0;
    };
    Unpacker::require(object.first < scene_.spheres.size() && is_there(scene_.spheres[object.first]) &&
                      !scene_.materials[object.material].microfacets.have_texture());
    return;
  }
  Unpacker::require(object.kind == ObjectKind::polygon || object.kind == ObjectKind::patch ||
                    object.kind == ObjectKind::textured);
  Unpacker::require(object.kind == ObjectKind::textured || !scene_.materials[object.material].microfacets.have_texture());
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
  const core::Microfacets& facets = material.microfacets;
  Unpacker::require(facets == core::Microfacets{} ||
                    (is_share(facets.roughness) && is_share(facets.metallic) && is_share(facets.reflectance) &&
                     is_share(facets.transmission) && is_share(facets.opacity)));
  Unpacker::require(!facets.have_texture() || (facets.are_there() && facets.texture < scene_.textures.size()));
  Unpacker::require(
      facets.use == core::FacetTexture::mean ||
      (facets.use == core::FacetTexture::placed && (!facets.have_texture() || material.texture != core::Material::no_texture)));
}

/// None of them is one of a colour, too.
void SceneReceiver::check_facet_textures() const {
  std::vector<bool> are_numbers(scene_.textures.size());
  for (const core::Material& material : scene_.materials) {
    if (material.microfacets.have_texture()) {
      are_numbers[material.microfacets.texture] = true;
    }
  }
  for (const core::Material& material : scene_.materials) {
    Unpacker::require(material.texture == core::Material::no_texture || !are_numbers[material.texture]);
  }
}

/// A reader does not know whether a texture has alpha, which it asks dmpc to read.
void SceneReceiver::drop_needless_alpha(core::Material& material) const {
  if (material.texture != core::Material::no_texture &&
      scene_.textures[material.texture].format != core::TexelFormat::srgb_alpha) {
    material.alpha = core::AlphaUse::none;
    material.alpha_cutoff = 0;
  }
}

/// Each mesh has objects of its own, none of them round, and each place one of the meshes.
void SceneReceiver::check_instances() const {
  std::uint32_t next = 0;
  for (const core::SharedMesh& mesh : instances_.meshes) {
    Unpacker::require(mesh.first >= next && mesh.end > mesh.first && mesh.end <= scene_.objects.size());
    for (; next < mesh.end; ++next) {
      Unpacker::require(next < mesh.first || scene_.objects[next].vertex_count > 0);
    }
  }
  next = 0;
  for (const core::Instance& place : instances_.places) {
    Unpacker::require(place.mesh < instances_.meshes.size() && place.before >= next && place.before <= scene_.objects.size());
    next = place.before;
  }
}

/// Few bytes may say much of them.
void SceneReceiver::settle_instances() {
  if (instances_.empty()) {
    return;
  }
  check_instances();
  const std::uint64_t bytes = core::settled_size(scene_, instances_, copies_).bytes();
  if (bytes > limits_.expanded_bytes) {
    throw core::CapacityError("with every instance it takes " + bytes_text(bytes) + " of memory, and there are " +
                              bytes_text(limits_.expanded_bytes) + " for it: give the scene fewer, or coarser meshes" +
                              (copies_ == core::Copies::put ? ", or have dmpc render keep each once (--instances=keep)" : ""));
  }
  core::settle(scene_, std::exchange(instances_, {}), copies_);
  Unpacker::require(std::ranges::all_of(scene_.vertices, [](const Vec3d& point) { return is_in_reach(point); }));
  check_copies();
}

/// Copies that are left out must have all corners within the allowed range, too.
void SceneReceiver::check_copies() const {
  if (!leaves_copies_out(scene_)) {
    return;
  }
  const std::vector<core::Box> boxes =
      core::mapped<core::Box>(scene_.kept->meshes, [&](const core::Scene& mesh) { return core::Box::around(mesh.vertices); });
  for (const core::BaseMeshInstance& place : scene_.kept->places) {
    Unpacker::require(is_in_reach(boxes[place.mesh], place.world));
  }
}

/// Normals and places on textures, or colours of corners, may have any bits (core/database/conversion.cpp).
core::Scene SceneReceiver::finish() {
  const core::View& view = scene_.view;
  Unpacker::require(has_head_ && view.width >= 1 && view.height >= 1 && view.width <= resolution_max &&
                    view.height <= resolution_max && std::int64_t{view.width} * view.height <= picture_pixels_max);
  Unpacker::require(!fault_of(view) && is_in_reach(view.from) && is_in_reach(view.at) && is_in_reach(view.up) &&
                    is_weight(view.hither));
  Unpacker::require(is_light(scene_.background));
  for (core::Material& material : scene_.materials) {
    check_material(material);
    drop_needless_alpha(material);
  }
  check_facet_textures();
  core::settle_facet_textures(scene_);
  check_objects();
  Unpacker::require(std::ranges::all_of(points_, [](const Vec3d& point) { return is_in_reach(point); }));
  core::forget(points_);
  settle_instances();
  return std::exchange(scene_, {});
}

}  // namespace dmpc::apps
