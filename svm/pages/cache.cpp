#include "svm/pages/cache.h"

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "svm/pages/pages_in_place.h"

namespace dmpc::svm {
namespace {

std::size_t frame_bytes(const CacheShape& shape) {
  return shape.frame_count == 0 ? 0 : shape.frame_count * shape.page_size_bytes + core::overread_bytes;
}

/// The cache's memory besides frames, table and policy.
nodes::Layout<std::uint64_t, PageId> own_layout(const CacheShape& shape) {
  return {{core::MemoryUse::page_table, shape.frame_count}, {core::MemoryUse::page_table, shape.frame_count}};
}

}  // namespace

nodes::MemoryPlan Cache::layout(const CacheShape& shape) {
  return nodes::ImmutablePieces::layout(core::MemoryUse::cache_frames, frame_bytes(shape)) +
         PageTable::layout(shape.frame_count) + own_layout(shape) + kind_of(shape.replacement).layout(shape.frame_count);
}

Cache::Cache(nodes::LocalMemory& memory, const CacheShape& shape, std::uint32_t seed)
    : hears_hits_(shape.own != nullptr || kind_of(shape.replacement).hears_hits),
      frames_(memory, core::MemoryUse::cache_frames, frame_bytes(shape), shape.page_size_bytes),
      table_(memory, shape.frame_count) {
  std::tie(stamps_, pages_) = own_layout(shape).in(memory);
  const PolicySite site{memory, stamps_, pages_, seed};
  policy_ = kind_of(shape.replacement).make(site);
  if (shape.own != nullptr && shape.frame_count > 0) {
    policy_ = shape.own->make(site);
  }
}

PageId Cache::install(PageId page, std::span<const std::byte> bytes) {
  return install_by(page, table_, [&](std::uint32_t frame) { frames_.put(frame, bytes); });
}

PageId Cache::install(PageId page, std::span<const std::byte> bytes, PagesInPlace& places) {
  return install_by(page, places, [&](std::uint32_t frame) { frames_.put(frame, bytes); });
}

PageId Cache::install(PageId page, const nodes::ByteSource& source, std::size_t offset_bytes) {
  return install_by(page, table_, [&](std::uint32_t frame) { frames_.put(frame, source, offset_bytes); });
}

template <class Places, class Put>
PageId Cache::install_by(PageId page, Places& places, const Put& put) {
  core::expect(!stamps_.empty(), "a page is installed only where there is a frame");
  core::expect(places.find(page) == no_frame, "a page is in at most one frame");
  const bool is_full = filled_count_ == frame_count();
  const std::uint32_t frame = is_full ? policy_->victim(page) : filled_count_++;
  if (frame == bypass) {
    return page;
  }
  core::expect(frame < frame_count(), "a page leaves a frame that there is");
  const PageId evicted = is_full ? pages_[frame] : no_page;
  if (is_full) {
    places.erase(evicted);
  }
  put(frame);
  pages_[frame] = page;
  stamps_[frame] = ++clock_;
  places.insert(page, frame);
  policy_->insert(page, frame);
  last_frame_ = frame;
  return evicted;
}

void Cache::report_of_hit(std::uint32_t frame) {
  if (frame != last_frame_) {
    last_frame_ = frame;
    policy_->hit(pages_[frame], frame);
  }
}

}  // namespace dmpc::svm
