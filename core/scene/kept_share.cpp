#include "core/scene/kept_share.h"

#include <vector>

#include "core/record/instance.h"
#include "core/scene/kept_meshes.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {

static_assert(beside_places_max == 1U << (3U * levels_above_instances));

namespace {

std::uint64_t primitives_of(const Scene& scene) {
  const std::uint64_t round = scene.spheres.size() + scene.cones.size(), polygons = scene.objects.size() - round;
  return scene.vertices.size() - 2 * polygons + round;
}

}  // namespace

KeptShare kept_share(const Scene& scene) {
  constexpr std::uint64_t corners_of_a_place = 6;
  KeptShare share{.seen = size_with_copies(scene).vertices};
  if (scene.kept == nullptr) {
    share.stored = scene.vertices.size();
    share.own = primitives_of(scene);
    return share;
  }
  const KeptMeshes& kept = *scene.kept;
  std::vector<bool> are_kept;
  for (const Scene& mesh : kept.meshes) {
    are_kept.push_back(mesh.vertices.size() <= 3 * kept_triangles_max && !shines(mesh, scene.materials));
    share.stored += are_kept.back() ? mesh.vertices.size() : 0;
  }
  share.stored += scene.vertices.size();
  share.own = primitives_of(scene);
  for (const KeptPlace& place : kept.places) {
    const Scene& mesh = kept.meshes[place.mesh];
    share.stored += are_kept[place.mesh] ? corners_of_a_place : mesh.vertices.size();
    share.own += are_kept[place.mesh] ? 0 : primitives_of(mesh);
    if (place.has_copy) {
      share.stored -= mesh.vertices.size();
      share.own -= primitives_of(mesh);
    }
  }
  share.places = kept.places.size();
  return share;
}

}  // namespace dmpc::core
