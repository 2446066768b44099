#include "svm/pages/pager.h"

#include "core/base/expect.h"
#include "svm/pages/packets.h"

namespace dmpc::svm {

nodes::MemoryPlan Pager::layout(const PageCapacity& capacity, std::uint32_t index) {
  return own_layout() + HomePages::layout(capacity, index) + Cache::layout(capacity.resident_shape()) +
         Cache::layout(capacity.cache) + Faults::layout(capacity.in_flight, capacity.faults_max) +
         PageServer::layout(capacity, index);
}

Pager::Pager(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
    : geometry_(capacity.page_size_bytes()),
      in_place_(PagesInPlace::of(node.memory(), capacity, database)),
      translations_(own_layout().in(node.memory())),
      homes_(node, capacity, database),
      resident_(node.memory(), capacity.resident_shape(), 0),
      cache_(node.memory(), capacity.cache, nodes::index_of(node.id())),
      faults_(node.memory(), capacity.in_flight, capacity.faults_max),
      server_(node, capacity),
      tree_(capacity.tree()),
      node_(&node) {
  core::expect(capacity.resident.size() == capacity.resident_count, "it is known which pages are resident");
  for (const PageId page : capacity.resident) {
    resident_.install(page, database, index_of(page) * capacity.page_size_bytes());
  }
  for (std::uint32_t page = 0; in_place_ && page < capacity.page_count; ++page) {
    if (keeps(PageId{page})) {
      in_place_->put(PageId{page}, PagesInPlace::for_good);
    }
  }
  grant_requests(node, capacity);
}

const std::byte* Pager::find_other(PageId page, std::size_t offset) {
  if (in_place_) {
    const std::uint32_t frame = in_place_->frame_of(page);
    if (frame == PagesInPlace::absent) {
      ++counters_.misses;
      return nullptr;
    }
    return refer(page, frame == PagesInPlace::for_good ? Cache::no_frame : frame, in_place_->bytes_of(page)) + offset;
  }
  Translation& translation = translation_of(page);
  if (translation.page != page && !translate(page, translation)) {
    ++counters_.misses;
    return nullptr;
  }
  return refer(page, translation.frame, translation.bytes) + offset;
}

/// Counts a reference to a local page, and returns its address.
const std::byte* Pager::refer(PageId page, std::uint32_t frame, const std::byte* bytes) {
  const bool is_kept = frame == Cache::no_frame;
  if (frame < cache_.frame_count()) {
    cache_.touch(frame);
  }
  last_hits_ = is_kept ? &counters_.home_hits : &counters_.cache_hits;
  ++*last_hits_;
  last_page_ = page;
  return last_bytes_ = bytes;
}

/// Returns whether the page is local; if not, `translation` is unchanged.
bool Pager::translate(PageId page, Translation& translation) const {
  if (in_place_) {
    const std::uint32_t frame = in_place_->frame_of(page);
    if (frame == PagesInPlace::absent) {
      return false;
    }
    translation = {page, frame == PagesInPlace::for_good ? Cache::no_frame : frame, in_place_->bytes_of(page)};
    return true;
  }
  if (const std::byte* const at_home = homes_.find(page)) {
    translation = {page, Cache::no_frame, at_home};
    return true;
  }
  if (const std::uint32_t kept = resident_.frame_of(page); kept != Cache::no_frame) {
    translation = {page, Cache::no_frame, resident_.bytes_of(kept)};
    return true;
  }
  if (page == passing_page_) {
    translation = {page, passing, passing_bytes_};
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
  if (Faults::Fault* fault = faults_.park(slot, page, asked_for(page))) {
    ++counters_.faults;
    request(*fault);
  }
}

/// Its home, or the parent in the tree.
std::uint32_t Pager::asked_for(PageId page) const {
  return tree_ ? tree_->parent_of(nodes::index_of(node_->id())) : homes_.home_of(page);
}

/// The page for another node, or nullptr. A page that others use is kept as if used here.
const std::byte* Pager::served_bytes(PageId page) {
  Translation found;
  if (!translate(page, found)) {
    return nullptr;
  }
  if (found.frame != Cache::no_frame) {
    cache_.touch(found.frame);
  }
  return found.bytes;
}

void Pager::serve(const nodes::Packet& packet) {
  const PassedRequest request = request_in(packet);
  if (const std::byte* const bytes = tree_ ? served_bytes(request.page) : homes_.find(request.page)) {
    return server_.reply(request, bytes);
  }
  core::expect(tree_.has_value(), "a request reaches its page's home");
  const nodes::NodeId parent{asked_for(request.page)};
  node_->grant(parent, request_channel);  // the slot that the requester's request has reserved all the way up
  node_->send_reserved(parent, request_channel, number_of(Kind::passed_request), request);
}

/// Without credit the fault stays in the list, and is requested when a reply of its home or parent brings the credit back.
void Pager::request(Faults::Fault& fault) {
  fault.requested =
      node_->try_send(nodes::NodeId{fault.home}, request_channel, number_of(Kind::page_request), PageRequest{fault.page});
}

std::uint32_t Pager::install(const nodes::Packet& reply) {
  core::expect(reply.payload_bytes() == page_reply_bytes(geometry_.size_bytes()), "a page reply carries one page");
  let_go();
  const auto header = reply.front<PageReplyHeader>();
  const std::uint32_t source = nodes::index_of(reply.source), asked = asked_for(header.page);
  core::expect(tree_ ? tree_->is_above(source, nodes::index_of(node_->id())) : source == asked,
               "a page comes from its home, or from above in the tree");
  node_->grant(nodes::NodeId{asked}, request_channel);
  const std::uint32_t first = faults_.arrived(header.page);
  if (Faults::Fault* refused = faults_.oldest_refused(asked)) {
    request(*refused);
  }
  const std::span<const std::byte> bytes = reply.behind(sizeof(header));
  const PageId out = in_place_ ? cache_.install(header.page, bytes, *in_place_) : cache_.install(header.page, bytes);
  if (out == header.page) {
    hold(out, bytes.data());
  } else {
    forget_page(out);
  }
  return first;
}

/// A page that bypasses the cache is used from its packet.
void Pager::hold(PageId page, const std::byte* bytes) {
  last_page_ = no_page;
  passing_page_ = page;
  passing_bytes_ = bytes;
  if (in_place_) {
    in_place_->put(page, PagesInPlace::passing);
  }
}

void Pager::let_go() {
  if (passing_page_ == no_page) {
    return;
  }
  last_page_ = no_page;
  if (in_place_) {
    in_place_->erase(passing_page_);
  } else if (translation_of(passing_page_).page == passing_page_) {
    translation_of(passing_page_) = {};
  }
  passing_page_ = no_page;
}

void Pager::forget_page(PageId evicted) {
  last_page_ = no_page;
  if (evicted == no_page) {
    return;
  }
  ++counters_.evictions;
  if (!in_place_ && translation_of(evicted).page == evicted) {
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

void Pager::add_charges(nodes::Charges& charges) const {
  const PageCounters pages = counters();
  charges[core::Charge::home_lookup] += pages.home_hits;
  charges[core::Charge::cached_lookup] += pages.references - pages.home_hits;
  charges[core::Charge::page_install] += pages.faults - faults();
}

}  // namespace dmpc::svm
