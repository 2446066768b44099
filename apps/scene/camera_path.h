// The motion of a camera from frame to frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "apps/scene/scene_setup.h"
#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Frames are numbered from 1 on, up to this.
inline constexpr std::uint64_t frame_max = 1'000'000'000;

/// The camera at a frame; missing values are the scene's.
struct Keyframe {
  std::uint64_t frame = 1;
  CameraChoice camera;
};

/// The point around which the camera turns: the point on its line of sight, before the camera, that is nearest to the middle of
/// the scene's bounds, or else the point that it looks at.
core::Vec3d pivot_of(const core::View& view, const core::Box& bounds);

/// Frame k's view depends on k, the scene's own view and its bounds alone, by + - * / sqrt, so that a frame is the same on every
/// computer, alone or in a sequence.
class CameraPath {
 public:
  /// Turns around the scene: around pivot_of() of the scene's own view and the view's up, anticlockwise as seen from above, by
  /// `degrees` from each frame to the next; frame 1 is the scene's own view. Requires |degrees| <= 360.
  static CameraPath turntable(double degrees);
  /// The keyframes' cameras, and between them a spline through all of them (E. Catmull, R. Rom, "A Class of Local Interpolating
  /// Splines", 1974): the slope at a keyframe is that between its neighbours. Requires ascending frames.
  explicit CameraPath(std::vector<Keyframe> keyframes);

  std::uint64_t first() const { return keyframes_.empty() ? 1 : keyframes_.front().frame; }
  std::uint64_t last() const { return keyframes_.empty() ? frame_max : keyframes_.back().frame; }
  /// Sets the scene's own view and, in world coordinates, its bounds. To be called before view().
  void set_scene(const core::View& own, const core::Box& bounds);
  /// Requires a frame of the path.
  core::View view(std::uint64_t frame) const;
  /// Throws core::InputError, with the frame, unless each of these shows something.
  void check(std::uint64_t first, std::uint64_t last) const;

 private:
  CameraPath() = default;

  core::View between(const Keyframe& key, const Keyframe& next, std::uint64_t frame) const;
  core::View turned(std::uint64_t frame) const;

  core::View own_;
  core::Vec3d pivot_;
  double degrees_ = 0;
  std::vector<Keyframe> keyframes_;  ///< none: a turntable
};

/// Reads a file of lines "FRAME CAMERA", such as "1 4,3,5/0,0,0/0,1,0/45", the camera as for --camera; blank lines and text
/// behind # are ignored. Throws core::InputError with file and line for anything else, no keyframe, frames that do not ascend,
/// and a file that cannot be read.
CameraPath read_camera_path(const std::filesystem::path& file);

}  // namespace dmpc::apps
