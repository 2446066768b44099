#include "apps/lab/bench/speed/warm_pager.h"

#include <algorithm>
#include <vector>

#include "svm/packets.h"
#include "svm/pages/home.h"
#include "svm/run.h"

namespace dmpc::apps {
namespace {

core::Address start_of(svm::PageId page, std::size_t page_size_bytes) {
  return core::Address{static_cast<std::uint32_t>(svm::index_of(page) * (page_size_bytes / core::record_alignment))};
}

svm::Plan plan_for(const core::Database& database, const core::RenderSettings& settings, std::uint32_t node_count) {
  const auto page_count = static_cast<std::uint32_t>(database.page_count());
  return svm::plan_of(*svm::svm_strategy(), database, settings,
                      {.computer = {.node_count = node_count}, .pages = {.cache_pages = std::max(page_count, 1U)}});
}

}  // namespace

WarmPager::WarmPager(const core::Database& database, const core::RenderSettings& settings, std::uint32_t node_count)
    : plan_(plan_for(database, settings, node_count)),
      memory_(plan_.node_memory(0)),
      node_(nodes::NodeId{0}, node_count + 1, memory_, network_),
      pager_(node_, plan_.pages(), database.bytes()) {
  for (std::uint32_t page = 0; page < database.page_count(); ++page) {
    fetch(database, svm::PageId{page});
  }
}

void WarmPager::fetch(const core::Database& database, svm::PageId page) {
  const core::Address first = start_of(page, database.page_size());
  if (pager_.find(first) != nullptr) {
    return;
  }
  pager_.park(0, first);
  const svm::PageReplyHeader header{page};
  const std::span<const std::byte> first_bytes = std::as_bytes(std::span(&header, 1));
  const std::span<const std::byte> bytes = database.page(svm::index_of(page));
  std::vector<std::byte> payload(first_bytes.begin(), first_bytes.end());
  payload.insert(payload.end(), bytes.begin(), bytes.end());
  const nodes::NodeId home{svm::Homes(plan_.request.computer.node_count).place_of(page).node};
  pager_.install({home, svm::number_of(svm::Kind::page_reply), payload});
}

}  // namespace dmpc::apps
