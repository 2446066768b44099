#include "apps/render.h"

#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

#include "apps/checkpoints.h"
#include "apps/distinct_files.h"
#include "apps/heat_files.h"
#include "apps/html/render_page.h"
#include "apps/load_scene.h"
#include "apps/machines.h"
#include "apps/onlookers.h"
#include "apps/origin.h"
#include "apps/output_file.h"
#include "apps/preview.h"
#include "apps/progress.h"
#include "apps/run_strategy.h"
#include "apps/stats.h"
#include "apps/stopwatch.h"
#include "apps/subject.h"
#include "apps/summary.h"
#include "apps/trace_file.h"

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

/// Returns what keeps others off the checkpoint, if there is to be one.
std::optional<FileLock> check_outputs(const RenderOptions& options) {
  std::vector<NamedFile> inputs, outputs = {{"-o", options.image}};
  add_scene_file(options.picture.scene, inputs);
  if (options.computer.runner == RunnerKind::virtual_time && find_machine_preset(options.computer.machine_name) == nullptr) {
    inputs.push_back({"--machine", options.computer.machine_name});
  }
  if (options.stats) {
    outputs.push_back({"--stats", *options.stats});
  }
  if (options.trace.path) {
    outputs.push_back({"--trace", *options.trace.path});
  }
  if (options.report) {
    outputs.push_back({"--report", *options.report});
  }
  for (const HeatRequest& request : options.heat_maps) {
    outputs.push_back({"--heatmap", request.path});
  }
  if (options.checkpoint.file) {
    outputs.push_back({"--checkpoint", *options.checkpoint.file});
  }
  check_distinct(inputs, outputs);
  check_image_path(options.image, "-o");
  if (options.stats) {
    check_output_path(*options.stats, "--stats");
  }
  if (options.trace.path) {
    check_output_path(*options.trace.path, "--trace");
  }
  if (options.report) {
    check_output_path(*options.report, "--report");
  }
  for (const HeatRequest& request : options.heat_maps) {
    check_image_path(request.path, "--heatmap");
  }
  return claim_checkpoint(options.checkpoint);
}

/// What is rendered, and the digest of its scene if a page tells it.
struct Loaded {
  Subject subject;
  std::optional<std::uint64_t> scene_digest;
};

/// Reads and builds, and makes `checkpoints` if some are asked for; a signal ends the process here and now.
Loaded load(const RenderOptions& options, std::optional<Checkpoints>& checkpoints, Interrupt& interrupt, Seconds& seconds) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  Stopwatch stopwatch;
  core::Scene scene = load_scene(options.picture, options.quiet ? LoadNotes::silent : LoadNotes::said);
  if (options.checkpoint.file) {
    checkpoints.emplace(options.checkpoint, identity_of(options, scene), std::cerr, options.quiet, interrupt.token());
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

/// Where the nodes' meters write; nothing if nobody wants to know.
std::optional<nodes::HeatMap> make_heat_map(const RenderOptions& options, const core::Camera& camera) {
  if (options.heat_maps.empty()) {
    return std::nullopt;
  }
  return nodes::HeatMap(static_cast<std::uint32_t>(camera.width() * camera.height()), kinds_of(options.heat_maps));
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

/// Plans, and says what the user should know before waiting for the picture; a signal ends the process here and now.
ReadyRun prepare(const RenderOptions& options, const Subject& subject, const RunTies& ties, Interrupt& interrupt,
                 Seconds& seconds) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  Stopwatch stopwatch;
  ReadyRun run = make_ready(options, subject.database, subject.settings, {}, ties);
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
  interrupt.check();
  core::expect(account_of(report).end == nodes::RunEnd::finished, "a run that nobody stopped is finished");
  const ProcessorTime after = processor_time();
  seconds.render = stopwatch.lap();
  seconds.render_user = after.user - before.user;
  seconds.render_system = after.system - before.system;
  return report;
}

/// A file of text, as far as there is a text.
class TextFile {
 public:
  TextFile(const std::optional<std::filesystem::path>& path, const std::string& text) {
    if (!text.empty()) {
      file_.emplace(*path).write(text);
    }
  }
  void commit() {
    if (file_) {
      file_->commit();
    }
  }

 private:
  std::optional<OutputFile> file_;
};

/// What is written of a run beside its picture.
struct Texts {
  std::string counters;  ///< for --stats
  std::string page;      ///< for --report
};

/// Writes all files before any gets its name, so that a failure leaves none of them.
void write_files(const RenderRecord& record, OutputFile& picture, const Texts& texts, Interrupt& interrupt) {
  HeatFiles heat_maps(record);
  TraceFile trace(record);
  TextFile stats(record.options.stats, texts.counters), page(record.options.report, texts.page);
  interrupt.set_consequence("perhaps not all outputs were written");
  picture.commit();
  heat_maps.commit();
  trace.commit();
  stats.commit();
  page.commit();
}

/// What goes to the standard output: counters if they were asked for there, then the closing lines.
void print_closing(const RenderRecord& record, const std::string& counters, std::ostream& output) {
  output << counters;
  if (!record.options.quiet) {
    print_summary(output, record);
  }
  finish_output(output, "the picture was written, but what follows it");
}

void write_outputs(RenderRecord record, Interrupt& interrupt, std::ostream& output) {
  std::signal(SIGPIPE, SIG_IGN);  // a pipe that nobody reads is an error to report, and no reason to leave temporary files
  interrupt.set_consequence("the picture was not written");
  Texts texts{.page = record.options.report ? html::render_page(record, this_origin(record.scene_digest), std::cerr) : ""};
  interrupt.check();
  const Interrupt::EndAtOnce end_at_once(interrupt);
  Stopwatch stopwatch;
  const RenderOptions& options = record.options;
  OutputFile picture(options.image);
  write_image(options.image, image_of(account_of(record.report).film), picture);
  record.seconds.write = stopwatch.lap();
  const ProcessorTime all = processor_time();
  record.seconds.user = all.user;
  record.seconds.system = all.system;
  std::string counters = options.stats ? stats_json(record) : "";
  const bool to_standard_output = options.stats && is_standard_output(*options.stats);
  if (!to_standard_output) {
    texts.counters.swap(counters);
  }
  write_files(record, picture, texts, interrupt);
  interrupt.set_consequence("the picture was written, what follows it is incomplete");
  print_closing(record, counters, output);
}

}  // namespace

Image image_of(const core::Film& film) {
  Image image(film.width(), film.height());
  for (std::uint32_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    const core::Vec3d radiance = film.radiance(pixel);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      image.rgb[std::size_t{pixel} * 3 + channel] = static_cast<float>(radiance[channel]);
    }
  }
  return image;
}

int render_command(const RenderOptions& asked, Interrupt& interrupt, std::ostream& output) {
  const std::optional<FileLock> lock = check_outputs(asked);
  RenderOptions options = asked;
  choose_machine(options);
  Seconds seconds;
  std::optional<Checkpoints> checkpoints;
  Loaded loaded = load(options, checkpoints, interrupt, seconds);
  Subject& subject = loaded.subject;
  std::optional<nodes::HeatMap> heat = make_heat_map(options, subject.settings.camera);
  Onlookers onlookers(options, static_cast<std::uint32_t>(subject.database.page_count()));
  const std::unique_ptr<Preview> preview =
      make_preview(options, subject.settings.camera, checkpoints ? checkpoints->start() : nullptr, interrupt.token());
  const RunTies ties{.distributed = [&subject] { subject.database.forget_records(); },  // the nodes have theirs
                     .heat = heat ? &*heat : nullptr,
                     .observer = onlookers.observer(),
                     .reference_logs = onlookers.reference_logs(),
                     .continuation = continuation_of(checkpoints ? &*checkpoints : nullptr, preview.get(), interrupt)};
  const ReadyRun run = prepare(options, subject, ties, interrupt, seconds);
  if (checkpoints) {
    interrupt.set_consequence(consequence_of(*checkpoints));
  }
  const Report report = run_timed(options, run, interrupt, seconds);
  const Sights sights = take_sights(options, onlookers);
  write_outputs({options, subject.database, report, seconds, heat ? &*heat : nullptr, sights.trace ? &*sights.trace : nullptr,
                 sights.view ? &*sights.view : nullptr, checkpoints ? checkpoints->samples_found_done() : 0, loaded.scene_digest},
                interrupt, output);
  if (checkpoints) {
    checkpoints->finish();
  }
  if (preview) {
    preview->finish(account_of(report).film);
  }
  return 0;
}

}  // namespace dmpc::apps
