#include "dataflow/units/unit_primaries.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::dataflow {

UnitPrimaries::UnitPrimaries(nodes::LocalMemory& memory, const Capacity& capacity, std::span<const PrimaryRun> runs,
                             std::span<const std::uint32_t> runs_of_unit, const core::SampleRange& samples)
    : samples_(samples) {
  std::tie(runs_, lists_) = layout(capacity).in(memory);
  core::expect(runs.size() <= runs_.size(), "there is room for a node's own runs");
  std::copy(runs.begin(), runs.end(), runs_.begin());
  std::uint32_t first = 0;
  std::size_t next = 0;
  for (std::uint32_t unit = 0; unit < runs_of_unit.size(); ++unit) {
    if (const std::uint32_t count = runs_of_unit[unit]; count > 0) {
      core::expect(next < lists_.size() && first + count <= runs.size(), "a node's runs are those of its units");
      List& list = lists_[next++];
      list = {.unit = unit, .first = first, .count = count, .rays = 0};
      for (const PrimaryRun& run : runs.subspan(first, count)) {
        list.rays += run.count;
      }
      first += count;
      left_ += list.rays;
    }
  }
  core::expect(first == runs.size(), "every run is a unit's");
}

nodes::Layout<PrimaryRun, UnitPrimaries::List> UnitPrimaries::layout(const Capacity& capacity) {
  return {{nodes::Category::queues, capacity.runs}, {nodes::Category::queues, capacity.units}};
}

/// Its rays; nullptr if it has none.
UnitPrimaries::List* UnitPrimaries::find(std::uint32_t unit) const {
  const auto found =
      std::find_if(lists_.begin(), lists_.end(), [unit](const List& list) { return list.count > 0 && list.unit == unit; });
  return found == lists_.end() ? nullptr : &*found;
}

std::uint64_t UnitPrimaries::left_of(std::uint32_t unit) const {
  const List* const list = find(unit);
  return list == nullptr ? 0 : list->rays;
}

std::size_t UnitPrimaries::runs_of(std::uint32_t unit) const {
  const List* const list = find(unit);
  return list == nullptr ? 0 : list->count;
}

std::uint32_t UnitPrimaries::largest_unit() const {
  core::expect(!empty(), "a unit with primary rays is asked for where there is one");
  return std::max_element(lists_.begin(), lists_.end(), [](const List& a, const List& b) { return a.rays < b.rays; })->unit;
}

std::uint64_t UnitPrimaries::take() {
  core::expect(!empty(), "a primary ray starts once");
  const auto next = [this](const List& list) { return list.count == 0 ? ~std::uint64_t{0} : runs_[list.first].first; };
  List& list = *std::min_element(lists_.begin(), lists_.end(), [&](const List& a, const List& b) { return next(a) < next(b); });
  PrimaryRun& run = runs_[list.first];
  const std::uint64_t number = run.first++;
  --run.count;
  --list.rays;
  --left_;
  if (run.count == 0) {
    ++list.first;
    --list.count;
  }
  return number;
}

DealtPrimaries UnitPrimaries::give(std::uint32_t unit) {
  DealtPrimaries dealt{.samples = samples_};
  if (List* const list = find(unit)) {
    dealt.count = std::min(list->count, static_cast<std::uint32_t>(dealt.runs.size()));
    for (std::uint32_t i = 0; i < dealt.count; ++i) {
      dealt.runs[i] = runs_[list->first + i];
      list->rays -= dealt.runs[i].count;
      left_ -= dealt.runs[i].count;
    }
    list->first += dealt.count;
    list->count -= dealt.count;
  }
  return dealt;
}

void UnitPrimaries::put(std::uint32_t unit, const DealtPrimaries& dealt) {
  core::expect(dealt.count == 0 || dealt.samples == samples_, "primary rays go along in the pass that they are of");
  List& list = lists_.front();
  if (empty()) {
    list = {.unit = unit};
  }
  core::expect(list.unit == unit && list.first + list.count + dealt.count <= runs_.size(),
               "runs come where there is room for all of their unit");
  for (std::uint32_t i = 0; i < dealt.count; ++i) {
    runs_[list.first + list.count] = dealt.runs[i];
    ++list.count;
    list.rays += dealt.runs[i].count;
    left_ += dealt.runs[i].count;
  }
}

}  // namespace dmpc::dataflow
