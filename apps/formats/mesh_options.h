// What the command line says about a mesh file beside its path.
#pragma once

#include <optional>
#include <string>

#include "apps/formats/bounding_sphere.h"
#include "apps/formats/resolution.h"
#include "apps/formats/up_axis.h"
#include "apps/reader/confinement.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// What a file without a camera or lights is seen and lit by: else they would sway with what moves. All at 0 seconds.
struct StillScene {
  BoundingSphere bounds;   ///< bounds the whole scene
  core::View view;         ///< the file's or ours
  double light_share = 1;  ///< by which lights of its own shine that are too bright
};

struct AnimationMoment {
  std::string name;                 ///< name of the animation in the file; empty: the first
  double seconds = 0;               ///< from 0 on; behind its end it stands still
  double frames_per_second = 24;    ///< for what is said of its length
  std::optional<StillScene> still;  ///< nothing: this moment is it
};

struct MeshOptions {
  std::optional<double> scale;           ///< all coordinates are multiplied by it; above 0; 1 if not given
  std::optional<UpAxis> up;              ///< what points up where the file has no camera; y if not given
  std::optional<Resolution> size;        ///< pixels of the picture, over which a file's camera spans its angle; the file's own
  std::optional<double> smooth_degrees;  ///< vertex normals are reckoned anew, over edges up to this angle; 0 to 180
  bool opens_anywhere = false;           ///< files that lie neither beside nor below the scene are opened, too
  bool allows_missing = false;           ///< what files that are missing would cover is shown in its plain colour
  Sandbox sandbox = Sandbox::available;  ///< what the readers of the file and of its textures have to be confined by
  /// Another view is taken, or other lights, so that nothing is said of the file's.
  bool is_seen_otherwise = false, is_lit_otherwise = false, is_below_sky = false;
  bool is_below_own_sky = false;  ///< the sky that the file says itself
  /// Emissive surfaces become lights, and metal and roughness textures are read; only path tracing shows these.
  bool is_by_paths = false;
  core::Copies copies = core::Copies::put;   ///< for meshes with several instances
  std::optional<AnimationMoment> animation;  ///< glTF only; nothing: nodes stand as the file says
};

}  // namespace dmpc::apps
