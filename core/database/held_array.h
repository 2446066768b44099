// An array that nobody changes any more: a vector, or a part of memory that others share.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace dmpc::core {

/// Copies share the items. Thread safety: that of std::shared_ptr.
template <class T>
class HeldArray {
 public:
  HeldArray() = default;
  explicit HeldArray(std::vector<T> own) {
    auto kept = std::make_shared<const std::vector<T>>(std::move(own));
    items_ = *kept;
    keeper_ = std::move(kept);
  }
  /// `keeper` keeps the items' memory.
  HeldArray(std::span<const T> items, std::shared_ptr<const void> keeper) : keeper_(std::move(keeper)), items_(items) {}

  std::span<const T> items() const { return items_; }

 private:
  std::shared_ptr<const void> keeper_;
  std::span<const T> items_;
};

}  // namespace dmpc::core
