// The scene of each frame.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/frontend/system/opened_files.h"
#include "apps/run/render_options.h"
#include "apps/scene/camera_path.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// One scene for all frames, or, for an animation, one per frame. Frame k's scene and view depend on the options and k alone.
class FrameScenes {
 public:
  /// Reads the camera's path, if there is one. `asked` holds for all frames, and outlives this. Throws as camera_path_of().
  explicit FrameScenes(const RenderOptions& asked);

  /// Whether frames differ in more than the camera.
  bool are_animated() const { return asked_.frames.animation.has_value(); }
  /// The number of the first frame.
  std::uint64_t first() const { return path_ ? path_->first() : 1; }

  /// Reads the scene of a frame, or, without one, of the single picture. Its view is that of the still scene, so that everything
  /// derived from a view is the same in all frames. `opened` gets all files that were read. Throws as load_scene(), for an
  /// animation with the frame's number, and core::InputError if one of the frames shows nothing.
  core::Scene load(std::optional<std::uint64_t> frame, OpenedFiles& opened);

  /// After load() of this frame.
  core::View view(std::optional<std::uint64_t> frame) const {
    return frame && path_ ? path_->view(*frame) : are_animated() ? moved_view_ : own_view_;
  }

 private:
  core::Scene load_still(OpenedFiles& opened);
  core::Scene load_at(double seconds, OpenedFiles& opened, StillScene* still);

  const RenderOptions& asked_;
  std::optional<CameraPath> path_;
  core::View own_view_, moved_view_;  ///< the latter is that of the frame loaded last
  std::optional<StillScene> still_;   ///< an animation's, once it is known
};

}  // namespace dmpc::apps
