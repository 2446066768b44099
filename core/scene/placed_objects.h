// All objects of a scene with each copy of its base meshes, which the scene may have or leave out.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec.h"
#include "core/scene/base_meshes.h"
#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// Places all objects of a mesh by an instance, world to world: the only code that makes copies.
class CopyPlacing {
 public:
  explicit CopyPlacing(const Transform& world)
      : world_(&world), normals_(world.of_normals()), is_mirrored_(world.determinant() < 0) {}

  /// The corner of the mesh's object that becomes the i-th.
  std::uint32_t corner(const Object& object, std::uint32_t i) const {
    return placed_corner(is_mirrored_, object.vertex_count, i);
  }
  /// To a point, line or plane: then there are no normals.
  bool presses_flat() const { return world_->determinant() == 0; }
  Vec3d point(const Vec3d& of_mesh) const { return world_->point(of_mesh); }
  Vec3d normal(const Vec3d& of_mesh) const { return normals_.direction(of_mesh); }

 private:
  const Transform* world_;
  Transform normals_;
  bool is_mirrored_;
};

/// An object in the scene. Refers to the scene, and to the placing if it is a copy.
class PlacedObject {
 public:
  PlacedObject(const Scene& pools, const Object& object, const CopyPlacing* placing)
      : pools_(&pools), object_(&object), placing_(placing) {}

  /// Its `first` and `first_normal` refer to pools().
  const Object& object() const { return *object_; }
  /// The scene's own or, for a copy that is left out, the mesh's.
  const Scene& pools() const { return *pools_; }

  Vec3d vertex(std::uint32_t i) const {
    const Vec3d& own = pools_->vertices[object_->first + of_mesh(i)];
    return placing_ == nullptr ? own : placing_->point(own);
  }
  /// For a patch.
  Vec3d normal(std::uint32_t i) const {
    const Vec3d& own = pools_->normals[object_->first_normal + of_mesh(i)];
    return placing_ == nullptr ? own : placing_->normal(own);
  }
  /// For a textured patch.
  TexturedCorner corner(std::uint32_t i) const {
    TexturedCorner own = pools_->corners[object_->first_normal + of_mesh(i)];
    if (placing_ != nullptr && !(own.normal == Vec3d{} && is_flat())) {
      own.normal = placing_->normal(own.normal);
    }
    return own;
  }

 private:
  std::uint32_t of_mesh(std::uint32_t i) const { return placing_ == nullptr ? i : placing_->corner(*object_, i); }
  bool is_flat() const {
    bool is = true;
    for (std::uint32_t i = 0; i < object_->vertex_count; ++i) {
      is = is && pools_->corners[object_->first_normal + i].normal == Vec3d{};
    }
    return is;
  }

  const Scene* pools_;
  const Object* object_;
  const CopyPlacing* placing_;
};

/// Whether some copies of base meshes are left out of the scene's objects.
bool leaves_copies_out(const Scene& scene);

/// All of a scene's objects by the indices that they have with all copies. They have the same bits if the scene leaves copies
/// out. The scene must outlive it.
class PlacedObjects {
 public:
  explicit PlacedObjects(const Scene& scene);
  /// Includes only the left out copies of these instances, one entry for each of Scene::kept.
  PlacedObjects(const Scene& scene, const std::vector<bool>& places);

  std::uint64_t size() const { return count_; }

  /// Calls `take` with every `stride`-th object, a PlacedObject each, from the first on in the file's order. Requires that
  /// `stride` is above 0.
  template <class Take>
  void for_each(const Take& take, std::uint64_t stride = 1) const {
    std::uint64_t next = 0;
    for (const Run& run : runs_) {
      if (next >= run.end) {
        continue;
      }
      if (run.place == nullptr) {
        for (; next < run.end; next += stride) {
          take(PlacedObject(scene_, scene_.objects[run.own + (next - run.first)], nullptr));
        }
      } else {
        const Scene& mesh = scene_.kept->meshes[run.place->mesh];
        const CopyPlacing placing(run.place->world);
        for (; next < run.end; next += stride) {
          take(PlacedObject(mesh, mesh.objects[next - run.first], &placing));
        }
      }
    }
  }

 private:
  /// Objects from `first` to before `end`: of an instance or, if that is null, the scene's own from `own` on.
  struct Run {
    std::uint64_t first, end;
    std::size_t own;
    const BaseMeshInstance* place;
  };
  void add_own(std::size_t until);
  void add_place(const BaseMeshInstance& place);

  const Scene& scene_;
  std::vector<Run> runs_;
  std::uint64_t count_ = 0;
  std::size_t own_ = 0;  ///< number of the scene's objects in runs
};

/// The number of a scene's objects with all copies.
std::uint64_t object_count(const Scene& scene);

/// The size of a scene's pools with all copies.
ExpandedSize size_with_copies(const Scene& scene);
/// With copies for these instances, one entry for each of Scene::kept, in addition to those that it has.
ExpandedSize size_with_copies(const Scene& scene, const std::vector<bool>& places);

/// Adds the copies of base meshes that are left out: then the scene is the result of expand(). Others stay as they are. Throws
/// CapacityError if pools outgrow 32 bits.
void put_copies(Scene& scene);
/// For these instances only, one entry for each of Scene::kept.
void put_copies(Scene& scene, const std::vector<bool>& places);

/// Only the objects, and their pools, that are no copies of base meshes, as in a scene that leaves copies out.
Scene without_copies(const Scene& scene);

}  // namespace dmpc::core
