#include "apps/render/command.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

#include "apps/edge/ranks/rank_group.h"
#include "apps/edge/system/attempts.h"
#include "apps/edge/system/output_file.h"
#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/effort/render_effort.h"
#include "apps/oracle/oracle.h"
#include "apps/picture/film_image.h"
#include "apps/render/checkpoints.h"
#include "apps/render/onlookers.h"
#include "apps/render/outputs.h"
#include "apps/render/preview.h"
#include "apps/render/ranks.h"
#include "apps/render/self_test.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "apps/show/stats/stats.h"
#include "apps/show/summary.h"
#include "apps/show/trace/file.h"
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

/// What is rendered, and the digest of its scene if a page tells it.
struct Loaded {
  Subject subject;
  std::optional<std::uint64_t> scene_digest;
};

/// Reads and builds, and makes `checkpoints` if some are asked for; a signal ends the process here and now.
Loaded load(const RenderOptions& options, const OutputSet<RenderRecord>& outputs, Files& files,
            std::optional<Checkpoints>& checkpoints, Interrupt& interrupt, Seconds& seconds) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  Stopwatch stopwatch;
  OpenedFiles opened;
  core::Scene scene = load_scene(options.picture, options.quiet ? LoadNotes::silent : LoadNotes::said, &opened);
  check_not_read(opened, files_of(outputs.names()));
  if (options.checkpoint.file) {
    checkpoints.emplace(options.checkpoint, identity_of(options, scene), std::cerr, options.quiet, interrupt.token(), files);
  }
  const auto digest = options.report ? std::optional(scene_digest(scene)) : std::nullopt;
  seconds.load = stopwatch.lap();
  Subject subject = build_subject(std::move(scene), options.picture, options.database, true);
  if (options.tracer != TracerChoice::embree) {
    subject.database.forget_primitives();
  }
  seconds.build = stopwatch.lap();
  return {std::move(subject), digest};
}

WatchOrder watch_order_for(const RenderOptions& options, const Subject& subject) {
  return watch_order(options, static_cast<std::uint32_t>(subject.database.page_count()), subject.settings.camera.pixel_count());
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

/// What the onlookers have seen; says so if some of a trace was lost, or there is none.
Sights take_sights(const RenderOptions& options, Onlookers& onlookers) {
  Sights sights = onlookers.take();
  if (!sights.trace || options.quiet) {
    return sights;
  }
  for (const std::string& note : {loss_note(*sights.trace, options.trace), empty_note(*sights.trace)}) {
    if (!note.empty()) {
      std::cerr << "dmpc: " << note << '\n';
    }
  }
  return sights;
}

/// Says how long a long render will take, where somebody waits; a signal ends the process here and now. Without what is done
/// already.
void announce_effort(const RenderOptions& options, const Subject& subject, const Checkpoints* checkpoints, Interrupt& interrupt) {
  if (options.quiet || !stderr_is_terminal()) {
    return;
  }
  const Interrupt::EndAtOnce end_at_once(interrupt);
  const double samples = static_cast<double>(subject.settings.camera.pixel_count()) * options.picture.samples;
  const double done = checkpoints == nullptr ? 0 : static_cast<double>(checkpoints->samples_found_done());
  Effort effort = render_effort(options, subject);
  effort.seconds *= std::max(0.0, 1 - done / samples);
  if (is_long(effort)) {
    announce("render " + options.picture.scene + (options.picture.is_refined ? ", at least" : ""), effort, options.quiet,
             std::cerr);
  }
}

/// Plans, and says what the user should know before waiting for the picture; a signal ends the process here and now.
ReadyRun prepare(const RenderOptions& options, const Subject& subject, const nodes::Watching& watching,
                 const core::Continuation& continuation, Interrupt& interrupt, Seconds& seconds) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  Stopwatch stopwatch;
  ReadyRun run = make_ready(options, subject.database, subject.settings, {}, watching, continuation);
  seconds.prepare = stopwatch.lap();
  for (const std::string& note : run.notes) {
    if (!options.quiet) {
      std::cerr << "dmpc: " << note << '\n';
    }
  }
  return run;
}

Report run_timed(const RenderOptions& options, const ReadyRun& run, const Interrupt& interrupt, Seconds& seconds) {
  Stopwatch stopwatch;
  const ProcessorTime before = processor_time();
  Progress progress(std::cerr, !options.quiet && stderr_is_terminal());
  const auto update = [&progress](std::uint32_t done, std::uint32_t total) { progress.update(done, total); };
  Report report = run.start(update, interrupt.token());
  if (account_of(report).end != nodes::RunEnd::finished) {  // else the picture is done, and a signal comes too late for it
    interrupt.check();
    core::expect(options.computer.ranks != nullptr, "a run that nobody stopped is finished");
    throw Interrupted{};  // by a signal that came to another rank
  }
  const ProcessorTime after = processor_time();
  seconds.render = stopwatch.lap();
  seconds.render_user = after.user - before.user;
  seconds.render_system = after.system - before.system;
  return report;
}

/// Before all else that is to be done, so that nothing that fails takes it away.
void write_picture(const RenderOptions& options, const core::Film& film, Files& files, Interrupt& interrupt, Seconds& seconds) {
  interrupt.set_consequence("the picture was not written");
  const Interrupt::EndAtOnce end_at_once(interrupt, Interrupt::EndAtOnce::Before::is_passed_over);
  Stopwatch stopwatch;
  OutputFile picture(options.image, {.option = "-o"}, files);
  picture.write(encoded_picture(options.image, image_of(film)));
  interrupt.set_consequence("perhaps the picture was not written");
  picture.commit();
  interrupt.set_consequence("the picture was written, what follows it is incomplete");
  seconds.write = stopwatch.lap();
}

/// What goes to the standard output: counters if they were asked for there, then the closing lines.
void print_closing(const RenderRecord& record, std::ostream& output) {
  if (has_counters_on_standard_output(record.options)) {
    output << stats_json(record);
  }
  if (!record.options.quiet) {
    print_summary(output, record);
  }
  finish_output(output, "what follows the picture");
}

void write_others(RenderRecord record, const OutputSet<RenderRecord>& outputs, Files& files, Interrupt& interrupt,
                  Attempts& attempts, std::ostream& output) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  const ProcessorTime all = processor_time();
  record.seconds.user = all.user;
  record.seconds.system = all.system;
  outputs.write(record, attempts, files);
  attempts.make([&] { print_closing(record, output); });
}

/// Where there are other ranks, they are shown that this one lives while it does something that has nothing to do with them.
template <class Work>
auto apart(const RenderOptions& options, const Work& work) {
  return options.computer.ranks == nullptr ? work() : nodes::with_life_signs(*options.computer.ranks, work);
}

/// Renders, on ranks the first one.
int render(RenderOptions options, Interrupt& interrupt, std::ostream& output, Files& files) {
  const OutputSet<RenderRecord> outputs = outputs_of(options);
  check_outputs(options, outputs);
  if (options.tracer == TracerChoice::embree) {
    open_embree();
  }
  const std::optional<FileLock> lock = claim_checkpoint(options.checkpoint);
  choose_machine(options);
  Seconds seconds;
  std::optional<Checkpoints> checkpoints;
  Loaded loaded = apart(options, [&] { return load(options, outputs, files, checkpoints, interrupt, seconds); });
  Subject& subject = loaded.subject;
  Onlookers onlookers(watch_order_for(options, subject));
  const std::unique_ptr<Preview> preview =
      make_preview(options, subject.settings.camera, checkpoints ? checkpoints->start() : nullptr, interrupt.token());
  nodes::Watching watching = onlookers.watching();
  watching.distributed = [&subject] { subject.database.forget_records(); };  // the nodes have theirs
  options.pages.reference_logs = onlookers.reference_logs();
  const core::Continuation continuation = continuation_of(checkpoints ? &*checkpoints : nullptr, preview.get(), interrupt);
  const ReadyRun run = apart(options, [&] {
    announce_effort(options, subject, checkpoints ? &*checkpoints : nullptr, interrupt);
    return prepare(options, subject, watching, continuation, interrupt, seconds);
  });
  if (checkpoints) {
    interrupt.set_consequence(consequence_of(*checkpoints));
  }
  const Report report = run_timed(options, run, interrupt, seconds);
  return apart(options, [&] {
    const core::Film& film = account_of(report).film;
    Attempts attempts(std::cerr);
    const bool is_written = attempts.make([&] { write_picture(options, film, files, interrupt, seconds); });
    if (checkpoints && is_written) {
      attempts.make([&] { checkpoints->finish(); });
    } else if (checkpoints && checkpoints->has_one()) {
      std::cerr << "dmpc: the checkpoint stays, --resume goes on from it\n";
    }
    Sights sights;
    attempts.make([&] { sights = take_sights(options, onlookers); });
    write_others({options, subject.database, report, seconds, onlookers.heat(), sights.trace ? &*sights.trace : nullptr,
                  sights.view ? &*sights.view : nullptr, sights.references.empty() ? nullptr : &sights.references,
                  checkpoints ? checkpoints->samples_found_done() : 0, loaded.scene_digest},
                 outputs, files, interrupt, attempts, output);
    if (preview) {
      preview->finish(film);
    }
    return attempts.status();
  });
}

int render_by_mpi(RenderOptions options, RankGroup& group, Interrupt& interrupt, std::ostream& output, Files& files) {
  if (!options.is_node_count_given) {
    options.computer.node_count = group.default_node_count();
  }
  if (!options.runner.idle) {
    options.runner.idle = group.default_idle(options.computer.node_count);
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
  return render(options, interrupt, output, files);
}

int render_over(nodes::Fabric& fabric, const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files) {
  check_nodes_on_ranks(options, fabric.rank_count());
  const auto render_here = [&](nodes::RankLinks& links) {
    if (links.rank_count() == 1 && !options.quiet) {
      std::cerr << "dmpc: --runner=mpi: this is the only process, so that all nodes are in it\n";
    }
    RenderOptions here = options;
    here.computer.ranks = &links;
    return render(here, interrupt, output, files);
  };
  return render_as_rank(fabric, options, render_here, interrupt.token());
}

}  // namespace dmpc::apps
