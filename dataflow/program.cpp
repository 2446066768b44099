#include "dataflow/program.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "core/picture/memory_use.h"
#include "core/trace/charge.h"
#include "core/trace/traversal.h"
#include "dataflow/packets.h"

namespace dmpc::dataflow {
namespace {

using nodes::Category;
using nodes::LocalMemory;
using Bytes = nodes::Room<std::byte>;

/// Copies `value`, which has no default, into local memory.
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

core::RenderSettings settings_for(const NodeDeal& deal) {
  core::RenderSettings settings = deal.settings;
  settings.header = deal.header;
  return settings;
}

/// Where places are shared all other nodes count as one sender, the host as another.
RayQueue::Capacity backlog_capacity(const Plan& plan) {
  const std::uint32_t packets_each = std::max({plan.ray_credits, plan.ray_places, plan.host_credits});
  return {.sender_count = plan.shares_places() ? 2 : plan.node_count() + 1,
          .packets_each = packets_each,
          .packets = plan.shares_places() ? plan.ray_places + plan.host_credits : plan.node_count() * packets_each,
          .ray_batch = plan.ray_batch,
          .depth_max = plan.request.depth_max,
          .are_kinds_apart = plan.rays_a_task > 1,
          .tested_objects = plan.tested_objects()};
}

Gather::Capacity gather_capacity(const Plan& plan) {
  return {.node_count = plan.node_count(),
          .ray_batch = plan.ray_batch,
          .ray_credits = plan.ray_credits,
          .shares_places = plan.shares_places(),
          .open_packets = plan.shares_places() ? std::min(plan.ray_places, plan.node_count()) : 0,
          .host_credits = plan.host_credits,
          .queue_packets = plan.queue_packets,
          .tested_objects = plan.tested_objects()};
}

/// Only rays that walk alone have lists of what they have tested.
template <class RaysTask>
RaysTask make_task(nodes::Node& node, const Plan& plan) {
  if constexpr (RaysTask::rays_max == 1) {
    return RaysTask(node.memory(), node.id(), plan.request.depth_max, plan.tested_objects());
  } else {
    core::expect(plan.tested_objects() == 0, "rays with lists of what they have tested walk alone");
    return RaysTask(node.memory(), node.id(), plan.request.depth_max);
  }
}

}  // namespace

template <class RaysTask>
RayProgram<RaysTask>::RayProgram(nodes::Node& node, const Plan& plan, const NodeDeal& deal,
                                 const std::optional<nodes::Meter>& meter)
    : meter_(meter),
      node_(&node),
      host_(plan.host()),
      return_batch_(return_batch(plan.ray_credits)),
      return_batch_host_(return_batch(plan.host_credits)),
      constants_(keep(node.memory(), Constants{settings_for(deal), deal.regions, deal.outline.header})),
      part_(keep_records(node.memory(), core::MemoryUse::home_pages,
                         plan.is_moving() ? nodes::ByteSource(std::span<const std::byte>()) : deal.records)),
      pages_(node.memory(), plan.pages_of_node(nodes::index_of(node.id()))),
      records_(part_, plan.is_moving() ? &pages_ : nullptr),
      surroundings_{constants_->regions, constants_->outline,
                    core::LocalRecords(keep_records(node.memory(), core::MemoryUse::constants, std::span(deal.outline.bytes))),
                    deal.settings.skips},
      tracer_(records_, deal.header, deal.settings.skips, constants_->regions, node.id()),
      primaries_(node.memory(), plan.is_moving() ? std::span<const PrimaryRun>() : deal.primaries, deal.settings.first_samples(),
                 plan.request.is_dealt()),
      unit_primaries_(node.memory(), plan.primaries_of_node(nodes::index_of(node.id())),
                      plan.is_moving() ? deal.primaries : std::span<const PrimaryRun>(), deal.runs_of_unit,
                      deal.settings.first_samples()),
      backlog_(node.memory(), backlog_capacity(plan)),
      places_(node.memory(), plan.node_count(), plan.ray_places),
      shares_places_(plan.shares_places()),
      tested_objects_(plan.tested_objects()),
      task_(make_task<RaysTask>(node, plan)),
      gather_(node, gather_capacity(plan)),
      film_(node, plan.node_count(), plan.film_credits),
      movement_(node, plan, {&constants_->settings.header, &constants_->regions, &pages_, &unit_primaries_}),
      backpressure_(plan.node_count() - 1, plan.queue_packets, !plan.request.rays.without_backpressure) {
  if (plan.is_moving()) {
    pages_.begin_with(deal.pages, deal.records);
  }
  core::expect(RaysTask::rays_max == plan.rays_a_task, "a node's task is that of the plan");
}

nodes::MemoryPlan NodeProgram::layout(const Plan& plan, std::uint32_t index) {
  const Share& share = plan.request.shares[index];
  nodes::MemoryPlan memory = Bytes{core::MemoryUse::constants, sizeof(Constants)} +
                             Bytes{core::MemoryUse::constants, share.outline_bytes} +
                             Primaries::layout(plan.is_moving() ? 0 : share.primary_runs, plan.request.is_dealt()) +
                             RayQueue::layout(backlog_capacity(plan)) + Places::layout(plan.node_count(), plan.ray_places) +
                             Gather::layout(gather_capacity(plan)) + FilmGather::layout();
  if (plan.is_moving()) {
    memory += UnitPages::layout(plan.pages_of_node(index)) + UnitPrimaries::layout(plan.primaries_of_node(index)) +
              Movement::layout(plan);
  } else {
    memory += Bytes{core::MemoryUse::home_pages, share.part_bytes + core::overread_bytes};
  }
  if (plan.rays_a_task > 1) {
    memory += BundleTask::layout(plan.request.depth_max);
  } else {
    memory += RayTask::layout(plan.request.depth_max);
  }
  return memory;
}

template <class RaysTask>
void RayProgram<RaysTask>::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::rays:
    case Kind::forwarded:
      return receive_rays(packet);
    case Kind::credits:
      return take_credits(packet.source, packet.as<Credits>().count);
    case Kind::ask:
      places_.ask(packet.source);
      return grant_places();
    case Kind::unused:
      termination_.ray_packet_received();
      places_.give_back(1);
      return grant_places();
    case Kind::hold:
      backpressure_.take(packet.as<Hold>().holds != 0);
      return send_control(*node_, packet.source, Kind::hold_acknowledgement, HoldAcknowledgement{});
    case Kind::hold_acknowledgement:
      return backpressure_.acknowledged();
    case Kind::film_acknowledgement:
      return film_.acknowledged();
    case Kind::token:
      return termination_.take(packet.as<Token>());
    case Kind::finish:
      core::expect(is_passive(state()), "the end is proved only when every node is passive");
      finishing_ = true;
      done_ = false;
      return;
    case Kind::primaries:
      return receive_primaries(packet.as<DealtPrimaries>());
    case Kind::unit_ask:
    case Kind::unit_refusal:
    case Kind::unit_page:
    case Kind::unit_primaries:
    case Kind::unit_acknowledgement:
      return receive_movement(packet);
    case Kind::unit_moved:
      return movement_.take_news(packet.as<UnitMoved>());
    case Kind::stop:
      core::expect(done_ && !stopped_, "the host stops only nodes that are done, and once");
      core::expect(places_.free() == places_.count() && places_.asking() == 0, "every shared place has become free again");
      stopped_ = true;
      return;
    default:
      core::expect(false, "a node receives only what is sent to nodes");
  }
}

/// What may set this node going counts as a packet of rays for the proof of the end.
template <class RaysTask>
void RayProgram<RaysTask>::receive_movement(const nodes::Packet& packet) {
  termination_.ray_packet_received();
  if (movement_.receive(packet)) {
    termination_.ray_packet_sent();
  }
}

/// A packet with rays has come: this pass has not ended, or the next has begun.
template <class RaysTask>
void RayProgram<RaysTask>::wake() {
  core::expect(!finishing_ || done_, "no ray comes after the end");
  finishing_ = false;
  termination_.ray_packet_received();
  movement_.rays_came();
}

template <class RaysTask>
void RayProgram<RaysTask>::receive_primaries(const DealtPrimaries& dealt) {
  wake();
  primaries_.put(dealt);
}

template <class RaysTask>
void RayProgram<RaysTask>::receive_rays(const nodes::Packet& packet) {
  wake();
  core::expect(packet.payload.size() >= sizeof(RayPacketHeader), "a packet of rays has a header");
  RayPacketHeader header;
  std::memcpy(&header, packet.payload.data(), sizeof(header));
  core::expect(packet.payload.size() == ray_packet_bytes(header.count, tested_objects_),
               "a packet of rays is as long as it says");
  core::expect(nodes::NodeId{header.owner} == node_->id(), "rays come to their owner");
  const std::uint32_t sender = account_of(packet.source);
  if (movement_.is_on() && packet.source != host_) {
    movement_.take_rays_left(packet.source, header.rays_left);
  }
  backlog_.accept_packet(sender, header.count);
  for (std::uint32_t i = 0; i < header.count; ++i) {
    const RayMessage message = ray_in(packet.payload, i, tested_objects_);
    backlog_.put(sender, message);
    if (is_others(message) && packet.source != host_) {
      movement_.is_behind(packet.source, constants_->regions.region_index_of(message.cell));
    }
    ++counters_.in[static_cast<std::size_t>(message.ray.kind)];
  }
}

template <class RaysTask>
void RayProgram<RaysTask>::take_credits(nodes::NodeId receiver, std::uint32_t count) {
  for (std::uint32_t sent = gather_.credits_returned(receiver, count); sent > 0; --sent) {
    termination_.ray_packet_sent();
  }
}

template <class RaysTask>
NodeState RayProgram<RaysTask>::state() const {
  const bool has_work = !task_.is_idle() || !backlog_.empty(), has_primaries = this->has_primaries();
  return {.must_announce = backpressure_.is_due(gather_.queued()),
          .packet_waits = packet_waits(),
          .is_tracing = !task_.is_idle(),
          .has_backlog = !backlog_.empty(),
          .has_primaries = has_primaries,
          .admits_primaries = backpressure_.admits_primaries(gather_.queued()),
          .can_flush = !has_work && gather_.can_flush(),  // looks at every owner
          .has_gathered = !gather_.empty(),
          .is_unacknowledged = !backpressure_.is_settled(),
          .is_unanswered = gather_.is_unanswered(),
          .is_moving_units = !movement_.is_settled() || (!has_work && !has_primaries && movement_.wants_to_ask())};
}

template <class RaysTask>
bool RayProgram<RaysTask>::work() {
  const Task task = next_task(state());
  if (puts_off(task)) {
    return false;
  }
  if (meter_) [[unlikely]] {
    perform_metered(task);
  } else {
    perform(task);
  }
  if (movement_.is_on()) {
    gather_.tell(movement_.rays_left());
  }
  const Task next = next_task(state());
  if (next == Task::rest) {
    rest();
  }
  return next != Task::rest && next != Task::send_waiting;
}

/// Bundles fill packets fast, so a node among many is soon without work, and its neighbours' rays may fill more: before it sends
/// packets that are not full it lets others run. Not twice in succession.
template <class RaysTask>
bool RayProgram<RaysTask>::puts_off(Task task) {
  const bool is_first_flush = task == Task::flush && !flushes_;
  puts_off_flush_ = is_first_flush && RaysTask::rays_max > 1;
  flushes_ = task == Task::flush;
  return puts_off_flush_;
}

template <class RaysTask>
void RayProgram<RaysTask>::perform_metered(Task task) {
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

template <class RaysTask>
void RayProgram<RaysTask>::perform(Task task) {
  switch (task) {
    case Task::announce:
      return announce();
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

template <class RaysTask>
void RayProgram<RaysTask>::announce() {
  const Hold hold{backpressure_.announce(gather_.queued()) ? 1U : 0U};
  for (std::uint32_t i = 0; i < nodes::index_of(host_); ++i) {
    if (nodes::NodeId{i} != node_->id()) {
      send_control(*node_, nodes::NodeId{i}, Kind::hold, hold);
    }
  }
}

/// A film packet that waits is sent as soon as the host acknowledges another.
template <class RaysTask>
void RayProgram<RaysTask>::send_waiting() {
  if (!gather_.waits()) {
    return;
  }
  const Way way = gather_.send();
  if (way == Way::to_owner || way == Way::to_host) {
    termination_.ray_packet_sent();
  }
}

template <class RaysTask>
void RayProgram<RaysTask>::take_received() {
  std::uint32_t sender = 0;
  const RayMessage first = backlog_.take(sender);
  take_up(first, sender);
  for (std::uint32_t i = 1; i < RaysTask::rays_max && !packet_waits() && backlog_.has_alike(first.ray); ++i) {
    const RayMessage message = backlog_.take_alike(first.ray, sender);
    take_up(message, sender);
  }
  go_on();
}

template <class RaysTask>
void RayProgram<RaysTask>::take_up(const RayMessage& message, std::uint32_t sender) {
  give_back(sender, false);
  newest_.pixel = message.ray.pixel;
  newest_.depth = message.ray.depth;
  if (message.is_confirmed != 0) {
    shade_at_finder(message);
  } else if (is_others(message)) {
    movement_.sent_on();
    dispatch(constants_->regions.owner_of(message.cell), message);
  } else {
    task_.enter(message);
  }
}

/// The unit that it enters has moved on, and the sender did not know.
template <class RaysTask>
bool RayProgram<RaysTask>::is_others(const RayMessage& message) const {
  return movement_.is_on() && message.is_confirmed == 0 &&
         !movement_.answers_for(constants_->regions.region_index_of(message.cell));
}

template <class RaysTask>
void RayProgram<RaysTask>::start_primaries() {
  for (std::uint32_t i = 0; i < RaysTask::rays_max && has_primaries() && !packet_waits(); ++i) {
    start_primary();
  }
  trace();
}

template <class RaysTask>
void RayProgram<RaysTask>::start_primary() {
  const bool is_of_unit = primaries_.empty();
  const std::uint64_t number = is_of_unit ? unit_primaries_.take() : primaries_.take();
  const core::SampleRange& samples = is_of_unit ? unit_primaries_.samples() : primaries_.samples();
  if (const std::uint32_t count = primaries_.packets_worked_off(); count > 0) {
    send_control(*node_, host_, Kind::primaries_taken, PrimariesTaken{count});
  }
  const std::uint32_t pixel = pixel_of(number, samples), sample = sample_of(number, samples);
  newest_ = {.pixel = pixel, .sample = sample};
  if (constants_->settings.shows_background(pixel)) {
    return leave_background(pixel, sample);
  }
  shoot(constants_->settings.camera.primary_ray(pixel, sample));
}

/// What a primary ray that needs not be traced comes to.
template <class RaysTask>
void RayProgram<RaysTask>::leave_background(std::uint32_t pixel, std::uint32_t sample) {
  ++operations_.rays[static_cast<std::size_t>(core::RayKind::primary)];
  ++operations_.skipped.background;
  end_miss({.pixel = pixel, .sample = sample});
}

/// Traces the rays under way, or the next children of the hits under way.
template <class RaysTask>
void RayProgram<RaysTask>::go_on() {
  if (!task_.has_rays() && !task_.has_ended()) {
    task_.next_children(tracer_, constants_->settings, operations_, [this](const core::Ray& child) { shoot(child); });
  }
  trace();
}

/// A fresh ray.
template <class RaysTask>
void RayProgram<RaysTask>::shoot(const core::Ray& ray) {
  ++operations_.rays[static_cast<std::size_t>(ray.kind)];
  newest_.depth = ray.depth;
  task_.shoot(ray);
}

/// Past regions where it meets nothing, to the owner of the next where it may meet something: this node or another.
template <class RaysTask>
void RayProgram<RaysTask>::go_to_next(const RayMessage& message) {
  const NextStop stop = next_stop(message.ray, message.passage(), surroundings_, node_->id(), operations_);
  if (stop.traced == core::Traced::miss) {
    return end_miss(message.ray);
  }
  if (stop.traced == core::Traced::hit) {
    return end_confirmed(message);
  }
  const nodes::NodeId owner = constants_->regions.owner_at(stop.region);
  RayMessage next = message_of(message.ray, stop.passage, nodes::NodeId{message.finder});
  next.tested = message.tested;
  if (owner == node_->id()) {
    task_.enter(next);
  } else {
    dispatch(owner, next);
  }
}

/// Rays that do not start in this region may go on in it, but none comes back.
template <class RaysTask>
void RayProgram<RaysTask>::trace() {
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

template <class RaysTask>
void RayProgram<RaysTask>::end_ray() {
  switch (task_.traced()) {
    case core::Traced::left: {
      const RayMessage message = task_.leaving();
      task_.drop_ended();
      return go_to_next(message);
    }
    case core::Traced::miss:
      end_miss(task_.ray());
      break;
    default:
      end_hit();
      break;
  }
  task_.drop_ended();
}

template <class RaysTask>
void RayProgram<RaysTask>::end_blocked() {
  ++operations_.shadow_blocked;
  ++counters_.ended;
}

/// The nearest hit of a ray is proved where nothing is.
template <class RaysTask>
void RayProgram<RaysTask>::end_confirmed(RayMessage message) {
  if (message.ray.kind == core::RayKind::shadow) {
    return end_blocked();
  }
  message.is_confirmed = 1;
  shade_at_finder(message);
}

/// A ray has met its nearest hit, or a shadow ray any.
template <class RaysTask>
void RayProgram<RaysTask>::end_hit() {
  if (task_.ray().kind == core::RayKind::shadow) {
    end_blocked();
  } else if (task_.found_here()) {
    task_.shade_hit();
    count_claim(task_.ray().kind);
  } else {
    shade_at_finder(task_.confirmed_hit());
  }
}

/// A hit is known to be the nearest where its record is not, or not at hand.
template <class RaysTask>
void RayProgram<RaysTask>::shade_at_finder(const RayMessage& hit) {
  const nodes::NodeId finder{hit.finder};
  if (finder == node_->id()) {
    task_.resume_hit(hit);
    count_claim(hit.ray.kind);
  } else {
    ++counters_.hits_sent_back;
    dispatch(finder, hit);
  }
}

/// This node shades the hit of a ray, and no other does.
template <class RaysTask>
void RayProgram<RaysTask>::count_claim(core::RayKind kind) {
  ++counters_.ended;
  ++(kind == core::RayKind::primary ? operations_.primary_hits : operations_.secondary_hits);
}

/// A shadow ray brings its light, any other the background's.
template <class RaysTask>
void RayProgram<RaysTask>::end_miss(const core::Ray& ray) {
  ++counters_.ended;
  const core::Color background = constants_->settings.header.background;
  const core::FixedColor light = core::to_fixed(ray.kind == core::RayKind::shadow ? ray.weight : ray.weight * background);
  if (light != core::FixedColor{}) {
    film_.add(ray.pixel, ray.sample % 2, light);
  }
}

template <class RaysTask>
void RayProgram<RaysTask>::dispatch(nodes::NodeId owner, const RayMessage& message) {
  ++counters_.out[static_cast<std::size_t>(message.ray.kind)];
  gather_.add(owner, message);
  send_waiting();
}

template <class RaysTask>
void RayProgram<RaysTask>::give_back(std::uint32_t sender, bool rests) {
  const std::uint32_t owed = backlog_.owed(sender);
  if (shares_places_ && sender != account_of(host_)) {
    backlog_.gave_back(sender, owed);
    places_.give_back(owed);
    return grant_places();
  }
  const nodes::NodeId target = shares_places_ ? host_ : nodes::NodeId{sender};
  if (returns_credits(owed, target == host_ ? return_batch_host_ : return_batch_, rests)) {
    backlog_.gave_back(sender, owed);
    tell_news(target);
    send_control(*node_, target, Kind::credits, Credits{owed});
  }
}

/// In the backlog's account.
template <class RaysTask>
std::uint32_t RayProgram<RaysTask>::account_of(nodes::NodeId sender) const {
  return !shares_places_ ? nodes::index_of(sender) : sender == host_ ? 1 : 0;
}

template <class RaysTask>
void RayProgram<RaysTask>::grant_places() {
  while (const std::optional<nodes::NodeId> sender = places_.grant()) {
    tell_news(*sender);
    send_control(*node_, *sender, Kind::credits, Credits{1});
  }
}

/// Ahead of credits, so that there is room for it: it has been taken before the credits let more of it arise.
template <class RaysTask>
void RayProgram<RaysTask>::tell_news(nodes::NodeId sender) {
  if (movement_.is_on() && sender != host_) {
    movement_.tell_news(sender);
  }
}

/// Nothing to do until a packet comes: keeps nobody's credit.
template <class RaysTask>
void RayProgram<RaysTask>::rest() {
  ++counters_.rests;
  for (std::uint32_t sender = 0; sender < backlog_.sender_count(); ++sender) {
    give_back(sender, true);
  }
  if (!has_primaries() && movement_.wants_to_ask()) {
    movement_.ask();
    termination_.ray_packet_sent();
  }
  if (is_passive(state())) {
    be_passive();
  }
}

/// Keeps no token, and once the end is proved no light.
template <class RaysTask>
void RayProgram<RaysTask>::be_passive() {
  if (const std::optional<Token> token = termination_.hand_on()) {
    send_control(*node_, next_on_ring(node_->id(), nodes::index_of(host_)), Kind::token, *token);
  }
  if (finishing_ && !done_) {
    settle();
  }
}

template <class RaysTask>
void RayProgram<RaysTask>::settle() {
  film_.flush();
  if (film_.settled()) {
    send_control(*node_, host_, Kind::done, Done{film_.counters().entries});
    done_ = true;
  }
}

template <class RaysTask>
nodes::HeatTotals RayProgram<RaysTask>::totals() const {
  nodes::HeatTotals totals{.charges = charges()};
  totals[core::HeatKind::rays] = operations_.ray_count();
  return totals;
}

template <class RaysTask>
nodes::Charges RayProgram<RaysTask>::charges() const {
  nodes::Charges charges{core::charges_of(operations_)};
  const auto add_up = [](const auto& by_kind) { return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0}); };
  charges[core::Charge::ray_packing] = add_up(counters_.in) + add_up(counters_.out);
  movement_.add_charges(charges);
  return charges;
}

template <class RaysTask>
nodes::Levels RayProgram<RaysTask>::levels() const {
  return {{"rays in backlog", backlog_.size()}, {"rays gathered", gather_.size()}, {"packets queued", gather_.queued()}};
}

template <class RaysTask>
std::string RayProgram<RaysTask>::describe() const {
  return std::to_string(primaries_.left() + unit_primaries_.left()) + " primary rays not started, " +
         std::to_string(backlog_.size()) + " rays in the backlog, " +
         (task_.is_idle()                         ? "none"
          : task_.has_rays() || task_.has_ended() ? "rays"
                                                  : "hits") +
         " under way, " + std::to_string(gather_.size()) + " rays gathered" +
         (gather_.waits() ? " (a packet waits for room), " : ", ") + std::to_string(gather_.queued()) + " packets queued, " +
         (places_.asking() > 0 ? std::to_string(places_.asking()) + " nodes wait for a place here, " : "") +
         (gather_.is_unanswered() ? "waits for places, " : "") +
         (backpressure_.admits_primaries(0) ? "" : "asked to hold primary rays back, ") + std::to_string(film_.gathered()) +
         " film entries" + (film_.waits() ? " (waiting)" : "") + ", ray packets sent - received " +
         std::to_string(termination_.balance()) + (termination_.holds_token() ? ", holds the token" : "") +
         (termination_.is_black() ? ", black" : ", white") +
         (stopped_     ? ", stopped"
          : done_      ? ", done"
          : finishing_ ? ", finishing"
                       : "");
}

template <class RaysTask>
ProgramReport RayProgram<RaysTask>::report() const {
  ProgramReport report{{.operations = operations_,
                        .rays = counters_,
                        .gather = gather_.counters(),
                        .film = film_.counters(),
                        .movement = movement_.counters(),
                        .backlog_high_water = backlog_.high_water()},
                       gather_.pairs()};
  report.rays.holds = backpressure_.count();
  if constexpr (RaysTask::rays_max == 1) {
    report.rays.tests_avoided = task_.tests_avoided();
  }
  report.operations.deposits_saturated += film_.counters().saturated;
  return report;
}

template class RayProgram<RayTask>;
template class RayProgram<BundleTask>;

std::unique_ptr<NodeProgram> make_node_program(nodes::Node& node, const Plan& plan, const NodeDeal& deal,
                                               const std::optional<nodes::Meter>& meter) {
  if (plan.rays_a_task > 1) {
    return std::make_unique<RayProgram<BundleTask>>(node, plan, deal, meter);
  }
  return std::make_unique<RayProgram<RayTask>>(node, plan, deal, meter);
}

}  // namespace dmpc::dataflow
