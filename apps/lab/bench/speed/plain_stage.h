// The scene for plain renderers: Embree's tree, and the camera, materials, lights and emitters in single precision.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/lab/bench/speed/embree_tree.h"
#include "apps/scene/subject.h"
#include "core/base/vec.h"
#include "core/record/choice_node.h"
#include "core/record/emitter.h"
#include "core/record/record.h"

namespace dmpc::apps {

/// As in core/picture/shade.cpp: the offset of a ray's start from a surface, and the end of a ray to a light.
inline constexpr float plain_offset = 0x1p-21F, plain_light_end = 1 - 1e-6F;
/// End of a shadow ray to an emitter, as a share of its length, so that the emitter does not hide itself.
inline constexpr float plain_emitter_end = 1 - 1e-4F;
/// Side of the tiles that threads take, in pixels.
inline constexpr int plain_tile_side = 16;

/// The camera in double precision.
struct PlainCamera {
  core::Vec3d eye, corner, right, down;  ///< from the eye to the first pixel; from a pixel to the next

  explicit PlainCamera(const core::Camera& camera);
  /// Returns a unit vector.
  template <class T>
  core::Vec3<T> towards(T x, T y) const {
    return normalize(core::Vec3<T>(corner) + core::Vec3<T>(right) * x + core::Vec3<T>(down) * y);
  }
};

/// Replaces highlight and mirror for a microfacet surface.
struct PlainFacets {
  float metallic = 0, alpha = 1, reflectance = 0;
  float there = 1;  ///< the share of the surface that is present
};

/// A surface with its material extension. A picture in which alpha matters is textured, and is not compared.
struct PlainMaterial : core::MaterialRecord {
  core::Color highlight;  ///< colour that `mirror` reflects
  float mirror = 1;
  core::Color emission;
  PlainFacets facets;

  explicit PlainMaterial(const core::MaterialRecord& record)
      : core::MaterialRecord(record), highlight{specular, specular, specular} {}
  void add(const core::MaterialExtensionRecord& finish);
  void add(const core::MicrofacetRecord& finish);
  bool is_glossy() const { return !(highlight == core::Color{}); }
  float inside_index() const { return refraction_index > 0 ? refraction_index : 1; }
};

struct PlainSurface {
  core::Vec3f point;
  core::Vec3f geometric_normal, normal;  ///< unit vectors; `normal` is the shading normal, on the ray's side
  std::uint32_t material = 0;
  bool is_leaving = false;
  bool is_curved = false;
  core::Vec3d exact_point, exact_normal;  ///< of a curved surface
  float radius = 0;                       ///< spheres only
};

/// Immutable; every call is thread-safe.
class PlainStage {
 public:
  /// Builds the robust tree, of high quality, on all cores. `subject` outlives it.
  explicit PlainStage(const Subject& subject);

  const EmbreeTree& tree() const { return tree_; }
  const PlainCamera& camera() const { return camera_; }
  const core::RenderSettings& settings() const { return settings_; }
  const std::vector<PlainMaterial>& materials() const { return materials_; }
  const std::vector<core::LightRecord>& lights() const { return lights_; }
  /// The emitters that paths sample, and the tree by which one is selected.
  const std::vector<core::EmitterRecord>& emitters() const { return emitters_; }
  const std::vector<core::ChoiceNode>& choices() const { return choices_; }
  /// Whether there are spheres or cones.
  bool is_curved() const { return !tree_.shapes().quadrics.empty(); }
  bool is_triangle(unsigned geometry) const { return geometry == 0 && !tree_.shapes().triangles.empty(); }
  /// Returns the normals of a triangle in Embree's numbering; nullptr if it is flat.
  const core::PatchNormals* normals_of(unsigned triangle) const {
    const core::ShadingReference shading = shading_[triangle];
    return shading.is_smooth() ? reinterpret_cast<const core::PatchNormals*>(records_.find(shading.normals())) : nullptr;
  }
  /// Returns the material of a flat triangle; others have it with their normals.
  std::uint32_t flat_material_of(unsigned triangle) const { return shading_[triangle].material(); }
  /// Returns the surface where a ray hits a sphere or cone in Embree's numbering.
  PlainSurface curved_at(unsigned curved, const core::Vec3d& origin, const core::Vec3d& direction, float t) const;

 private:
  const core::RenderSettings& settings_;
  core::LocalRecords records_;
  EmbreeTree tree_;
  PlainCamera camera_;
  std::vector<PlainMaterial> materials_;
  std::vector<core::LightRecord> lights_;
  std::vector<core::EmitterRecord> emitters_;
  std::vector<core::ChoiceNode> choices_;
  std::vector<core::ShadingReference> shading_;  ///< per triangle, then per curved surface
};

}  // namespace dmpc::apps
