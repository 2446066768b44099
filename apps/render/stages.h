// The stages of a picture from the scene to files: each value is made from the one before.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/formats/up_axis.h"
#include "apps/picture/layer_image.h"
#include "apps/render/call.h"
#include "apps/render/observers.h"
#include "apps/render/picture_identity.h"
#include "apps/run/render_record.h"
#include "apps/run/report.h"
#include "apps/run/warm_nodes.h"
#include "apps/scene/subject.h"
#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Properties of a scene that remain known when its objects are gone.
struct SceneFacts {
  core::Box bounds;
  UpAxis up;                                     ///< for a suggested camera
  std::optional<std::uint64_t> digest = {};      ///< if a page shows it, or frames may differ in more than the view
  std::optional<PictureIdentity> identity = {};  ///< for its own view's picture, if there is a checkpoint
  Seconds seconds = {};                          ///< so far
};

struct ReadScene {
  core::Scene scene;
  SceneFacts facts;
};

struct BuiltScene {
  Subject subject;
  SceneFacts facts;
};

/// The last frame that these nodes have rendered, for frames that equal it.
struct DoneFrame {
  std::uint64_t number = 0;
  std::string view;  ///< view_text()
  Report report;
};

/// Not movable: its nodes refer to the other members.
struct PlannedPicture {
  PlannedPicture(RenderCall& call, const DueFrame& frame, BuiltScene scene);

  BuiltScene built;
  RenderOptions options;  ///< the frame's, with what the scene decides and where references are recorded
  Observers observers;
  WarmNodes nodes;
  std::vector<LayerImage> layers = {};  ///< of the frame
  std::optional<DoneFrame> done = {};   ///< of the same scene; after plan_picture() only if the frame equals it
};

struct RenderedPicture {
  Report report;
  Seconds seconds;                                 ///< so far
  std::optional<std::uint64_t> copied_frame = {};  ///< RenderRecord::copied_frame
};

struct WrittenPicture {
  int status = 0;             ///< the exit status: not 0 if an output could not be written
  std::string page, closing;  ///< for viewers, at the end
};

/// Reads, builds and plans the frame, or reuses the nodes of the last one if they exist and only the camera has changed;
/// otherwise those end before another scene is built. Checkpoints and observers begin anew. While a file is read, a signal ends
/// the process at once. Throws as FrameScenes::load(), Checkpoints, build_subject() and make_ready() do, and core::UsageError if
/// an output is a file that the scene was read from.
std::unique_ptr<PlannedPicture> plan_picture(RenderCall& call, const DueFrame& frame, const DueFrames& frames,
                                             std::unique_ptr<PlannedPicture> last);

/// If all frames exist: removes the checkpoint of the last one, which a process leaves that is killed when it has written that.
/// Throws as claim_checkpoint() and FrameScenes::load() do.
void end_frames(RenderCall& call, const DueFrames& frames);

/// Renders the frame's layers, if any are asked for, by the strategy, on nodes of their own; with ranks on rank 0 alone. Nothing
/// observes or counts that. Throws Interrupted, and what ReadyRun does.
void render_layers(const RenderCall& call, PlannedPicture& planned);

/// Processor time of all threads of this process so far, in seconds.
struct ProcessorTime {
  double user = 0, system = 0;
};
ProcessorTime processor_time();

/// Shows progress, and keeps the frame that is done, if it equals the frame, as it is. Throws Interrupted, and what ReadyRun
/// does.
RenderedPicture render_picture(RenderCall& call, const DueFrame& frame, PlannedPicture& planned);

/// Writes the picture first, so that no error of another output loses it. Errors are reported on stderr, and do not prevent other
/// outputs. Keeps the report of one of several frames as planned.done.
WrittenPicture write_picture(RenderCall& call, const DueFrame& frame, PlannedPicture& planned, RenderedPicture rendered);

}  // namespace dmpc::apps
