#include "core/scene/placed_objects.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/forget.h"
#include "core/scene/stored_objects.h"

namespace dmpc::core {
namespace {

bool has_corners(const Object& object) { return object.kind < ObjectKind::sphere; }

/// The objects and pools of a scene, to which objects are added one by one. Vertices come with the objects; shading may come
/// later, so that not all pools must exist twice.
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

std::vector<bool> all_places(const Scene& scene) {
  return std::vector<bool>(scene.kept == nullptr ? 0 : scene.kept->places.size(), true);
}

/// In the file's order, limited to the instances in `places`.
template <class Take>
void for_each_left_out(const Scene& scene, const std::vector<bool>& places, const Take& take) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] && !scene.kept->places[i].has_copy) {
      take(scene.kept->places[i]);
    }
  }
}

/// Marks the copies of the instances in `places` as put.
void mark_copies(BaseMeshes& kept, const std::vector<bool>& places) {
  std::uint32_t left_out = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    BaseMeshInstance& place = kept.places[i];
    place.at = place.first - left_out;
    place.has_copy = place.has_copy || places[i];
    left_out += place.has_copy ? 0 : static_cast<std::uint32_t>(kept.meshes[place.mesh].objects.size());
  }
}

}  // namespace

bool leaves_copies_out(const Scene& scene) {
  return scene.kept != nullptr && std::any_of(scene.kept->places.begin(), scene.kept->places.end(),
                                              [](const BaseMeshInstance& place) { return !place.has_copy; });
}

PlacedObjects::PlacedObjects(const Scene& scene) : PlacedObjects(scene, all_places(scene)) {}

PlacedObjects::PlacedObjects(const Scene& scene, const std::vector<bool>& places) : scene_(scene) {
  for_each_left_out(scene, places, [this](const BaseMeshInstance& place) { add_place(place); });
  add_own(scene.objects.size());
}

void PlacedObjects::add_place(const BaseMeshInstance& place) {
  add_own(place.at);
  const std::uint64_t end = count_ + scene_.kept->meshes[place.mesh].objects.size();
  runs_.push_back({count_, end, 0, &place});
  count_ = end;
}

/// Adds the scene's own objects before `until`.
void PlacedObjects::add_own(std::size_t until) {
  if (own_ < until) {
    runs_.push_back({count_, count_ + (until - own_), own_, nullptr});
    count_ += until - own_;
    own_ = until;
  }
}

std::uint64_t object_count(const Scene& scene) {
  return scene.stored != nullptr ? scene.stored->object_count() : size_with_copies(scene).objects;
}

ExpandedSize size_with_copies(const Scene& scene) { return size_with_copies(scene, all_places(scene)); }

ExpandedSize size_with_copies(const Scene& scene, const std::vector<bool>& places) {
  ExpandedSize size = size_of_pools(scene);
  for_each_left_out(scene, places,
                    [&](const BaseMeshInstance& place) { size = size + size_of_pools(scene.kept->meshes[place.mesh]); });
  return size;
}

void put_copies(Scene& scene) { put_copies(scene, all_places(scene)); }

void put_copies(Scene& scene, const std::vector<bool>& places) {
  if (!leaves_copies_out(scene)) {
    return;
  }
  const ExpandedSize size = size_with_copies(scene, places);
  size.check();
  Scene left;
  left.kept = std::exchange(scene.kept, nullptr);
  left.objects.swap(scene.objects);
  left.vertices.swap(scene.vertices);
  left.normals.swap(scene.normals);
  left.corners.swap(scene.corners);
  const PlacedObjects all(left, places);
  PoolWriter writer(scene);
  scene.objects.reserve(size.objects);
  scene.vertices.reserve(size.vertices);
  all.for_each([&](const PlacedObject& object) { writer.add(object); });
  forget(left.vertices);
  scene.normals.reserve(size.normals);
  scene.corners.reserve(size.corners);
  all.for_each([&](const PlacedObject& object) { writer.add_shading(object); });
  BaseMeshes kept = *left.kept;
  mark_copies(kept, places);
  scene.kept = std::make_shared<const BaseMeshes>(std::move(kept));
}

Scene without_copies(const Scene& scene) {
  Scene own;
  own.spheres = scene.spheres;
  own.cones = scene.cones;
  PoolWriter writer(own);
  std::uint32_t next = 0;
  const auto add_until = [&](std::uint32_t end) {
    for (; next < end; ++next) {
      const PlacedObject object(scene, scene.objects[next], nullptr);
      writer.add(object);
      writer.add_shading(object);
    }
  };
  if (scene.kept != nullptr) {
    for (const BaseMeshInstance& place : scene.kept->places) {
      add_until(place.at);
      next += place.has_copy ? static_cast<std::uint32_t>(scene.kept->meshes[place.mesh].objects.size()) : 0;
    }
  }
  add_until(static_cast<std::uint32_t>(scene.objects.size()));
  return own;
}

}  // namespace dmpc::core
