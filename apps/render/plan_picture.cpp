#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/render/picture_notes.h"
#include "apps/render/stages.h"
#include "apps/scene/load_scene.h"
#include "core/database/conversion.h"

namespace dmpc::apps {

namespace {

constexpr const char* equal_frames_note =
    "a frame that equals the one before it is not rendered again: its picture is a copy, and its counters are 0 "
    "(--no-skip=equal-frames renders it)";

/// Whether a checkpoint may be there of this frame, whose picture is: a process was killed when it had written that.
bool may_have_checkpoint(const RenderCall& call, std::uint64_t frame, const DueFrames& frames) {
  const CheckpointOptions& checkpoint = call.asked.checkpoint;
  std::error_code error;
  return checkpoint.file && checkpoint.resumes && frames.was_there(frame) && std::filesystem::exists(*checkpoint.file, error);
}

bool follows_checkpoint(const RenderCall& call, const DueFrame& frame, const DueFrames& frames) {
  return !call.checkpoints && frame.number && *frame.number > call.scenes.first() &&
         may_have_checkpoint(call, *frame.number - 1, frames);
}

SceneFacts facts_of(const RenderOptions& options, const core::Scene& scene) {
  SceneFacts facts;
  facts.bounds = core::bounds_of(scene, core::Parallel(0));
  facts.up = is_mesh(options.picture.scene) ? options.picture.scene_setup.mesh.up.value_or(UpAxis{}) : up_of(scene.view);
  if (options.report || options.frames.animation) {
    facts.digest = scene_digest(scene);
  }
  if (options.checkpoint.file) {
    facts.identity = identity_of(options, scene);
  }
  return facts;
}

/// Removes the checkpoint of a frame that is done; `own` is the identity of the scene's own picture.
void remove_old_checkpoint(const RenderCall& call, std::uint64_t frame, const PictureIdentity& own) {
  remove_checkpoint_of(identity_from(call.scenes.view(frame), own), call.asked.checkpoint, call.files);
}

/// As above; reads the frame's scene.
void remove_old_checkpoint(RenderCall& call, std::uint64_t frame) {
  OpenedFiles opened;
  remove_old_checkpoint(call, frame, identity_of(call.asked, call.scenes.load(frame, opened)));
}

/// The checkpoint is from now on that of this frame.
void begin_checkpoint(RenderCall& call, const DueFrame& frame, const PictureIdentity& own) {
  const PictureIdentity identity = frame.number ? identity_from(call.scenes.view(frame.number), own) : own;
  if (call.checkpoints) {
    call.checkpoints->begin(identity);
  } else {
    call.checkpoints.emplace(call.asked.checkpoint, identity, std::cerr, call.asked.quiet, call.interrupt.token(), call.files);
  }
}

/// Reads the scene; for the first frame a checkpoint, too.
ReadScene read_scene(RenderCall& call, const DueFrame& frame, const DueFrames& frames) {
  Stopwatch stopwatch;
  const bool follows = follows_checkpoint(call, frame, frames);
  if (follows && call.scenes.are_animated()) {
    remove_old_checkpoint(call, *frame.number - 1);
  }
  OpenedFiles opened;
  ReadScene read{.scene = call.scenes.load(frame.number, opened), .facts = {}};
  check_not_read(opened, files_of(frame.outputs.names()));
  read.facts = facts_of(call.asked, read.scene);
  if (follows && !call.scenes.are_animated()) {
    remove_old_checkpoint(call, *frame.number - 1, *read.facts.identity);
  }
  if (read.facts.identity) {
    begin_checkpoint(call, frame, *read.facts.identity);
  }
  read.facts.seconds.load = stopwatch.lap();
  return read;
}

BuiltScene build_scene(RenderCall& call, ReadScene read) {
  Stopwatch stopwatch;
  BuiltScene built{.subject = build_subject_quietly(std::move(read.scene), call.asked.picture, call.asked.database, true),
                   .facts = std::move(read.facts)};
  call.report_once(notes_of(built.subject));
  const bool looks_for_detail = built.subject.built.keeps_instances && call.asked.picture.is_refined;
  if (call.asked.tracer != TracerChoice::embree && !looks_for_detail) {
    built.subject.database.forget_primitives();
  }
  built.facts.seconds.build = stopwatch.lap();
  return built;
}

/// Where somebody observes threads they read the clock twice a call, which takes a third of the processor's time more: then
/// what nodes do is shown only if others observe them, too.
bool are_nodes_shown(const RenderOptions& options) { return options.computer.machine || options.report || options.trace.path; }

LiveHead live_head(const RenderCall& call, const DueFrame& frame, const core::Camera& camera) {
  return {.width = static_cast<std::uint32_t>(camera.width()),
          .height = static_cast<std::uint32_t>(camera.height()),
          .node_count = are_nodes_shown(call.asked) ? call.asked.computer.node_count : 0,
          .is_modelled = call.asked.computer.machine.has_value(),
          .frame = call.asked.frames.are_several() ? *frame.number : 0};
}

RenderOptions options_of(const DueFrame& frame, const Subject& subject) {
  RenderOptions options = frame.options;
  options.database.build = subject.built;
  options.picture.depth = subject.settings.shade.depth_max;
  if (options.picture.transport.is_by_paths()) {
    options.picture.transport.bounces = options.picture.depth - 1;
  }
  return options;
}

/// As the frame sees it, or the scene's own view.
core::RenderSettings settings_of(const RenderCall& call, const DueFrame& frame, const Subject& subject) {
  return frame.number ? seen_from(call.scenes.view(frame.number), subject.settings, subject.database) : subject.settings;
}

/// Shows the picture that is next to whoever looks on.
nodes::Observer* show_next(const RenderCall& call, const DueFrame& frame, const core::Camera& camera) {
  if (!call.live) {
    return nullptr;
  }
  call.live->begin(live_head(call, frame, camera), call.checkpoints ? call.checkpoints->start() : nullptr);
  return call.live->observer();
}

core::Continuation continuation_of(RenderCall& call) {
  core::Continuation continuation;
  continuation.ends_before = [&call](const core::PassEnd& end) { return call.passes->ends_before(end); };
  if (call.checkpoints) {
    const core::Continuation kept = call.checkpoints->continuation();
    continuation.start = kept.start;
    continuation.is_due = [is_due = kept.is_due, &call] { return call.interrupt.take_keep_request() || is_due(); };
    continuation.keep = [keep = kept.keep, &call](const core::Film& film, const core::Refinement& pass,
                                                  const core::PixelMask& done) {
      keep(film, pass, done);
      call.set_consequence();
    };
  }
  if (call.live) {
    continuation.watch = [live = call.live.get()](const core::Film& film, const core::Refinement& pass, std::uint32_t pixel) {
      live->watch(film, pass, pixel);
    };
  }
  return continuation;
}

void plan(RenderCall& call, PlannedPicture& picture) {
  nodes::Watching watching = picture.observers.watching();
  if (!call.asked.frames.are_several() && call.asked.layers.empty()) {                       // else it is needed once more
    watching.distributed = [&picture] { picture.built.subject.database.forget_records(); };  // the nodes have theirs
  }
  Stopwatch stopwatch;
  const std::vector<std::string> notes = picture.nodes.plan(watching, continuation_of(call));
  picture.built.facts.seconds.prepare = stopwatch.lap();
  if (!call.asked.quiet) {
    call.report_once(notes);
    if (const auto& machine = call.asked.computer.machine) {
      call.report_once({price_note(*machine, picture.built.subject.database.structure())});
    }
  }
}

/// Its picture, where nobody asks for what a run does beside.
bool equals_done(const RenderCall& call, const DueFrame& frame, const PlannedPicture& picture) {
  return picture.done && call.asked.picture.skips_equal_frames && call.asked.heat_maps.empty() &&
         view_text(call.scenes.view(frame.number)) == picture.done->view;
}

/// The nodes stay as they are.
void go_on(RenderCall& call, const DueFrame& frame, PlannedPicture& picture) {
  picture.options = options_of(frame, picture.built.subject);
  if (equals_done(call, frame, picture)) {
    call.report_once({call.asked.quiet ? "" : equal_frames_note});
    return;
  }
  picture.done.reset();  // its film makes room for the next one
  picture.nodes.move_to(call.scenes.view(frame.number));
  picture.observers.begin_again();
  show_next(call, frame, picture.nodes.camera());
}

}  // namespace

PlannedPicture::PlannedPicture(RenderCall& call, const DueFrame& frame, BuiltScene scene)
    : built(std::move(scene)),
      options(options_of(frame, built.subject)),
      observers(observer_order(options, static_cast<std::uint32_t>(built.subject.database.page_count()),
                               built.subject.settings.camera.pixel_count()),
                show_next(call, frame, built.subject.settings.camera)),
      nodes(options, built.subject.database, settings_of(call, frame, built.subject)) {
  options.pages.reference_logs = observers.reference_logs();
}

void end_frames(RenderCall& call, const DueFrames& frames) {
  const std::uint64_t last = call.asked.frames.range->last;
  if (may_have_checkpoint(call, last, frames)) {
    const std::optional<FileLock> lock = claim_checkpoint(call.asked.checkpoint);
    const Interrupt::EndAtOnce end_at_once(call.interrupt);
    remove_old_checkpoint(call, last);
  }
}

std::unique_ptr<PlannedPicture> plan_picture(RenderCall& call, const DueFrame& frame, const DueFrames& frames,
                                             std::unique_ptr<PlannedPicture> last) {
  if (last && !call.scenes.are_animated()) {
    if (last->built.facts.identity) {
      begin_checkpoint(call, frame, *last->built.facts.identity);
    }
    go_on(call, frame, *last);
    return last;
  }
  if (last) {
    call.set_consequence();
  }
  const Interrupt::EndAtOnce end_at_once(call.interrupt);
  ReadScene read = read_scene(call, frame, frames);
  if (last && last->built.facts.digest == read.facts.digest) {
    last->built.facts = std::move(read.facts);
    go_on(call, frame, *last);
    return last;
  }
  const bool is_first = last == nullptr;
  last.reset();
  auto picture = std::make_unique<PlannedPicture>(call, frame, build_scene(call, std::move(read)));
  if (is_first) {
    call.say({frames.disk_note(picture->nodes.camera().pixel_count())});
  }
  plan(call, *picture);
  return picture;
}

}  // namespace dmpc::apps
