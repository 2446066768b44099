// A moment of an animation that a mesh file has.
#pragma once

#include <optional>
#include <string>

#include "apps/formats/bounding_sphere.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// What a file without a camera or lights is seen and lit by: else they would sway with what moves.
struct StillScene {
  BoundingSphere bounds;  ///< of all, at 0 seconds
  core::View view;        ///< the file's or ours, at 0 seconds
};

struct AnimationMoment {
  std::string name;                 ///< of the file's animation; empty: the first
  double seconds = 0;               ///< from 0 on; behind its end it stands still
  double frames_per_second = 24;    ///< for what is said of its length
  std::optional<StillScene> still;  ///< nothing: this moment is it
};

}  // namespace dmpc::apps
