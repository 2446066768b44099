#include "core/scene/placed_objects.h"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "core/base/forget.h"

namespace dmpc::core {
namespace {

bool has_corners(const Object& object) { return object.kind < ObjectKind::sphere; }

/// The objects and pools of a scene as one after the other adds to them. Vertices come with the objects, shading may come later,
/// so that not all pools need be there twice.
class PoolWriter {
 public:
  explicit PoolWriter(Scene& to) : to_(to) {}

  void add(const PlacedObject& from) {
    Object object = from.object();
    if (has_corners(object)) {
      object.first = static_cast<std::uint32_t>(to_.vertices.size());
      for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        to_.vertices.push_back(from.vertex(i));
      }
    }
    to_.objects.push_back(object);
  }

  /// In the order in which the objects were added.
  void add_shading(const PlacedObject& from) {
    Object& object = to_.objects[shaded_++];
    if (object.kind == ObjectKind::patch) {
      object.first_normal = static_cast<std::uint32_t>(to_.normals.size());
      for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        to_.normals.push_back(from.normal(i));
      }
    } else if (object.kind == ObjectKind::textured) {
      object.first_normal = static_cast<std::uint32_t>(to_.corners.size());
      for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        to_.corners.push_back(from.corner(i));
      }
    }
  }

 private:
  Scene& to_;
  std::size_t shaded_ = 0;
};

}  // namespace

bool leaves_copies_out(const Scene& scene) { return scene.kept != nullptr && !scene.kept->have_copies; }

PlacedObjects::PlacedObjects(const Scene& scene) : scene_(scene) {
  if (leaves_copies_out(scene)) {
    for (const KeptPlace& place : scene.kept->places) {
      add_own(place.first);
      const std::uint64_t end = count_ + scene.kept->meshes[place.mesh].objects.size();
      runs_.push_back({count_, end, 0, &place});
      count_ = end;
    }
  }
  add_own(count_ + (scene.objects.size() - own_));
}

void PlacedObjects::add_own(std::uint64_t until) {
  if (count_ < until) {
    runs_.push_back({count_, until, own_, nullptr});
    own_ += static_cast<std::size_t>(until - count_);
    count_ = until;
  }
}

std::uint64_t object_count(const Scene& scene) {
  std::uint64_t count = scene.objects.size();
  if (leaves_copies_out(scene)) {
    for (const KeptPlace& place : scene.kept->places) {
      count += scene.kept->meshes[place.mesh].objects.size();
    }
  }
  return count;
}

ExpandedSize size_with_copies(const Scene& scene) {
  ExpandedSize size = size_of_pools(scene);
  if (leaves_copies_out(scene)) {
    for (const KeptPlace& place : scene.kept->places) {
      size = size + size_of_pools(scene.kept->meshes[place.mesh]);
    }
  }
  return size;
}

void put_copies(Scene& scene) {
  if (!leaves_copies_out(scene)) {
    return;
  }
  const ExpandedSize size = size_with_copies(scene);
  size.check();
  Scene left;
  left.kept = std::exchange(scene.kept, nullptr);
  left.objects.swap(scene.objects);
  left.vertices.swap(scene.vertices);
  left.normals.swap(scene.normals);
  left.corners.swap(scene.corners);
  const PlacedObjects all(left);
  PoolWriter writer(scene);
  scene.objects.reserve(size.objects);
  scene.vertices.reserve(size.vertices);
  all.for_each([&](const PlacedObject& object) { writer.add(object); });
  forget(left.vertices);
  scene.normals.reserve(size.normals);
  scene.corners.reserve(size.corners);
  all.for_each([&](const PlacedObject& object) { writer.add_shading(object); });
  KeptMeshes kept = *left.kept;
  kept.have_copies = true;
  scene.kept = std::make_shared<const KeptMeshes>(std::move(kept));
}

Scene without_copies(const Scene& scene) {
  Scene own;
  own.spheres = scene.spheres;
  own.cones = scene.cones;
  PoolWriter writer(own);
  const bool has_copies = scene.kept != nullptr && scene.kept->have_copies;
  std::uint32_t next = 0;
  const auto add_until = [&](std::uint32_t end) {
    for (; next < end; ++next) {
      const PlacedObject object(scene, scene.objects[next], nullptr);
      writer.add(object);
      writer.add_shading(object);
    }
  };
  for (const KeptPlace& place : has_copies ? std::span(scene.kept->places) : std::span<const KeptPlace>()) {
    add_until(place.first);
    next += static_cast<std::uint32_t>(scene.kept->meshes[place.mesh].objects.size());
  }
  add_until(static_cast<std::uint32_t>(scene.objects.size()));
  return own;
}

}  // namespace dmpc::core
