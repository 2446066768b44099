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

Places::Capacity places_of(const Plan& plan) {
  return {.node_count = plan.node_count(),
          .shared = plan.ray_places,
          .ray_credits = plan.ray_credits,
          .host_credits = plan.host_credits};
}

RayQueue::Capacity backlog_capacity(const Plan& plan) {
  const std::uint32_t packets_each = std::max({plan.ray_credits, plan.ray_places, plan.host_credits});
  return {.sender_count = places_of(plan).account_count(),
          .packets_each = packets_each,
          .packets = plan.shares_places() ? plan.ray_places + plan.host_credits : plan.node_count() * packets_each,
          .ray_batch = plan.ray_batch,
          .depth_max = plan.request.depth_max,
          .are_kinds_apart = plan.rays_a_task > 1,
          .tested_objects = plan.tested_objects()};
}

/// Only rays that walk alone have lists of what they have tested.
template <class RaysTask>
RaysTask make_task(nodes::Node& node, const Plan& plan) {
  if constexpr (RaysTask::rays_max == 1) {
    return RaysTask(node.memory(), node.id(), plan.request.waiting_hits_max, plan.tested_objects(), plan.request.has_instances);
  } else {
    core::expect(plan.tested_objects() == 0, "rays with lists of what they have tested walk alone");
    return RaysTask(node.memory(), node.id(), plan.request.waiting_hits_max, plan.request.has_instances);
  }
}

/// A ray that ends leaves light once; hits that glow, which are shaded side by side, do so together.
template <class RaysTask>
std::uint32_t deposits_at_once(const core::DatabaseHeader& header) {
  static_assert(RaysTask::rays_max < film_packet_entries);
  return core::hits_glow(header) ? RaysTask::rays_max : 1;
}

}  // namespace

template <class RaysTask, class Units>
RayProgram<RaysTask, Units>::RayProgram(nodes::Node& node, const Plan& plan, const NodeDeal& deal,
                                        const std::optional<nodes::Meter>& meter)
    : meter_(meter),
      node_(&node),
      host_(plan.host()),
      constants_(keep(node.memory(), Constants{settings_for(deal), deal.regions, deal.outline.header})),
      units_(node, plan, deal, constants_->settings.header, constants_->regions),
      records_(units_.records()),
      surroundings_{constants_->regions, constants_->outline,
                    core::LocalRecords(keep_records(node.memory(), core::MemoryUse::constants, std::span(deal.outline.bytes))),
                    deal.settings.skips},
      tracer_(records_, deal.header, deal.settings.skips, constants_->regions, node.id()),
      primaries_(node.memory(), Units::others_of(deal.primaries), deal.settings.first_samples(), plan.request.is_dealt()),
      backlog_(node.memory(), backlog_capacity(plan)),
      places_(node.memory(), places_of(plan)),
      tested_objects_(plan.tested_objects()),
      pixel_order_(plan.request.pixel_order()),
      leaves_runs_(!plan.request.computer.machine && plan.request.first_samples == 1),
      task_(make_task<RaysTask>(node, plan)),
      gather_(node, plan.gather()),
      film_(node, plan.film(deposits_at_once<RaysTask>(deal.header))),
      tells_host_alone_(plan.shares_places()),
      backpressure_(tells_host_alone_ ? 1 : plan.node_count() - 1, plan.queue_packets, !plan.request.rays.without_backpressure),
      termination_(Termination::member(node.id(), {plan.node_count()})) {
  core::expect(RaysTask::rays_max == plan.rays_a_task, "a node's task is that of the plan");
  core::expect(plan.request.has_instances == (deal.header.has_instances != 0),
               "rays have the cursors that the database asks for");
}

nodes::MemoryPlan NodeProgram::layout(const Plan& plan, std::uint32_t index) {
  const Share& share = plan.request.shares[index];
  nodes::MemoryPlan memory = Bytes{core::MemoryUse::constants, sizeof(Constants)} +
                             Bytes{core::MemoryUse::constants, share.outline_bytes} +
                             (plan.is_moving() ? MovingUnits::layout(plan, index) : NoUnits::layout(plan, index)) +
                             Primaries::layout(plan.is_moving() ? 0 : share.primary_runs, plan.request.is_dealt()) +
                             RayQueue::layout(backlog_capacity(plan)) + Places::layout(places_of(plan)) +
                             Gather::layout(plan.gather()) + FilmGather::layout(plan.film_entries());
  if (plan.rays_a_task > 1) {
    memory += BundleTask::layout(plan.request.waiting_hits_max, plan.request.has_instances);
  } else {
    memory += RayTask::layout(plan.request.waiting_hits_max, plan.request.has_instances);
  }
  return memory;
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::receive(const nodes::Packet& packet) {
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
      return take_hold(packet.source, packet.as<Hold>());
    case Kind::hold_acknowledgement:
      return tells_host_alone_ && packet.source != host_ ? hold_told_below() : backpressure_.acknowledged();
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
      return receive_primaries(packet.as<DealtPrimaries>());
    case Kind::stop:
      core::expect(done_ && !stopped_, "the host stops only nodes that are done, and once");
      core::expect(places_.are_all_free(), "every shared place has become free again");
      stopped_ = true;
      return tell_children(*node_, termination_.place(), Kind::stop, Stop{});
    default:
      return units_.receive(packet, termination_);
  }
}

/// Where the host relays it, those below are told before the one above gets its answer.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::take_hold(nodes::NodeId teller, const Hold& hold) {
  backpressure_.take(hold.holds != 0);
  holds_below_ = tells_host_alone_ ? termination_.place().child_count : 0;
  if (holds_below_ == 0) {
    return send_control(*node_, teller, Kind::hold_acknowledgement, HoldAcknowledgement{});
  }
  tell_children(*node_, termination_.place(), Kind::hold, hold);
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::hold_told_below() {
  core::expect(holds_below_ > 0, "an acknowledgement answers what was relayed");
  if (--holds_below_ == 0) {
    send_control(*node_, termination_.place().parent, Kind::hold_acknowledgement, HoldAcknowledgement{});
  }
}

/// A packet with rays has come: this pass has not ended, or the next has begun.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::wake() {
  core::expect(!finishing_ || done_, "no ray comes after the end");
  finishing_ = false;
  termination_.ray_packet_received();
  units_.rays_came();
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::receive_primaries(const DealtPrimaries& dealt) {
  wake();
  primaries_.put(dealt);
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::receive_rays(const nodes::Packet& packet) {
  wake();
  core::expect(packet.payload.size() >= sizeof(RayPacketHeader), "a packet of rays has a header");
  RayPacketHeader header;
  std::memcpy(&header, packet.payload.data(), sizeof(header));
  core::expect(packet.payload.size() == ray_packet_bytes(header.count, tested_objects_),
               "a packet of rays is as long as it says");
  core::expect(nodes::NodeId{header.owner} == node_->id(), "rays come to their owner");
  const std::uint32_t account = places_.account_of(packet.source);
  const bool is_from_node = packet.source != host_;
  if (is_from_node) {
    units_.packet_came(packet.source, header);
  }
  backlog_.accept_packet(account, header.count);
  for (std::uint32_t i = 0; i < header.count; ++i) {
    const std::span<const std::byte> message = ray_bytes_in(packet.payload, i, tested_objects_);
    backlog_.put(account, message);
    if (is_from_node) {
      units_.ray_came(packet.source, message);
    }
    ++counters_.in[static_cast<std::size_t>(kind_in(message))];
  }
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::take_credits(nodes::NodeId receiver, std::uint32_t count) {
  for (std::uint32_t sent = gather_.credits_returned(receiver, count); sent > 0; --sent) {
    termination_.ray_packet_sent();
  }
}

template <class RaysTask, class Units>
NodeState RayProgram<RaysTask, Units>::state() const {
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
          .is_moving_units = !units_.is_settled() || (!has_work && !has_primaries && units_.wants_to_ask())};
}

template <class RaysTask, class Units>
bool RayProgram<RaysTask, Units>::work() {
  const Task task = next_task(state());
  if (puts_off(task)) {
    return false;
  }
  if (meter_) [[unlikely]] {
    perform_metered(task);
  } else {
    perform(task);
  }
  units_.tell_left(gather_);
  const Task next = next_task(state());
  if (next == Task::rest) {
    rest();
  }
  return next != Task::rest && next != Task::send_waiting;
}

/// Bundles fill packets fast, so a node among many is soon without work, and its neighbours' rays may fill more: before it sends
/// packets that are not full it lets others run. Not twice in succession.
template <class RaysTask, class Units>
bool RayProgram<RaysTask, Units>::puts_off(Task task) {
  const bool is_first_flush = task == Task::flush && !flushes_;
  puts_off_flush_ = is_first_flush && RaysTask::rays_max > 1;
  flushes_ = task == Task::flush;
  return puts_off_flush_;
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::perform_metered(Task task) {
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

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::perform(Task task) {
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

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::announce() {
  const Hold hold{backpressure_.announce(gather_.queued()) ? 1U : 0U};
  if (tells_host_alone_) {
    return send_control(*node_, host_, Kind::hold, hold);
  }
  for (std::uint32_t i = 0; i < nodes::index_of(host_); ++i) {
    if (nodes::NodeId{i} != node_->id()) {
      send_control(*node_, nodes::NodeId{i}, Kind::hold, hold);
    }
  }
}

/// A film packet that waits is sent as soon as the host acknowledges another.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::send_waiting() {
  if (!gather_.waits()) {
    return;
  }
  const Way way = gather_.send();
  if (way == Way::to_owner || way == Way::to_host) {
    termination_.ray_packet_sent();
  }
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::take_received() {
  std::uint32_t account = 0;
  std::span<const std::byte> message = backlog_.take(account);
  take_up(message, account);
  for (std::uint32_t i = 1; i < RaysTask::rays_max && !packet_waits() && backlog_.has_alike(); ++i) {
    message = backlog_.take_alike(account);
    take_up(message, account);
  }
  go_on();
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::take_up(std::span<const std::byte> message, std::uint32_t account) {
  give_back(account, false);
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

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::start_primaries() {
  for (std::uint32_t i = 0; i < RaysTask::rays_max && has_primaries() && !packet_waits(); ++i) {
    start_primary();
  }
  trace();
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::start_primary() {
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

/// What a primary ray that needs not be traced comes to. With one sample a pixel nothing else falls on it. On a modelled machine
/// it is sent like other light: what packets take is part of every virtual time.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::leave_background(std::uint32_t pixel, std::uint32_t sample) {
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

/// Traces the rays under way, or the next children of the hits under way.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::go_on() {
  if (!task_.has_rays() && !task_.has_ended()) {
    task_.next_children(
        tracer_, constants_->settings, operations_, [this](const auto& make) { shoot(make); },
        [this](const core::Ray& ray, const core::Color& light) { leave_light(ray, light); });
  }
  trace();
}

/// A fresh ray, if make(ray) makes one.
template <class RaysTask, class Units>
template <class Make>
void RayProgram<RaysTask, Units>::shoot(const Make& make) {
  if (const core::Ray* const ray = task_.shoot_made(make)) {
    ++operations_.rays[static_cast<std::size_t>(ray->kind)];
    newest_.depth = ray->depth;
  }
}

/// The ray goes on in a region of this node's, or of another's.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::go_to_stop() {
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

/// Rays that do not start in this region may go on in it, but none comes back.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::trace() {
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

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::end_ray() {
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

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::end_blocked() {
  ++operations_.shadow_blocked;
  ++counters_.ended;
}

/// A ray has met its nearest hit, or a shadow ray any; or that is proved where nothing is.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::end_hit() {
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
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::shade_at_finder(const RayMessage& hit) {
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
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::count_claim(core::RayKind kind) {
  ++counters_.ended;
  ++(kind == core::RayKind::primary ? operations_.primary_hits : operations_.secondary_hits);
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::end_miss(const core::Ray& ray) {
  ++counters_.ended;
  const core::RenderSettings& settings = constants_->settings;
  leave_light(ray, settings.asks_sky(ray) ? light_of_sky(ray) : settings.light_of_miss(ray));
}

/// Every node has all of a sky's picture: rays leave the scene anywhere.
template <class RaysTask, class Units>
core::Color RayProgram<RaysTask, Units>::light_of_sky(const core::Ray& ray) {
  const core::RenderSettings& settings = constants_->settings;
  const std::byte* const tile = tracer_.find(core::sky_record(ray, settings.header));
  core::expect(tile != nullptr, "a node has all of the sky's picture");
  ++operations_.tile_reads;
  return ray.weight * core::sky_met(ray, settings.header, settings.shade.transport, tile);
}

template <class RaysTask, class Units>
core::FixedColor RayProgram<RaysTask, Units>::fixed(const core::Color& found) const {
  return core::to_fixed(found, constants_->settings.shade.film_scale);
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::leave_light(const core::Ray& ray, const core::Color& found) {
  const core::FixedColor light = fixed(found);
  if (light != core::FixedColor{}) {
    film_.add(ray.pixel, core::plane_of(ray.sample), light);
  }
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::dispatch(nodes::NodeId owner, const RayMessage& message) {
  ++counters_.out[static_cast<std::size_t>(message.ray.kind)];
  gather_.add(owner, message);
  send_waiting();
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::give_back(std::uint32_t account, bool rests) {
  const std::uint32_t owed = backlog_.owed(account);
  if (!places_.gives_back(account, owed, rests)) {
    return;
  }
  backlog_.gave_back(account, owed);
  if (places_.is_shared(account)) {
    places_.give_back(owed);
    grant_places();
  } else {
    send_credits(places_.sender_of(account), owed);
  }
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::grant_places() {
  while (const std::optional<nodes::NodeId> sender = places_.grant()) {
    send_credits(*sender, 1);
  }
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::send_credits(nodes::NodeId sender, std::uint32_t count) {
  if (sender != host_) {
    units_.tell_news(sender);
  }
  send_control(*node_, sender, Kind::credits, Credits{count});
}

/// Nothing to do until a packet comes: keeps nobody's credit.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::rest() {
  ++counters_.rests;
  for (std::uint32_t account = 0; account < backlog_.sender_count(); ++account) {
    give_back(account, true);
  }
  if (!has_primaries() && units_.wants_to_ask()) {
    units_.ask();
    termination_.ray_packet_sent();
  }
  if (is_passive(state())) {
    be_passive();
  }
}

/// Keeps no token, and once the end is proved no light.
template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::be_passive() {
  if (const std::optional<TokenHandover> handover = termination_.hand_on()) {
    send_tokens(*node_, *handover);
  }
  if (finishing_ && !done_) {
    settle();
  }
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::finish() {
  finishing_ = true;
  done_ = false;
  below_ = {};
  tell_children(*node_, termination_.place(), Kind::finish, Finish{});
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::settle() {
  film_.flush();
  const TreePlace& place = termination_.place();
  if (film_.settled() && below_.told == place.child_count) {
    send_control(*node_, place.parent, Kind::done, Done{film_.counters().entries + below_.entries});
    done_ = true;
  }
}

template <class RaysTask, class Units>
nodes::HeatTotals RayProgram<RaysTask, Units>::totals() const {
  nodes::HeatTotals totals{.charges = charges()};
  totals[core::HeatKind::rays] = operations_.ray_count();
  return totals;
}

template <class RaysTask, class Units>
nodes::Charges RayProgram<RaysTask, Units>::charges() const {
  nodes::Charges charges{core::charges_of(operations_)};
  const auto add_up = [](const auto& by_kind) { return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0}); };
  charges[core::Charge::ray_packing] = add_up(counters_.in) + add_up(counters_.out);
  units_.add_charges(charges);
  return charges;
}

template <class RaysTask, class Units>
nodes::Levels RayProgram<RaysTask, Units>::levels() const {
  return {{"rays in backlog", backlog_.size()}, {"rays gathered", gather_.size()}, {"packets queued", gather_.queued()}};
}

template <class RaysTask, class Units>
std::string RayProgram<RaysTask, Units>::describe() const {
  return std::to_string(primaries_.left() + units_.primaries_left()) + " primary rays not started, " +
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
         (termination_.awaited() > 0 ? ", waits for " + std::to_string(termination_.awaited()) + " below it to tell" : "") +
         (stopped_     ? ", stopped"
          : done_      ? ", done"
          : finishing_ ? ", finishing"
                       : "");
}

template <class RaysTask, class Units>
ProgramReport RayProgram<RaysTask, Units>::report() const {
  ProgramReport report{{.operations = operations_,
                        .rays = counters_,
                        .gather = gather_.counters(),
                        .film = film_.counters(),
                        .movement = units_.counters(),
                        .backlog_high_water = backlog_.high_water()},
                       gather_.pairs()};
  report.rays.holds = backpressure_.count();
  if constexpr (RaysTask::rays_max == 1) {
    report.rays.tests_avoided = task_.tests_avoided();
  }
  report.operations.deposits_saturated += film_.counters().saturated;
  return report;
}

template <class RaysTask, class Units>
void RayProgram<RaysTask, Units>::begin_frame(const core::RenderSettings& settings) {
  core::expect(stopped_ && !has_primaries(), "a frame begins when the one before has ended");
  const core::DatabaseHeader part = constants_->settings.header;
  constants_->settings = settings;
  constants_->settings.header = part;
  stopped_ = false;
}

template class RayProgram<RayTask>;
template class RayProgram<BundleTask>;
template class RayProgram<RayTask, MovingUnits>;
template class RayProgram<BundleTask, MovingUnits>;

std::unique_ptr<NodeProgram> make_node_program(nodes::Node& node, const Plan& plan, const NodeDeal& deal,
                                               const std::optional<nodes::Meter>& meter) {
  const auto make = [&]<class Units>() -> std::unique_ptr<NodeProgram> {
    if (plan.rays_a_task > 1) {
      return std::make_unique<RayProgram<BundleTask, Units>>(node, plan, deal, meter);
    }
    return std::make_unique<RayProgram<RayTask, Units>>(node, plan, deal, meter);
  };
  return plan.is_moving() ? make.template operator()<MovingUnits>() : make.template operator()<NoUnits>();
}

}  // namespace dmpc::dataflow
