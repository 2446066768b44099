// A pager that also records which pages are referenced. A type of its own, so that normal runs pay nothing for it.
#pragma once

#include <cstddef>
#include <span>

#include "core/base/expect.h"
#include "svm/pages/pager.h"
#include "svm/pages/watch/reference_log.h"

namespace dmpc::svm {

/// Notes a reference when it is answered, so a step that is retried after its page arrived is noted once. Pages that are here for
/// good are left out: they need no frame. Takes as much local memory as a Pager; the log lies outside. Thread safety: none.
class RecordingPager : public Pager {
 public:
  RecordingPager(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
      : Pager(node, capacity, database), geometry_(capacity.page_size_bytes()) {}

  /// To be called once, before the first reference. `log` outlives this.
  void record_into(ReferenceLog& log) { log_ = &log; }

  /// Hides Pager's: looks the page up, then notes it.
  const std::byte* find(core::Address address) {
    const std::byte* const record = Pager::find(address);
    const PageId page = geometry_.page_of(address);
    if (record != nullptr && !keeps(page)) {
      log_->note(page);
    }
    return record;
  }

 private:
  PageGeometry geometry_;
  ReferenceLog* log_ = nullptr;
};
static_assert(core::Records<RecordingPager>);

}  // namespace dmpc::svm
