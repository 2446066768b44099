// What a look-up of a record costs that finds its page: at home, in the cache by way of the pager's translation table, and in the
// cache past that table, beside plain loads from an array.
//
// Each look-up needs what the last one found: a record says where the next one is, and all together make one round, as a
// traversal goes from record to record.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "svm/packets.h"
#include "svm/pages/pager.h"
#include "tests/bench/groups.h"
#include "tests/support/small_machine.h"

namespace dmpc::bench {
namespace {

constexpr std::size_t page_size_bytes = 1024;
constexpr std::uint32_t record_bytes = 64;
constexpr std::uint32_t records_a_page = page_size_bytes / record_bytes;
/// Larger databases would measure how long it takes to make them.
constexpr std::uint32_t page_count_max = 16384;

/// In which order the round passes the records: any, or page by page.
enum class Order { scattered, page_by_page };

/// Pages that a round passes: `stride` apart, all at home on node 0 or none.
struct PageSet {
  std::uint32_t node_count = 1;
  std::uint32_t stride = 1;
  std::uint32_t count = 0;
  bool at_home = true;

  /// Passes over those that are on the wrong side. Requires a stride of 1 or one that shares a factor with node_count, and of
  /// node_count if they are at home.
  std::uint32_t page(std::uint32_t i) const {
    return at_home ? i * stride : 1 + i * stride + (stride == 1 ? i / (node_count - 1) : 0);
  }
  std::uint32_t page_count() const { return page(count - 1) + 1; }
  core::Address address_of(std::uint32_t record) const {
    const std::uint64_t offset = record % records_a_page * record_bytes;
    return core::advance(core::Address{0}, page(record / records_a_page) * page_size_bytes + offset);
  }
};

/// A database whose records, in the pages of the set, make one round.
class Round {
 public:
  Round(const PageSet& set, Order order)
      : bytes_(set.page_count() * page_size_bytes + core::overread_bytes), record_count_(set.count * records_a_page) {
    std::vector<std::uint32_t> records(record_count_);
    std::iota(records.begin(), records.end(), 0U);
    std::minstd_rand random(1);
    const std::uint32_t run = order == Order::scattered ? record_count_ : records_a_page;
    for (auto first = records.begin(); first != records.end(); first += run) {
      std::shuffle(first, first + run, random);
    }
    start_ = set.address_of(records.front());
    for (std::size_t i = 0; i < records.size(); ++i) {
      const core::Address next = set.address_of(records[(i + 1) % records.size()]);
      std::memcpy(bytes_.data() + core::byte_offset(set.address_of(records[i])), &next, sizeof(next));
    }
  }

  std::span<const std::byte> database() const { return std::span(bytes_).first(bytes_.size() - core::overread_bytes); }
  std::span<const std::byte> page(std::uint32_t page) const {
    return database().subspan(page * page_size_bytes, page_size_bytes);
  }
  core::Address start() const { return start_; }
  std::uint32_t record_count() const { return record_count_; }

 private:
  std::vector<std::byte> bytes_;
  std::uint32_t record_count_;
  core::Address start_{};
};

/// The pager of node 0, with all pages of the set.
class FilledPager {
 public:
  FilledPager(const PageSet& set, const Round& round)
      : plan_(svm::make_plan(request_for(set))), lone_(plan_, 0), pager_(lone_.node, plan_.pages(), round.database()) {
    for (std::uint32_t i = 0; !set.at_home && i < set.count; ++i) {
      install(set.page(i), round);
    }
  }

  const std::byte* find(core::Address address) { return pager_.find(address); }
  svm::PageCounters counters() const { return pager_.counters(); }

 private:
  static svm::PlanRequest request_for(const PageSet& set) {
    svm::PlanRequest request{.page_count = set.page_count(),
                             .page_size_bytes = page_size_bytes,
                             .computer = {.node_count = set.node_count},
                             .pages = {.in_flight = 1},
                             .width = 1,
                             .height = 1};
    if (!set.at_home) {
      request.pages.cache_pages = set.count;
    }
    return request;
  }
  void install(std::uint32_t page, const Round& round) {
    pager_.park(0, core::advance(core::Address{0}, std::uint64_t{page} * page_size_bytes));
    lone_.post.parcels.clear();
    tests::Parcel reply = tests::parcel_of(page % plan_.request.computer.node_count, svm::Kind::page_reply,
                                           svm::PageReplyHeader{svm::PageId{page}});
    reply.payload.insert(reply.payload.end(), round.page(page).begin(), round.page(page).end());
    static_cast<void>(pager_.install(reply.packet()));
  }

  svm::Plan plan_;
  tests::LoneNode lone_;
  svm::Pager pager_;
};

/// Goes round until the benchmark has enough of it.
template <core::Records Records>
void go_round(benchmark::State& state, Records& records, const Round& round) {
  core::Address at = round.start();
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < round.record_count(); ++i) {
      std::memcpy(&at, records.find(at), sizeof(at));
    }
    core::expect(at == round.start(), "a round comes back to where it began");
  }
  state.SetItemsProcessed(state.iterations() * round.record_count());
}

void plain_loads(benchmark::State& state, const PageSet& set, Order order) {
  const Round round(set, order);
  core::LocalRecords records(round.database());
  go_round(state, records, round);
}

void look_ups(benchmark::State& state, const PageSet& set, Order order) {
  const Round round(set, order);
  FilledPager pager(set, round);
  go_round(state, pager, round);
  const svm::PageCounters counters = pager.counters();
  const auto references = static_cast<std::uint64_t>(state.iterations()) * round.record_count();
  core::expect((set.at_home ? counters.home_hits : counters.cache_hits) == references && counters.misses == 0,
               "every look-up found its page where this row says");
}

void add_group(std::uint32_t count, Order order) {
  const std::string group = "a record of " + std::to_string(count) + " pages of 1 KiB, " +
                            (order == Order::scattered ? "in any order" : "page by page");
  add_row(group, "plain array", [=](auto& state) { plain_loads(state, {.count = count}, order); });
  const auto add = [&](const std::string& subject, const PageSet& set) {
    add_row(group, subject, [=](auto& state) { look_ups(state, set, order); });
  };
  add("at home, one node", {.count = count});
  const std::uint32_t nodes = std::min(64U, page_count_max / count);
  add("at home, one of " + std::to_string(nodes) + " nodes", {.node_count = nodes, .stride = nodes, .count = count});
  add("cached", {.node_count = 64, .count = count, .at_home = false});
  // So far apart that they share few places of the translation table.
  const std::uint32_t far = std::min(256U, page_count_max / count);
  add("cached, past the table", {.node_count = 64, .stride = far, .count = count, .at_home = false});
}

}  // namespace

void add_pager_rows() {
  for (const std::uint32_t count : {16U, 256U, 4096U}) {
    for (const Order order : {Order::scattered, Order::page_by_page}) {
      add_group(count, order);
    }
  }
}

}  // namespace dmpc::bench
