// The list of tested objects that a ray carries, after the article.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace dmpc::dataflow {

inline constexpr std::uint32_t tested_objects_max = 8;

/// Names of leaves that a ray has tested and may meet again: those whose boxes reach beyond a region or a voxel
/// (core::LeafHeader::shared_name), the newest first; 0: none. A leaf is tested for the whole ray, wherever its box is met, so a
/// second test finds nothing new.
using TestedNames = std::array<std::uint32_t, tested_objects_max>;

/// The list while its ray is traced, with a maximum number of names: when it is full the oldest is dropped.
class TestedObjects {
 public:
  explicit TestedObjects(std::uint32_t capacity) : capacity_(capacity) {}

  std::uint32_t capacity() const { return capacity_; }
  const TestedNames& names() const { return names_; }
  void set(const TestedNames& names) { names_ = names; }

  /// Whether the leaf of this name was tested.
  bool has(std::uint32_t name) const {
    return name != 0 && std::find(names_.begin(), names_.begin() + capacity_, name) != names_.begin() + capacity_;
  }
  /// Adds the leaf, unless it has no name.
  void add(std::uint32_t name) {
    if (name != 0 && capacity_ > 0) {
      std::copy_backward(names_.begin(), names_.begin() + capacity_ - 1, names_.begin() + capacity_);
      names_[0] = name;
    }
  }

 private:
  std::uint32_t capacity_;
  TestedNames names_{};
};

}  // namespace dmpc::dataflow
