#include "svm/pager.h"

#include <cstring>

#include "core/base/expect.h"
#include "svm/packets.h"

namespace dmpc::svm {
namespace {

using nodes::Category;
using nodes::LocalMemory;

}  // namespace

void Pager::add_needs(nodes::MemoryPlan& memory, const PageCapacity& capacity, std::uint32_t index) {
  HomePages::add_needs(memory, capacity, index);
  PageServer::add_needs(memory, capacity, index);
  memory[Category::page_table] += LocalMemory::bytes_for<Translation>(translation_count);
  Cache::add_needs(memory, capacity.cache);
  Faults::add_needs(memory, capacity.in_flight, capacity.faults_max);
}

Pager::Pager(nodes::Node& node, const PageCapacity& capacity, std::span<const std::byte> database)
    : geometry_(capacity.page_size_bytes()),
      translations_(node.memory().allocate<Translation>(Category::page_table, translation_count)),
      homes_(node, capacity, database),
      cache_(node.memory(), capacity.cache, nodes::index_of(node.id())),
      faults_(node.memory(), capacity.in_flight, capacity.faults_max),
      server_(node, capacity),
      node_(&node) {
  grant_requests(node, capacity);
}

const std::byte* Pager::find_other(PageId page, std::size_t offset) {
  Translation& translation = translation_of(page);
  if (translation.page != page && !translate(page, translation)) {
    ++counters_.misses;
    return nullptr;
  }
  const bool at_home = translation.frame == Cache::no_frame;
  if (!at_home) {
    cache_.touch(translation.frame);
  }
  last_hits_ = at_home ? &counters_.home_hits : &counters_.cache_hits;
  ++*last_hits_;
  last_page_ = page;
  last_bytes_ = translation.bytes;
  return last_bytes_ + offset;
}

/// Returns whether the page is here; if not, `translation` stays as it was.
bool Pager::translate(PageId page, Translation& translation) const {
  if (const std::byte* const at_home = homes_.find(page)) {
    translation = {page, Cache::no_frame, at_home};
    return true;
  }
  const std::uint32_t frame = cache_.frame_of(page);
  if (frame == Cache::no_frame) {
    return false;
  }
  translation = {page, frame, cache_.bytes_of(frame)};
  return true;
}

void Pager::park(std::uint32_t slot, core::Address address) {
  const PageId page = geometry_.page_of(address);
  if (Faults::Fault* fault = faults_.park(slot, page, homes_.home_of(page))) {
    ++counters_.faults;
    request(*fault);
  }
}

/// Refused for want of credit, the fault stays in the list and is requested when a reply from its home brings the credit back.
void Pager::request(Faults::Fault& fault) {
  fault.requested =
      node_->try_send(nodes::NodeId{fault.home}, request_channel, number_of(Kind::page_request), PageRequest{fault.page});
}

std::uint32_t Pager::install(const nodes::Packet& reply) {
  core::expect(reply.payload_bytes() == sizeof(PageReplyHeader) + geometry_.size_bytes(), "a page reply carries one page");
  PageReplyHeader header;
  std::memcpy(&header, reply.payload.data(), sizeof(header));
  core::expect(homes_.home_of(header.page) == nodes::index_of(reply.source), "a page comes from its home");
  node_->grant(reply.source, request_channel);
  const std::uint32_t first = faults_.arrived(header.page);
  if (Faults::Fault* refused = faults_.oldest_refused(nodes::index_of(reply.source))) {
    request(*refused);
  }
  forget(cache_.install(header.page, reply.behind(sizeof(header))));
  return first;
}

void Pager::forget(PageId evicted) {
  last_page_ = no_page;
  if (evicted == no_page) {
    return;
  }
  ++counters_.evictions;
  if (translation_of(evicted).page == evicted) {
    translation_of(evicted) = {};
  }
}

PageCounters Pager::counters() const {
  PageCounters counters = counters_;
  counters.served = server_.served();
  counters.cache_hits -= retries_;
  counters.references = counters.home_hits + counters.cache_hits + counters.misses;
  return counters;
}

}  // namespace dmpc::svm
