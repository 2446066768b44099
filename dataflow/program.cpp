#include "dataflow/program.h"

#include <algorithm>
#include <memory>

#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "core/picture/memory_use.h"
#include "core/trace/charge.h"
#include "core/trace/traversal.h"
#include "dataflow/arrivals.h"
#include "dataflow/flow_control.h"
#include "dataflow/packets.h"
#include "dataflow/part_units.h"
#include "dataflow/rays/bundle_task.h"
#include "dataflow/rays/next_stop.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/rays/ray_task.h"
#include "dataflow/termination.h"

namespace dmpc::dataflow {
namespace {

using nodes::Category;
using nodes::LocalMemory;
using Bytes = nodes::Room<std::byte>;

/// Copies `value`, which has no default constructor, into local memory.
template <class T>
T* keep(LocalMemory& memory, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::span<std::byte> bytes = Bytes{core::MemoryUse::constants, sizeof(T)}.in(memory);
  return std::construct_at(reinterpret_cast<T*>(bytes.data()), value);
}

std::span<std::byte> keep_records(LocalMemory& memory, Category category, const nodes::ByteSource& records) {
  const std::span<std::byte> bytes = Bytes{category, records.size_bytes()}.in(memory);
  records.copy(0, bytes);
  return bytes;
}

core::RenderSettings settings_for(const NodeAssignment& assign) {
  core::RenderSettings settings = assign.settings;
  settings.header = assign.header;
  core::show(settings.shade.layer, settings.header);
  return settings;
}

/// Constants in local memory: everything except the ownership of regions.
struct Constants {
  core::RenderSettings settings;  ///< header: the part's
  Regions regions;
  core::DatabaseHeader proxy;
};

/// Only single rays have lists of tested leaves.
template <class RaysTask>
RaysTask make_task(nodes::Node& node, const Plan& plan) {
  if constexpr (RaysTask::rays_max == 1) {
    return RaysTask(node.memory(), node.id(), plan.request.waiting_hits_max, plan.tested_objects(), plan.request.has_instances);
  } else {
    core::expect(plan.tested_objects() == 0, "rays with lists of what they have tested walk alone");
    return RaysTask(node.memory(), node.id(), plan.request.waiting_hits_max, plan.request.has_instances);
  }
}

/// A ray that ends leaves light once; emitting hits that are shaded together do so together.
template <class RaysTask>
std::uint32_t deposits_at_once(const core::DatabaseHeader& header) {
  static_assert(RaysTask::rays_max < film_packet_entries);
  return core::hits_glow(header) ? RaysTask::rays_max : 1;
}

/// `RaysTask` is RayTask or BundleTask, and `Units` is NoUnits or MovingUnits, depending on the plan.
template <class RaysTask, class Units = NoUnits>
class RayProgram final : public NodeProgram {
 public:
  /// Takes all its memory and credits from `node`. `meter`, if any, gets the cost for each pixel: a quantum that works on a ray
  /// counts for that ray's pixel; receiving rays and sending waiting packets count for none.
  RayProgram(nodes::Node& node, const Plan& plan, const NodeAssignment& assign,
             const std::optional<nodes::Meter>& meter = std::nullopt)
      : meter_(meter),
        node_(&node),
        host_(plan.host()),
        constants_(keep(node.memory(), Constants{settings_for(assign), assign.regions, assign.proxy.header})),
        units_(node, plan, assign, constants_->settings.header, constants_->regions),
        records_(units_.records()),
        surroundings_{constants_->regions, constants_->proxy,
                      core::LocalRecords(keep_records(node.memory(), core::MemoryUse::constants, std::span(assign.proxy.bytes))),
                      assign.settings.skips},
        tracer_(records_, assign.header, assign.settings.skips, constants_->regions, node.id()),
        primaries_(node.memory(), Units::others_of(assign.primaries), assign.settings.first_samples(),
                   plan.request.is_assigned()),
        arrivals_(node, plan, units_),
        pixel_order_(plan.request.pixel_order()),
        leaves_runs_(!plan.request.computer.machine && plan.request.first_samples == 1),
        task_(make_task<RaysTask>(node, plan)),
        gather_(node, plan.gather()),
        film_(node, plan.film(deposits_at_once<RaysTask>(constants_->settings.header))),
        queue_capacity_(plan.request.rays.without_backpressure ? 0 : plan.queue_packets),
        termination_(Termination::member(node.id(), {plan.node_count()})) {
    core::expect(RaysTask::rays_max == plan.rays_a_task, "a node's task is that of the plan");
    core::expect(plan.request.has_instances == (assign.header.has_instances != 0),
                 "rays have the cursors that the database asks for");
  }

  void receive(const nodes::Packet& packet) override {
    switch (Kind{packet.kind}) {
      case Kind::rays:
      case Kind::forwarded:
        return receive_rays(packet);
      case Kind::credits:
        return take_credits(packet.source, packet.as<Credits>().count);
      case Kind::overflow_taken:
        host_rays_ = packet.as<OverflowTaken>().host_rays;
        return take_credits(host_, 1);
      case Kind::ask:
        return arrivals_.take_ask(packet.source);
      case Kind::unused:
        termination_.ray_packet_received();
        return arrivals_.take_unused();
      case Kind::film_acknowledgement:
        return film_.acknowledged();
      case Kind::token:
        return termination_.take(packet.as<Token>());
      case Kind::finish:
        core::expect(is_passive(state()), "the end is proved only when every node is passive");
        return finish();
      case Kind::done:
        below_.add(packet.as<Done>());
        return;
      case Kind::primaries:
        return receive_primaries(packet.as<AssignedPrimaries>());
      case Kind::stop:
        core::expect(done_ && !stopped_, "the host stops only nodes that are done, and once");
        core::expect(arrivals_.slots().are_all_free(), "every shared place has become free again");
        stopped_ = true;
        return notify_children(*node_, termination_.place(), Kind::stop, Stop{});
      default:
        return units_.receive(packet, termination_);
    }
  }

  bool work() override {
    const Task task = next_task(state());
    if (puts_off(task)) {
      return false;
    }
    if (meter_) [[unlikely]] {
      perform_metered(task);
    } else {
      perform(task);
    }
    units_.report_left(gather_);
    const Task next = next_task(state());
    if (next == Task::rest) {
      rest();
    }
    return next != Task::rest && next != Task::send_waiting;
  }

  bool finished() const override { return stopped_; }
  bool has_leftovers() const override { return puts_off_flush_; }

  nodes::Charges charges() const override {
    nodes::Charges charges{core::charges_of(operations_)};
    charges[core::Charge::ray_packing] = counters_.received() + counters_.sent();
    units_.add_charges(charges);
    return charges;
  }

  nodes::Levels levels() const override {
    return {
        {"rays in backlog", arrivals_.backlog().size()}, {"rays gathered", gather_.size()}, {"packets queued", gather_.queued()}};
  }

  std::string describe() const override {
    return std::to_string(primaries_.left() + units_.primaries_left()) + " primary rays not started, " +
           std::to_string(arrivals_.backlog().size()) + " rays in the backlog, " +
           (task_.is_idle()                         ? "none"
            : task_.has_rays() || task_.has_ended() ? "rays"
                                                    : "hits") +
           " under way, " + std::to_string(gather_.size()) + " rays gathered" +
           (gather_.waits() ? " (a packet waits for room), " : ", ") + std::to_string(gather_.queued()) + " packets queued, " +
           (arrivals_.slots().asking() > 0 ? std::to_string(arrivals_.slots().asking()) + " nodes wait for a place here, " : "") +
           (gather_.is_unanswered() ? "waits for places, " : "") + (admits_primaries() ? "" : "holds primary rays back, ") +
           std::to_string(film_.gathered()) + " film entries" + (film_.waits() ? " (waiting)" : "") +
           ", ray packets sent - received " + std::to_string(termination_.balance()) +
           (termination_.holds_token() ? ", holds the token" : "") + (termination_.is_black() ? ", black" : ", white") +
           (termination_.awaited() > 0 ? ", waits for " + std::to_string(termination_.awaited()) + " below it to tell" : "") +
           (stopped_     ? ", stopped"
            : done_      ? ", done"
            : finishing_ ? ", finishing"
                         : "");
  }

  ProgramReport report() const override {
    ProgramReport report{{.operations = operations_,
                          .rays = counters_,
                          .gather = gather_.counters(),
                          .film = film_.counters(),
                          .movement = units_.counters(),
                          .backlog_high_water = arrivals_.backlog().high_water()},
                         gather_.pairs()};
    if constexpr (RaysTask::rays_max == 1) {
      report.rays.tests_avoided = task_.tests_avoided();
    }
    report.operations.deposits_saturated += film_.counters().saturated;
    return report;
  }

  void begin_frame(const core::RenderSettings& settings) override {
    core::expect(stopped_ && !has_primaries(), "a frame begins when the one before has ended");
    const core::DatabaseHeader part = constants_->settings.header;
    constants_->settings = settings;
    constants_->settings.header = part;
    stopped_ = false;
  }

 private:
  /// The ray that was last started, received or created; `sample`: that of the primary ray last started.
  struct Newest {
    std::uint32_t pixel = 0, sample = 0, depth = 1;
  };
  bool packet_waits() const { return gather_.waits() || film_.waits(); }
  bool has_primaries() const { return !primaries_.empty() || units_.primaries_left() > 0; }
  bool admits_primaries() const { return dataflow::admits_primaries(gather_.queued(), queue_capacity_, host_rays_); }

  /// A packet with rays has come: this pass has not ended, or the next one has begun.
  void wake() {
    core::expect(!finishing_ || done_, "no ray comes after the end");
    finishing_ = false;
    termination_.ray_packet_received();
    units_.rays_came();
  }

  void receive_primaries(const AssignedPrimaries& assigned) {
    wake();
    primaries_.put(assigned);
  }

  void receive_rays(const nodes::Packet& packet) {
    wake();
    arrivals_.take_packet(
        packet, [this](std::span<const std::byte> message) { ++counters_.in[static_cast<std::size_t>(kind_in(message))]; });
  }

  void take_credits(nodes::NodeId receiver, std::uint32_t count) {
    for (std::uint32_t sent = gather_.credits_returned(receiver, count); sent > 0; --sent) {
      termination_.ray_packet_sent();
    }
  }

  NodeState state() const {
    const bool has_work = !task_.is_idle() || !arrivals_.backlog().empty(), has_primaries = this->has_primaries();
    return {.packet_waits = packet_waits(),
            .is_tracing = !task_.is_idle(),
            .has_backlog = !arrivals_.backlog().empty(),
            .has_primaries = has_primaries,
            .admits_primaries = admits_primaries(),
            .can_flush = !has_work && gather_.can_flush(),  // checks every owner
            .has_gathered = !gather_.empty(),
            .is_unanswered = gather_.is_unanswered(),
            .is_moving_units = !units_.is_settled() || (!has_work && !has_primaries && units_.wants_to_ask())};
  }

  /// Bundles fill packets fast, so a node among many soon has no work, while its neighbours' rays may fill more packets: before
  /// it sends partly filled packets, it lets others run, but not twice in succession.
  bool puts_off(Task task) {
    const bool is_first_flush = task == Task::flush && !flushes_;
    puts_off_flush_ = is_first_flush && RaysTask::rays_max > 1;
    flushes_ = task == Task::flush;
    return puts_off_flush_;
  }

  void perform_metered(Task task) {
    if (task != Task::start_primary && task != Task::take_received && task != Task::go_on) {
      perform(task);
      return;
    }
    meter_->begin(totals());
    perform(task);
    meter_->end(newest_.pixel, newest_.depth, totals());
    if (task == Task::start_primary && newest_.sample == 0) {
      meter_->claim(newest_.pixel);
    }
  }

  void perform(Task task) {
    switch (task) {
      case Task::send_waiting:
        return send_waiting();
      case Task::go_on:
        return go_on();
      case Task::take_received:
        return take_received();
      case Task::start_primary:
        return start_primaries();
      case Task::flush:
        gather_.flush();
        return send_waiting();
      case Task::rest:
        return;
    }
  }

  /// A waiting film packet is sent as soon as the host acknowledges another.
  void send_waiting() {
    if (!gather_.waits()) {
      return;
    }
    const Way way = gather_.send();
    if (way == Way::to_owner || way == Way::to_host) {
      termination_.ray_packet_sent();
    }
  }

  void take_received() {
    take_up(arrivals_.take());
    for (std::uint32_t i = 1; i < RaysTask::rays_max && !packet_waits() && arrivals_.has_alike(); ++i) {
      take_up(arrivals_.take_alike());
    }
    go_on();
  }

  void take_up(std::span<const std::byte> message) {
    newest_.pixel = pixel_in(message);
    newest_.depth = depth_in(message);
    if (is_confirmed_in(message)) {
      shade_at_finder(message_in(message));
    } else if (units_.is_others(message)) {
      units_.sent_on();
      const RayMessage others = message_in(message);
      dispatch(constants_->regions.owner_of(others.cell), others);
    } else {
      task_.enter(message);
    }
  }

  void start_primaries() {
    for (std::uint32_t i = 0; i < RaysTask::rays_max && has_primaries() && !packet_waits(); ++i) {
      start_primary();
    }
    trace();
  }

  void start_primary() {
    const auto [number, samples] = units_.take_primary(primaries_);
    if (const std::uint32_t count = primaries_.packets_worked_off(); count > 0) {
      send_control(*node_, host_, Kind::primaries_taken, PrimariesTaken{count});
    }
    const std::uint32_t pixel = pixel_order_.pixel_at(place_of(number, samples)), sample = sample_of(number, samples);
    newest_ = {.pixel = pixel, .sample = sample};
    if (constants_->settings.shows_background(pixel)) {
      return leave_background(pixel, sample);
    }
    shoot([&](core::Ray& ray) {
      ray = constants_->settings.camera.primary_ray(pixel, sample);
      return true;
    });
  }

  /// The light of a primary ray that need not be traced. With one sample a pixel, nothing else contributes to that pixel. On a
  /// modelled machine it is sent like other light: the cost of packets is part of every virtual time.
  void leave_background(std::uint32_t pixel, std::uint32_t sample) {
    ++operations_.rays[static_cast<std::size_t>(core::RayKind::primary)];
    ++operations_.skipped.background;
    const core::RenderSettings& settings = constants_->settings;
    const core::Ray ray = settings.missing_ray(pixel, sample);
    if (!leaves_runs_) {
      return end_miss(ray);
    }
    ++counters_.ended;
    const core::FixedColor light = fixed(settings.light_of_miss(ray));
    if (light != core::FixedColor{}) {
      film_.add_only(pixel, core::plane_of(sample), light);
    }
  }

  /// Traces the current rays, or the next children of the current hits.
  void go_on() {
    if (!task_.has_rays() && !task_.has_ended()) {
      task_.next_children(
          tracer_, constants_->settings, operations_, [this](const auto& make) { this->shoot(make); },
          [this](const core::Ray& ray, const core::Color& light) { leave_light(ray, light); });
    }
    trace();
  }

  /// Adds a new ray if make(ray) makes one.
  template <class Make>
  void shoot(const Make& make) {
    if (const core::Ray* const ray = task_.shoot_made(make)) {
      ++operations_.rays[static_cast<std::size_t>(ray->kind)];
      newest_.depth = ray->depth;
    }
  }

  /// The ray continues in a region of this node, or of another.
  void go_to_stop() {
    const nodes::NodeId owner = constants_->regions.owner_at(task_.stop());
    if (owner == node_->id()) {
      const RayMessage message = task_.leaving();
      task_.drop_ended();
      return task_.enter(message);
    }
    const core::RayKind kind = task_.ray().kind;
    ++counters_.out[static_cast<std::size_t>(kind)];
    gather_.add(owner, kind, [this](std::span<std::byte> place) { task_.put_leaving(place); });
    task_.drop_ended();
    send_waiting();
  }

  /// Rays that do not start in this region may continue in it, but none returns.
  void trace() {
    while (task_.has_rays() || task_.has_ended()) {
      if (!task_.has_ended()) {
        task_.trace(tracer_, constants_->settings.header, operations_);
      }
      for (; task_.has_ended(); end_ray()) {
        if (packet_waits()) {
          return;
        }
      }
    }
  }

  void end_ray() {
    task_.find_stops(surroundings_, operations_);
    switch (task_.traced()) {
      case core::Traced::left:
        return go_to_stop();
      case core::Traced::miss:
        end_miss(task_.ray());
        break;
      default:
        end_hit();
        break;
    }
    task_.drop_ended();
  }

  void end_blocked() {
    ++operations_.shadow_blocked;
    ++counters_.ended;
  }

  /// A ray has found its nearest hit, or a shadow ray any hit; or it is certain that there is none.
  void end_hit() {
    if (task_.ray().kind == core::RayKind::shadow) {
      end_blocked();
    } else if (task_.found_here()) {
      task_.shade_hit();
      count_claim(task_.ray().kind);
    } else {
      shade_at_finder(task_.confirmed_hit());
    }
  }

  /// A hit proved to be the nearest where its record is not available, or not at hand.
  void shade_at_finder(const RayMessage& hit) {
    const nodes::NodeId finder{hit.finder};
    if (finder == node_->id()) {
      task_.resume_hit(hit);
      count_claim(hit.ray.kind);
    } else {
      ++counters_.hits_sent_back;
      dispatch(finder, hit);
    }
  }

  /// This node, and no other, shades the hit of a ray.
  void count_claim(core::RayKind kind) {
    ++counters_.ended;
    ++(kind == core::RayKind::primary ? operations_.primary_hits : operations_.secondary_hits);
  }

  void end_miss(const core::Ray& ray) {
    ++counters_.ended;
    const core::RenderSettings& settings = constants_->settings;
    leave_light(ray, settings.asks_sky(ray) ? light_of_sky(ray) : settings.light_of_miss(ray));
  }

  /// Every node has the whole sky picture, since rays may leave the scene anywhere.
  core::Color light_of_sky(const core::Ray& ray) {
    const core::RenderSettings& settings = constants_->settings;
    const std::byte* const tile = tracer_.find(core::sky_record(ray, settings.header));
    core::expect(tile != nullptr, "a node has all of the sky's picture");
    ++operations_.tile_reads;
    return ray.weight * core::sky_met(ray, settings.header, settings.shade.transport, tile);
  }

  core::FixedColor fixed(const core::Color& found) const { return core::to_fixed(found, constants_->settings.shade.film_scale); }

  void leave_light(const core::Ray& ray, const core::Color& found) {
    const core::FixedColor light = fixed(core::clamped(ray, found, constants_->settings.shade));
    if (light != core::FixedColor{}) {
      film_.add(ray.pixel, core::plane_of(ray.sample), light);
    }
  }

  void dispatch(nodes::NodeId owner, const RayMessage& message) {
    ++counters_.out[static_cast<std::size_t>(message.ray.kind)];
    gather_.add(owner, message);
    send_waiting();
  }

  /// Nothing to do until a packet comes: returns all credits.
  void rest() {
    ++counters_.rests;
    arrivals_.give_all_back();
    if (!has_primaries() && units_.wants_to_ask()) {
      units_.ask();
      termination_.ray_packet_sent();
    }
    if (is_passive(state())) {
      be_passive();
    }
  }

  /// Keeps no token and, once termination is proved, no light.
  void be_passive() {
    if (const std::optional<TokenHandover> handover = termination_.hand_on()) {
      send_tokens(*node_, *handover);
    }
    if (finishing_ && !done_) {
      settle();
    }
  }

  void finish() {
    finishing_ = true;
    done_ = false;
    below_ = {};
    notify_children(*node_, termination_.place(), Kind::finish, Finish{});
  }

  void settle() {
    film_.flush();
    const TreePlace& place = termination_.place();
    if (film_.settled() && below_.reported == place.child_count) {
      send_control(*node_, place.parent, Kind::done, Done{film_.counters().entries + below_.entries});
      done_ = true;
    }
  }

  nodes::HeatTotals totals() const {
    nodes::HeatTotals totals{.charges = charges()};
    totals[core::HeatKind::rays] = operations_.ray_count();
    return totals;
  }

  std::optional<nodes::Meter> meter_;
  nodes::Node* node_;
  nodes::NodeId host_;
  Constants* constants_;
  Units units_;
  PartRecords records_;
  Surroundings surroundings_;
  PartTracer tracer_;
  Primaries primaries_;
  Arrivals<Units> arrivals_;
  PixelOrder pixel_order_;
  bool leaves_runs_;  ///< for the background
  RaysTask task_;
  Gather gather_;
  FilmGather film_;
  std::uint32_t queue_capacity_;  ///< packets, for backpressure; 0: none
  std::uint32_t host_rays_ = 0;   ///< buffered by the host, by its last answer
  Termination termination_;
  DoneBelow below_;
  core::Operations operations_;
  RayCounters counters_;
  Newest newest_;                ///< of the current or last quantum, if it works on a ray
  bool finishing_ = false;       ///< the host has proved that the pass has no rays left
  bool flushes_ = false;         ///< or would have done so, in the last quantum
  bool puts_off_flush_ = false;  ///< until it is known that no packet comes soon
  bool done_ = false;
  bool stopped_ = false;
};

}  // namespace

nodes::MemoryPlan NodeProgram::layout(const Plan& plan, std::uint32_t index) {
  const Share& share = plan.request.shares[index];
  nodes::MemoryPlan memory =
      Bytes{core::MemoryUse::constants, sizeof(Constants)} + Bytes{core::MemoryUse::constants, share.proxy_bytes} +
      (plan.is_moving() ? MovingUnits::layout(plan, index) : NoUnits::layout(plan, index)) +
      Primaries::layout(plan.is_moving() ? 0 : share.primary_runs, plan.request.is_assigned()) + Arrivals<NoUnits>::layout(plan) +
      Gather::layout(plan.gather()) + FilmGather::layout(film_packet_entries);
  if (plan.rays_a_task > 1) {
    memory += BundleTask::layout(plan.request.waiting_hits_max, plan.request.has_instances);
  } else {
    memory += RayTask::layout(plan.request.waiting_hits_max, plan.request.has_instances);
  }
  return memory;
}

std::unique_ptr<NodeProgram> make_node_program(nodes::Node& node, const Plan& plan, const NodeAssignment& assign,
                                               const std::optional<nodes::Meter>& meter) {
  const auto make = [&]<class Units>() -> std::unique_ptr<NodeProgram> {
    if (plan.rays_a_task > 1) {
      return std::make_unique<RayProgram<BundleTask, Units>>(node, plan, assign, meter);
    }
    return std::make_unique<RayProgram<RayTask, Units>>(node, plan, assign, meter);
  };
  return plan.is_moving() ? make.template operator()<MovingUnits>() : make.template operator()<NoUnits>();
}

}  // namespace dmpc::dataflow
