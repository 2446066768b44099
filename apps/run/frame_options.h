// The options of frames: how many pictures of one scene, and how the camera, or what is in it, moves from one to the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/scene/camera_path.h"

namespace dmpc::apps {

/// Frames of a path, one after the other on the same nodes.
struct FrameRange {
  std::uint64_t first = 1, last = 1;

  std::uint64_t count() const { return last - first + 1; }
};

struct FrameOptions {
  std::optional<FrameRange> range;                   ///< nothing: one picture, of the scene's own view
  std::optional<double> turntable_degrees;           ///< from frame to frame
  std::optional<std::filesystem::path> camera_path;  ///< or a file of keyframes
  std::optional<std::string> animation;              ///< the scene's file plays it: that of this name; empty: its first
  double per_second = 24;                            ///< frames, where they show an animation

  /// More than one, that follow each other.
  bool are_several() const { return range && range->count() > 1; }
  /// The camera moves by more than the file's own animation.
  bool has_camera_path() const { return turntable_degrees || camera_path; }
  /// Time of a frame in an animation.
  double seconds_at(std::uint64_t frame) const { return static_cast<double>(frame - 1) / per_second; }
};

/// "24", which are frames 1 to 24, or "3..7". Throws core::UsageError for anything else, and for frames that there are not.
FrameRange parse_frames(const std::string& text);

/// Declares --frames, --turntable and --camera-path, of which one moves the camera, and --animation with --fps: by something
/// frames differ.
void add_options(OptionSet options, FrameOptions& frames);

/// Reads the path's file, if it is one. Requires frames, and has_camera_path(). Throws core::InputError as read_camera_path()
/// does, or if the path lacks one of the frames.
CameraPath camera_path_of(const FrameOptions& frames);

}  // namespace dmpc::apps
