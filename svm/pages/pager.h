// Turns page misses into faults and requests, replies into installed pages, and serves other nodes' requests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "core/trace/charge.h"
#include "nodes/node.h"
#include "nodes/program.h"
#include "svm/pages/cache.h"
#include "svm/pages/faults.h"
#include "svm/pages/home_pages.h"
#include "svm/pages/node_program.h"
#include "svm/pages/packets.h"
#include "svm/pages/page.h"
#include "svm/pages/page_capacity.h"
#include "svm/pages/page_server.h"
#include "svm/pages/pages_in_place.h"
#include "svm/pages/plain_records.h"
#include "svm/pages/request_tree.h"

namespace dmpc::svm {

/// A node's part of the shared virtual memory: its home pages, those resident at every node, its cache, its faults. A
/// core::Records whose find() returns nullptr for any other page. The victim of a page is chosen when the page arrives. Not
/// thread-safe.
class Pager : public PlainRecords {
 public:
  /// Puts the node's home pages, from `database`, into its local memory (nodes::ImmutablePieces) and takes the credits for its
  /// requests.
  Pager(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database);
  /// The memory that the constructor takes at node `index`.
  static nodes::MemoryPlan layout(const PageCapacity& capacity, std::uint32_t index);

  /// One reference. The pointer is valid until the next call of install(). Repeated references of one page, the usual case,
  /// do not change the order of use, so they cost a comparison.
  const std::byte* find(core::Address address) {
    const PageId page = geometry_.page_of(address);
    const std::size_t offset = geometry_.offset_of(address);
    if (page == last_page_) [[likely]] {
      ++*last_hits_;
      return last_bytes_ + offset;
    }
    return find_other(page, offset);
  }

  /// Takes a packet about pages: replies to a request, or installs a page and continues all slots that wait for it, before the
  /// next packet can evict it: waiting.go_on(slot) runs a slot until it can do no more for now. Returns false for any other
  /// packet.
  template <class Waiting>
  bool receive(const nodes::Packet& packet, Waiting& waiting) {
    switch (Kind{packet.kind}) {
      case Kind::page_request:
      case Kind::passed_request:
        serve(packet);
        return true;
      case Kind::page_reply:
        for (std::uint32_t slot = install(packet); slot != no_slot;) {
          const std::uint32_t next = next_waiting(slot);
          retried();
          waiting.go_on(slot);
          slot = next;
        }
        let_go();
        return true;
      default:
        return false;
    }
  }
  /// To be called when find() has reported a page absent that the task in `slot` needs.
  template <class Waiting>
  void lacks(std::uint32_t slot, Waiting& waiting) {
    park(slot, waiting.task(slot).absent());
  }
  /// Lets `slot` wait for the page of `address`, which find() has just reported absent. Requests the page if no slot has done so.
  void park(std::uint32_t slot, core::Address address);
  /// Takes a page reply: installs the page and returns the first slot that waited for it. The caller calls retried() before
  /// running each of those slots, and runs them all before the next install(). A page that bypasses the cache is there until
  /// then, in receive() until they have run.
  std::uint32_t install(const nodes::Packet& reply);
  /// The slot that waits for the same page after `slot`, or no_slot. Read it before the slot runs.
  std::uint32_t next_waiting(std::uint32_t slot) const { return faults_.next(slot); }
  /// To be called when the next reference repeats one that was counted as a page miss.
  void retried() { ++retries_; }
  /// Takes a page request and replies at once; in a tree, if the page is not here, passes the request on to the parent. Installs
  /// nothing, so it may interrupt a computing node.
  void serve(const nodes::Packet& request);
  /// Whether the page is stored here permanently, at home or resident.
  bool keeps(PageId page) const { return homes_.find(page) != nullptr || resident_.frame_of(page) != Cache::no_frame; }

  /// Number of faults that have not ended.
  std::uint32_t faults() const { return faults_.count(); }
  /// Number of pages in the cache.
  std::uint32_t cached_pages() const { return cache_.filled_count(); }
  std::uint32_t pending() const { return faults(); }
  PageCounters counters() const;
  void add_charges(nodes::Charges& charges) const;
  nodes::Levels levels() const { return {{"pages in cache", cached_pages()}, {"pages awaited", faults()}}; }

 private:
  /// The place where a page was found last: tested before the arithmetic and the cache's table, small enough to stay in the
  /// processor's own cache.
  struct Translation {
    PageId page = no_page;
    std::uint32_t frame = Cache::no_frame;  ///< no_frame: the page is stored here permanently; or passing
    const std::byte* bytes = nullptr;
  };
  static constexpr std::size_t translation_count = 256;
  static constexpr std::uint32_t passing = Cache::no_frame - 1;
  static nodes::Room<Translation> own_layout() { return {core::MemoryUse::page_table, translation_count}; }

  Translation& translation_of(PageId page) { return translations_[index_of(page) % translation_count]; }
  bool translate(PageId page, Translation& translation) const;
  const std::byte* find_other(PageId page, std::size_t offset);
  const std::byte* refer(PageId page, std::uint32_t frame, const std::byte* bytes);
  void hold(PageId page, const std::byte* bytes);
  void let_go();
  std::uint32_t asked_for(PageId page) const;
  const std::byte* served_bytes(PageId page);
  void request(Faults::Fault& fault);
  void forget_page(PageId evicted);

  // Members read by a reference come first.
  PageGeometry geometry_;
  PageId last_page_ = no_page;
  const std::byte* last_bytes_ = nullptr;
  std::uint64_t* last_hits_ = nullptr;
  std::optional<PagesInPlace> in_place_;  ///< if pages are referred to: instead of translations
  std::span<Translation> translations_;
  HomePages homes_;
  Cache resident_;  ///< for pages that never leave it
  PageCounters counters_;
  std::uint64_t retries_ = 0;
  PageId passing_page_ = no_page;  ///< has bypassed the cache, and serves the slots that waited for it
  const std::byte* passing_bytes_ = nullptr;
  Cache cache_;
  Faults faults_;
  PageServer server_;
  std::optional<RequestTree> tree_;
  nodes::Node* node_;
};
static_assert(core::Records<Pager>);

}  // namespace dmpc::svm
