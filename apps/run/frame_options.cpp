#include "apps/run/frame_options.h"

#include <cmath>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/option_values.h"
#include "apps/edge/line/parsed_number.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::UsageError;

double parse_degrees(const std::string& text) {
  const double degrees = finite_number(text);
  if (!(std::abs(degrees) <= 360)) {
    throw UsageError("--turntable=" + text + ": expected degrees from one frame to the next, from -360 to 360");
  }
  return degrees;
}

}  // namespace

FrameRange parse_frames(const std::string& text) {
  const std::size_t dots = text.find("..");
  const bool is_range = dots != std::string::npos;
  const auto first = is_range ? number_in<std::uint64_t>(text.substr(0, dots)) : std::uint64_t{1};
  const auto last = number_in<std::uint64_t>(is_range ? text.substr(dots + 2) : text);
  if (!first || !last || *first < 1 || *last < *first || *last > frame_max) {
    throw UsageError("--frames=" + text + ": expected how many frames, such as 24, or which, such as 3..7, of those from 1 to " +
                     grouped(frame_max));
  }
  return {*first, *last};
}

void add_options(OptionSet options, FrameOptions& frames) {
  options.begin_group("Frames");
  options.add_text(
      "--frames", "N|A..B", [&frames](const std::string& text) { frames.range = parse_frames(text); },
      "Render frames 1 to N, or A to B, one after the other on the same nodes, which keep caches and regions. Names of outputs "
      "have a place for the number, as in -o out.####.png or -o out.%04d.png. Each frame is, to the bit, what it is alone");
  options.add_text(
      "--turntable", "DEGREES", [&frames](const std::string& text) { frames.turntable_degrees = parse_degrees(text); },
      "From one frame to the next the camera goes round the scene by so much; frame 1 is the scene's own view");
  options.add_path("--camera-path", "FILE", frames.camera_path,
                   "Move the camera through the keyframes of FILE, lines of a frame and what --camera takes, such as 24 "
                   "1,2,3/0,0,0, on a spline through them");
  options.check_in_the_end([&frames] {
    const bool moves = frames.turntable_degrees || frames.camera_path;
    if (frames.turntable_degrees && frames.camera_path) {
      throw UsageError("--turntable does not go with --camera-path: the camera moves in one way");
    }
    if (frames.range && !moves) {
      throw UsageError("--frames: expected --turntable=DEGREES or --camera-path=FILE, too, by which the camera moves");
    }
    if (moves && !frames.range) {
      throw UsageError(std::string(frames.camera_path ? "--camera-path" : "--turntable") +
                       " goes with --frames, which says how many there are");
    }
  });
}

CameraPath camera_path_of(const FrameOptions& frames) {
  if (frames.turntable_degrees) {
    return CameraPath::turntable(*frames.turntable_degrees);
  }
  CameraPath path = read_camera_path(*frames.camera_path);
  if (frames.range->first < path.first() || frames.range->last > path.last()) {
    throw core::InputError(frames.camera_path->string() + ": its keyframes reach from frame " + grouped(path.first()) + " to " +
                           grouped(path.last()) + ", and --frames asks for " + grouped(frames.range->first) + " to " +
                           grouped(frames.range->last));
  }
  return path;
}

}  // namespace dmpc::apps
