// The node program of svm, replicated and forest: pixels under way, work items, and the packets that concern them.
//
// A quantum runs one pixel, or some that share a task, until it has ended a ray or a bundle, finished, or needs an absent page.
// Newest first: the pixel that ran last goes on, another one starts only when none can run. With one pixel in flight this is the
// sequential ray tracer's order of references.
//
// Why the last node always moves: requests are served in receive(), whatever the node's own state. A reply's place was
// reserved when its request left. A page that arrives runs every pixel that waited for it before the next packet is looked
// at, and one step reads one record, so even one frame serves any number of pixels. A full film starts no pixel and waits for
// the host, which waits for nobody. Questions are answered in receive(), too, from memory that never changes: their asker goes on
// with other pixels, or waits for nodes that wait for nobody.
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
#include "nodes/lasting_pieces.h"
#include "nodes/node.h"
#include "nodes/watch/meter.h"
#include "svm/film_gather.h"
#include "svm/packets.h"
#include "svm/pages/faults.h"
#include "svm/pages/node_program.h"
#include "svm/plan.h"
#include "svm/slots.h"
#include "svm/work_source.h"

namespace dmpc::svm {

/// `Records` is Pager, CountingPager, LocalCopy or Forest; `Tracer` reads them; `Task` is core::PixelTask, core::BundleTask,
/// or a test's.
template <class Records, class Tracer, class Task = core::PixelTask>
class ControlProgram final : public NodeProgram {
 public:
  /// Takes all its memory from `node`, which keeps `settings` and `database` (nodes/lasting_pieces.h). make_tracer(Records&)
  /// returns the tracer. `meter` is there where somebody wants to know what is done for which pixel.
  template <class MakeTracer>
  ControlProgram(nodes::Node& node, const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                 const MakeTracer& make_tracer, const std::optional<nodes::Meter>& meter = std::nullopt)
      : settings_(kept(node, settings)),
        node_(&node),
        host_(nodes::NodeId{plan.request.computer.node_count}),
        records_(node, plan.pages(), database),
        tracer_(make_tracer(records_)),
        slots_(node.memory(), plan.task_count(), static_cast<std::uint32_t>(plan.request.depth_max)),
        work_(node, plan.work(), settings.skips.idle_nodes),
        film_(node, plan.film()),
        meter_(meter) {
    core::expect(Task::pixels_max == plan.pixels_a_task, "a node's tasks are those of the plan");
    node.grant(host_, control_channel, 1);  // for Done
  }

  void receive(const nodes::Packet& packet) override {
    switch (Kind{packet.kind}) {
      case Kind::page_request:
      case Kind::passed_request:
        return serve(packet);
      case Kind::page_reply:
        return resume(packet);
      case Kind::questions:
        return answer(packet);
      case Kind::answers:
        return take_answers(packet);
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
      case Kind::film_sums:
      case Kind::done:
      case Kind::mask_acknowledgement:
        break;
    }
    core::expect(false, "a node receives only what is sent to nodes");
  }

  bool work() override {
    begin_metering();
    if (!slots_.has_runnable() && can_start()) {
      start();
    }
    if (slots_.has_runnable()) {
      run(slots_.take_runnable());
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
    const PageCounters pages = records_.counters();
    charges[core::Charge::home_lookup] = pages.home_hits;
    charges[core::Charge::cached_lookup] = pages.references - pages.home_hits;
    charges[core::Charge::page_install] = pages.faults - pending_faults();
    if constexpr (questions_travel) {
      const QuestionCounters& questions = records_.questions();
      charges[core::Charge::ray_setup] += questions.rays_answered;
      charges[core::Charge::ray_packing] =
          questions.rays_asked + questions.records_asked + questions.rays_answered + questions.records_answered;
    }
    return charges;
  }

  nodes::Levels levels() const override {
    if constexpr (Records::pages_travel) {
      return {
          {"pages in cache", records_.cached_pages()}, {"pages awaited", records_.faults()}, {"pixels done", pixels_rendered_}};
    } else if constexpr (questions_travel) {
      return {{"questions pending", records_.pending()}, {"pixels done", pixels_rendered_}};
    } else {
      return {{"pixels done", pixels_rendered_}};
    }
  }

  std::string describe() const override {
    return std::to_string(pixels_in_flight_) + " pixels in flight, " + std::to_string(pending()) +
           (questions_travel ? " answers awaited, " : " pages awaited, ") + std::to_string(film_.gathered()) +
           " pixels gathered, " + std::to_string(film_.under_way()) + " film packets unacknowledged, " + work_.describe() +
           (stopped_ ? ", stopped"
            : done_  ? ", done"
                     : "");
  }

  ProgramReport report() const override {
    ProgramReport report{operations_, records_.counters(), work_.counters()};
    report.work.pixels_rendered = pixels_rendered_;
    report.rays_ended = rays_ended_;
    report.operations.skipped.idle_nodes = work_.nodes_passed_over();
    if constexpr (questions_travel) {
      report.questions = records_.questions();
    }
    return report;
  }

 private:
  static const core::RenderSettings& kept(nodes::Node& node, const core::RenderSettings& settings) {
    static_assert(std::is_trivially_copyable_v<core::RenderSettings>);
    return *reinterpret_cast<const core::RenderSettings*>(
        nodes::kept(node.memory(), core::MemoryUse::constants, std::as_bytes(std::span(&settings, 1))).data());
  }

  static constexpr bool questions_travel = requires(Records & records) { records.flush(); };
  static constexpr bool counts_pages = requires(Records & records) { records.forget(); };

  bool can_start() const {
    return slots_.has_free() && work_.has_pixel() && film_.has_room_for(pixels_in_flight_ + Task::pixels_max);
  }

  /// A task takes pixels of one tile with the same samples, so who walks together does not depend on who takes which item.
  void start() {
    const std::uint32_t slot = slots_.take_free();
    std::array<std::uint32_t, Task::pixels_max> pixels;
    std::uint32_t count = 0;
    const core::SampleRange samples = work_.next_samples();
    const std::uint32_t most = std::max(Task::pixels_max / samples.count, 1U);
    do {
      pixels[count++] = work_.next_pixel();
    } while (count < most && work_.stays_in_tile() && work_.next_samples() == samples);
    slots_.task(slot).start(std::span<const std::uint32_t>(pixels).first(count), samples, settings_, operations_);
    pixels_in_flight_ += count;
    if constexpr (counts_pages) {
      records_.select(slot);
      records_.forget();
    }
    slots_.make_runnable(slot);
  }

  void run(std::uint32_t slot) {
    if constexpr (counts_pages) {
      records_.select(slot);
    }
    go_on(slot);
    end_metering(slots_.task(slot));
  }

  void go_on(std::uint32_t slot) {
    switch (slots_.task(slot).run(tracer_, settings_, operations_)) {
      case core::TaskState::more:
        rays_ended_ += slots_.task(slot).rays_ended();
        return slots_.make_runnable(slot);
      case core::TaskState::finished:
        return finish(slot);
      case core::TaskState::absent:
        return park(slot);
    }
  }

  /// What the node counts from here to end_metering() is one pixel's.
  void begin_metering() {
    if (meter_) [[unlikely]] {
      meter_->begin(heat_totals());
    }
  }

  void end_metering(const Task& task) {
    if (meter_) [[unlikely]] {
      meter_->end(task.pixel(), task.ray().depth, heat_totals());
      meter_->claim(task.pixel());  // of several passes the last one's node stays
    }
  }

  // Out of line, so that a quantum without a meter is no longer for it.
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

  void park(std::uint32_t slot) {
    if constexpr (Records::pages_travel) {
      records_.park(slot, slots_.task(slot).absent());
    } else if constexpr (questions_travel) {
      const Task& task = slots_.task(slot);
      if (task.is_tracing()) {
        records_.ask(slot, task.below(settings_.skips));
      } else {
        records_.ask(slot, task.absent_kind(), task.absent());
      }
    } else {
      core::expect(false, "a whole copy of the database lacks no record");
    }
  }

  void serve(const nodes::Packet& packet) {
    if constexpr (Records::pages_travel) {
      records_.serve(packet);
    } else {
      core::expect(false, "no page travels where every node has all");
    }
  }

  /// Every pixel that waits for the page runs before anything else can evict it: until its ray ends or it needs another
  /// absent page. The first of them, whose fault it was, is charged for the page.
  void resume(const nodes::Packet& packet) {
    if constexpr (Records::pages_travel) {
      begin_metering();
      std::uint32_t slot = records_.install(packet);
      while (slot != no_slot) {
        const std::uint32_t next = records_.next_waiting(slot);
        records_.retried();
        run(slot);
        slot = next;
      }
    } else {
      core::expect(false, "no page travels where every node has all");
    }
  }

  void answer(const nodes::Packet& packet) {
    if constexpr (questions_travel) {
      records_.answer(packet, operations_);
    } else {
      core::expect(false, "nobody is asked about what every node has, or what travels");
    }
  }

  /// Each pixel that has waited runs until its ray ends, or it has another question.
  void take_answers(const nodes::Packet& packet) {
    if constexpr (questions_travel) {
      records_.take(packet, [this](std::uint32_t slot, const core::Hit* hit) {
        begin_metering();
        if (hit != nullptr) {
          slots_.task(slot).take_below(*hit, settings_.skips, operations_);
        }
        run(slot);
      });
    } else {
      core::expect(false, "nobody is asked about what every node has, or what travels");
    }
  }

  /// Nothing can run until a packet comes: send what is asked, ask for work, send what is gathered, or say that all is done.
  void fall_idle() {
    if constexpr (questions_travel) {
      records_.flush();
    }
    if (slots_.has_free() && !work_.has_pixel()) {
      work_.ask();
    }
    if (slots_.active() == 0) {
      film_.flush();
    }
    if (!done_ && slots_.active() == 0 && work_.exhausted() && film_.settled()) {
      core::expect(pending() == 0, "nothing is awaited when no pixel is in flight");
      node_->send_reserved(host_, control_channel, number_of(Kind::done), Done{pixels_rendered_ - pixels_announced_});
      pixels_announced_ = pixels_rendered_;
      done_ = true;
    }
  }

  void take_mask(const nodes::Packet& packet) {
    core::expect(done_, "the mask of a pass comes when the one before has ended");
    work_.take_mask(packet.as<MaskPart>());
    node_->grant(host_, control_channel);  // the place that the part has reserved
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

  std::uint32_t pending_faults() const {
    if constexpr (Records::pages_travel) {
      return records_.faults();
    }
    return 0;
  }

  /// What pixels wait for: pages or answers.
  std::uint32_t pending() const {
    if constexpr (questions_travel) {
      return records_.pending();
    } else {
      return pending_faults();
    }
  }

  const core::RenderSettings& settings_;
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
  std::optional<nodes::Meter> meter_;
};

}  // namespace dmpc::svm
