#include "apps/run/frame_options.h"

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/parsed_number.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::UsageError;

double parse_degrees(const std::string& text) {
  return parse_within(text, "--turntable", -360, 360, "degrees from one frame to the next, from -360 to 360");
}

double parse_per_second(const std::string& text) {
  constexpr double most = 1e6;
  const double frames = amount_in(text);
  if (!(frames > 0 && frames <= most)) {
    throw UsageError("--fps=" + text + ": expected frames a second, above 0 and up to " + grouped(std::uint64_t{1'000'000}) +
                     ", such as 24 or 30000/1001");
  }
  return frames;
}

void check(const OptionSet& options, FrameOptions& frames) {
  if (!options.is_given("--animation")) {
    frames.animation.reset();
  }
  const bool moves = frames.has_camera_path() || frames.animation;
  if (frames.turntable_degrees && frames.camera_path) {
    throw UsageError("--turntable does not go with --camera-path: the camera moves in one way");
  }
  if (frames.range && !moves) {
    throw UsageError(
        "--frames: expected also --turntable=DEGREES or --camera-path=FILE, which move the camera, or --animation, which plays "
        "the animation of the scene's file");
  }
  if (moves && !frames.range) {
    throw UsageError(std::string(frames.camera_path         ? "--camera-path"
                                 : frames.turntable_degrees ? "--turntable"
                                                            : "--animation") +
                     " goes with --frames, which sets how many there are");
  }
  if (options.is_given("--fps") && !frames.animation) {
    throw UsageError("--fps goes with --animation: nothing else takes time from frame to frame");
  }
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
      "contain a placeholder for the frame number, as in -o out.####.png or -o out.%04d.png. Each frame is the same, to the bit, "
      "as if it were rendered alone. A frame that equals the one before it, in scene and view, is a copy: it counts nothing, "
      "unless "
      "--heatmap or --no-skip=equal-frames has it rendered");
  options.add_text(
      "--turntable", "DEGREES", [&frames](const std::string& text) { frames.turntable_degrees = parse_degrees(text); },
      "Rotate the camera round the scene by this angle per frame; frame 1 is the scene's own view");
  options.add_path("--camera-path", "FILE", frames.camera_path,
                   "Move the camera on a spline through the keyframes of FILE. A line of it is a frame's number and a value of "
                   "--camera, such as 24 1,2,3/0,0,0");
  options.add_flag_with_text("--animation", "", frames.animation.emplace(),
                             "Play an animation of the scene's glTF file, the first or --animation=NAME: frame K shows it K - 1 "
                             "frames after its beginning, seen by the file's camera, if there is one, unless the options above "
                             "move the camera. Caches stay warm while only the camera moves; otherwise nodes start afresh");
  options.add_text(
      "--fps", "N [24]", [&frames](const std::string& text) { frames.per_second = parse_per_second(text); },
      "Frames per second of the animation");
  options.check_in_the_end([options, &frames] { check(options, frames); });
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
