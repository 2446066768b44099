// The whole database in a node's local memory, for strategy replicated, in place of a pager.
#pragma once

#include <cstddef>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "nodes/immutable_pieces.h"
#include "nodes/node.h"
#include "svm/pages/node_program.h"
#include "svm/pages/page_capacity.h"
#include "svm/pages/plain_records.h"

namespace dmpc::svm {

/// A core::Records that is never absent; where nodes refer to the database the copy is counted, but is that one. Thread safety:
/// belongs to one node.
class LocalCopy : public PlainRecords {
 public:
  /// Puts `database` into the node's local memory.
  LocalCopy(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
      : bytes_(nodes::kept(node.memory(), core::MemoryUse::home_pages, database, database.size_bytes(), core::overread_bytes)) {
    core::expect(database.size_bytes() == capacity.database_bytes(), "the plan is the database's");
  }
  /// The memory that the constructor takes.
  static nodes::MemoryPlan layout(std::size_t database_bytes) {
    return nodes::ImmutablePieces::layout(core::MemoryUse::home_pages, database_bytes + core::overread_bytes);
  }

  const std::byte* find(core::Address address) const { return bytes_.data() + core::byte_offset(address); }
  /// The copy, without the readable bytes behind it.
  std::span<const std::byte> bytes() const { return bytes_; }
  /// There are no packets about records, as all nodes have them.
  template <class Waiting>
  bool receive(const nodes::Packet& /*packet*/, Waiting& /*waiting*/) {
    return false;
  }
  template <class Waiting>
  void lacks(std::uint32_t /*slot*/, Waiting& /*waiting*/) {
    core::expect(false, "a whole copy of the database lacks no record");
  }
  /// All 0: there are no pages.
  PageCounters counters() const { return {}; }

 private:
  std::span<const std::byte> bytes_;
};
static_assert(core::Records<LocalCopy>);

}  // namespace dmpc::svm
