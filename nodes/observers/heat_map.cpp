#include "nodes/observers/heat_map.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "core/base/expect.h"
#include "nodes/flat_bytes.h"

namespace dmpc::nodes {

std::uint64_t* HeatMap::place(HeatNumber kind, std::uint32_t item) {
  core::expect(item < item_count_, "heat falls on an item that there is");
  std::vector<std::uint64_t>& values = values_.at(kind.value());
  return values.empty() ? nullptr : &values[item];
}

void HeatMap::add(HeatNumber kind, std::uint32_t item, std::uint64_t amount) {
  if (std::uint64_t* const value = place(kind, item)) {
    std::atomic_ref(*value).fetch_add(amount, std::memory_order_relaxed);
  }
}

void HeatMap::raise(HeatNumber kind, std::uint32_t item, std::uint64_t value) {
  if (std::uint64_t* const old = place(kind, item)) {
    const std::atomic_ref highest(*old);
    std::uint64_t known = highest.load(std::memory_order_relaxed);
    while (known < value && !highest.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
    }
  }
}

void HeatMap::set(HeatNumber kind, std::uint32_t item, std::uint64_t value) {
  if (std::uint64_t* const old = place(kind, item)) {
    std::atomic_ref(*old).store(value, std::memory_order_relaxed);
  }
}

void HeatMap::clear() {
  for (std::vector<std::uint64_t>& values : values_) {
    std::fill(values.begin(), values.end(), 0);
  }
}

std::uint64_t HeatMap::sum(HeatNumber kind) const {
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

void HeatMap::add(std::string_view bytes, const ClockDrift& clock) {
  FlatReader flat(bytes);
  for (std::size_t kind = 0; kind < values_.size(); ++kind) {
    const bool is_done = kind == done_.value(), is_largest = is_done || kind == depth_.value() || kind == node_.value();
    std::vector<std::uint64_t> more(values_[kind].size());
    flat.take_all(std::span(more));
    for (std::size_t item = 0; item < more.size(); ++item) {
      std::uint64_t& value = values_[kind][item];
      const std::uint64_t other = is_done && more[item] > 0 ? clock.corrected(more[item]) : more[item];
      value = is_largest ? std::max(value, other) : value + other;
    }
  }
  core::expect(flat.is_at_end(), "heat maps that are added are of the same kinds");
}

}  // namespace dmpc::nodes
