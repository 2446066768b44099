#include "core/scene/instances.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/base/expect.h"
#include "core/scene/face_normals.h"

namespace dmpc::core {
namespace {

constexpr std::uint64_t count_max = std::uint64_t{1} << 48U;

ExpandedSize plus(const ExpandedSize& a, const ExpandedSize& b) {
  const auto sum = [](std::uint64_t x, std::uint64_t y) { return std::min(x + y, count_max); };
  return {sum(a.objects, b.objects), sum(a.vertices, b.vertices), sum(a.normals, b.normals), sum(a.corners, b.corners)};
}

ExpandedSize size_of(const Object& object) {
  const std::uint64_t vertices = object.vertex_count;
  return {1, vertices, object.kind == ObjectKind::patch ? vertices : 0, object.kind == ObjectKind::textured ? vertices : 0};
}

ExpandedSize size_of(std::span<const Object> objects) {
  ExpandedSize size;
  for (const Object& object : objects) {
    size = plus(size, size_of(object));
  }
  return size;
}

void check(const ExpandedSize& size) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - std::uint64_t{1};
  if (std::max({size.objects, size.vertices, size.normals, size.corners}) > most) {
    throw RoomError("with every instance the scene has more than 4294967294 vertices, normals or objects; divide it");
  }
}

/// What an instance does to every object of its mesh.
struct Placing {
  explicit Placing(const Transform& to_world)
      : world(to_world), normals(to_world.of_normals()), determinant(to_world.determinant()) {}

  /// Which of an object's corners becomes the i-th.
  std::uint32_t corner(const Object& object, std::uint32_t i) const { return determinant < 0 ? object.vertex_count - 1 - i : i; }

  const Transform& world;
  Transform normals;
  double determinant;
};

/// One pool after the other, so that but one is there twice at a time.
class Expansion {
 public:
  Expansion(Scene& scene, const Instances& instances) : scene_(scene), instances_(instances) {}

  void run() {
    const ExpandedSize size = expanded_size(scene_, instances_);
    check(size);
    old_ = std::exchange(scene_.objects, {});
    scene_.objects.reserve(size.objects);
    expand_vertices(size.vertices);
    expand_shading(size);
    scene_.objects.shrink_to_fit();
  }

 private:
  /// Calls `own` with each object that stands where it is, and `placed` with each of an instance's and its Placing, in order.
  template <class Own, class Placed>
  void for_each(const Own& own, const Placed& placed) const {
    auto place = instances_.places.begin();
    auto mesh = instances_.meshes.begin();
    for (std::size_t i = 0; i <= old_.size();) {
      for (; place != instances_.places.end() && place->before <= i; ++place) {
        const SharedMesh& shared = instances_.meshes[place->mesh];
        const Placing placing(place->world);
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
    const auto add = [&](Object object) {
      object.first = static_cast<std::uint32_t>(all.size());
      scene_.objects.push_back(object);
    };
    for_each(
        [&](const Object& object) {
          add(object);
          const auto corners = std::span(old).subspan(object.first, object.vertex_count);
          all.insert(all.end(), corners.begin(), corners.end());
        },
        [&](const Object& object, const Placing& placing) {
          add(object);
          for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
            all.push_back(placing.world.point(old[object.first + placing.corner(object, i)]));
          }
        });
  }

  /// Normals, corners, and of which kind an object is with them.
  void expand_shading(const ExpandedSize& size) {
    const std::vector<Vec3d> normals = std::exchange(scene_.normals, {});
    const std::vector<TexturedCorner> corners = std::exchange(scene_.corners, {});
    scene_.normals.reserve(size.normals);
    scene_.corners.reserve(size.corners);
    std::size_t next = 0;
    for_each(
        [&](const Object& object) {
          Object& result = scene_.objects[next++];
          if (object.kind == ObjectKind::patch) {
            append(result, scene_.normals, std::span(normals).subspan(object.first_normal, object.vertex_count));
          } else if (object.kind == ObjectKind::textured) {
            append(result, scene_.corners, std::span(corners).subspan(object.first_normal, object.vertex_count));
          }
        },
        [&](const Object& object, const Placing& placing) {
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

  /// Fills placed_ by `normal(i)`, or leaves it empty where `result` looks the same without.
  template <class Normal>
  void place_normals(const Object& result, const Placing& placing, const Normal& normal) {
    placed_.clear();
    if (placing.determinant == 0) {
      return;
    }
    bool is_flat = true;
    for (std::uint32_t i = 0; i < result.vertex_count; ++i) {
      const Vec3d& before = normal(placing.corner(result, i));
      is_flat = is_flat && before == Vec3d{};
      placed_.push_back(placing.normals.direction(before));
    }
    if (is_flat || are_the_faces_own(placed_, std::span(scene_.vertices).subspan(result.first, result.vertex_count))) {
      placed_.clear();
    }
  }

  void place_patch(Object& result, const Object& object, const Placing& placing, const std::vector<Vec3d>& normals) {
    place_normals(result, placing, [&](std::uint32_t i) -> const Vec3d& { return normals[object.first_normal + i]; });
    if (placed_.empty()) {
      result.kind = ObjectKind::polygon;
      result.first_normal = 0;
    } else {
      append(result, scene_.normals, std::span<const Vec3d>(placed_));
    }
  }

  void place_textured(Object& result, const Object& object, const Placing& placing, const std::vector<TexturedCorner>& corners) {
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
  std::vector<Vec3d> placed_;  ///< the normals of one object
};

}  // namespace

ExpandedSize expanded_size(const Scene& scene, const Instances& instances) {
  std::vector<ExpandedSize> meshes;
  ExpandedSize size;
  std::size_t next = 0;
  const std::span<const Object> objects(scene.objects);
  for (const SharedMesh& mesh : instances.meshes) {
    size = plus(size, size_of(objects.subspan(next, mesh.first - next)));
    meshes.push_back(size_of(objects.subspan(mesh.first, mesh.end - mesh.first)));
    next = mesh.end;
  }
  size = plus(size, size_of(objects.subspan(next)));
  for (const Instance& place : instances.places) {
    size = plus(size, meshes[place.mesh]);
  }
  return size;
}

void expand(Scene& scene, const Instances& instances) { Expansion(scene, instances).run(); }

}  // namespace dmpc::core
