#include <sys/resource.h>

#include <chrono>
#include <cstdint>
#include <iostream>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/render/stages.h"
#include "core/base/expect.h"
#include "core/picture/sampling/refinement.h"

namespace dmpc::apps {

namespace {

void announce(RenderCall& call, const DueFrame& frame, const std::optional<DoneFrame>& equal) {
  const FrameOptions& frames = call.asked.frames;
  if (call.checkpoints || frames.are_several()) {
    call.set_consequence();
  }
  if (call.live && equal) {
    call.live->say("Frame " + grouped(*frame.number) + " equals frame " + grouped(equal->number) + ".");
    return;
  }
  if (call.live) {
    call.live->say(frames.are_several()
                       ? "Frame " + grouped(*frame.number) + " is rendered, the last is " + grouped(frames.range->last) + "."
                       : "Rendering the picture.");
  }
}

Report render_with_progress(RenderCall& call, WarmNodes& nodes) {
  const core::PartialPicture* const start = call.checkpoints ? call.checkpoints->start() : nullptr;
  Progress progress(std::cerr, !call.asked.quiet && stderr_is_terminal());
  const auto begin = std::chrono::steady_clock::now();
  call.passes.emplace(progress,
                      RefinedRun{.error = call.asked.picture.refinement.error,
                                 .seconds = call.asked.seconds_max,
                                 .pass = start != nullptr ? start->passes : 1,
                                 .samples_done = start != nullptr ? start->samples_done() : 0},
                      [begin] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); });
  return nodes.render(
      [&](std::uint32_t done, std::uint32_t total) {
        if (call.live) {
          call.live->update(done, total);
        }
        call.asked.picture.is_refined ? call.passes->update(done, total) : progress.update(done, total);
      },
      call.interrupt.token());
}

}  // namespace

ProcessorTime processor_time() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(usage.ru_utime), seconds(usage.ru_stime)};
}

RenderedPicture render_picture(RenderCall& call, const DueFrame& frame, PlannedPicture& planned) {
  announce(call, frame, planned.done);
  if (planned.done) {
    clear_counters(planned.done->report);
    return {std::move(planned.done->report), planned.built.facts.seconds, planned.done->number};
  }
  Stopwatch stopwatch;
  const ProcessorTime before = processor_time();
  RenderedPicture rendered{render_with_progress(call, planned.nodes), planned.built.facts.seconds};
  if (account_of(rendered.report).end != nodes::RunEnd::finished) {  // else it is done, and a signal comes too late for it
    call.interrupt.check();
    core::expect(call.asked.computer.ranks != nullptr, "a run that nobody stopped is finished");
    throw Interrupted{};  // by a signal that came to another rank
  }
  const ProcessorTime after = processor_time();
  rendered.seconds.render = stopwatch.lap();
  rendered.seconds.render_user = after.user - before.user;
  rendered.seconds.render_system = after.system - before.system;
  return rendered;
}

}  // namespace dmpc::apps
