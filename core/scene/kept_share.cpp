#include "core/scene/kept_share.h"

#include "core/scene/kept_meshes.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {

KeptShare kept_share(const Scene& scene) {
  constexpr std::uint64_t corners_of_a_place = 6;
  KeptShare share{.seen = size_with_copies(scene).vertices, .stored = scene.vertices.size()};
  if (scene.kept == nullptr) {
    return share;
  }
  const KeptMeshes& kept = *scene.kept;
  for (const Scene& mesh : kept.meshes) {
    share.stored += mesh.vertices.size();
  }
  for (const KeptPlace& place : kept.places) {
    share.stored -= place.has_copy ? kept.meshes[place.mesh].vertices.size() : 0;
  }
  share.places = kept.places.size();
  share.stored += corners_of_a_place * share.places;
  return share;
}

}  // namespace dmpc::core
