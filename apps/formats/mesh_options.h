// Options for a mesh file on the command line.
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

/// Default view and lights of a file without them, at 0 seconds: otherwise they would move with the animated objects.
struct StillScene {
  BoundingSphere bounds;   ///< bounds the whole scene
  core::View view;         ///< the file's or ours
  double light_share = 1;  ///< factor for lights of its own that are too bright
};

struct AnimationMoment {
  std::string name;                 ///< name of the animation in the file; empty: the first
  double seconds = 0;               ///< from 0 on; clamped to the end
  double frames_per_second = 24;    ///< for messages about its length
  std::optional<StillScene> still;  ///< nothing: this moment is the still one
};

struct MeshOptions {
  std::optional<double> scale;           ///< factor for all coordinates; above 0; 1 if not given
  std::optional<UpAxis> up;              ///< up axis where the file has no camera; y if not given
  std::optional<Resolution> size;        ///< pixels of the picture, over which a file's camera spans its angle; the file's own
  std::optional<double> smooth_degrees;  ///< vertex normals are recomputed, over edges up to this angle; 0 to 180
  bool opens_anywhere = false;           ///< files outside the scene's folder are opened, too
  bool allows_missing = false;           ///< surfaces with missing textures have their plain colour
  Sandbox sandbox = Sandbox::available;  ///< the required confinement of the readers of the file and its textures
  /// Another view or other lights are used, so that notes about the file's are omitted.
  bool is_seen_otherwise = false, is_lit_otherwise = false, is_below_sky = false;
  bool is_below_own_sky = false;  ///< the file's own sky
  /// Emissive surfaces become lights, and metal and roughness textures are read; only path tracing shows these.
  bool is_by_paths = false;
  core::Copies copies = core::Copies::put;   ///< for meshes with several instances
  std::optional<AnimationMoment> animation;  ///< glTF only; nothing: nodes stand as the file says
};

}  // namespace dmpc::apps
