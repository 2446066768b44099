#include "dataflow/host.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::dataflow {
namespace {

/// The most primary rays in a run, some of which are urgent. A node has space for 120 runs: usually milliseconds of work.
constexpr std::uint64_t run_rays_max = 16;

}  // namespace

HostProgram::HostProgram(nodes::Node& node, const Plan& plan, core::Film& film, nodes::Progress progress, AssignPrimaries assign,
                         const core::Continuation& continuation, const core::FineDetail* detail)
    : Host(node, film, plan.request.refinement, plan.request.first_samples, std::move(progress), continuation, detail),
      assign_(std::move(assign)),
      pending_primaries_(plan.node_count(), plan.request.is_assigned_on_the_way ? run_rays_max : ~std::uint64_t{0},
                         plan.request.pixel_order()),
      kept_(plan.node_count(), plan.tested_objects()),
      termination_(Termination::initiator({plan.node_count()})),
      packet_(packet_layout(plan).in(node.memory())),
      node_count_(plan.node_count()),
      ray_batch_(plan.ray_batch),
      tested_objects_(plan.tested_objects()) {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    node.grant(nodes::NodeId{i}, ray_channel, plan.host_credits);
    node.grant(nodes::NodeId{i}, film_channel, plan.dealing_credits());
  }
  core::expect(plan.request.is_assigned_on_the_way || (continuation.start == nullptr && !continuation.keep),
               "where a picture is gone on with, or kept, the host assigns all of it");
  if (plan.request.is_assigned_on_the_way) {
    assign_pass();
  }
}

nodes::MemoryPlan HostProgram::layout(const Plan& plan) {
  return packet_layout(plan) + own_layout(std::size_t{plan.request.width} * plan.request.height);
}

void HostProgram::begin_frame(const core::FineDetail* detail) {
  Host::begin_frame(detail);
  finishing_ = stopped_ = false;
  termination_.begin_again();
  below_ = {};
  assign_pass();
}

/// Finds the owners of the primary rays for the pass's pixels that have no light yet; these then wait for assign_all().
void HostProgram::assign_pass() {
  const core::PixelMask done = with_light();
  std::optional<std::vector<std::vector<PrimaryRun>>> runs = assign_(refinement().pass(), done);
  if (runs) {
    pending_primaries_.begin_pass(std::move(*runs), numbered_samples(refinement().pass()), done);
  }
  is_cut_short_ = !runs;
}

void HostProgram::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::overflow:
      return take_overflow(packet);
    case Kind::credits:
      return node_->grant(packet.source, ray_channel, packet.as<Credits>().count);
    case Kind::film:
      return take_film(packet);
    case Kind::token:
      return termination_.take(packet.as<Token>());
    case Kind::done:
      return take_done(packet.as<Done>());
    case Kind::primaries_taken:
      node_->grant(packet.source, film_channel, packet.as<PrimariesTaken>().count);
      return assign(nodes::index_of(packet.source));
    default:
      core::expect(false, "the host receives only what is sent to the host");
  }
}

/// Forwards all that it can; without rays it passes on the token, and informs all when it detects termination.
bool HostProgram::work() {
  if (is_cut_short_) {
    return true;  // so that idleness is not taken for termination before the runner has seen the stop
  }
  assign_all();
  for (std::uint32_t owner = 0; owner < node_count_; ++owner) {
    while (can_forward(owner)) {
      forward(owner);
    }
  }
  if (finishing_ || !is_passive()) {
    return false;
  }
  if (const std::optional<TokenHandover> handover = termination_.hand_on()) {
    ++counters_.token_rounds;
    send_tokens(*node_, *handover);
  } else if (termination_.is_terminated()) {
    finishing_ = true;
    notify_children(*node_, termination_.place(), Kind::finish, Finish{});
  }
  return false;
}

void HostProgram::take_overflow(const nodes::Packet& packet) {
  const auto header = packet.front<RayPacketHeader>();
  core::expect(packet.payload.size() == ray_packet_bytes(header.count, tested_objects_),
               "a packet of rays is as long as it says");
  core::expect(header.owner < node_count_, "rays have an owner");
  termination_.ray_packet_received();
  for (std::uint32_t i = 0; i < header.count; ++i) {
    kept_.put(header.owner, ray_in(packet.payload, i, tested_objects_));
  }
  counters_.rays_in += header.count;
  send_control(*node_, packet.source, Kind::overflow_taken, OverflowTaken{static_cast<std::uint32_t>(kept_.size())});
}

bool HostProgram::can_forward(std::uint32_t owner) const {
  return forwards(kept_.count(owner), node_->credits(nodes::NodeId{owner}, ray_channel) > 0);
}

void HostProgram::forward(std::uint32_t owner) {
  const auto count = static_cast<std::uint16_t>(std::min<std::uint64_t>(kept_.count(owner), ray_batch_));
  const RayPacketHeader header{count, static_cast<std::uint16_t>(owner)};
  std::memcpy(packet_.data(), &header, sizeof(header));
  for (std::uint32_t i = 0; i < count; ++i) {
    put_ray(packet_, i, tested_objects_, kept_.take(owner));
  }
  node_->send_reserved(nodes::NodeId{owner}, ray_channel, number_of(Kind::forwarded),
                       std::span<const std::byte>(packet_.first(ray_packet_bytes(count, tested_objects_))));
  termination_.ray_packet_sent();
  counters_.rays_out += count;
}

void HostProgram::take_film(const nodes::Packet& packet) {
  const auto header = packet.front<FilmHeader>();
  core::expect(packet.payload.size() == film_packet_bytes(header.count), "a film packet is as long as it says");
  for (std::uint32_t i = 0; i < header.count; ++i) {
    FilmEntry entry;
    std::memcpy(&entry, packet.payload.data() + film_packet_bytes(i), sizeof(entry));
    core::expect(entry.plane < 2, "light falls on a plane of the film");
    core::PixelSums sums;
    sums.plane[entry.plane] = entry.light;
    take_light(entry.pixel, entry.more, sums);
  }
  counters_.film_entries += header.count;
  send_control(*node_, packet.source, Kind::film_acknowledgement, FilmAcknowledgement{header.count});
  report_progress(pixels_with_light());
  if (!pending_primaries_.is_empty() && !pending_primaries_.holds_back() && is_due()) {
    pending_primaries_.hold_back();
  }
}

void HostProgram::take_done(const Done& done) {
  core::expect(finishing_, "a node is done after the end is proved");
  below_.add(done);
  if (below_.reported < termination_.place().child_count) {
    return;
  }
  core::expect(below_.entries == counters_.film_entries, "all light that was sent has arrived");
  if (pending_primaries_.holds_back()) {
    return go_on_dealing();
  }
  report_progress(refinement().pixel_count());
  end_pass();
}

/// All light of the pass is on the film: assigns the next pass, or stops all nodes.
void HostProgram::end_pass() {
  if (!next_pass()) {
    notify_children(*node_, termination_.place(), Kind::stop, Stop{});
    stopped_ = true;
    return;
  }
  if (is_due()) {
    keep(with_light());
  }
  assign_pass();
  begin_again();
}

/// Only rays held back are left: the pixels that have begun are done.
void HostProgram::go_on_dealing() {
  keep(pending_primaries_.begun());
  pending_primaries_.release();
  begin_again();
}

/// After the termination of what was assigned.
void HostProgram::begin_again() {
  finishing_ = false;
  termination_.begin_again();
  below_ = {};
  assign_all();
}

void HostProgram::assign_all() {
  for (std::uint32_t i = 0; i < node_count_; ++i) {
    assign(i);
  }
}

/// Sends a node as many of its primary rays as fit its memory.
void HostProgram::assign(std::uint32_t index) {
  while (pending_primaries_.has(index) && node_->credits(nodes::NodeId{index}, film_channel) > 0) {
    node_->send_reserved(nodes::NodeId{index}, film_channel, number_of(Kind::primaries), pending_primaries_.take(index));
    termination_.ray_packet_sent();
  }
}

/// As termination detection defines it: has no ray to send, and no announcement to withdraw.
bool HostProgram::is_passive() const { return host_is_passive(kept_.size()) && pending_primaries_.is_empty(); }

std::string HostProgram::describe() const {
  return std::to_string(kept_.size()) + " rays kept, light on " + std::to_string(pixels_with_light()) + " of " +
         std::to_string(refinement().pixel_count()) + " pixels of pass " + std::to_string(refinement().result().passes) +
         ", ray packets sent - received " + std::to_string(termination_.balance()) +
         (termination_.holds_token() ? ", holds the token" : "") + (termination_.is_black() ? ", black, " : ", white, ") +
         std::to_string(below_.reported) + " of " + std::to_string(termination_.place().child_count) + " branches of nodes done" +
         (finishing_ ? ", finishing" : "");
}

HostCounters HostProgram::report() const {
  HostCounters counters = counters_;
  counters.deposits_saturated = deposits_saturated();
  counters.rays_buffered_max = kept_.high_water();
  counters.buffered_bytes_max = kept_.store_bytes();
  return counters;
}

}  // namespace dmpc::dataflow
