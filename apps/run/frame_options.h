// The options of frames: the number of pictures of one scene, and the motion of the camera or of objects between them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/scene/camera_path.h"

namespace dmpc::apps {

/// Frames of a path, rendered in order on the same nodes.
struct FrameRange {
  std::uint64_t first = 1, last = 1;

  std::uint64_t count() const { return last - first + 1; }
};

struct FrameOptions {
  std::optional<FrameRange> range;                   ///< without it: one picture, from the scene's own view
  std::optional<double> turntable_degrees;           ///< rotation from frame to frame
  std::optional<std::filesystem::path> camera_path;  ///< file of keyframes, as an alternative
  std::optional<std::string> animation;              ///< name of the animation in the scene's file; empty: the first
  double per_second = 24;                            ///< frames per second of an animation

  /// Returns whether there is more than one frame.
  bool are_several() const { return range && range->count() > 1; }
  /// Returns whether anything besides the file's own animation moves the camera.
  bool has_camera_path() const { return turntable_degrees || camera_path; }
  /// Returns the time of a frame in an animation.
  double seconds_at(std::uint64_t frame) const { return static_cast<double>(frame - 1) / per_second; }
};

/// Parses "24" for frames 1 to 24, or "3..7". Throws core::UsageError for anything else, and for frames out of range.
FrameRange parse_frames(const std::string& text);

/// Declares --frames, --turntable, --camera-path (not with --turntable), --animation and --fps. Frames must differ in something.
void add_options(OptionSet options, FrameOptions& frames);

/// Reads the path's file, if there is one. Requires frames, and has_camera_path(). Throws core::InputError as read_camera_path()
/// does, or if the path lacks one of the frames.
CameraPath camera_path_of(const FrameOptions& frames);

}  // namespace dmpc::apps
