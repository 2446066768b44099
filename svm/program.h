// The node program of all strategies in which pixels stay on their node: pixels in flight, work items, and the packets about
// them. Its records have their own packets.
//
// A quantum runs one pixel, or some that share a task, until it has ended a ray or a bundle, finished, or needs an absent page.
// Newest first: the pixel that ran last goes on, another one starts only when none can run. With one pixel in flight this is the
// sequential ray tracer's order of references.
//
// Why the last node always makes progress: requests are served in receive(), regardless of the node's state. A reply's slot was
// reserved when its request was sent. A page that arrives runs every pixel that waited for it before the next packet is handled,
// and one step reads one record, so even one frame serves any number of pixels. A node with a full film starts no pixel and waits
// for the host, which waits for nobody.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "core/picture/memory_use.h"
#include "core/picture/pixel_task.h"
#include "core/trace/charge.h"
#include "nodes/byte_source.h"
#include "nodes/immutable_pieces.h"
#include "nodes/node.h"
#include "nodes/observers/meter.h"
#include "nodes/pictures/computer.h"
#include "svm/film_gather.h"
#include "svm/packets.h"
#include "svm/pages/node_program.h"
#include "svm/pages/plain_records.h"
#include "svm/plan.h"
#include "svm/slots.h"
#include "svm/work_source.h"

namespace dmpc::svm {

/// `Records` is described in PlainRecords; `Tracer` reads them; `Task` is core::PixelTask, core::BundleTask, or a test's.
template <class Records, class Tracer, class Task = core::PixelTask>
class ControlProgram final : public NodeProgram, public pictures::PictureProgram {
 public:
  /// Takes all its memory from `node`, which keeps `settings` and `database` (nodes/immutable_pieces.h). make_tracer(Records&)
  /// returns the tracer. `meter` is set if costs per pixel are observed.
  template <class MakeTracer>
  ControlProgram(nodes::Node& node, const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                 const MakeTracer& make_tracer, const std::optional<nodes::Meter>& meter = std::nullopt)
      : settings_room_(node.memory(), core::MemoryUse::constants, sizeof(settings), sizeof(settings)),
        settings_(keep(settings)),
        node_(&node),
        host_(nodes::NodeId{plan.request.computer.node_count}),
        records_(node, plan.pages(), database),
        tracer_(make_tracer(records_)),
        slots_(node.memory(), plan.task_count(), static_cast<std::uint32_t>(plan.request.waiting_hits_max)),
        work_(node, plan.work(), settings.skips.idle_nodes),
        film_(node, plan.film()),
        may_leave_runs_(!plan.request.computer.machine && !meter),
        meter_(meter) {
    core::expect(Task::pixels_max == plan.pixels_a_task, "a node's tasks are those of the plan");
    node.grant(host_, control_channel, 1);  // for Done
  }

  void begin_frame(const core::RenderSettings& settings) override {
    core::expect(stopped_, "a frame begins when the one before has ended");
    settings_ = keep(settings);
    work_.begin_frame();
    node_->grant(host_, control_channel);  // for Done
    done_ = stopped_ = false;
  }

  /// Packets about records come first: most are. The first pixel that continues with what a packet brings is charged for it.
  void receive(const nodes::Packet& packet) override {
    begin_metering();
    if (records_.receive(packet, *this)) {
      return;
    }
    switch (Kind{packet.kind}) {
      case Kind::work_request:
        return work_.answer(packet.as<WorkRequest>());
      case Kind::work_reply:
        return work_.take_reply(packet);
      case Kind::film_acknowledgement:
        return film_.acknowledged();
      case Kind::mask_part:
        return take_mask(packet);
      case Kind::begin_pass:
        return begin_pass();
      case Kind::stop:
        return stop();
      default:
        break;
    }
    core::expect(false, "a node receives only what is sent to nodes");
  }

  bool work() override {
    begin_metering();
    if (!slots_.has_runnable() && can_start() && !leave_background()) {
      start();
    }
    if (slots_.has_runnable()) {
      go_on(slots_.take_runnable());
    }
    const bool more = slots_.has_runnable() || can_start();
    if (!more) {
      fall_idle();
    }
    return more;
  }

  bool finished() const override { return stopped_; }

  nodes::Charges charges() const override {
    nodes::Charges charges{core::charges_of(operations_)};
    records_.add_charges(charges);
    return charges;
  }

  nodes::Levels levels() const override {
    nodes::Levels levels = records_.levels();
    levels.add({"pixels done", pixels_rendered_});
    return levels;
  }

  std::string describe() const override {
    return std::to_string(pixels_in_flight_) + " pixels in flight, " + std::to_string(records_.pending()) + " " +
           Records::awaited + " awaited, " + std::to_string(film_.gathered()) + " pixels gathered, " +
           std::to_string(film_.under_way()) + " film packets unacknowledged, " + work_.describe() +
           (stopped_ ? ", stopped"
            : done_  ? ", done"
                     : "");
  }

  ProgramReport report() const override {
    ProgramReport report{operations_, records_.counters(), work_.counters()};
    report.work.pixels_rendered = pixels_rendered_;
    report.rays_ended = rays_ended_;
    report.operations.skipped.idle_nodes = work_.nodes_passed_over();
    report.questions = records_.questions();
    return report;
  }

  // For records only, to continue the pixels that wait for them.

  Task& task(std::uint32_t slot) { return slots_.task(slot); }
  const core::RenderSettings& settings() const { return *settings_; }
  /// The node's work is counted there, including that for other nodes' pixels.
  core::Operations& operations() { return operations_; }
  /// Runs the pixel, or those of the task, until a ray or bundle has ended, all is finished, or something is absent.
  void go_on(std::uint32_t slot) {
    records_.select(slot);
    run(slot);
    end_metering(slots_.task(slot));
  }

 private:
  const core::RenderSettings* keep(const core::RenderSettings& settings) {
    static_assert(std::is_trivially_copyable_v<core::RenderSettings>);
    settings_room_.put(0, std::as_bytes(std::span(&settings, 1)));
    return reinterpret_cast<const core::RenderSettings*>(settings_room_.at(0));
  }

  bool leaves_runs() const {
    return may_leave_runs_ && settings_->skips.background && settings_->background.count() > 0 && settings_->is_beyond_alike();
  }

  bool can_start() const {
    return slots_.has_free() && work_.has_pixel() && film_.has_room_for(pixels_in_flight_ + Task::pixels_max);
  }

  /// Neighbouring background pixels are sent to the host row by row, without a task. On a modelled machine and for heat maps each
  /// is a pixel like others.
  bool leave_background() {
    const PixelRectangle pixels =
        leaves_runs() ? work_.take_background(settings_->background, film_.room_left() - pixels_in_flight_) : PixelRectangle{};
    if (pixels.width == 0) {
      return false;
    }
    const core::PixelSums sums = core::background_sums(pixels.pixel_count(), *settings_, operations_);
    for (std::uint32_t row = 0; row < pixels.height; ++row) {
      film_.add(pixels.pixel(0, row, work_.image_width()), sums, pixels.width);
    }
    rays_ended_ += pixels.pixel_count() * settings_->first_samples().count;
    pixels_rendered_ += pixels.pixel_count();
    return true;
  }

  /// A task takes pixels of one tile, so the bundles do not depend on which node takes which item.
  void start() {
    const std::uint32_t slot = slots_.take_free();
    std::array<std::uint32_t, Task::pixels_max> pixels;
    std::array<core::SampleStep, Task::pixels_max> steps;
    std::uint32_t count = 0;
    do {
      steps[count] = work_.next_step();
      pixels[count++] = work_.next_pixel();
    } while (count < Task::pixels_max && work_.stays_in_tile());
    slots_.task(slot).start(std::span<const std::uint32_t>(pixels).first(count),
                            std::span<const core::SampleStep>(steps).first(count), *settings_, operations_);
    pixels_in_flight_ += count;
    records_.select(slot);
    records_.forget();
    slots_.make_runnable(slot);
  }

  void run(std::uint32_t slot) {
    switch (slots_.task(slot).run(tracer_, *settings_, operations_)) {
      case core::TaskState::more:
        rays_ended_ += slots_.task(slot).rays_ended();
        return slots_.make_runnable(slot);
      case core::TaskState::finished:
        return finish(slot);
      case core::TaskState::absent:
        return records_.lacks(slot, *this);
    }
  }

  /// What the node counts from here to end_metering() belongs to one pixel.
  void begin_metering() {
    if (meter_) [[unlikely]] {
      meter_->begin(heat_totals());
    }
  }

  void end_metering(const Task& task) {
    if (meter_) [[unlikely]] {
      meter_->end(task.pixel(), task.ray().depth, heat_totals());
      meter_->claim(task.pixel());  // after several passes the last one's node remains
    }
  }

  // Out of line, so that it does not lengthen a quantum without a meter.
  [[gnu::noinline]] nodes::HeatTotals heat_totals() const {
    const PageCounters pages = records_.counters();
    nodes::HeatTotals totals{.charges = charges()};
    totals[core::HeatKind::rays] = operations_.ray_count();
    totals[core::HeatKind::references] = pages.references;
    totals[core::HeatKind::faults] = pages.faults;
    totals[core::HeatKind::pages] = pages.distinct_pages;
    return totals;
  }

  void finish(std::uint32_t slot) {
    const Task& task = slots_.task(slot);
    for (std::uint32_t place = 0; place < task.pixel_count(); ++place) {
      film_.add(task.pixel(place), task.sums(place));
    }
    pixels_rendered_ += task.pixel_count();
    pixels_in_flight_ -= task.pixel_count();
    slots_.make_free(slot);
  }

  /// Nothing can run until a packet arrives: sends questions, asks for work, sends gathered pixels, or reports that all is done.
  void fall_idle() {
    records_.flush();
    if (slots_.has_free() && !work_.has_pixel()) {
      work_.ask();
    }
    if (slots_.active() == 0) {
      film_.flush();
    }
    if (!done_ && slots_.active() == 0 && work_.exhausted() && film_.settled()) {
      core::expect(records_.pending() == 0, "nothing is awaited when no pixel is in flight");
      node_->send_reserved(host_, control_channel, number_of(Kind::done), Done{pixels_rendered_ - pixels_announced_});
      pixels_announced_ = pixels_rendered_;
      done_ = true;
    }
  }

  void take_mask(const nodes::Packet& packet) {
    core::expect(done_, "the mask of a pass comes when the one before has ended");
    work_.take_mask(packet.as<MaskPart>());
    node_->grant(host_, control_channel);  // the slot that the part has reserved
    node_->send_reserved(host_, control_channel, number_of(Kind::mask_acknowledgement), MaskAcknowledgement{});
  }

  void begin_pass() {
    core::expect(done_ && !stopped_, "a pass begins when the one before has ended");
    work_.begin_pass();
    node_->grant(host_, control_channel);  // for Done
    done_ = false;
  }

  void stop() {
    core::expect(done_ && !stopped_, "the host stops only nodes that are done, and once");
    stopped_ = true;
  }

  nodes::ImmutablePieces settings_room_;
  const core::RenderSettings* settings_;
  nodes::Node* node_;
  nodes::NodeId host_;
  Records records_;
  Tracer tracer_;
  Slots<Task> slots_;
  WorkSource work_;
  FilmGather film_;
  core::Operations operations_;
  std::uint64_t pixels_rendered_ = 0, pixels_announced_ = 0;
  std::uint64_t rays_ended_ = 0;
  std::uint32_t pixels_in_flight_ = 0;
  bool done_ = false;
  bool stopped_ = false;
  const bool may_leave_runs_;  ///< for background
  std::optional<nodes::Meter> meter_;
};

}  // namespace dmpc::svm
