// The scene as each frame shows it.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/frontend/system/opened_files.h"
#include "apps/run/render_options.h"
#include "apps/scene/camera_path.h"
#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// One scene for all frames, or, of an animation, one for each. Frame k's scene and view follow from the options and k alone.
class FrameScenes {
 public:
  /// Reads the camera's path, if it has one. `asked`, which outlives this: as of all frames. Throws as camera_path_of().
  explicit FrameScenes(const RenderOptions& asked);

  /// Whether frames differ in more than the camera.
  bool are_animated() const { return asked_.frames.animation.has_value(); }
  /// The first frame that there is.
  std::uint64_t first() const { return path_ ? path_->first() : 1; }

  /// Reads the scene of a frame, or, without one, of the one picture. Its view is that of the scene as it stands before anything
  /// moves, so that what else follows from a view is alike in all frames. `opened` gets all files that were read. Throws as
  /// load_scene(), of an animation with the frame's number, and core::InputError if one of the frames shows nothing.
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
  core::View own_view_, moved_view_;  ///< the latter of the frame loaded last
  std::optional<StillScene> still_;   ///< an animation's, once it is known
};

}  // namespace dmpc::apps
