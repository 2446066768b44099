#include "apps/render/command.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/edge/ranks/rank_group.h"
#include "apps/edge/system/attempts.h"
#include "apps/edge/system/output_file.h"
#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/effort/render_effort.h"
#include "apps/oracle/oracle.h"
#include "apps/picture/film_image.h"
#include "apps/render/checkpoints.h"
#include "apps/render/film_notes.h"
#include "apps/render/onlookers.h"
#include "apps/render/outputs.h"
#include "apps/render/pass_progress.h"
#include "apps/render/preview.h"
#include "apps/render/ranks.h"
#include "apps/render/self_test.h"
#include "apps/render/unseen_note.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "apps/show/stats/stats.h"
#include "apps/show/summary.h"
#include "apps/show/trace/file.h"
#include "core/database/conversion.h"
#include "core/picture/refinement.h"
#include "nodes/ranks/life_signs.h"

namespace dmpc::apps {

namespace {

struct ProcessorTime {
  double user = 0, system = 0;
};

ProcessorTime processor_time() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(usage.ru_utime), seconds(usage.ru_stime)};
}

/// Who looks on; nothing if nobody wants to or listens.
std::unique_ptr<Preview> make_preview(const RenderOptions& options, const core::Camera& camera, const core::PartialPicture* start,
                                      const std::stop_token& stop) {
  if (options.viewer.empty()) {
    return nullptr;
  }
  return Preview::to_viewer(parse_viewer_address(options.viewer, "--preview"), options.picture.scene, camera.width(),
                            camera.height(), start, stop);
}

/// What an interruption of the run means.
const char* consequence_of(const Checkpoints& checkpoints) {
  return checkpoints.has_one() ? "no picture was written; --resume goes on from the checkpoint" : "no picture was written";
}

core::Continuation continuation_of(Checkpoints* checkpoints, Preview* preview, Interrupt& interrupt) {
  core::Continuation continuation;
  if (checkpoints != nullptr) {
    continuation = checkpoints->continuation();
    continuation.is_due = [is_due = continuation.is_due, &interrupt] { return interrupt.take_keep_request() || is_due(); };
    continuation.keep = [keep = continuation.keep, checkpoints, &interrupt](const core::Film& film, const core::Refinement& pass,
                                                                            const core::PixelMask& done) {
      keep(film, pass, done);
      interrupt.set_consequence(consequence_of(*checkpoints));
    };
  }
  if (preview != nullptr) {
    continuation.watch = [preview](const core::Film& film, const core::Refinement& pass, std::uint32_t pixel) {
      preview->watch(film, pass, pixel);
    };
  }
  return continuation;
}

/// One call of `render`, on ranks that of the first one: stages, of which each has what those before it made.
class Rendering {
 public:
  Rendering(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files)
      : options_(options), interrupt_(interrupt), output_(output), files_(files) {}

  int run() {
    claim();
    apart([this] { load(); });
    look_on();
    apart([this] { plan(); });
    render();
    return apart([this] { return write(); });
  }

 private:
  /// Where there are other ranks, they are shown that this one lives while it does something that has nothing to do with them.
  template <class Work>
  std::invoke_result_t<const Work&> apart(const Work& work) {
    return options_.computer.ranks == nullptr ? work() : nodes::with_life_signs(*options_.computer.ranks, work);
  }

  /// What can be seen before the scene is: paths, libraries, the machine.
  void claim() {
    check_outputs(options_, outputs_);
    if (options_.tracer == TracerChoice::embree) {
      open_embree();
    }
    if (std::optional<FileLock> lock = claim_checkpoint(options_.checkpoint)) {
      lock_.emplace(std::move(*lock));
    }
    choose_machine(options_);
  }

  /// Reads and builds; a signal ends the process here and now.
  void load() {
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    Stopwatch stopwatch;
    OpenedFiles opened;
    core::Scene scene = load_scene(options_.picture, options_.quiet ? LoadNotes::silent : LoadNotes::said, &opened);
    check_not_read(opened, files_of(outputs_.names()));
    if (options_.checkpoint.file) {
      checkpoints_.emplace(options_.checkpoint, identity_of(options_, scene), std::cerr, options_.quiet, interrupt_.token(),
                           files_);
    }
    bounds_ = core::bounds_of(scene, core::world_axes, core::Parallel(0));
    up_ = is_mesh(options_.picture.scene) ? options_.picture.staging.mesh.up.value_or(UpAxis{}) : up_of(scene.view);
    scene_digest_ = options_.report ? std::optional(scene_digest(scene)) : std::nullopt;
    seconds_.load = stopwatch.lap();
    subject_.emplace(build_subject(std::move(scene), options_.picture, options_.database, true));
    if (options_.tracer != TracerChoice::embree) {
      subject_->database.forget_primitives();
    }
    seconds_.build = stopwatch.lap();
  }

  void look_on() {
    const core::Camera& camera = subject_->settings.camera;
    onlookers_.emplace(watch_order(options_, static_cast<std::uint32_t>(subject_->database.page_count()), camera.pixel_count()));
    options_.pages.reference_logs = onlookers_->reference_logs();
    preview_ = make_preview(options_, camera, checkpoints_ ? checkpoints_->start() : nullptr, interrupt_.token());
    continuation_ = continuation_of(checkpoints_ ? &*checkpoints_ : nullptr, preview_.get(), interrupt_);
  }

  /// Plans, and says what the user should know before waiting for the picture; a signal ends the process here and now.
  void plan() {
    announce_long();
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    nodes::Watching watching = onlookers_->watching();
    watching.distributed = [this] { subject_->database.forget_records(); };  // the nodes have theirs
    Stopwatch stopwatch;
    ready_ = make_ready(options_, subject_->database, subject_->settings, {}, watching, continuation_);
    seconds_.prepare = stopwatch.lap();
    say(ready_.notes);
  }

  /// How long a long render will take, where somebody waits; without what is done already.
  void announce_long() {
    if (options_.quiet || !stderr_is_terminal()) {
      return;
    }
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    const double samples = static_cast<double>(subject_->settings.camera.pixel_count()) * options_.picture.samples;
    Effort effort = render_effort(options_, *subject_);
    effort.seconds *= std::max(0.0, 1 - static_cast<double>(samples_found_done()) / samples);
    if (is_long(effort)) {
      announce("render " + options_.picture.scene + (options_.picture.is_refined ? ", at least" : ""), effort, options_.quiet,
               std::cerr);
    }
  }

  void render() {
    if (checkpoints_) {
      interrupt_.set_consequence(consequence_of(*checkpoints_));
    }
    Stopwatch stopwatch;
    const ProcessorTime before = processor_time();
    Progress progress(std::cerr, !options_.quiet && stderr_is_terminal());
    PassProgress passes(progress, continuation_.start != nullptr ? continuation_.start->passes : 1, core::passes_max);
    const auto update = [this, &progress, &passes](std::uint32_t done, std::uint32_t total) {
      options_.picture.is_refined ? passes.update(done, total) : progress.update(done, total);
    };
    report_.emplace(ready_.start(update, interrupt_.token()));
    if (account_of(*report_).end != nodes::RunEnd::finished) {  // else the picture is done, and a signal comes too late for it
      interrupt_.check();
      core::expect(options_.computer.ranks != nullptr, "a run that nobody stopped is finished");
      throw Interrupted{};  // by a signal that came to another rank
    }
    const ProcessorTime after = processor_time();
    seconds_.render = stopwatch.lap();
    seconds_.render_user = after.user - before.user;
    seconds_.render_system = after.system - before.system;
  }

  /// The picture before all else, so that nothing that fails takes it away. Returns the exit status.
  int write() {
    const Account account = account_of(*report_);
    const core::Film& film = account.film;
    Attempts attempts(std::cerr);
    const bool is_written = attempts.make([&] { write_picture(film); });
    attempts.make([&] { say(film_notes(film, lit_in(account))); });
    attempts.make([&] { say({sees_nothing(account) ? unseen_note(bounds_, up_) : ""}); });
    if (checkpoints_ && is_written) {
      attempts.make([&] { checkpoints_->finish(); });
    } else if (checkpoints_ && checkpoints_->has_one()) {
      std::cerr << "dmpc: the checkpoint stays, --resume goes on from it\n";
    }
    Sights sights;
    attempts.make([&] { sights = take_sights(); });
    write_others(sights, attempts);
    if (preview_) {
      preview_->finish(film);
    }
    return attempts.status();
  }

  void write_picture(const core::Film& film) {
    interrupt_.set_consequence("the picture was not written");
    const Interrupt::EndAtOnce end_at_once(interrupt_, Interrupt::EndAtOnce::Before::is_passed_over);
    Stopwatch stopwatch;
    OutputFile picture(options_.image, {.option = "-o"}, files_);
    picture.write(encoded_picture(options_.image, picture_rows(film)));
    interrupt_.set_consequence("perhaps the picture was not written");
    picture.commit();
    interrupt_.set_consequence("the picture was written, what follows it is incomplete");
    seconds_.write = stopwatch.lap();
  }

  /// By paths it tells so, too.
  ImageRows picture_rows(const core::Film& film) const {
    ImageRows rows = rows_of(film);
    if (options_.picture.transport.is_by_paths()) {
      rows.remarks.emplace_back("transport", text_of(options_.picture.transport));
    }
    return rows;
  }

  /// No ray from the eye has met anything of a scene that has something.
  bool sees_nothing(const Account& account) const {
    return account.operations.primary_hits == 0 && samples_found_done() == 0 && !bounds_.empty();
  }

  /// Shadow rays that brought light, where none is shot that would not.
  std::uint64_t lit_in(const Account& account) const {
    const bool all_bring_light = options_.picture.skips.zero_terms && options_.picture.convention == core::Convention::haines;
    const std::uint64_t shot = account.operations.rays[static_cast<std::size_t>(core::RayKind::shadow)];
    return all_bring_light ? shot - account.operations.shadow_blocked : 0;
  }

  /// What the onlookers have seen; says so if some of a trace was lost, or there is none.
  Sights take_sights() {
    Sights sights = onlookers_->take();
    if (sights.trace) {
      say({loss_note(*sights.trace, options_.trace), empty_note(*sights.trace)});
    }
    return sights;
  }

  void write_others(const Sights& sights, Attempts& attempts) {
    RenderRecord record = {options_,
                           subject_->database,
                           *report_,
                           seconds_,
                           onlookers_->heat(),
                           sights.trace ? &*sights.trace : nullptr,
                           sights.view ? &*sights.view : nullptr,
                           sights.references.empty() ? nullptr : &sights.references,
                           samples_found_done(),
                           scene_digest_};
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    const ProcessorTime all = processor_time();
    record.seconds.user = all.user;
    record.seconds.system = all.system;
    outputs_.write(record, attempts, files_);
    attempts.make([&] { print_closing(record); });
  }

  /// What goes to the standard output: counters if they were asked for there, then the closing lines.
  void print_closing(const RenderRecord& record) {
    if (has_counters_on_standard_output(options_)) {
      output_ << stats_json(record);
    }
    if (!options_.quiet) {
      print_summary(output_, record);
    }
    finish_output(output_, "what follows the picture");
  }

  /// Those of `notes` that say something, unless quiet.
  void say(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
      if (!options_.quiet && !note.empty()) {
        std::cerr << "dmpc: " << note << '\n';
      }
    }
  }

  std::uint64_t samples_found_done() const { return checkpoints_ ? checkpoints_->samples_found_done() : 0; }

  RenderOptions options_;  ///< with the machine, once it is read, and where references are noted
  Interrupt& interrupt_;
  std::ostream& output_;
  Files& files_;
  const OutputSet<RenderRecord> outputs_ = outputs_of(options_);
  Seconds seconds_;
  std::optional<FileLock> lock_;
  std::optional<Checkpoints> checkpoints_;
  std::optional<std::uint64_t> scene_digest_;  ///< if a page tells it
  core::Box bounds_;                           ///< of the scene
  UpAxis up_;                                  ///< of the scene, where a camera is advised
  std::optional<Subject> subject_;
  std::optional<Onlookers> onlookers_;
  std::unique_ptr<Preview> preview_;
  core::Continuation continuation_;
  ReadyRun ready_;
  std::optional<Report> report_;
};

int render_by_mpi(RenderOptions options, RankGroup& group, Interrupt& interrupt, std::ostream& output, Files& files) {
  if (!options.is_node_count_given) {
    options.computer.node_count = group.default_node_count();
  }
  if (!options.runner.idle) {
    options.runner.idle = group.default_idle(options.computer);
  }
  return render_over(group.connect(payload_bytes_max(options)), options, interrupt, output, files);
}

}  // namespace

int render_command(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files) {
  if (options.checkpoint.file) {
    interrupt.take_usr1_for_keep();
  }
  if (options.runner.kind == RunnerKind::mpi) {
    return run_as_rank({.own = renderer_likeness()},
                       [&](RankGroup& group) { return render_by_mpi(options, group, interrupt, output, files); });
  }
  return Rendering(options, interrupt, output, files).run();
}

int render_over(nodes::Fabric& fabric, const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files) {
  check_nodes_on_ranks(options, fabric.rank_count());
  const auto render_here = [&](nodes::RankLinks& links) {
    if (links.rank_count() == 1 && !options.quiet) {
      std::cerr << "dmpc: --runner=mpi: this is the only process, so that all nodes are in it\n";
    }
    RenderOptions here = options;
    here.computer.ranks = &links;
    return Rendering(here, interrupt, output, files).run();
  };
  return render_as_rank(fabric, options, render_here, interrupt.token());
}

}  // namespace dmpc::apps
