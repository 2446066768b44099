#include "svm/plan.h"

#include <algorithm>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/database/database.h"
#include "core/picture/bundle_task.h"
#include "core/picture/memory_use.h"
#include "nodes/immutable_pieces.h"
#include "nodes/runner.h"
#include "nodes/size_text.h"
#include "nodes/threads/delayed_packets.h"
#include "svm/host.h"
#include "svm/packets.h"
#include "svm/slots.h"
#include "svm/work_items.h"

namespace dmpc::svm {
namespace {

using core::check_use;
using core::field_of;
using nodes::size_text;

constexpr core::Field strategy_field = field_of<&PlanRequest::strategy>(),
                      nodes_field = field_of<&nodes::ComputerRequest::node_count>(),
                      memory_field = field_of<&nodes::ComputerRequest::node_memory_bytes>();

constexpr std::uint32_t auto_cache_pages_min = 64;
/// Of the cache, where memory is bounded and the number of pixels in flight is not asked for: with fewer frames, tasks evict each
/// other's pages (svm/RESULTS.md).
constexpr std::uint32_t frames_a_task = 8;
constexpr std::size_t host_stack_bytes = std::size_t{1} << 20U;

bool is_host_home(const PlanRequest& request) { return are_at_host(request.pages.homes); }

/// Bundles are always full: with fewer pixels in flight, rays are traced one by one.
std::uint32_t pixels_a_task(const PlanRequest& request, std::uint32_t in_flight) {
  return request.bundles && in_flight >= bundle_pixels ? bundle_pixels : 1;
}

/// If a pass may omit pixels, a work item travels with a mask of one word, which limits the item's size.
std::uint32_t item_side_of(const PlanRequest& request) {
  const std::uint32_t side = work_item_side_of(request.pages, request.bundles);
  return request.is_masked() ? std::min(side, masked_side_max) : side;
}

/// The maximum number of pixels in progress on a node: all of the picture if work moves, else the largest share. A node may have
/// none, but has space for one.
std::uint64_t node_pixels_max(const PlanRequest& request) {
  const PixelRectangle image{0, 0, request.width, request.height};
  if (item_side_of(request) > 0) {
    return image.pixel_count();
  }
  std::uint64_t most = 1;
  const std::uint32_t workers = request.worker_count();
  for (std::uint32_t index = 0; index < workers; ++index) {
    most = std::max(most, share_of(image, index, workers, request.pages.pixel_shares).pixel_count());
  }
  return most;
}

std::uint32_t film_credits_of(const PlanRequest& request) {
  return nodes::batching_credits(request.computer.node_count, request.computer.machine.has_value());
}

/// On a modelled machine all entries have both: the cost of a packet is part of every virtual time.
std::uint32_t film_planes_of(const PlanRequest& request) {
  return request.computer.machine ? 2 : core::planes_for(request.first_samples);
}

std::uint32_t film_entries_of(const PlanRequest& request) {
  return static_cast<std::uint32_t>((pictures::film_packet_bytes_max - sizeof(FilmHeader)) /
                                    film_entry_bytes(film_planes_of(request)));
}

/// The capacity that a node's mailbox needs for any order of sends; the mailbox itself adds the slot that receives.
nodes::MailboxCapacity node_mailbox_of(const Plan& plan) {
  const PlanRequest& request = plan.request;
  const bool ring = item_side_of(request) > 0;
  nodes::MailboxCapacity capacity;
  // Work requests: each other node has at most one on the ring, unless they go to the host.
  const std::uint32_t passed_on = ring && !request.is_assigned() ? request.computer.node_count - 1 : 0;
  capacity.small_slots = passed_on                   // work requests
                         + (ring ? 1 : 0)            // the reply to this node's own work request
                         + film_credits_of(request)  // acknowledgements: one for each film packet of this node's
                         + 1;                        // Stop
  if (request.refinement.is_wanted()) {
    capacity.small_slots += 1;  // BeginPass
    capacity.bulk_slots = 1;    // a part of the mask: the next one follows its acknowledgement
    capacity.bulk_payload_bytes = sizeof(MaskPart);
  }
  request.strategy->add_slots(plan, capacity);
  return capacity;
}

nodes::MailboxCapacity host_mailbox_of(const Plan& plan) {
  const PlanRequest& request = plan.request;
  return {.small_slots = request.computer.node_count  // Done: one from each node
                         + (request.refinement.is_wanted() ? request.computer.node_count
                                                           : 0)  // acknowledgements: one for each node's part of the mask
                         + (request.is_assigned() ? request.worker_count() : 0)  // work requests: one from each worker
                         + (is_host_home(request) ? request.computer.node_count * plan.request_credits
                                                  : 0),                          // page requests: each node's credits
          .bulk_slots = request.computer.node_count * film_credits_of(request),  // film packets: each node's credits
          .bulk_payload_bytes = film_packet_bytes(plan.film_entries, plan.film_planes)};
}

/// Fewer credits than the mailboxes have slots for, and a slot for delayed packets.
void plan_chaos(Plan& plan, const nodes::Chaos& chaos) {
  plan.request_credits = nodes::shrunk_credits(chaos, plan.request_credits, request_channel);
  plan.film_credits = nodes::shrunk_credits(chaos, plan.film_credits, bulk_channel);
  plan.held_bytes = nodes::DelayedPackets::room_bytes(
      std::max(plan.node_mailbox.bulk_payload_bytes, plan.host_mailbox.bulk_payload_bytes));  // a page reply or film
}

/// The plan with this cache and these pixels in flight, whether or not it fits.
Plan plan_with(const PlanRequest& request, std::uint32_t frames, std::uint32_t in_flight) {
  Plan plan;
  plan.request = request;
  // At least one frame is left for other pages.
  plan.resident_count = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(std::uint64_t{frames} * request.pages.resident_percent / 100, frames - std::min(frames, 1U)));
  plan.frames = frames - plan.resident_count;
  plan.in_flight = in_flight;
  plan.pixels_a_task = pixels_a_task(request, in_flight);
  plan.worker_count = request.worker_count();
  plan.work_item_side = item_side_of(request);
  plan.request_credits = request.strategy->request_credits(plan);
  plan.film_credits = film_credits_of(request);
  plan.film_planes = film_planes_of(request);
  plan.film_entries = film_entries_of(request);
  plan.node_mailbox = node_mailbox_of(plan);
  plan.host_mailbox = host_mailbox_of(plan);
  if (request.computer.chaos) {
    plan_chaos(plan, *request.computer.chaos);
  }
  return plan;
}

std::size_t bytes_with(const PlanRequest& request, std::uint32_t frames, std::uint32_t in_flight) {
  return plan_with(request, frames, in_flight).node_memory_max_bytes();
}

/// A field that only nodes which fetch pages have, and whether it has its default.
struct FieldOfSvm {
  core::Field field;
  bool (*is_usual)(const PageOptions&);
};

template <auto Member>
constexpr FieldOfSvm of_svm() {
  return {field_of<Member>(), [](const PageOptions& pages) { return pages.*Member == PageOptions{}.*Member; }};
}

constexpr FieldOfSvm fields_of_svm[] = {
    of_svm<&PageOptions::cache_pages>(), of_svm<&PageOptions::replacement>(),      of_svm<&PageOptions::homes>(),
    of_svm<&PageOptions::count_pages>(), of_svm<&PageOptions::resident_percent>(), of_svm<&PageOptions::bundles_on_machines>(),
    of_svm<&PageOptions::own_policy>()};

void check_fields_of_svm(const PlanRequest& request) {
  for (const FieldOfSvm& of_svm : fields_of_svm) {
    check_use(goes_with(of_svm.field, *request.strategy) || of_svm.is_usual(request.pages), of_svm.field, " goes with ",
              strategy_field, "=svm");
  }
}

/// Work that moves, or a pixel that continues while another waits, would make the order of references depend on page misses.
void check_recording(const PlanRequest& request) {
  if (request.pages.record_references) {
    check_use(request.strategy->fetches_pages(), "page references are recorded with ", strategy_field, "=svm only");
    check_use(request.pages.work_item_side == 0U,
              "page references are recorded only if no node gives work away: ", field_of<&PageOptions::work_item_side>(), "=0");
    check_use(request.pages.in_flight == 1U,
              "page references are recorded only with one pixel in flight: ", field_of<&PageOptions::in_flight>(), "=1");
    check_use(request.computer.ranks == nullptr, "page references are recorded in one process, not on ranks");
    check_use(!request.pages.count_pages, "page references are recorded, or distinct pages counted, not both");
  }
}

void check_work(const PlanRequest& request) {
  constexpr core::Field donor = field_of<&PageOptions::work_donor>();
  const std::uint32_t workers = request.worker_count(), in_flight = request.pages.in_flight.value_or(1);
  check_use(workers >= 1 && workers <= request.computer.node_count, field_of<&PageOptions::worker_count>(), "=", workers,
            ": expected at least one worker, and at most as many as there are nodes, ", request.computer.node_count);
  check_use(!request.is_assigned() || request.pages.work_item_side != 0U, donor, "=host does not go with ",
            field_of<&PageOptions::work_item_side>(), "=0: the host assigns items of a pixel or more");
  check_use(!request.is_assigned() || request.pages.pixel_shares == PixelShares::submaps, field_of<&PageOptions::pixel_shares>(),
            "=interleaved does not go with ", donor, "=host: where the host assigns items, no pixel is a node's own");
  check_use(in_flight >= 1 && in_flight <= in_flight_max, field_of<&PageOptions::in_flight>(), "=", in_flight, ": from 1 to ",
            in_flight_max, " pixels");
}

void check(const PlanRequest& request) {
  check_use(is_page_size(request.page_size_bytes), field_of<&core::BuildOptions::page_size_bytes>(), "=",
            size_text(request.page_size_bytes), ": a page is a power of two from 512B to 64KiB");
  check_use(request.computer.node_count >= 1 && request.computer.node_count <= nodes::node_count_max, nodes_field, "=",
            request.computer.node_count, ": from 1 to ", nodes::node_count_max, " nodes");
  nodes::check_ranks(request.computer);
  check_work(request);
  check_fields_of_svm(request);
  check_use(request.pages.own_policy == nullptr || request.computer.machine, field_of<&PageOptions::own_policy>(),
            " is for a modelled machine, whose time it does not take");
  check_use(request.pages.resident_percent <= 100, field_of<&PageOptions::resident_percent>(), "=",
            request.pages.resident_percent, ": from 0 to 100");
  check_use(!request.pages.count_pages || !request.refinement.is_wanted(),
            "distinct pages are counted where all pixels have the same samples, not with refinement");
  check_use(request.pages.cache_pages != 0U, field_of<&PageOptions::cache_pages>(),
            "=0: a node needs at least one frame for the pages of others");
  request.strategy->check(request);
  check_recording(request);
  core::expect(request.page_count >= 1 && request.waiting_hits_max >= 1, "a database has a page, and a ray a hit");
  core::expect(request.width >= 1 && request.height >= 1, "a picture has a pixel");
  core::expect(request.start == nullptr || request.start->pass.steps().size() == std::size_t{request.width} * request.height,
               "what is gone on with is of the same picture");
}

/// The user's choice, or the default, limited by the number of pixels, before memory is considered.
std::uint32_t wanted_in_flight(const PlanRequest& request) {
  const std::uint32_t asked =
      request.pages.in_flight.value_or(request.strategy->usual_tasks(request) * (request.bundles ? bundle_pixels : 1));
  const auto wanted = static_cast<std::uint32_t>(std::min<std::uint64_t>(asked, node_pixels_max(request)));
  return wanted - wanted % pixels_a_task(request, wanted);
}

std::uint32_t frames_min(const PlanRequest& request) {
  return std::min(request.pages.cache_pages.value_or(1), request.strategy->foreign_pages_max(request));
}

std::uint32_t auto_frames(const PlanRequest& request) {
  const std::uint32_t quarter = core::ceil_divide(request.page_count, 4U);
  return std::min(request.pages.cache_pages.value_or(std::max(quarter, auto_cache_pages_min)),
                  request.strategy->foreign_pages_max(request));
}

/// The maximum number of frames that fit; frames_min() are known to fit.
std::uint32_t most_frames(const PlanRequest& request, std::uint32_t in_flight, std::size_t memory_bytes) {
  std::uint32_t fits = frames_min(request);
  std::uint32_t too_many = (request.pages.cache_pages ? fits : request.strategy->foreign_pages_max(request)) + 1;
  while (too_many - fits > 1) {
    const std::uint32_t middle = fits + (too_many - fits) / 2;
    (bytes_with(request, middle, in_flight) <= memory_bytes ? fits : too_many) = middle;
  }
  return fits;
}

/// The maximum number of pixels in flight that leave space for the requested cache, or else for a frame each: a pixel without one
/// evicts another's page. Unless so many pixels were asked for, each task leaves its share of a cache that is worth having.
std::uint32_t most_in_flight(const PlanRequest& request, std::size_t memory_bytes) {
  std::uint32_t in_flight = wanted_in_flight(request);
  const auto frames_for = [&](std::uint32_t pixels) {
    const std::uint32_t each = request.pages.in_flight ? 0 : frames_a_task * (pixels / pixels_a_task(request, pixels));
    return request.pages.cache_pages ? frames_min(request)
                                     : std::min(std::max(pixels, each), request.strategy->foreign_pages_max(request));
  };
  while (in_flight > 1 && bytes_with(request, frames_for(in_flight), in_flight) > memory_bytes) {
    const std::uint32_t less = pixels_a_task(request, in_flight);
    in_flight = in_flight > less ? in_flight - less : in_flight - 1;
  }
  return in_flight;
}

/// With more nodes each holds fewer pages, but larger mailboxes and credit tables, so fewer nodes may help.
std::optional<std::uint32_t> smallest_node_count(PlanRequest request) {
  for (request.computer.node_count = 1; request.computer.node_count <= nodes::node_count_max; ++request.computer.node_count) {
    if (smallest_node_memory_bytes(request) <= *request.computer.node_memory_bytes) {
      return request.computer.node_count;
    }
  }
  return std::nullopt;
}

[[noreturn]] void say_too_small(const PlanRequest& request) {
  core::Sentence sentence(memory_field, "=", size_text(*request.computer.node_memory_bytes), " is too small for ", nodes_field,
                          "=", request.computer.node_count, ": the smallest that works is ", memory_field, "=",
                          size_text(smallest_node_memory_bytes(request)));
  if (const auto nodes = smallest_node_count(request)) {
    sentence.add(", or with this memory ", nodes_field, "=", *nodes);
  } else {
    sentence.add(request.strategy->advice());
  }
  throw core::Refusal<core::CapacityError>(sentence);
}

void note_reductions(Plan& plan) {
  const PlanRequest& request = plan.request;
  const std::uint32_t wanted = wanted_in_flight(request), asked = request.pages.in_flight.value_or(wanted);
  const std::string reduced = "in-flight reduced from " + std::to_string(asked) + " to " + std::to_string(plan.in_flight);
  if (plan.in_flight < wanted) {
    plan.notes.push_back(reduced + " to fit " + size_text(*request.computer.node_memory_bytes));
  } else if (wanted < asked) {
    const bool is_rounded = wanted == asked - asked % plan.pixels_a_task;
    plan.notes.push_back(reduced + (wanted == 1 ? " pixel" : " pixels") +
                         (is_rounded ? ": whole bundles of " + std::to_string(bundle_pixels) : ": no node ever has more"));
  }
  const std::uint32_t all_frames = plan.frames + plan.resident_count;
  if (request.pages.cache_pages && all_frames < *request.pages.cache_pages) {
    plan.notes.push_back("cache reduced from " + std::to_string(*request.pages.cache_pages) + " to " +
                         std::to_string(all_frames) + " pages: no more are not at home");
  }
  if (request.pages.work_item_side.value_or(0) > plan.work_item_side) {
    plan.notes.push_back("work items reduced from " + std::to_string(*request.pages.work_item_side) + " to " +
                         std::to_string(plan.work_item_side) + " pixels a side: where pixels are left out none is larger");
  }
}

}  // namespace

core::Sentence Strategy::advice() const {
  return core::Sentence("; no number of nodes up to ", nodes::node_count_max, " works with this memory");
}

bool goes_with(const core::Field& field, const Strategy& strategy) {
  return strategy.fetches_pages() || std::none_of(std::begin(fields_of_svm), std::end(fields_of_svm),
                                                  [&](const FieldOfSvm& of_svm) { return of_svm.field == field; });
}

std::uint32_t Plan::faults_max() const { return std::min(task_count(), request.strategy->foreign_pages_max(request)); }

PageCapacity Plan::pages() const {
  return {.page_count = request.page_count,
          .node_count = request.computer.node_count,
          .where = request.pages.homes,
          .resident_count = resident_count,
          .resident = resident,
          .cache = {frames, request.page_size_bytes, request.pages.replacement, own_policy},
          .in_flight = task_count(),
          .rays_a_task = pixels_a_task,
          .faults_max = faults_max(),
          .request_credits = request_credits,
          .leading_pages = request.strategy->leading_pages(request),
          .open_pages = request.open_page_count};
}

FilmCapacity Plan::film() const {
  return {.host = nodes::NodeId{request.computer.node_count},
          .packet_entries = film_entries,
          .credits = film_credits,
          .in_flight = in_flight,
          .planes = film_planes};
}

WorkShape Plan::work() const {
  return {.worker_count = worker_count,
          .width = request.width,
          .height = request.height,
          .tile = request.is_masked() ? tile_of(pixels_a_task) : tile_for(request.first_samples, pixels_a_task),
          .item_side = work_item_side,
          .shares = request.pages.pixel_shares,
          .dealer = request.is_assigned() ? std::optional(request.computer.node_count) : std::nullopt,
          .is_masked = request.is_masked(),
          .start = request.start};
}

nodes::Batching Plan::batching() const { return nodes::batching_of(number_of(Kind::film_sums), film_credits); }

nodes::MemoryPlan Plan::node_memory(std::uint32_t index) const {
  nodes::MemoryPlan plan = nodes::memory_beside_program(node_mailbox, request.computer.node_count + 1, held_bytes,
                                                        request.computer.stack_reserve_bytes) +
                           nodes::ImmutablePieces::layout(core::MemoryUse::constants, sizeof(core::RenderSettings)) +
                           FilmGather::layout(film()) + WorkSource::layout(work(), index) +
                           request.strategy->layout(*this, index);
  const auto waiting_max = static_cast<std::uint32_t>(request.waiting_hits_max);
  if (pixels_a_task > 1 && request.has_instances) {
    plan += Slots<core::InstanceBundleTask>::layout(task_count(), waiting_max);
  } else if (pixels_a_task > 1) {
    plan += Slots<core::BundleTask>::layout(task_count(), waiting_max);
  } else if (request.has_instances) {
    plan += Slots<core::InstancePixelTask>::layout(task_count(), waiting_max);
  } else {
    plan += Slots<core::PixelTask>::layout(task_count(), waiting_max);
  }
  return plan;
}

std::size_t Plan::node_memory_max_bytes() const {
  std::size_t most = node_memory(0).total();  // it has as many home pages, and receives as many requests, as any
  for (std::uint32_t index = 1; request.is_masked() && index < request.computer.node_count; ++index) {
    most = std::max(most, node_memory(index).total());
  }
  return most;
}

nodes::MemoryPlan Plan::host_memory() const {
  return nodes::memory_beside_program(host_mailbox, request.computer.node_count + 1, held_bytes, host_stack_bytes) +
         HostProgram::layout(*this);
}

std::size_t smallest_node_memory_bytes(const PlanRequest& request) { return bytes_with(request, frames_min(request), 1); }

Plan make_plan(const PlanRequest& request) {
  check(request);
  std::uint32_t in_flight = wanted_in_flight(request);
  std::uint32_t frames = auto_frames(request);
  if (request.computer.node_memory_bytes) {
    if (smallest_node_memory_bytes(request) > *request.computer.node_memory_bytes) {
      say_too_small(request);
    }
    in_flight = most_in_flight(request, *request.computer.node_memory_bytes);
    frames = most_frames(request, in_flight, *request.computer.node_memory_bytes);
  }
  Plan plan = plan_with(request, frames, in_flight);
  core::expect(plan.node_memory_max_bytes() <= request.computer.node_memory_bytes.value_or(plan.node_memory_max_bytes()),
               "a plan keeps within the node's memory");
  note_reductions(plan);
  return plan;
}

}  // namespace dmpc::svm
