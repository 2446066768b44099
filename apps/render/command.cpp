#include "apps/render/command.h"

#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "apps/frontend/ranks/rank_group.h"
#include "apps/frontend/system/progress.h"
#include "apps/render/outputs.h"
#include "apps/render/ranks.h"
#include "apps/render/self_test.h"
#include "apps/render/stages.h"

namespace dmpc::apps {

namespace {

/// For those who look on.
std::string last_words(const RenderCall& call, bool is_well) {
  if (call.asked.frames.are_several()) {
    return is_well ? "All frames are done."
                   : "A frame was not written completely, and no further frame is rendered: see the messages of dmpc.";
  }
  return is_well ? "The picture is done." : "The picture is done, but there were errors: see the messages of dmpc.";
}

/// On a terminal those who look on have the page until a signal comes, in a script until they have got it.
void stay(RenderCall& call, LiveEnd end) {
  if (!call.live) {
    return;
  }
  call.live->end(std::move(end), call.interrupt.token());
  if (const std::string complaint = call.live->complaint(); !complaint.empty()) {
    std::cerr << "dmpc: the page received no further updates: " << complaint << '\n';
  }
  if (stderr_is_terminal()) {
    std::cerr << "dmpc: the page stays at " << call.live->address() << " until Ctrl-C\n";
    LiveView::wait(call.interrupt.token());
  }
}

/// The one after `last`, whose files can be written.
std::optional<DueFrame> next_frame(RenderCall& call, const DueFrames& frames, const DueFrame& last) {
  std::optional<DueFrame> next = frames.after(last);
  if (next) {
    call.interrupt.check();
    check_outputs(next->options, next->outputs);
  }
  return next;
}

/// From the scene to files, as long as all goes well. Returns the exit status.
int render_all(RenderCall& call, const DueFrames& frames, std::optional<DueFrame> frame) {
  std::unique_ptr<PlannedPicture> planned;
  WrittenPicture written;
  std::string closing;
  while (written.status == 0 && frame) {
    planned = call.apart([&] { return plan_picture(call, *frame, frames, std::move(planned)); });
    call.apart([&] { render_layers(call, *planned); });
    RenderedPicture rendered = render_picture(call, *frame, *planned);
    written = call.apart([&] { return write_picture(call, *frame, *planned, std::move(rendered)); });
    closing += written.closing;
    frame = written.status == 0 ? call.apart([&] { return next_frame(call, frames, *frame); }) : std::nullopt;
  }
  call.apart(
      [&] { stay(call, {.said = last_words(call, written.status == 0), .figures = closing, .page = std::move(written.page)}); });
  return written.status;
}

void notify_end(const RenderCall& call, const std::string& said) {
  if (call.live) {
    call.live->end({.said = said});
  }
}

/// On ranks this is what the first one does.
int render_here(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files) {
  RenderCall call(options, interrupt, output, files);
  const DueFrames frames(call.asked);
  call.say({frames.note()});
  const std::optional<DueFrame> first = frames.first();
  if (!first) {
    call.apart([&] { end_frames(call, frames); });
    return 0;
  }
  claim(call, *first);
  try {
    return render_all(call, frames, first);
  } catch (const Interrupted&) {
    notify_end(call, "The run was interrupted: " + std::string(interrupt.consequence()) + ".");
    throw;
  } catch (const std::exception& error) {
    notify_end(call, "The run has failed: " + std::string(error.what()));
    throw;
  }
}

int render_by_mpi(RenderOptions options, RankGroup& group, Interrupt& interrupt, std::ostream& output, Files& files) {
  if (!options.is_node_count_given) {
    options.computer.node_count = group.default_node_count();
  }
  options.runner.idle = group.default_idle(options.computer);
  return render_over(group.connect(payload_bytes_max(options)), options, interrupt, output, files);
}

}  // namespace

int render_command(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files) {
  if (options.checkpoint.file) {
    interrupt.take_usr1_for_keep();
  }
  if (options.runner.kind == RunnerKind::mpi) {
    return run_as_rank({.own = renderer_compatibility()},
                       [&](RankGroup& group) { return render_by_mpi(options, group, interrupt, output, files); });
  }
  return render_here(options, interrupt, output, files);
}

int render_over(nodes::Fabric& fabric, const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files) {
  check_nodes_on_ranks(options, fabric.rank_count());
  const auto lead = [&](nodes::RankLinks& links) {
    if (links.rank_count() == 1 && !options.quiet) {
      std::cerr << "dmpc: --runner=mpi: this is the only process, so it has all nodes\n";
    }
    RenderOptions here = options;
    here.computer.ranks = &links;
    return render_here(here, interrupt, output, files);
  };
  return render_as_rank(fabric, options, lead, interrupt.token());
}

}  // namespace dmpc::apps
