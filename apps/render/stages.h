// What becomes of a picture on its way from the scene to files: values, each made of the one before.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "apps/formats/up_axis.h"
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

/// What is known of a scene, also when its objects are gone.
struct SceneFacts {
  core::Box bounds;
  UpAxis up;                                     ///< where a camera is advised
  std::optional<std::uint64_t> digest = {};      ///< if a page shows it, or frames may differ in more than the view
  std::optional<PictureIdentity> identity = {};  ///< that of its own view's picture, where there is a checkpoint
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

/// Stays where it is: its nodes refer to all the rest.
struct PlannedPicture {
  PlannedPicture(RenderCall& call, const DueFrame& frame, BuiltScene scene);

  BuiltScene built;
  RenderOptions options;  ///< the frame's, with what the scene decides and where references are noted
  Observers observers;
  WarmNodes nodes;
};

struct RenderedPicture {
  Report report;
  Seconds seconds;  ///< so far
};

struct WrittenPicture {
  int status = 0;             ///< the exit status: not 0 if something could not be written
  std::string page, closing;  ///< for who looks on, in the end
};

/// Reads, builds and plans the frame, or reuses the nodes of the last one if they exist and only the camera has changed;
/// otherwise those end before another scene is built. Checkpoints and observers begin anew. While a file is read, a signal ends
/// the process at once. Throws as FrameScenes::load(), Checkpoints, build_subject() and make_ready() do, and core::UsageError if
/// an output is a file that the scene was read from.
std::unique_ptr<PlannedPicture> plan_picture(RenderCall& call, const DueFrame& frame, const DueFrames& frames,
                                             std::unique_ptr<PlannedPicture> last);

/// What all threads of this process have computed so far, in seconds.
struct ProcessorTime {
  double user = 0, system = 0;
};
ProcessorTime processor_time();

/// Shows how far it is. Throws Interrupted, and what ReadyRun does.
RenderedPicture render_picture(RenderCall& call, const DueFrame& frame, PlannedPicture& planned);

/// The picture before all else, so that nothing that fails takes it away. What fails is said on stderr, and keeps nothing else
/// from being written.
WrittenPicture write_picture(RenderCall& call, const DueFrame& frame, PlannedPicture& planned, RenderedPicture rendered);

}  // namespace dmpc::apps
