#include "apps/render/command.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/parsed_number.h"
#include "apps/edge/ranks/rank_group.h"
#include "apps/edge/show/page/origin.h"
#include "apps/edge/system/attempts.h"
#include "apps/edge/system/output_file.h"
#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/oracle/oracle.h"
#include "apps/picture/film_image.h"
#include "apps/render/checkpoints.h"
#include "apps/render/film_notes.h"
#include "apps/render/frame_files.h"
#include "apps/render/frame_scenes.h"
#include "apps/render/live_view.h"
#include "apps/render/onlookers.h"
#include "apps/render/outputs.h"
#include "apps/render/pass_progress.h"
#include "apps/render/ranks.h"
#include "apps/render/self_test.h"
#include "apps/render/unseen_note.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "apps/show/frame_line.h"
#include "apps/show/page/render_page.h"
#include "apps/show/stats/stats.h"
#include "apps/show/summary.h"
#include "apps/show/trace/file.h"
#include "core/database/conversion.h"
#include "core/picture/frame_settings.h"
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

/// What an interruption of the run means; where there are several frames, of the one under way.
const char* consequence_of(const Checkpoints* checkpoints, bool are_frames) {
  const bool has_checkpoint = checkpoints != nullptr && checkpoints->has_one();
  if (are_frames) {
    return has_checkpoint ? "this frame was not written, those before it were; --resume goes on from the checkpoint"
                          : "this frame was not written, those before it were; --resume leaves them out";
  }
  return has_checkpoint ? "no picture was written; --resume goes on from the checkpoint" : "no picture was written";
}

core::Continuation continuation_of(Checkpoints* checkpoints, bool are_frames, LiveView* live, Interrupt& interrupt) {
  core::Continuation continuation;
  if (checkpoints != nullptr) {
    continuation = checkpoints->continuation();
    continuation.is_due = [is_due = continuation.is_due, &interrupt] { return interrupt.take_keep_request() || is_due(); };
    continuation.keep = [keep = continuation.keep, checkpoints, are_frames, &interrupt](
                            const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
      keep(film, pass, done);
      interrupt.set_consequence(consequence_of(checkpoints, are_frames));
    };
  }
  if (live != nullptr) {
    continuation.watch = [live](const core::Film& film, const core::Refinement& pass, std::uint32_t pixel) {
      live->watch(film, pass, pixel);
    };
  }
  return continuation;
}

/// One call of `render`, on ranks that of the first one: stages, of which each has what those before it made.
class Rendering {
 public:
  Rendering(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files)
      : asked_(options), options_(options), interrupt_(interrupt), output_(output), files_(files) {}

  int run() {
    try {
      return run_stages();
    } catch (const Interrupted&) {
      tell_end("The run was interrupted: " + std::string(interrupt_.consequence()) + ".");
      throw;
    } catch (const std::exception& error) {
      tell_end("The run has failed: " + std::string(error.what()));
      throw;
    }
  }

 private:
  int run_stages() {
    if (asked_.frames.range && !claim_frames()) {
      return 0;
    }
    claim();
    apart([this] { load(); });
    look_on();
    apart([this] { foretell(); });
    apart([this] { plan(); });
    render();
    int status = apart([this] { return write(); });
    while (status == 0 && apart([this] { return next_frame(); })) {
      render();
      status = apart([this] { return write(); });
    }
    apart([&] { stay(status); });
    return status;
  }

  /// Where there are other ranks, they are shown that this one lives while it does something that has nothing to do with them.
  template <class Work>
  std::invoke_result_t<const Work&> apart(const Work& work) {
    return options_.computer.ranks == nullptr ? work() : nodes::with_life_signs(*options_.computer.ranks, work);
  }

  /// Which frames there are to do; false if none is left.
  bool claim_frames() {
    check_frame_names(asked_);
    frames_there_ = frames_there(asked_);
    if (!frames_there_.empty() && !asked_.checkpoint.resumes) {
      throw core::InputError("-o " + options_of(asked_, *frames_there_.begin()).image.string() + ": the picture of this frame" +
                             (frames_there_.size() == 1 ? " is" : ", and of " + grouped(frames_there_.size() - 1) + " more, is") +
                             " there already: --resume leaves out what is there, or remove it, or give another name");
    }
    if (!frames_there_.empty()) {
      say({counted(frames_there_.size(), "frame") + " of " + grouped(asked_.frames.range->count()) +
           (frames_there_.size() == 1 ? " is there and stays as it is" : " are there and stay as they are")});
    }
    frame_ = missing_from(asked_.frames.range->first);
    if (frame_) {
      options_ = options_of(asked_, *frame_);
      outputs_ = outputs_of(options_);
    }
    return frame_.has_value();
  }

  /// The next to do. Another process may have the others.
  std::optional<std::uint64_t> missing_from(std::uint64_t frame) const {
    while (frame <= asked_.frames.range->last && (frames_there_.contains(frame) || is_there_by_now(frame))) {
      ++frame;
    }
    return frame <= asked_.frames.range->last ? std::optional(frame) : std::nullopt;
  }

  bool is_there_by_now(std::uint64_t frame) const {
    const std::filesystem::path picture = options_of(asked_, frame).image;
    std::error_code error;
    const bool is_there = picture != asked_.image && std::filesystem::exists(picture, error);
    if (is_there && !asked_.checkpoint.resumes) {
      throw core::InputError("-o " + picture.string() +
                             ": the picture of this frame has come there meanwhile: --resume goes on " +
                             "with those that are missing");
    }
    return is_there;
  }

  std::uint64_t frames_left() const { return asked_.frames.range->count() - frames_there_.size(); }

  /// Makes all ready for the next frame that is missing, on the same nodes; false if none is.
  bool next_frame() {
    frame_ = asked_.frames.range ? missing_from(*frame_ + 1) : std::nullopt;
    if (!frame_) {
      return false;
    }
    interrupt_.check();
    options_ = options_of(asked_, *frame_);
    outputs_ = outputs_of(options_);
    check_outputs(options_, outputs_);
    if (scenes_.are_animated()) {
      load_next();
    }
    settings_ = frame_settings();
    if (checkpoints_) {
      checkpoints_->begin(own_identity());
    }
    is_started_ ? go_on() : begin_anew();
    return true;
  }

  /// On the same nodes.
  void go_on() {
    continuation_.start = nullptr;  // the first frame's
    onlookers_->begin_again();
    if (live_) {
      live_->begin(live_head(), nullptr);
    }
  }

  void begin_anew() {
    look_on();
    plan();
  }

  /// Reads the frame's scene. Where more of it differs from the last one's than the view, that and its nodes end here.
  void load_next() {
    interrupt_.set_consequence(consequence_of(nullptr, true));
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    Stopwatch stopwatch;
    core::Scene scene = read_scene();
    seconds_.load = stopwatch.lap();
    seconds_.build = seconds_.prepare = 0;
    const std::uint64_t before = std::exchange(contents_, scene_digest(scene));
    is_started_ = contents_ == before;
    if (!is_started_) {
      ready_ = {};
      report_.reset();
      onlookers_.reset();
      subject_.reset();
      build(std::move(scene));
      seconds_.build = stopwatch.lap();
    }
  }

  /// Of the frame under way, or the scene's own.
  core::View view() const { return scenes_.view(frame_); }
  PictureIdentity own_identity() const { return frame_ ? identity_from(view(), *own_identity_) : *own_identity_; }

  core::RenderSettings frame_settings() const {
    const core::RenderSettings& own = subject_->settings;
    const core::Camera camera(view(), own.header.frame, own.camera.width(), own.camera.height(), own.camera.samples());
    return core::seen_by(camera, own, subject_->database);
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
    choose_machine(asked_);
    options_ = frame_ ? options_of(asked_, *frame_) : asked_;
    if (!options_.serve_port.empty()) {
      live_ = std::make_unique<LiveView>(*number_in<std::uint16_t>(options_.serve_port), "dmpc render " + options_.picture.scene,
                                         [this] { interrupt_.stop_once(); });
      std::cerr << "dmpc: to be seen at " + live_->address() + "\n";  // at once
    }
  }

  /// Reads and builds; a signal ends the process here and now.
  void load() {
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    Stopwatch stopwatch;
    const bool follows = follows_checkpoint();
    if (follows && scenes_.are_animated()) {
      OpenedFiles opened;
      remove_old_checkpoint(identity_of(options_, scenes_.load(*frame_ - 1, opened)));
    }
    core::Scene scene = read_scene();
    if (follows && !scenes_.are_animated()) {
      remove_old_checkpoint(*own_identity_);
    }
    contents_ = scenes_.are_animated() ? scene_digest(scene) : 0;
    if (options_.checkpoint.file) {
      checkpoints_.emplace(options_.checkpoint, own_identity(), std::cerr, options_.quiet, interrupt_.token(), files_);
    }
    up_ = is_mesh(options_.picture.scene) ? options_.picture.staging.mesh.up.value_or(UpAxis{}) : up_of(scene.view);
    scene_digest_ = options_.report ? std::optional(scene_digest(scene)) : std::nullopt;
    seconds_.load = stopwatch.lap();
    build(std::move(scene));
    settings_ = frame_ ? frame_settings() : subject_->settings;
    seconds_.build = stopwatch.lap();
  }

  /// Of the frame, and who it is.
  core::Scene read_scene() {
    OpenedFiles opened;
    core::Scene scene = scenes_.load(frame_, opened);
    check_not_read(opened, files_of(outputs_.names()));
    bounds_ = core::bounds_of(scene, core::world_axes, core::Parallel(0));
    if (options_.checkpoint.file) {
      own_identity_ = identity_of(options_, scene);
    }
    return scene;
  }

  void build(core::Scene scene) {
    subject_.emplace(build_subject_quietly(std::move(scene), options_.picture, asked_.database, true));
    options_.database.build = subject_->built;
    tell_once(notes_of(*subject_));
    const bool looks_for_detail = options_.database.build.keeps_instances && options_.picture.is_refined;
    if (options_.tracer != TracerChoice::embree && !looks_for_detail) {
      subject_->database.forget_primitives();
    }
  }

  /// Whether a checkpoint may be there of the frame before, where a process was killed when that was written.
  bool follows_checkpoint() const {
    std::error_code error;
    return options_.checkpoint.file && options_.checkpoint.resumes && frame_ && *frame_ > scenes_.first() &&
           frames_there_.contains(*frame_ - 1) && std::filesystem::exists(*options_.checkpoint.file, error);
  }

  /// That of the frame before, whose scene has just been read: `own`.
  void remove_old_checkpoint(const PictureIdentity& own) const {
    remove_checkpoint_of(identity_from(scenes_.view(*frame_ - 1), own), options_.checkpoint, files_);
  }

  /// Where somebody observes threads they read the clock twice a call, which takes a third of the processor's time more: then
  /// what nodes do is shown only if others observe them, too.
  bool are_nodes_shown() const { return options_.computer.machine || options_.report || options_.trace.path; }

  LiveHead live_head() const {
    const core::Camera& camera = settings_->camera;
    return {.width = static_cast<std::uint32_t>(camera.width()),
            .height = static_cast<std::uint32_t>(camera.height()),
            .node_count = are_nodes_shown() ? options_.computer.node_count : 0,
            .is_modelled = options_.computer.machine.has_value(),
            .frame = asked_.frames.are_several() ? *frame_ : 0};
  }

  void look_on() {
    const core::Camera& camera = subject_->settings.camera;
    const core::PartialPicture* const start = checkpoints_ ? checkpoints_->start() : nullptr;
    if (live_) {
      live_->begin(live_head(), start);
    }
    onlookers_.emplace(watch_order(options_, static_cast<std::uint32_t>(subject_->database.page_count()), camera.pixel_count()),
                       live_ ? live_->observer() : nullptr);
    options_.pages.reference_logs = onlookers_->reference_logs();
    continuation_ =
        continuation_of(checkpoints_ ? &*checkpoints_ : nullptr, asked_.frames.are_several(), live_.get(), interrupt_);
  }

  /// What the user should know before waiting for the first picture.
  void foretell() {
    if (frame_) {
      say({disk_note(asked_, frames_left(), settings_->camera.pixel_count())});
    }
  }

  /// A signal ends the process here and now.
  void plan() {
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    nodes::Watching watching = onlookers_->watching();
    if (!asked_.frames.are_several()) {  // of which each looks at the database for where it shows nothing
      watching.distributed = [this] { subject_->database.forget_records(); };  // the nodes have theirs
    }
    Stopwatch stopwatch;
    ready_ = make_ready(options_, subject_->database, *settings_, {}, watching, continuation_);
    seconds_.prepare = stopwatch.lap();
    if (!options_.quiet) {
      tell_once(ready_.notes);
    }
  }

  void render() {
    if (checkpoints_ || asked_.frames.are_several()) {
      interrupt_.set_consequence(consequence_of(checkpoints_ ? &*checkpoints_ : nullptr, asked_.frames.are_several()));
    }
    if (live_) {
      live_->say(asked_.frames.are_several()
                     ? "Frame " + grouped(*frame_) + " comes, the last is " + grouped(asked_.frames.range->last) + "."
                     : "The picture comes.");
    }
    Stopwatch stopwatch;
    const ProcessorTime before = processor_time();
    Progress progress(std::cerr, !options_.quiet && stderr_is_terminal());
    PassProgress passes(progress, continuation_.start != nullptr ? continuation_.start->passes : 1, core::passes_max);
    update_ = [this, &progress, &passes](std::uint32_t done, std::uint32_t total) {
      if (live_) {
        live_->update(done, total);
      }
      options_.picture.is_refined ? passes.update(done, total) : progress.update(done, total);
    };
    report_.emplace(is_started_ ? ready_.go_on(*settings_, interrupt_.token())
                                : ready_.start([this](std::uint32_t done, std::uint32_t total) { update_(done, total); },
                                               interrupt_.token()));
    is_started_ = true;
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
    if (has_viewers()) {
      attempts.make([&] { live_->show(film); });
    }
    if (checkpoints_ && is_written) {
      attempts.make([&] { checkpoints_->finish(); });
    } else if (checkpoints_ && checkpoints_->has_one()) {
      std::cerr << "dmpc: the checkpoint stays, --resume goes on from it\n";
    }
    Sights sights;
    attempts.make([&] { sights = take_sights(); });
    write_others(sights, attempts);
    return attempts.status();
  }

  /// Who looks on, or may in the end, where the page stays.
  bool has_viewers() const { return live_ && (live_->has_had_visitors() || stderr_is_terminal()); }

  void tell_end(const std::string& said) {
    if (live_) {
      live_->end({.said = said});
    }
  }

  /// For those who look on.
  std::string last_words(bool is_well) const {
    if (asked_.frames.are_several()) {
      return is_well ? "All frames are done." : "A frame is not written whole, and no further one is made: dmpc has said why.";
    }
    return is_well ? "The picture is done." : "The picture is done, but not all was well: dmpc has said what.";
  }

  /// On a terminal those who look on have the page until a signal comes, in a script until they have got it.
  void stay(int status) {
    if (!live_) {
      return;
    }
    live_->end({.said = last_words(status == 0), .figures = closing_, .page = std::move(page_)}, interrupt_.token());
    if (const std::string complaint = live_->complaint(); !complaint.empty()) {
      std::cerr << "dmpc: who looked on was told nothing any more: " << complaint << '\n';
    }
    if (stderr_is_terminal()) {
      std::cerr << "dmpc: the page stays at " << live_->address() << " until Ctrl-C\n";
      LiveView::wait(interrupt_.token());
    }
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
    if (options_.report && has_viewers()) {
      attempts.make([&] { page_ = html::render_page(record, this_origin(record.scene_digest), std::cerr); });
    }
    attempts.make([&] { print_closing(record); });
  }

  /// What goes to the standard output: counters if they were asked for there, then the closing lines.
  void print_closing(const RenderRecord& record) {
    if (has_counters_on_standard_output(options_)) {
      output_ << stats_json(record);
    }
    std::ostringstream lines;
    asked_.frames.are_several() ? print_frame(lines, *frame_, record) : print_summary(lines, record);
    closing_ += lines.str();
    if (!options_.quiet) {
      output_ << lines.str();
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

  /// Those of `notes` that say something, and have not been said of a frame before.
  void tell_once(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
      if (!note.empty() && told_.insert(note).second) {
        std::cerr << "dmpc: " << note << '\n';
      }
    }
  }

  std::uint64_t samples_found_done() const { return checkpoints_ ? checkpoints_->samples_found_done() : 0; }

  RenderOptions asked_;    ///< with names for all frames
  RenderOptions options_;  ///< of the frame; with where references are noted
  Interrupt& interrupt_;
  std::ostream& output_;
  Files& files_;
  OutputSet<RenderRecord> outputs_ = outputs_of(options_);
  FrameScenes scenes_{asked_};
  std::set<std::uint64_t> frames_there_;         ///< those asked for that were done before
  std::optional<std::uint64_t> frame_;           ///< under way
  std::uint64_t contents_ = 0;                   ///< a digest of an animated scene, whatever the view
  std::optional<PictureIdentity> own_identity_;  ///< that of the scene's own picture, where there is a checkpoint
  std::set<std::string> told_;                   ///< what is said once
  Seconds seconds_;
  std::optional<FileLock> lock_;
  std::unique_ptr<LiveView> live_;  ///< outlives all that it looks on at
  std::optional<Checkpoints> checkpoints_;
  std::optional<std::uint64_t> scene_digest_;  ///< if a page tells it
  core::Box bounds_;                           ///< of the scene
  UpAxis up_;                                  ///< of the scene, where a camera is advised
  std::optional<Subject> subject_;
  std::optional<core::RenderSettings> settings_;  ///< of the frame
  std::optional<Onlookers> onlookers_;
  std::string closing_, page_;  ///< for who looks on, in the end
  core::Continuation continuation_;
  ReadyRun ready_;
  nodes::Progress update_;  ///< of the frame under way
  bool is_started_ = false;
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
