#include "svm/pages/faults.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::svm {

using nodes::Category;

Faults::Faults(nodes::LocalMemory& memory, std::uint32_t slot_count, std::uint32_t faults_max) {
  std::tie(faults_, next_) = layout(slot_count, faults_max).in(memory);
}

nodes::Layout<Faults::Fault, std::uint32_t> Faults::layout(std::uint32_t slot_count, std::uint32_t faults_max) {
  return {{Category::queues, faults_max}, {Category::queues, slot_count}};
}

Faults::Fault* Faults::park(std::uint32_t slot, PageId page, std::uint32_t home) {
  next_[slot] = no_slot;
  if (Fault* fault = find(page)) {
    next_[fault->last] = slot;
    fault->last = slot;
    return nullptr;
  }
  core::expect(count_ < faults_.size(), "there are never more faults than pixels in flight, nor than pages that live elsewhere");
  Fault& fault = faults_[count_++];
  fault = {page, home, slot, slot, false};
  return &fault;
}

std::uint32_t Faults::arrived(PageId page) {
  Fault* fault = find(page);
  core::expect(fault != nullptr && fault->requested, "a page arrives only where it was asked for");
  const std::uint32_t first = fault->first;
  std::copy(fault + 1, faults_.data() + count_, fault);
  --count_;
  return first;
}

Faults::Fault* Faults::oldest_refused(std::uint32_t home) {
  for (Fault& fault : faults_.first(count_)) {
    if (!fault.requested && fault.home == home) {
      return &fault;
    }
  }
  return nullptr;
}

Faults::Fault* Faults::find(PageId page) {
  for (Fault& fault : faults_.first(count_)) {
    if (fault.page == page) {
      return &fault;
    }
  }
  return nullptr;
}

}  // namespace dmpc::svm
