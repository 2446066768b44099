#include "core/scene/instances.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

#include "core/base/ranges.h"
#include "core/scene/base_meshes.h"
#include "core/scene/face_normals.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {
namespace {

ExpandedSize size_of(const Object& object) {
  const std::uint64_t vertices = object.vertex_count;
  return {1, vertices, object.kind == ObjectKind::patch ? vertices : 0, object.kind == ObjectKind::textured ? vertices : 0};
}

ExpandedSize size_of(std::span<const Object> objects) {
  ExpandedSize size;
  for (const Object& object : objects) {
    size = size + size_of(object);
  }
  return size;
}

std::uint64_t triangle_count(std::span<const Object> objects) {
  return sum_over<std::uint64_t>(objects, [&](const Object& object) { return object.vertex_count - std::uint64_t{2}; });
}

/// Which meshes become base meshes: large ones with several instances that allow it.
std::vector<bool> base_meshes(const Scene& scene, const Instances& instances) {
  std::vector<std::uint64_t> uses(instances.meshes.size());
  for (const Instance& place : instances.places) {
    uses[place.mesh] += can_be_instanced(place.world) ? 1 : 0;
  }
  std::vector<bool> kept;
  const std::span<const Object> objects(scene.objects);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const SharedMesh& mesh = instances.meshes[i];
    kept.push_back(uses[i] > 1 && triangle_count(objects.subspan(mesh.first, mesh.end - mesh.first)) > copied_triangles_max);
  }
  return kept;
}

/// With all instances of which `counts` is true.
template <class Counts>
ExpandedSize size_with(const Scene& scene, const Instances& instances, const Counts& counts) {
  std::vector<ExpandedSize> meshes;
  ExpandedSize size;
  std::size_t next = 0;
  const std::span<const Object> objects(scene.objects);
  for (const SharedMesh& mesh : instances.meshes) {
    size = size + size_of(objects.subspan(next, mesh.first - next));
    meshes.push_back(size_of(objects.subspan(mesh.first, mesh.end - mesh.first)));
    next = mesh.end;
  }
  size = size + size_of(objects.subspan(next));
  for (const Instance& place : instances.places) {
    size = size + (counts(place) ? meshes[place.mesh] : ExpandedSize{});
  }
  return size;
}

constexpr std::uint32_t nowhere = 0xffffffffU;

/// Extracts a mesh from a scene, and decides on its normals: where they equal those of the faces, object and mesh have none.
class MeshTaker {
 public:
  explicit MeshTaker(Scene& scene) : scene_(scene) {}

  Scene take(const SharedMesh& shared) {
    Scene mesh;
    mesh.coordinate_rounding = scene_.coordinate_rounding;
    for (std::uint32_t i = shared.first; i < shared.end; ++i) {
      Object& object = scene_.objects[i];
      drop_the_faces_own(object);
      Object own = object;
      append(own.first, mesh.vertices, std::span<const Vec3d>(scene_.vertices), object.first, object.vertex_count);
      if (object.kind == ObjectKind::patch) {
        append(own.first_normal, mesh.normals, std::span<const Vec3d>(scene_.normals), object.first_normal, object.vertex_count);
      } else if (object.kind == ObjectKind::textured) {
        append(own.first_normal, mesh.corners, std::span<const TexturedCorner>(scene_.corners), object.first_normal,
               object.vertex_count);
      }
      mesh.objects.push_back(own);
    }
    return mesh;
  }

 private:
  template <class T>
  static void append(std::uint32_t& first, std::vector<T>& pool, std::span<const T> from, std::uint32_t begin,
                     std::uint32_t count) {
    first = static_cast<std::uint32_t>(pool.size());
    const auto some = from.subspan(begin, count);
    pool.insert(pool.end(), some.begin(), some.end());
  }

  void drop_the_faces_own(Object& object) const {
    const auto vertices = std::span(scene_.vertices).subspan(object.first, object.vertex_count);
    if (object.kind == ObjectKind::patch) {
      if (are_the_faces_own(std::span(scene_.normals).subspan(object.first_normal, object.vertex_count), vertices)) {
        object.kind = ObjectKind::polygon;
        object.first_normal = 0;
      }
    } else if (object.kind == ObjectKind::textured) {
      const auto corners = std::span(scene_.corners).subspan(object.first_normal, object.vertex_count);
      std::vector<Vec3d> normals;
      std::transform(corners.begin(), corners.end(), std::back_inserter(normals),
                     [](const TexturedCorner& corner) { return corner.normal; });
      if (are_the_faces_own(normals, vertices)) {
        std::for_each(corners.begin(), corners.end(), [](TexturedCorner& corner) { corner.normal = {}; });
      }
    }
  }

  Scene& scene_;
};

/// Pools are processed one after the other, so that only one exists twice at a time. Copies of base meshes are left out.
class Expansion {
 public:
  Expansion(Scene& scene, const Instances& instances) : scene_(scene), instances_(instances) {}

  /// Returns the base meshes.
  BaseMeshes run() {
    const ExpandedSize size = settled_size(scene_, instances_, Copies::left_out);
    size.check();
    ExpandedSize{.objects = expanded_size(scene_, instances_).objects}.check();
    keep_meshes();
    old_ = std::exchange(scene_.objects, {});
    scene_.objects.reserve(size.objects);
    expand_vertices(size.vertices);
    expand_shading(size);
    scene_.objects.shrink_to_fit();
    return std::move(kept_);
  }

 private:
  /// While the objects still have all that the meshes need.
  void keep_meshes() {
    const std::vector<bool> are_instanced = base_meshes(scene_, instances_);
    stored_as_.assign(are_instanced.size(), nowhere);
    MeshTaker recipient(scene_);
    for (std::size_t i = 0; i < are_instanced.size(); ++i) {
      if (are_instanced[i]) {
        stored_as_[i] = static_cast<std::uint32_t>(kept_.meshes.size());
        kept_.meshes.push_back(recipient.take(instances_.meshes[i]));
      }
    }
  }

  /// In order, calls `own` with each object that is not in an instance, `placed` with each object of an instance and its
  /// CopyPlacing, and `left` with each instance of a base mesh and the mesh's index.
  template <class Left, class Own, class Placed>
  void for_each(const Left& left, const Own& own, const Placed& placed) const {
    auto place = instances_.places.begin();
    auto mesh = instances_.meshes.begin();
    for (std::size_t i = 0; i <= old_.size();) {
      for (; place != instances_.places.end() && place->before <= i; ++place) {
        if (stored_as_[place->mesh] != nowhere && can_be_instanced(place->world)) {
          left(*place, stored_as_[place->mesh]);
          continue;
        }
        const SharedMesh& shared = instances_.meshes[place->mesh];
        const CopyPlacing placing(place->world);
        for (std::size_t object = shared.first; object < shared.end; ++object) {
          placed(old_[object], placing);
        }
      }
      if (mesh != instances_.meshes.end() && mesh->first == i) {
        i = mesh++->end;
        continue;
      }
      if (i < old_.size()) {
        own(old_[i]);
      }
      ++i;
    }
  }

  void expand_vertices(std::uint64_t count) {
    const std::vector<Vec3d> old = std::exchange(scene_.vertices, {});
    std::vector<Vec3d>& all = scene_.vertices;
    all.reserve(count);
    std::uint32_t left_objects = 0;
    const auto add = [&](Object object) {
      if (object.vertex_count > 0) {
        object.first = static_cast<std::uint32_t>(all.size());
      }
      scene_.objects.push_back(object);
    };
    for_each(
        [&](const Instance& place, std::uint32_t mesh) {
          const auto at = static_cast<std::uint32_t>(scene_.objects.size());
          kept_.places.push_back({.world = place.world, .mesh = mesh, .first = at + left_objects, .at = at});
          left_objects += static_cast<std::uint32_t>(kept_.meshes[mesh].objects.size());
        },
        [&](const Object& object) {
          add(object);
          const auto corners = std::span(old).subspan(object.first, object.vertex_count);
          all.insert(all.end(), corners.begin(), corners.end());
        },
        [&](const Object& object, const CopyPlacing& placing) {
          add(object);
          for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
            all.push_back(placing.point(old[object.first + placing.corner(object, i)]));
          }
        });
  }

  /// Normals, corners, and the resulting kind of each object.
  void expand_shading(const ExpandedSize& size) {
    const std::vector<Vec3d> normals = std::exchange(scene_.normals, {});
    const std::vector<TexturedCorner> corners = std::exchange(scene_.corners, {});
    scene_.normals.reserve(size.normals);
    scene_.corners.reserve(size.corners);
    std::size_t next = 0;
    for_each([](const Instance&, std::uint32_t) {},
             [&](const Object& object) {
               Object& result = scene_.objects[next++];
               if (object.kind == ObjectKind::patch) {
                 append(result, scene_.normals, std::span(normals).subspan(object.first_normal, object.vertex_count));
               } else if (object.kind == ObjectKind::textured) {
                 append(result, scene_.corners, std::span(corners).subspan(object.first_normal, object.vertex_count));
               }
             },
             [&](const Object& object, const CopyPlacing& placing) {
               Object& result = scene_.objects[next++];
               if (object.kind == ObjectKind::patch) {
                 place_patch(result, object, placing, normals);
               } else if (object.kind == ObjectKind::textured) {
                 place_textured(result, object, placing, corners);
               }
             });
  }

  template <class T>
  static void append(Object& object, std::vector<T>& pool, std::span<const T> more) {
    object.first_normal = static_cast<std::uint32_t>(pool.size());
    pool.insert(pool.end(), more.begin(), more.end());
  }

  /// Fills placed_ by `normal(i)`, or leaves it empty where `result` looks the same without normals.
  template <class Normal>
  void place_normals(const Object& result, const CopyPlacing& placing, const Normal& normal) {
    placed_.clear();
    if (placing.presses_flat()) {
      return;
    }
    bool is_flat = true;
    for (std::uint32_t i = 0; i < result.vertex_count; ++i) {
      const Vec3d& before = normal(placing.corner(result, i));
      is_flat = is_flat && before == Vec3d{};
      placed_.push_back(placing.normal(before));
    }
    if (is_flat || are_the_faces_own(placed_, std::span(scene_.vertices).subspan(result.first, result.vertex_count))) {
      placed_.clear();
    }
  }

  void place_patch(Object& result, const Object& object, const CopyPlacing& placing, const std::vector<Vec3d>& normals) {
    place_normals(result, placing, [&](std::uint32_t i) -> const Vec3d& { return normals[object.first_normal + i]; });
    if (placed_.empty()) {
      result.kind = ObjectKind::polygon;
      result.first_normal = 0;
    } else {
      append(result, scene_.normals, std::span<const Vec3d>(placed_));
    }
  }

  void place_textured(Object& result, const Object& object, const CopyPlacing& placing,
                      const std::vector<TexturedCorner>& corners) {
    place_normals(result, placing, [&](std::uint32_t i) -> const Vec3d& { return corners[object.first_normal + i].normal; });
    result.first_normal = static_cast<std::uint32_t>(scene_.corners.size());
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
      const TexturedCorner& before = corners[object.first_normal + placing.corner(object, i)];
      scene_.corners.push_back({placed_.empty() ? Vec3d{} : placed_[i], before.place});
    }
  }

  Scene& scene_;
  const Instances& instances_;
  std::vector<Object> old_;
  std::vector<std::uint32_t> stored_as_;  ///< by mesh
  BaseMeshes kept_;
  std::vector<Vec3d> placed_;  ///< the normals of one object
};

}  // namespace

ExpandedSize expanded_size(const Scene& scene, const Instances& instances) {
  return size_with(scene, instances, [](const Instance&) { return true; });
}

ExpandedSize settled_size(const Scene& scene, const Instances& instances, Copies copies) {
  if (copies == Copies::put) {
    return expanded_size(scene, instances);
  }
  const std::vector<bool> are_instanced = base_meshes(scene, instances);
  return size_with(scene, instances,
                   [&](const Instance& place) { return !are_instanced[place.mesh] || !can_be_instanced(place.world); });
}

void leave(Scene& scene, const Instances& instances) {
  BaseMeshes kept = Expansion(scene, instances).run();
  if (!kept.places.empty()) {
    scene.kept = std::make_shared<const BaseMeshes>(std::move(kept));
  }
}

void expand(Scene& scene, const Instances& instances) {
  expanded_size(scene, instances).check();
  leave(scene, instances);
  put_copies(scene);
}

void settle(Scene& scene, const Instances& instances, Copies copies) {
  copies == Copies::put ? expand(scene, instances) : leave(scene, instances);
}

}  // namespace dmpc::core
