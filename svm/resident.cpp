#include "svm/resident.h"

#include <algorithm>

#include "core/picture/camera/subsample.h"
#include "core/picture/render.h"
#include "core/record/records.h"

namespace dmpc::svm {
namespace {

constexpr int profile_subsample = 8;

/// The whole database, with a count of look-ups for each page.
class CountedRecords {
 public:
  explicit CountedRecords(const core::Database& database)
      : records_(database.bytes()), geometry_(database.page_size()), counts_(database.page_count()) {}

  const std::byte* find(core::Address address) {
    ++counts_[index_of(geometry_.page_of(address))];
    return records_.find(address);
  }
  const std::vector<std::uint64_t>& counts() const { return counts_; }

 private:
  core::LocalRecords records_;
  PageGeometry geometry_;
  std::vector<std::uint64_t> counts_;
};
static_assert(core::Records<CountedRecords>);

std::vector<std::uint64_t> references_of_small_picture(const core::Database& database, const core::RenderSettings& settings,
                                                       const std::stop_token& stop) {
  CountedRecords records(database);
  core::GridTracer<CountedRecords> tracer(records, settings.header, settings.skips);
  core::Operations operations;
  std::vector<core::HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  const std::vector<std::uint32_t> pixels =
      core::subsampled_pixels(settings.camera.width(), settings.camera.height(), profile_subsample);
  core::with_pixel_task(settings.header, stack, [&](auto& task) {
    for (std::size_t index = 0; index < pixels.size() && !stop.stop_requested(); ++index) {
      core::render_pixel(task, pixels[index], {0, 1}, tracer, settings, operations);
    }
  });
  return records.counts();
}

}  // namespace

std::vector<PageId> most_used_pages(const core::Database& database, const core::RenderSettings& settings, std::uint32_t count,
                                    const std::stop_token& stop) {
  if (count == 0) {
    return {};
  }
  const std::vector<std::uint64_t> references = references_of_small_picture(database, settings, stop);
  std::vector<PageId> pages(references.size());
  std::generate(pages.begin(), pages.end(), [next = std::uint32_t{0}]() mutable { return PageId{next++}; });
  std::stable_sort(pages.begin(), pages.end(),
                   [&](PageId a, PageId b) { return references[index_of(a)] > references[index_of(b)]; });
  pages.resize(std::min<std::size_t>(count, pages.size()));
  return pages;
}

}  // namespace dmpc::svm
