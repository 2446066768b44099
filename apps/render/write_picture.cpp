#include <algorithm>
#include <cstdint>
#include <iostream>
#include <numeric>
#include <ostream>
#include <sstream>
#include <string>
#include <variant>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/picture/film_image.h"
#include "apps/render/outputs.h"
#include "apps/render/picture_notes.h"
#include "apps/render/stages.h"
#include "apps/run/render_record.h"
#include "apps/scene/load_scene.h"
#include "apps/show/page/render_page.h"
#include "apps/show/stats/stats.h"
#include "apps/show/summary.h"
#include "apps/show/trace/file.h"

namespace dmpc::apps {
namespace {

/// Nothing where all have all.
std::string travel_text(const svm::Report& report) {
  const std::uint64_t faults = report.pages().faults;
  const svm::QuestionCounters questions = report.questions();
  const std::uint64_t asked = questions.rays_asked + questions.records_asked;
  if (asked > 0) {
    return ", " + counted(asked, "question");
  }
  return report.plan.request.strategy->fetches_pages() ? ", " + counted(faults, "fault") : "";
}
std::string travel_text(const dataflow::Report& report) {
  const auto out = report.rays().out;
  return ", " + counted(std::accumulate(out.begin(), out.end(), std::uint64_t{0}), "ray") + " sent on";
}

std::string virtual_text(const Account& account, std::uint64_t film_hash) {
  return !account.virtual_time ? ""
                               : ", virtual " + seconds_text(static_cast<double>(account.virtual_time->total_ns) * 1e-9) +
                                     ", run_hash " + hash_text(account.virtual_time->run_hash(film_hash));
}

/// A line: the frame, its picture and film, what its nodes fetched, asked or sent on, all that was sent, and times.
void print_frame(std::ostream& output, std::uint64_t frame, const RenderRecord& record) {
  const Account account = account_of(record.report);
  output << "frame " << grouped(frame) << "  " << shown(record.options.image.string()) << ", film "
         << hash_text(record.film_hash());
  if (record.copied_frame) {
    output << ", a copy of frame " << grouped(*record.copied_frame) << std::endl;
    return;
  }
  output << std::visit([](const auto& report) { return travel_text(report); }, record.report) << ", "
         << bytes_text(nodes::total(account.sent).bytes) << " sent, " << seconds_text(record.seconds.render)
         << virtual_text(account, record.film_hash()) << std::endl;  // seen at once, also in a file that somebody follows
}

/// With path tracing it says so, too. Has the layers that go into the picture's file.
ImageRows rows_for(const RenderOptions& options, const core::Film& film, const std::vector<LayerImage>& layers) {
  ImageRows rows = rows_of(film);
  for (const LayerImage& image : layers) {
    if (std::ranges::any_of(options.layers, [&](const LayerRequest& one) { return one.layer == image.layer && !one.path; })) {
      rows.layers.push_back(&image.channels);
    }
  }
  if (options.picture.transport.is_by_paths()) {
    rows.remarks.emplace_back("transport", text_of(options.picture.transport));
  }
  return rows;
}

/// Returns the seconds that it took.
double write_film(const RenderCall& call, const PlannedPicture& planned, const core::Film& film) {
  const RenderOptions& options = planned.options;
  call.interrupt.set_consequence("the picture was not written");
  const Interrupt::EndAtOnce end_at_once(call.interrupt, Interrupt::EndAtOnce::Before::is_passed_over);
  Stopwatch stopwatch;
  OutputFile picture(options.image, {.option = "-o"}, call.files);
  picture.write(encoded_picture(options.image, rows_for(options, film, planned.layers)));
  call.interrupt.set_consequence("the picture was perhaps not written");
  picture.commit();
  call.interrupt.set_consequence("the picture was written, the other outputs are incomplete");
  return stopwatch.lap();
}

std::uint64_t samples_found_done(const RenderCall& call) { return call.checkpoints ? call.checkpoints->samples_found_done() : 0; }

/// If few or none of the rays from the eye have met anything of a scene that has something.
std::string small_text(const RenderCall& call, const SceneFacts& scene, const Account& account) {
  if (samples_found_done(call) > 0 || scene.bounds.empty()) {
    return "";
  }
  const double share = static_cast<double>(account.operations.primary_hits) / static_cast<double>(account.film.samples());
  const double share_max = is_mesh(call.asked.picture.scene) ? small_share : 0;
  return share <= share_max ? small_note(share, scene.bounds, scene.up) : "";
}

/// Shadow rays that brought light, where none is shot that would not.
std::uint64_t lit_in(const RenderOptions& options, const Account& account) {
  const bool all_bring_light = options.picture.skips.zero_terms && options.picture.convention == core::Convention::haines;
  const std::uint64_t shot = account.operations.rays[static_cast<std::size_t>(core::RayKind::shadow)];
  return all_bring_light ? shot - account.operations.shadow_blocked : 0;
}

/// Somebody looks on, or may in the end, where the page stays.
bool has_viewers(const RenderCall& call) { return call.live && (call.live->has_had_visitors() || stderr_is_terminal()); }

/// `is_done`: it is written, and as good as it was asked for.
void end_checkpoint(RenderCall& call, bool is_done, Attempts& attempts) {
  if (call.checkpoints && is_done) {
    attempts.make([&] { call.checkpoints->finish(); });
  } else if (call.checkpoints && call.checkpoints->has_one()) {
    std::cerr << "dmpc: the checkpoint is kept; --resume continues from it\n";
  }
}

/// What the observers have seen; says so if some of a trace was lost, or there is none.
RunProfile take_run_profile(const RenderCall& call, Observers& observers) {
  RunProfile run_profile = observers.take();
  if (run_profile.trace) {
    call.say({loss_note(*run_profile.trace), empty_note(*run_profile.trace)});
  }
  return run_profile;
}

/// What goes to the standard output: counters if they were asked for there, then the closing lines, which it returns, unless
/// nobody reads them.
std::string print_closing(const RenderCall& call, const DueFrame& frame, const RenderRecord& record) {
  if (has_counters_on_standard_output(record.options)) {
    call.output << stats_json(record);
  }
  std::ostringstream lines;
  if (!call.asked.quiet || call.live) {
    call.asked.frames.are_several() ? print_frame(lines, *frame.number, record) : print_summary(lines, record);
  }
  if (!call.asked.quiet) {
    call.output << lines.str();
  }
  finish_output(call.output, "what follows the picture");
  return lines.str();
}

void write_others(const RenderCall& call, const DueFrame& frame, const RenderRecord& record, Attempts& attempts,
                  WrittenPicture& written) {
  const Interrupt::EndAtOnce end_at_once(call.interrupt);
  frame.outputs.write(record, attempts, call.files);
  if (record.options.report && has_viewers(call)) {
    attempts.make([&] { written.page = html::render_page(record, this_origin(record.scene_digest)); });
  }
  attempts.make([&] { written.closing = print_closing(call, frame, record); });
}

}  // namespace

WrittenPicture write_picture(RenderCall& call, const DueFrame& frame, PlannedPicture& planned, RenderedPicture rendered) {
  const Account account = account_of(rendered.report);
  const SceneFacts& scene = planned.built.facts;
  Attempts attempts(std::cerr);
  const bool is_written = attempts.make([&] { rendered.seconds.write = write_film(call, planned, account.film); });
  if (!rendered.copied_frame) {
    attempts.make([&] { call.say(film_notes(account.film, lit_in(planned.options, account))); });
    attempts.make([&] { call.say({small_text(call, scene, account)}); });
  }
  if (has_viewers(call) && !rendered.copied_frame) {
    attempts.make([&] { call.live->show(account.film); });
  }
  end_checkpoint(call, is_written && !account.refinement.is_cut_short, attempts);
  RunProfile run_profile;
  attempts.make([&] { run_profile = take_run_profile(call, planned.observers); });
  const ProcessorTime all = processor_time();
  rendered.seconds.user = all.user;
  rendered.seconds.system = all.system;
  WrittenPicture written;
  const RenderRecord record = {.options = planned.options,
                               .database = planned.built.subject.database,
                               .report = rendered.report,
                               .seconds = rendered.seconds,
                               .heat = planned.observers.heat(),
                               .layers = &planned.layers,
                               .trace = run_profile.trace ? &*run_profile.trace : nullptr,
                               .view = run_profile.view ? &*run_profile.view : nullptr,
                               .references = run_profile.references.empty() ? nullptr : &run_profile.references,
                               .samples_found_done = samples_found_done(call),
                               .scene_digest = scene.digest,
                               .copied_frame = rendered.copied_frame};
  write_others(call, frame, record, attempts, written);
  written.status = attempts.status();
  if (call.asked.frames.are_several()) {
    planned.done = {rendered.copied_frame.value_or(*frame.number), view_text(call.scenes.view(frame.number)),
                    std::move(rendered.report)};
  }
  return written;
}

}  // namespace dmpc::apps
