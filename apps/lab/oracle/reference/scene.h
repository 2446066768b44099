// A scene in double precision for the reference renderer: flat lists, world coordinates.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/lab/oracle/reference/body.h"
#include "apps/lab/oracle/reference/texture.h"
#include "core/base/box.h"
#include "core/record/choice_node.h"
#include "core/record/emitter.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct ReferenceLight {
  core::Vec3d position;
  core::Vec3d intensity;
  core::LightSpread spread;  ///< rounded as in the product
};

/// An emitter that paths sample, and its probability.
struct ReferenceEmitter {
  std::uint32_t body;
  double chance;
};

/// Bodies are in the order of the product's primitives: objects in file order, polygons as core/scene/triangulate.h splits them.
/// The product leaves out what has no area in float; this leaves out only what has none in double. Immutable once made.
struct ReferenceScene {
  std::vector<ReferenceBody> bodies;
  std::vector<core::Vec3d> normals;    ///< smooth triangles' unit normals; 0 for none
  std::vector<ReferencePlace> places;  ///< texture coordinates of textured triangles' corners
  std::vector<ReferenceTexel> colors;  ///< vertex colours
  std::vector<core::Texture> textures;
  std::vector<core::Material> materials;
  std::vector<ReferenceLight> lights;
  core::Vec3d background, ambient;
  core::Box bounds;           ///< bounds of all bodies
  double size = 1;            ///< the largest extent of `bounds`, above 0
  bool has_emission = false;  ///< some material emits
  // These are empty unless aim_as_product() was called:
  std::vector<ReferenceEmitter> emitters;
  std::vector<core::ChoiceNode> choices;  ///< the product's tree, by which one is selected
  double emitter_density = 0;             ///< probability density of a point on an emitter, by area, over its emission

  /// Returns whether hits send light by themselves.
  bool hits_glow() const { return has_emission || !(ambient == core::Vec3d{}); }
};

/// Lights without a colour get 1 / sqrt(their number), as in the product. Requires a sky of colours without a picture.
ReferenceScene reference_scene(const core::Scene& scene);

}  // namespace dmpc::apps
