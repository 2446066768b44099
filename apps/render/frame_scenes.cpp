#include "apps/render/frame_scenes.h"

#include <exception>

#include "apps/frontend/line/number_text.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/database/conversion.h"
#include "core/database/parallel.h"

namespace dmpc::apps {
namespace {

LoadNotes notes_for(const RenderOptions& options) { return options.quiet ? LoadNotes::silent : LoadNotes::said; }

/// What work() returns. What is wrong with its input says of which frame: others may be well.
template <class Work>
auto of_frame(std::uint64_t frame, const Work& work) {
  const auto named = [frame](const std::exception& error) { return "frame " + grouped(frame) + ": " + error.what(); };
  try {
    return work();
  } catch (const core::CapacityError& error) {
    throw core::CapacityError(named(error));
  } catch (const core::InputError& error) {
    throw core::InputError(named(error));
  }
}

}  // namespace

FrameScenes::FrameScenes(const RenderOptions& asked) : asked_(asked) {
  if (asked.frames.range && asked.frames.has_camera_path()) {
    path_.emplace(camera_path_of(asked.frames));
  }
}

core::Scene FrameScenes::load(std::optional<std::uint64_t> frame, OpenedFiles& opened) {
  core::expect(!are_animated() || frame, "an animation is shown by frames");
  if (are_animated() && still_) {
    core::Scene scene = of_frame(*frame, [&] { return load_at(asked_.frames.seconds_at(*frame), opened, nullptr); });
    moved_view_ = scene.view;
    scene.view = own_view_;
    return scene;
  }
  core::Scene scene = load_still(opened);
  if (!are_animated() || asked_.frames.seconds_at(*frame) == 0) {
    return scene;
  }
  scene = {};  // before there is another
  return load(frame, opened);
}

/// Nothing has moved yet: what is looked at by whoever has no camera of its own.
core::Scene FrameScenes::load_still(OpenedFiles& opened) {
  StillScene still;
  core::Scene scene = are_animated() ? load_at(0, opened, &still) : load_scene(asked_.picture, notes_for(asked_), &opened);
  own_view_ = moved_view_ = scene.view;
  if (are_animated()) {
    still_ = still;
  }
  if (path_) {
    path_->set_scene(own_view_, core::bounds_of(scene, core::Parallel(0)));
    path_->check(asked_.frames.range->first, asked_.frames.range->last);
  }
  return scene;
}

core::Scene FrameScenes::load_at(double seconds, OpenedFiles& opened, StillScene* still) {
  PictureOptions picture = asked_.picture;
  picture.scene_setup.mesh.animation = {*asked_.frames.animation, seconds, asked_.frames.per_second, still_};
  return load_scene(picture, notes_for(asked_), &opened, still);
}

}  // namespace dmpc::apps
