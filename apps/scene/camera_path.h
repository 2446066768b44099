// The motion of a camera from frame to frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "apps/scene/scene_setup.h"
#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Frames are numbered from 1 up to this.
inline constexpr std::uint64_t frame_max = 1'000'000'000;

/// The camera at a frame; missing values are taken from the scene.
struct Keyframe {
  std::uint64_t frame = 1;
  CameraChoice camera;
};

/// Returns the point around which the camera turns: the point on its line of sight, in front of the camera, that is nearest to
/// the centre of the scene's bounds, or else the point that it looks at.
core::Vec3d pivot_of(const core::View& view, const core::Box& bounds);

/// The view of frame k depends only on k, the scene's own view and its bounds, and is computed with + - * / sqrt, so that a frame
/// is identical on every computer, alone or in a sequence.
class CameraPath {
 public:
  /// Rotates by `degrees` per frame around pivot_of() of the scene's own view and the view's up vector, anticlockwise as seen
  /// from above; frame 1 is the scene's own view. Requires |degrees| <= 360.
  static CameraPath turntable(double degrees);
  /// Interpolates the keyframes' cameras by a spline (E. Catmull, R. Rom, "A Class of Local Interpolating Splines", 1974): the
  /// slope at a keyframe is that between its neighbours. Requires ascending frames.
  explicit CameraPath(std::vector<Keyframe> keyframes);

  std::uint64_t first() const { return keyframes_.empty() ? 1 : keyframes_.front().frame; }
  std::uint64_t last() const { return keyframes_.empty() ? frame_max : keyframes_.back().frame; }
  /// Sets the scene's own view and its bounds in world coordinates. Call it before view().
  void set_scene(const core::View& own, const core::Box& bounds);
  /// Requires a frame of the path.
  core::View view(std::uint64_t frame) const;
  /// Throws core::InputError, with the frame, unless each of these frames shows something.
  void check(std::uint64_t first, std::uint64_t last) const;

 private:
  CameraPath() = default;

  core::View between(const Keyframe& key, const Keyframe& next, std::uint64_t frame) const;
  core::View turned(std::uint64_t frame) const;

  core::View own_;
  core::Vec3d pivot_;
  double degrees_ = 0;
  std::vector<Keyframe> keyframes_;  ///< empty for a turntable
};

/// Reads lines "FRAME CAMERA", such as "1 4,3,5/0,0,0/0,1,0/45", in the syntax of --camera; blank lines and text after # are
/// ignored. Throws core::InputError, with file and line, for other lines, no keyframe, frames that do not ascend, an unreadable
/// file.
CameraPath read_camera_path(const std::filesystem::path& file);

}  // namespace dmpc::apps
