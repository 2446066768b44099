#include "dataflow/plan.h"

#include <algorithm>

#include "core/base/expect.h"
#include "core/base/refusal.h"
#include "dataflow/film_gather.h"
#include "dataflow/host.h"
#include "dataflow/packets.h"
#include "dataflow/program.h"
#include "dataflow/rays/bundle_task.h"
#include "dataflow/rays/gather.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/rays/ray_queue.h"
#include "dataflow/rays/ray_task.h"
#include "nodes/batching.h"
#include "nodes/runner.h"
#include "nodes/size_text.h"
#include "nodes/threads/delayed_packets.h"

namespace dmpc::dataflow {
namespace {

using core::check_use;
using core::field_of;
using nodes::size_text;

constexpr core::Field nodes_field = field_of<&nodes::ComputerRequest::node_count>(),
                      memory_field = field_of<&nodes::ComputerRequest::node_memory_bytes>();

/// One packet in flight, one being processed, and twice that so that neither waits for the other's credit. Eight send a tenth
/// fewer packets, but need 0.5 MB more per node with 64 nodes.
constexpr std::uint32_t default_ray_credits = 4;
/// Bundles are processed faster than a sleeping node wakes up, so a small number of nodes, which have the memory, get more: two
/// nodes with 4 credits are idle for a quarter of the time.
constexpr std::uint32_t few_nodes_ray_credits = 64;
/// With many nodes, each receives from few (5.7 of 1,024 on rings-4-t1), so slots for all would waste memory: they are shared.
/// With fewer nodes they are affordable, and nobody has to request them.
constexpr std::uint32_t own_credits_nodes_max = 128;
constexpr std::uint32_t default_ray_slots = 64;
/// Where many nodes share a core, a receiver may not run for milliseconds, and the others continue until its announcement of a
/// long queue arrives. 8 to 64 nodes on two cores with other load queued up to 464 packets on seven scenes at 512x512.
constexpr std::uint32_t default_queue_packets = 512;
/// Packets of bundles are twice as long.
constexpr std::uint32_t default_bundle_queue_packets = 256;
/// Where slots are shared, memory matters, and packets are few: with 1,024 nodes they are seldom full.
constexpr std::uint32_t default_shared_queue_packets = 128;
constexpr std::size_t host_stack_bytes = std::size_t{1} << 20U;

/// The maximum number of small packets about units in a node's mailbox.
std::uint32_t unit_slots_of(const Plan& plan) {
  const std::uint32_t others = plan.node_count() - 1;
  return others                                                    // UnitAsk: one from each other node
         + 1                                                       // UnitRefusal of this node's question
         + 1                                                       // UnitAcknowledgement of this node's page
         + others * (plan.shares_slots() ? 1 : plan.ray_credits);  // UnitMoved, beside each packet of credits
}

/// The capacity that a node's mailbox needs for any order of sends; the mailbox itself adds the slot that receives.
nodes::MailboxCapacity node_mailbox_of(const Plan& plan) {
  const std::uint32_t others = plan.node_count() - 1;
  const std::uint32_t assigned = plan.dealing_credits();
  const std::uint32_t moving = plan.is_moving() ? 1 : 0;
  const TerminationTree tree{plan.node_count()};
  return {.small_slots = others * plan.ray_credits             // credits back from each other node, at least one a packet
                         + (plan.shares_slots() ? others : 0)  // requests for slots: one from each other node
                         + (plan.shares_slots() ? plan.gather().asks_max() : 0)  // grants: one for each of this node's requests
                         + plan.host_credits                                     // the same from the host
                         + plan.film_credits                   // acknowledgements: one for each film packet of this node's
                         + tree.packets_max(nodes::NodeId{0})  // tokens or done: nobody has more children than the first
                         + 1                                   // Finish
                         + 1                                   // Stop
                         + moving * unit_slots_of(plan),
          .bulk_slots = others * plan.ray_credits  // rays: each other node's credits for this one
                        + plan.ray_slots           // rays, or unused credits: the slots that others share
                        + plan.host_credits        // forwarded rays: the host's
                        + assigned                 // primary rays assigned after the start
                        + moving,                  // unit_page or unit_primaries: the answer to this node's question
          .bulk_payload_bytes = std::max({plan.packet_bytes(), assigned > 0 ? sizeof(AssignedPrimaries) : 0,
                                          plan.unit_packet_bytes(), plan.is_moving() ? sizeof(UnitPrimaryRays) : 0})};
}

nodes::MailboxCapacity host_mailbox_of(const Plan& plan) {
  const TerminationTree tree{plan.node_count()};
  return {.small_slots = plan.node_count() * plan.host_credits                 // credits back for forwarded rays
                         + tree.packets_max(nodes::NodeId{plan.node_count()})  // tokens, or Done, of its children
                         + plan.node_count() * plan.dealing_credits()          // credits back for primary rays
                         + plan.node_count(),  // film of one entry, which is small: each node's last packet, and no other
          .bulk_slots = plan.node_count() * plan.host_credits  // overflow: each node's credits for the host
                        + plan.node_count() * plan.film_credits,
          .bulk_payload_bytes = std::max(plan.packet_bytes(), film_packet_bytes(film_packet_entries))};
}

/// Fewer credits than the mailboxes have slots for, and a slot for delayed packets.
void plan_chaos(Plan& plan, const nodes::Chaos& chaos) {
  plan.ray_credits = nodes::shrunk_credits(chaos, plan.ray_credits, ray_channel);
  plan.ray_slots = nodes::shrunk_credits(chaos, plan.ray_slots, ray_channel);
  plan.host_credits = nodes::shrunk_credits(chaos, plan.host_credits, nodes::channel_count);
  plan.film_credits = nodes::shrunk_credits(chaos, plan.film_credits, film_channel);
  plan.queue_packets = nodes::shrunk_credits(chaos, plan.queue_packets, nodes::channel_count + 1);
  plan.held_bytes =
      nodes::DelayedPackets::room_bytes(std::max(plan.node_mailbox.bulk_payload_bytes, plan.host_mailbox.bulk_payload_bytes));
}

/// What may be reduced where memory is scarce.
struct Bounds {
  std::uint32_t ray_batch = 1, ray_credits = 1, ray_slots = 0, queue_packets = 0;
  bool bundles = false;
  std::uint32_t spare_frames = 0;
  bool joins_nodes() const { return ray_credits > 0 || ray_slots > 0; }
};

/// The plan with these bounds, whether or not it fits.
Plan plan_with(const PlanRequest& request, const Bounds& bounds) {
  Plan plan;
  plan.request = request;
  plan.ray_batch = bounds.ray_batch;
  plan.ray_credits = bounds.ray_credits;
  plan.ray_slots = bounds.ray_slots;
  plan.host_credits = std::max(1U, bounds.ray_credits);
  plan.queue_packets = !bounds.joins_nodes() || request.node_count() == 1 ? 0 : bounds.queue_packets;
  plan.rays_a_task = bounds.bundles ? BundleTask::rays_max : RayTask::rays_max;
  plan.spare_frames = bounds.spare_frames;
  plan.film_credits = nodes::batching_credits(request.node_count(), request.computer.machine.has_value());
  plan.node_mailbox = node_mailbox_of(plan);
  plan.host_mailbox = host_mailbox_of(plan);
  if (request.computer.chaos) {
    plan_chaos(plan, *request.computer.chaos);
  }
  return plan;
}

void check(const PlanRequest& request) {
  constexpr core::Field tested_field = field_of<&RayOptions::tested_objects>(), batch_field = field_of<&RayOptions::ray_batch>(),
                        credits_field = field_of<&RayOptions::ray_credits>(), places_field = field_of<&RayOptions::ray_slots>();
  check_use(request.node_count() >= 1 && request.node_count() <= nodes::node_count_max, nodes_field, "=", request.node_count(),
            ": from 1 to ", nodes::node_count_max, " nodes with strategy=dataflow");
  nodes::check_ranks(request.computer);
  const std::uint32_t tested = request.rays.tested_objects;
  check_use(tested <= tested_objects_max, tested_field, "=", tested, ": at most ", tested_objects_max, " names");
  check_use(tested == 0 || !request.has_instances, tested_field, "=", tested,
            ": a leaf of a base mesh occurs in many instances, and a list would name it once for all of them");
  const std::uint32_t batch = request.rays.ray_batch.value_or(1), batch_max = rays_in(packet_bytes_max, tested);
  core::Sentence batches(batch_field, "=", batch, ": from 1 to ", batch_max, " rays");
  if (tested > 0) {
    batches.add(" with ", tested_field, "=", tested);
  }
  check_use(batch >= 1 && batch <= batch_max, batches);
  const std::uint32_t credits = request.rays.ray_credits.value_or(1);
  check_use(credits <= ray_credits_max, credits_field, "=", credits, ": at most ", ray_credits_max, " packets");
  const std::uint32_t slots = request.rays.ray_slots.value_or(1);
  check_use(slots >= 1 && slots <= ray_slots_max, places_field, "=", slots, ": from 1 to ", ray_slots_max, " packets");
  check_use(!request.rays.ray_slots || !request.rays.ray_credits, places_field, "=", slots, " and ", credits_field, "=", credits,
            ": senders have credits of their own or share slots, not both");
  const std::uint32_t queue = request.rays.queue_packets.value_or(0);
  check_use(queue <= queue_packets_max, field_of<&RayOptions::queue_packets>(), "=", queue, ": at most ", queue_packets_max,
            " packets");
  core::expect(request.depth_max >= 1 && request.depth_max <= 255, "a ray has a depth that fits its record");
  core::expect(request.width >= 1 && request.height >= 1, "a picture has a pixel");
}

std::uint32_t default_credits(const PlanRequest& request) {
  return std::max(default_ray_credits, request.bundles ? few_nodes_ray_credits / request.node_count() : 0);
}

bool shares_slots(const PlanRequest& request) {
  return request.rays.ray_slots || (!request.rays.ray_credits && request.node_count() > own_credits_nodes_max);
}

std::uint32_t default_queue(const PlanRequest& request) {
  return shares_slots(request) ? default_shared_queue_packets
         : request.bundles     ? default_bundle_queue_packets
                               : default_queue_packets;
}

/// Threads that share cores are woken less often with packets twice as long: 64 on two cores took 0.89 of the processor time for
/// three scenes; a modelled machine wakes none. Bundles double that again (0.8 on two scenes), but not where slots are shared:
/// with 1,024 nodes packets of 4 KiB are a fifth full, and their slots are three quarters of a node's queues.
std::uint32_t default_batch(const PlanRequest& request) {
  const std::size_t times = request.computer.machine ? 1 : request.bundles && !shares_slots(request) ? 4 : 2;
  return rays_in(times * packet_bytes, request.rays.tested_objects);
}

/// As many as a node has of its own, on average, so any node may grow to twice the mean.
std::uint32_t default_spare_frames(const PlanRequest& request) {
  std::size_t pages = 0;
  for (const Share& share : request.shares) {
    pages += request.is_moving() ? share.part_bytes / share.page_bytes : 0;
  }
  return static_cast<std::uint32_t>(core::ceil_divide<std::size_t>(pages, request.node_count()));
}

Bounds wanted(const PlanRequest& request) {
  const bool shares = shares_slots(request);
  return {.ray_batch = request.rays.ray_batch.value_or(default_batch(request)),
          .ray_credits = shares ? 0 : request.rays.ray_credits.value_or(default_credits(request)),
          .ray_slots = shares ? request.rays.ray_slots.value_or(default_ray_slots) : 0,
          .queue_packets = request.rays.queue_packets.value_or(default_queue(request)),
          .bundles = request.bundles,
          .spare_frames = default_spare_frames(request)};
}

/// With the minimum of everything that the request leaves open.
Plan smallest_plan(const PlanRequest& request) {
  const bool shares = shares_slots(request);
  return plan_with(request, {.ray_batch = request.rays.ray_batch.value_or(1),
                             .ray_credits = shares ? 0 : request.rays.ray_credits.value_or(1),
                             .ray_slots = shares ? request.rays.ray_slots.value_or(1) : 0,
                             .queue_packets = request.rays.queue_packets.value_or(0)});
}

/// Reduces queued packets first, then memory for units, then credits or slots, then bundles, then the packet length, as far as
/// the request leaves them open and the memory requires it.
Plan fitting_plan(const PlanRequest& request, std::size_t memory_bytes) {
  Bounds bounds = wanted(request);
  Plan plan = plan_with(request, bounds);
  while (plan.node_memory_max_bytes() > memory_bytes) {
    if (!request.rays.queue_packets && bounds.queue_packets > 0) {
      --bounds.queue_packets;
    } else if (bounds.spare_frames > 0) {
      --bounds.spare_frames;
    } else if (!request.rays.ray_credits && bounds.ray_credits > 1) {
      --bounds.ray_credits;
    } else if (!request.rays.ray_slots && bounds.ray_slots > 1) {
      --bounds.ray_slots;
    } else if (bounds.bundles) {
      bounds.bundles = false;
    } else {
      core::expect(!request.rays.ray_batch && bounds.ray_batch > 1, "the smallest plan fits");
      --bounds.ray_batch;
    }
    plan = plan_with(request, bounds);
  }
  return plan;
}

[[noreturn]] void say_too_small(const PlanRequest& request, const OtherNodeCount& other_node_count) {
  const Plan smallest = smallest_plan(request);
  const std::uint32_t largest = smallest.largest_node();
  core::Sentence sentence(memory_field, "=", size_text(*request.computer.node_memory_bytes), " is too small for ", nodes_field,
                          "=", request.node_count(), ": node ", largest, " needs at least ", smallest.node_memory_max_bytes(),
                          " bytes, ", request.shares[largest].part_bytes,
                          " of them for its part of the scene; the smallest that works is ", memory_field, "=",
                          size_text(smallest.node_memory_max_bytes()));
  if (const std::optional<std::uint32_t> other = other_node_count ? other_node_count() : std::nullopt) {
    sentence.add(", or with this memory ", nodes_field, "=", *other);
  }
  throw core::Refusal<core::CapacityError>(sentence);
}

void note_reductions(Plan& plan) {
  const PlanRequest& request = plan.request;
  const auto note = [&](const std::string& what, std::uint32_t wanted, std::uint32_t planned) {
    if (planned < wanted) {
      plan.notes.push_back(what + " reduced from " + std::to_string(wanted) + " to " + std::to_string(planned) + " to fit " +
                           size_text(*request.computer.node_memory_bytes));
    }
  };
  const Plan unbounded = plan_with(request, wanted(request));
  note("packets of rays that wait for credits", unbounded.queue_packets, plan.queue_packets);
  note("pages of units that a node may take", unbounded.spare_frames, plan.spare_frames);
  note("credits for rays", unbounded.ray_credits, plan.ray_credits);
  note("slots for packets of rays", unbounded.ray_slots, plan.ray_slots);
  note("rays traced together", unbounded.rays_a_task, plan.rays_a_task);
  note("rays in a packet", unbounded.ray_batch, plan.ray_batch);
}

}  // namespace

Gather::Capacity Plan::gather() const {
  return {.node_count = node_count(),
          .ray_batch = ray_batch,
          .ray_credits = ray_credits,
          .shares_slots = shares_slots(),
          .open_packets = shares_slots() ? std::min(ray_slots, node_count()) : 0,
          .host_credits = host_credits,
          .queue_packets = queue_packets,
          .tested_objects = tested_objects()};
}

std::uint32_t Plan::dealing_credits() const { return request.is_assigned() ? assigned_packets : 0; }

nodes::MemoryPlan Plan::node_memory(std::uint32_t index) const {
  return nodes::memory_beside_program(node_mailbox, node_count() + 1, held_bytes, request.computer.stack_reserve_bytes) +
         NodeProgram::layout(*this, index);
}

std::size_t Plan::unit_packet_bytes() const {
  return is_moving() ? sizeof(UnitPageHeader) + request.shares.front().page_bytes : 0;
}

UnitPages::Capacity Plan::pages_of_node(std::uint32_t index) const {
  const Share& share = request.shares[index];
  return {.page_bytes = share.page_bytes,
          .frames = static_cast<std::uint32_t>(share.part_bytes / share.page_bytes) + spare_frames};
}

UnitPrimaries::Capacity Plan::primaries_of_node(std::uint32_t index) const {
  std::size_t runs = 0;
  for (const Share& share : request.shares) {
    runs += share.primary_runs;
  }
  const std::size_t mean = core::ceil_divide<std::size_t>(runs, node_count());
  return {.units = request.rays.balance.regions_a_node, .runs = std::max(request.shares[index].primary_runs, mean)};
}

std::uint32_t Plan::largest_node() const {
  std::uint32_t largest = 0;
  std::size_t most_bytes = 0;
  for (std::uint32_t i = 0; i < node_count(); ++i) {
    const std::size_t bytes = node_memory(i).total();
    largest = bytes > most_bytes ? i : largest;
    most_bytes = std::max(most_bytes, bytes);
  }
  return largest;
}

nodes::MemoryPlan Plan::host_memory() const {
  return nodes::memory_beside_program(host_mailbox, node_count() + 1, held_bytes, host_stack_bytes) + HostProgram::layout(*this);
}

std::size_t smallest_node_memory_bytes(const PlanRequest& request) { return smallest_plan(request).node_memory_max_bytes(); }

Plan make_plan(const PlanRequest& request, const OtherNodeCount& other_node_count) {
  check(request);
  if (!request.computer.node_memory_bytes) {
    return plan_with(request, wanted(request));
  }
  if (smallest_node_memory_bytes(request) > *request.computer.node_memory_bytes) {
    say_too_small(request, other_node_count);
  }
  Plan plan = fitting_plan(request, *request.computer.node_memory_bytes);
  if (!request.computer.chaos) {
    note_reductions(plan);
  }
  return plan;
}

}  // namespace dmpc::dataflow
