#include "svm/pages/home_pages.h"

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "svm/pages/packets.h"

namespace dmpc::svm {
namespace {

std::size_t room_bytes(const PageCapacity& capacity, std::uint32_t index) {
  return capacity.pages_at(index) * capacity.page_size_bytes() + core::overread_bytes;
}

}  // namespace

HomePages::HomePages(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
    : homes_(capacity.homes()),
      self_(nodes::index_of(node.id())),
      first_page_(capacity.leading_pages),
      count_(capacity.pages_at(self_)),
      pages_(node.memory(), core::MemoryUse::home_pages, room_bytes(capacity, self_), capacity.page_size_bytes()) {
  core::expect(database.size_bytes() == capacity.database_bytes(), "the plan is the database's");
  pages_.begin_filling();
  std::size_t slot = 0;
  for_each_page(capacity, self_, [&](std::size_t offset_bytes) { pages_.put(slot++, database, offset_bytes); });
}

nodes::MemoryPlan HomePages::layout(const PageCapacity& capacity, std::uint32_t index) {
  return nodes::ImmutablePieces::layout(core::MemoryUse::home_pages, room_bytes(capacity, index));
}

void grant_requests(nodes::Node& node, const PageCapacity& capacity) {
  if (const auto tree = capacity.tree()) {
    return node.grant(nodes::NodeId{tree->parent_of(nodes::index_of(node.id()))}, request_channel, capacity.request_credits);
  }
  const Homes homes = capacity.homes();
  for (std::uint32_t other = homes.first(); other < homes.end(); ++other) {
    if (other != nodes::index_of(node.id())) {
      node.grant(nodes::NodeId{other}, request_channel, capacity.request_credits);
    }
  }
}

}  // namespace dmpc::svm
