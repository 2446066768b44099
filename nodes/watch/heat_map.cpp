#include "nodes/watch/heat_map.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "core/base/expect.h"
#include "nodes/flat_bytes.h"

namespace dmpc::nodes {

HeatMap::HeatMap(std::uint32_t pixel_count, std::span<const HeatKind> kinds) : pixel_count_(pixel_count) {
  for (const HeatKind kind : kinds) {
    values_[static_cast<std::size_t>(kind)].resize(pixel_count);
  }
}

std::uint64_t* HeatMap::place(HeatKind kind, std::uint32_t pixel) {
  core::expect(pixel < pixel_count_, "heat falls on a pixel of the picture");
  std::vector<std::uint64_t>& values = values_[static_cast<std::size_t>(kind)];
  return values.empty() ? nullptr : &values[pixel];
}

void HeatMap::add(HeatKind kind, std::uint32_t pixel, std::uint64_t amount) {
  if (std::uint64_t* const value = place(kind, pixel)) {
    std::atomic_ref(*value).fetch_add(amount, std::memory_order_relaxed);
  }
}

void HeatMap::raise(HeatKind kind, std::uint32_t pixel, std::uint64_t value) {
  if (std::uint64_t* const old = place(kind, pixel)) {
    const std::atomic_ref highest(*old);
    std::uint64_t known = highest.load(std::memory_order_relaxed);
    while (known < value && !highest.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
    }
  }
}

void HeatMap::set(HeatKind kind, std::uint32_t pixel, std::uint64_t value) {
  if (std::uint64_t* const old = place(kind, pixel)) {
    std::atomic_ref(*old).store(value, std::memory_order_relaxed);
  }
}

std::uint64_t HeatMap::sum(HeatKind kind) const {
  const std::span<const std::uint64_t> all = values(kind);
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0});
}

std::string HeatMap::bytes() const {
  FlatWriter flat;
  for (const std::vector<std::uint64_t>& values : values_) {
    flat.put_all(values);
  }
  return flat.take();
}

void HeatMap::add(std::string_view bytes) {
  FlatReader flat(bytes);
  for (std::size_t kind = 0; kind < values_.size(); ++kind) {
    const bool is_largest = kind == static_cast<std::size_t>(HeatKind::depth) || kind == static_cast<std::size_t>(HeatKind::node);
    std::vector<std::uint64_t> more(values_[kind].size());
    flat.take_all(std::span(more));
    for (std::size_t pixel = 0; pixel < more.size(); ++pixel) {
      std::uint64_t& value = values_[kind][pixel];
      value = is_largest ? std::max(value, more[pixel]) : value + more[pixel];
    }
  }
  core::expect(flat.is_at_end(), "heat maps that are added are of the same kinds");
}

}  // namespace dmpc::nodes
