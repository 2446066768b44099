#include "apps/render/call.h"

#include <iostream>

#include "apps/frontend/line/parsed_number.h"
#include "apps/oracle/oracle.h"
#include "apps/render/outputs.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

namespace {

RenderOptions with_machine(RenderOptions options, const Interrupt& interrupt) {
  choose_machine(options);
  load_policy(options, [&interrupt] { interrupt.check(); });
  return options;
}

}  // namespace

RenderCall::RenderCall(const RenderOptions& options, Interrupt& interrupts, std::ostream& out, Files& written_to)
    : asked(with_machine(options, interrupts)), interrupt(interrupts), output(out), files(written_to) {}

void RenderCall::say(const std::vector<std::string>& notes) const {
  if (!asked.quiet) {
    say_notes(notes);
  }
}

void RenderCall::report_once(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (!note.empty() && reported.insert(note).second) {
      std::cerr << "dmpc: " << note << '\n';
    }
  }
}

void RenderCall::set_consequence() {
  const bool are_frames = asked.frames.are_several();
  if (checkpoints && checkpoints->has_one()) {
    interrupt.set_consequence(
        are_frames ? "this frame was not written, the frames before it were; --resume continues from the checkpoint"
                   : "no picture was written; --resume continues from the checkpoint");
  } else if (are_frames) {
    interrupt.set_consequence("this frame was not written, the frames before it were; --resume skips them");
  } else if (checkpoints) {
    interrupt.set_consequence("no picture was written");
  }
}

void claim(RenderCall& call, const DueFrame& first) {
  check_outputs(first.options, first.outputs);
  if (call.asked.tracer == TracerChoice::embree) {
    open_embree();
  }
  if (std::optional<FileLock> lock = claim_checkpoint(call.asked.checkpoint)) {
    call.lock.emplace(std::move(*lock));
  }
  if (!call.asked.serve_port.empty()) {
    call.live = std::make_unique<LiveView>(*number_in<std::uint16_t>(call.asked.serve_port),
                                           "dmpc render " + call.asked.picture.scene, [&call] { call.interrupt.stop_once(); });
    std::cerr << "dmpc: to be seen at " + call.live->address() + "\n";  // at once
  }
}

}  // namespace dmpc::apps
