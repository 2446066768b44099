#include "svm/pages/task_plan.h"

#include <algorithm>

#include "core/base/refusal.h"
#include "core/base/units.h"
#include "core/picture/memory_use.h"
#include "nodes/node.h"
#include "nodes/runner.h"
#include "nodes/size_text.h"
#include "nodes/threads/delayed_packets.h"
#include "svm/pages/packets.h"
#include "svm/pages/page.h"
#include "svm/pages/pager.h"

namespace dmpc::svm {
namespace {

using nodes::Category;

constexpr std::uint32_t task_cache_pages_min = 64;
/// More requests to one home than this wait no less: it serves them one after another.
constexpr std::uint32_t task_requests_max = 4;

/// `name`: a word or a core::Field.
template <class Name>
void check_range(const Name& name, std::uint64_t value, std::uint64_t least, std::uint64_t most) {
  core::check_use(value >= least && value <= most, name, "=", value, ": expected ", least, " to ", most);
}

}  // namespace

TaskPlan::TaskPlan(const TaskOptions& options, std::size_t database_bytes, std::uint32_t task_count, const Sizes& sizes)
    : options_(options), task_count_(task_count), sizes_(sizes) {
  check();
  core::check_use(database_bytes > 0 && database_bytes % options.page_size_bytes == 0, database_bytes,
                  " bytes: expected whole pages of ", options.page_size_bytes, ", and one at least");
  const std::size_t page_count = database_bytes / options.page_size_bytes;
  check_range("page_count", page_count, 1, index_of(no_page) - 1);
  const auto pages = static_cast<std::uint32_t>(page_count);
  const std::uint32_t foreign_pages = node_count() == 1 ? 0 : pages - pages / node_count();
  std::uint32_t most_tasks = 1;  // a node without tasks has space for one
  for (std::uint32_t node = 0; node < node_count(); ++node) {
    most_tasks = std::max(most_tasks, tasks_at(node));
  }
  in_flight_ = std::min(options.in_flight, most_tasks);
  // A fault has at least one task that waits for it, and a page at most one fault.
  const std::uint32_t faults_max = std::min(in_flight_, foreign_pages);
  const std::uint32_t credits = std::min({faults_max, core::ceil_divide(pages, node_count()), task_requests_max});
  pages_ = {
      .page_count = pages,
      .node_count = node_count(),
      .cache = {.frame_count = std::min(options.cache_pages.value_or(std::max(pages / 4, task_cache_pages_min)), foreign_pages),
                .page_size_bytes = options.page_size_bytes,
                .replacement = options.replacement},
      .in_flight = in_flight_,
      .faults_max = faults_max,
      .request_credits = credits};
  mailbox_ = {.small_slots = (node_count() - 1) * credits,  // page requests: each other node's credits
              .bulk_slots = faults_max,                     // page replies: one for each fault
              .bulk_payload_bytes = page_reply_bytes(options.page_size_bytes)};
  if (options.computer.chaos) {
    pages_.request_credits = nodes::shrunk_credits(*options.computer.chaos, credits, request_channel);
    held_bytes_ = nodes::DelayedPackets::room_bytes(mailbox_.bulk_payload_bytes);
  }
  check_memory();
}

void TaskPlan::check() const {
  check_range(core::field_of<&nodes::ComputerRequest::node_count>(), node_count(), 1, nodes::node_count_max);
  check_range("task_count", task_count_, 1, 0xffffffffU);
  check_range(core::field_of<&TaskOptions::in_flight>(), options_.in_flight, 1, in_flight_max);
  check_range(core::field_of<&TaskOptions::cache_pages>(), options_.cache_pages.value_or(1), 1, index_of(no_page));
  core::check_use(is_page_size(options_.page_size_bytes), core::field_of<&TaskOptions::page_size_bytes>(), "=",
                  options_.page_size_bytes, ": a page is a power of two from 512B to 64KiB");
  nodes::check_ranks(options_.computer);
}

nodes::Layout<std::byte, std::uint32_t, std::uint32_t, std::uint32_t, std::byte> TaskPlan::program_layout(
    std::uint32_t node) const {
  return {{core::MemoryUse::ray_stacks, in_flight_ * sizes_.task_bytes},
          {Category::queues, in_flight_},
          {Category::queues, in_flight_},
          {Category::queues, in_flight_},
          {core::MemoryUse::film_tiles, tasks_at(node) * sizes_.result_bytes}};
}

nodes::MemoryPlan TaskPlan::node_memory(std::uint32_t node) const {
  return memory_beside_program(mailbox_) + Pager::layout(pages_, node) + program_layout(node);
}

nodes::MemoryPlan TaskPlan::host_memory() const { return memory_beside_program({}); }

nodes::MemoryPlan TaskPlan::memory_beside_program(const nodes::MailboxCapacity& mailbox) const {
  return nodes::memory_beside_program(mailbox, node_count() + 1, held_bytes_, options_.computer.stack_reserve_bytes);
}

void TaskPlan::check_memory() const {
  std::size_t most = 0;
  for (std::uint32_t node = 0; node < node_count(); ++node) {
    most = std::max(most, node_memory(node).total());
  }
  if (options_.computer.node_memory_bytes.value_or(most) < most) {
    throw core::Refusal<core::CapacityError>(core::Sentence(
        core::field_of<&nodes::ComputerRequest::node_memory_bytes>(), "=", nodes::size_text(*options_.computer.node_memory_bytes),
        ": a node takes ", nodes::size_text(most), "; fewer cache_pages, fewer tasks in_flight or more nodes take less"));
  }
}

}  // namespace dmpc::svm
