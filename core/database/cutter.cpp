#include "core/database/cutter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/units.h"

namespace dmpc::core {
namespace {

/// Groups up to this size are sorted and cut at the best of all places, larger ones between bins.
constexpr std::uint32_t sorted_count_max = 64;
constexpr std::size_t bin_count = 32;

float blocks_for(std::uint32_t count) { return static_cast<float>(ceil_divide<std::uint32_t>(count, block_lanes)); }

/// Where to cut, and what a ray that meets the whole pays for the two parts, but for a factor.
struct Cut {
  float cost = std::numeric_limits<float>::infinity();
  std::size_t axis = 0;
  std::uint32_t place = 0;  ///< how many primitives, or bins, lie before it
};

using Four = float __attribute__((vector_size(16)));
using FourCounts = std::int32_t __attribute__((vector_size(16)));

/// Bounds that grow in two registers, by name: left to itself, GCC takes numbers that are gathered in a loop one by one.
class Gathering {
 public:
  void include(const Bounds& bounds) { include(four(bounds.low), four(bounds.high)); }
  /// A point twice as far as the middle: Bounds::middle().
  void include_middle(const Bounds& bounds) {
    const Four middle = four(bounds.low) + four(bounds.high);
    include(middle, middle);
  }
  /// As Bounds::area().
  float area() const {
    const Four edges = high_ - low_;
    return edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0];
  }
  Bounds bounds() const {
    Bounds bounds;
    bounds.low = std::bit_cast<std::array<float, 4>>(low_);
    bounds.high = std::bit_cast<std::array<float, 4>>(high_);
    return bounds;
  }

 private:
  static Four four(const std::array<float, 4>& numbers) { return std::bit_cast<Four>(numbers); }
  void include(const Four& low, const Four& high) {
    low_ = low < low_ ? low : low_;
    high_ = high_ < high ? high : high_;
  }

  Four low_{Bounds::infinity, Bounds::infinity, Bounds::infinity, 0};
  Four high_{-Bounds::infinity, -Bounds::infinity, -Bounds::infinity, 0};
};

/// Where the middles of a group's primitives lie, twice: as Bounds::middle().
Bounds middles_of(std::span<const Bounds> items) {
  Gathering middles;
  for (const Bounds& item : items) {
    middles.include_middle(item);
  }
  return middles.bounds();
}

std::size_t longest_axis(const Bounds& bounds) {
  const float x = bounds.high[0] - bounds.low[0], y = bounds.high[1] - bounds.low[1], z = bounds.high[2] - bounds.low[2];
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Slices of equal width of where the middles lie along each axis.
struct Bins {
  struct Bin {
    Bounds bounds;
    std::uint32_t count = 0;
  };
  std::array<float, 4> low{}, scale{};
  std::array<std::array<Bin, bin_count>, 3> bins{};

  explicit Bins(const Bounds& middles) : low(middles.low) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float slices = static_cast<float>(bin_count) / (middles.high[axis] - middles.low[axis]);
      scale[axis] = std::isfinite(slices) ? slices : 0.0F;
    }
  }
  /// By one axis: by all at once is slower, as what comes out of a vector register has to be taken apart again.
  std::size_t of(const Bounds& item, std::size_t axis) const {
    const auto slice = static_cast<std::int32_t>((item.middle(axis) - low[axis]) * scale[axis]);
    return static_cast<std::size_t>(std::min<std::int32_t>(slice, bin_count - 1));
  }
  void add(const Bounds& item) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][of(item, axis)];
      bin.bounds.include(item);
      ++bin.count;
    }
  }
  Cut best_cut(std::uint32_t count) const;
  /// Of all that is in the bins of an axis from `first` on, before `last`.
  Bounds bounds_of(std::size_t axis, std::uint32_t first, std::uint32_t last) const {
    Gathering all;
    for (std::uint32_t i = first; i < last; ++i) {
      all.include(bins[axis][i].bounds);
    }
    return all.bounds();
  }
};

/// The bins of one number along all three axes, an axis a lane.
struct Slices {
  std::array<Four, 3> low{}, high{};  ///< by coordinate
  FourCounts count{};

  static Slices of(const Bins& bins, std::size_t number) {
    const auto bin = [&](std::size_t axis) -> const Bins::Bin& { return bins.bins[axis][number]; };
    Slices slices;
    slices.low = turned(bin(0).bounds.low, bin(1).bounds.low, bin(2).bounds.low);
    slices.high = turned(bin(0).bounds.high, bin(1).bounds.high, bin(2).bounds.high);
    const auto count = [&](std::size_t axis) { return static_cast<std::int32_t>(bin(axis).count); };
    slices.count = FourCounts{count(0), count(1), count(2), 0};
    return slices;
  }

 private:
  static std::array<Four, 3> turned(const std::array<float, 4>& first, const std::array<float, 4>& second,
                                    const std::array<float, 4>& third) {
    const Four a = std::bit_cast<Four>(first), b = std::bit_cast<Four>(second), c = std::bit_cast<Four>(third);
    const Four xy = __builtin_shufflevector(a, b, 0, 4, 1, 5), z = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    return {__builtin_shufflevector(xy, c, 0, 1, 4, 4), __builtin_shufflevector(xy, c, 2, 3, 5, 5),
            __builtin_shufflevector(z, c, 0, 1, 6, 6)};
  }
};

/// What lies in several bins along each axis: bounds that grow.
class Sweep {
 public:
  void include(const Slices& slices) {
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = slices.low[i] < low_[i] ? slices.low[i] : low_[i];
      high_[i] = high_[i] < slices.high[i] ? slices.high[i] : high_[i];
    }
    count_ += slices.count;
  }
  const FourCounts& count() const { return count_; }
  /// Bounds::area() times the number of primitives, 0 of none.
  Four cost() const {
    const Four x = high_[0] - low_[0], y = high_[1] - low_[1], z = high_[2] - low_[2];
    return count_ > 0 ? (x * y + y * z + z * x) * __builtin_convertvector(count_, Four) : Four{};
  }

 private:
  static constexpr Four infinity{Bounds::infinity, Bounds::infinity, Bounds::infinity, Bounds::infinity};

  std::array<Four, 3> low_{infinity, infinity, infinity}, high_{-infinity, -infinity, -infinity};
  FourCounts count_{};
};

/// The best cut between two bins of an axis (I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007), for
/// the three axes side by side. Of equal ones the first of the first axis.
Cut Bins::best_cut(std::uint32_t count) const {
  std::array<Slices, bin_count> slices;
  for (std::size_t i = 0; i < bin_count; ++i) {
    slices[i] = Slices::of(*this, i);
  }
  std::array<Four, bin_count> rest{};
  Sweep behind;
  for (std::size_t i = bin_count; i-- > 1;) {
    behind.include(slices[i]);
    rest[i] = behind.cost();
  }
  Four least{Cut{}.cost, Cut{}.cost, Cut{}.cost, Cut{}.cost};
  FourCounts place{};
  Sweep before;
  for (std::size_t i = 1; i < bin_count; ++i) {
    before.include(slices[i - 1]);
    const Four cost = before.cost() + rest[i];
    const FourCounts is_better = (before.count() > 0) & (before.count() < static_cast<std::int32_t>(count)) & (cost < least);
    least = is_better ? cost : least;
    place = is_better ? FourCounts{} + static_cast<std::int32_t>(i) : place;
  }
  Cut best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    best = least[axis] < best.cost ? Cut{least[axis], axis, static_cast<std::uint32_t>(place[axis])} : best;
  }
  return best;
}

}  // namespace

Cutter::Cutter(std::size_t count, std::span<const PrimitiveValues> primitives) : primitives_(primitives) {
  ids_.reserve(count);
  bounds_.reserve(count);
  for (auto& order : orders_) {
    order.resize(count);
  }
}

void Cutter::add(std::uint32_t id, const Bounds& bounds) {
  ids_.push_back(id);
  bounds_.push_back(bounds);
}

Group Cutter::group(PrimitiveKind kind, std::size_t first, std::size_t last, bool needs_plane) const {
  Group group{.first = static_cast<std::uint32_t>(first),
              .last = static_cast<std::uint32_t>(last),
              .needs_plane = needs_plane,
              .kind = kind};
  group.bounds = bounds_of(group);
  return group;
}

std::pair<Group, Group> Cutter::cut(Group whole, bool balanced) {
  if (!whole.is_sorted && whole.count() <= sorted_count_max) {
    sort(whole);
  }
  if (whole.needs_plane && whole.count() <= block_lanes && !balanced && !lies_in_one(whole)) {
    return halves(whole, cut_between_planes(whole));
  }
  if (whole.is_sorted) {
    return halves(whole, cut_sorted(whole, balanced));
  }
  return balanced ? halves(whole, cut_in_the_middle(whole)) : cut_between_bins(whole);
}

void Cutter::copy_ids(const Group& group, std::span<std::uint32_t> ids) const {
  for (std::uint32_t place = group.first; place < group.last; ++place) {
    ids[place - group.first] = ids_[item_at(group, 0, place)];
  }
}

void Cutter::sort_again(const Group& group) {
  for (std::size_t axis = 0; axis < 3 && group.is_sorted; ++axis) {
    const auto order = std::span(orders_[axis]).subspan(group.first, group.count());
    const auto along = [&](std::uint8_t item) { return std::pair(bounds_[group.base + item].middle(axis), item); };
    std::sort(order.begin(), order.end(), [&](std::uint8_t a, std::uint8_t b) { return along(a) < along(b); });
  }
}

/// The item at a place of a group: in its order along the axis, if it is sorted.
std::uint32_t Cutter::item_at(const Group& group, std::size_t axis, std::uint32_t place) const {
  return group.is_sorted ? group.base + orders_[axis][place] : place;
}

Bounds Cutter::bounds_of(const Group& group) const {
  Gathering all;
  for (std::uint32_t place = group.first; place < group.last; ++place) {
    all.include(bounds_[item_at(group, 0, place)]);
  }
  return all.bounds();
}

std::pair<Group, Group> Cutter::halves(const Group& whole, std::uint32_t middle) const {
  std::pair<Group, Group> both{whole, whole};
  both.first.last = both.second.first = middle;
  both.first.bounds = bounds_of(both.first);
  both.second.bounds = bounds_of(both.second);
  return both;
}

/// Counts for each how many come before it: for so few the quickest way, since nothing has to be guessed.
void Cutter::sort(Group& group) {
  group.base = group.first;
  group.is_sorted = true;
  const std::uint32_t count = group.count();
  std::array<float, sorted_count_max> middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::uint32_t i = 0; i < count; ++i) {
      middle[i] = bounds_[group.base + i].middle(axis);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      std::int32_t before = 0;
      for (std::uint32_t j = 0; j < i; ++j) {
        before += middle[j] <= middle[i] ? 1 : 0;
      }
      for (std::uint32_t j = i + 1; j < count; ++j) {
        before += middle[j] < middle[i] ? 1 : 0;
      }
      orders_[axis][group.base + static_cast<std::uint32_t>(before)] = static_cast<std::uint8_t>(i);
    }
  }
}

/// The best of all cuts between the primitives in their order along each axis.
std::uint32_t Cutter::cut_sorted(const Group& whole, bool balanced) {
  const std::uint32_t count = whole.count();
  Cut best{.axis = longest_axis(whole.bounds), .place = count / 2};
  for (std::size_t axis = 0; axis < 3 && !balanced; ++axis) {
    const auto item = [&](std::uint32_t i) -> const Bounds& { return bounds_[whole.base + orders_[axis][whole.first + i]]; };
    std::array<float, sorted_count_max> rest{};
    Gathering bounds;
    for (std::uint32_t i = count; i-- > 1;) {
      bounds.include(item(i));
      rest[i] = bounds.area() * blocks_for(count - i);
    }
    bounds = {};
    for (std::uint32_t i = 1; i < count; ++i) {
      bounds.include(item(i - 1));
      const float cost = bounds.area() * blocks_for(i) + rest[i];
      best = cost < best.cost ? Cut{cost, axis, i} : best;
    }
  }
  std::uint64_t is_first = 0;
  for (std::uint32_t place = whole.first; place < whole.first + best.place; ++place) {
    is_first |= std::uint64_t{1} << orders_[best.axis][place];
  }
  divide(whole, is_first);
  return whole.first + best.place;
}

/// Those in the plane of the first, and the others.
std::uint32_t Cutter::cut_between_planes(const Group& whole) {
  std::uint64_t is_first = 0;
  for (std::uint32_t place = whole.first; place < whole.last; ++place) {
    const bool belongs = plane_at(whole, place) == plane_of(whole);
    is_first |= std::uint64_t{belongs ? 1U : 0U} << orders_[0][place];
  }
  divide(whole, is_first);
  return whole.first + static_cast<std::uint32_t>(std::popcount(is_first));
}

std::uint32_t Cutter::plane_at(const Group& group, std::uint32_t place) const {
  return primitives_[ids_[item_at(group, 0, place)]].plane();
}

bool Cutter::lies_in_one(const Group& group) const {
  for (std::uint32_t place = group.first + 1; place < group.last; ++place) {
    if (plane_at(group, place) != plane_of(group)) {
      return false;
    }
  }
  return true;
}

/// Brings items, a bit each, to the front of all orders.
void Cutter::divide(const Group& whole, std::uint64_t is_first) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint8_t* const order = orders_[axis].data();
    std::array<std::uint8_t, sorted_count_max> behind{};
    std::uint32_t first = whole.first, second = 0;
    for (std::uint32_t place = whole.first; place < whole.last; ++place) {
      const std::uint8_t item = order[place];
      const auto belongs = static_cast<std::uint32_t>(is_first >> item & 1U);
      order[first] = item;
      behind[second] = item;
      first += belongs;
      second += 1 - belongs;
    }
    std::copy_n(behind.begin(), second, order + first);
  }
}

/// What the bins hold tells the bounds of both parts.
std::pair<Group, Group> Cutter::cut_between_bins(const Group& whole) {
  const auto items = std::span(bounds_).subspan(whole.first, whole.count());
  Bins bins(middles_of(items));
  for (const Bounds& item : items) {
    bins.add(item);
  }
  const Cut best = bins.best_cut(whole.count());
  if (best.place == 0) {
    return halves(whole, cut_in_the_middle(whole));
  }
  std::pair<Group, Group> both{whole, whole};
  both.first.last = both.second.first =
      partition(whole, [&](std::uint32_t i) { return bins.of(bounds_[i], best.axis) < best.place; });
  both.first.bounds = bins.bounds_of(best.axis, 0, best.place);
  both.second.bounds = bins.bounds_of(best.axis, best.place, bin_count);
  return both;
}

/// Equal numbers on both sides, along the axis on which the middles are farthest apart.
std::uint32_t Cutter::cut_in_the_middle(const Group& whole) {
  const std::size_t axis = longest_axis(middles_of(std::span(bounds_).subspan(whole.first, whole.count())));
  std::vector<std::pair<float, std::uint32_t>> along;
  along.reserve(whole.count());
  for (std::uint32_t i = whole.first; i < whole.last; ++i) {
    along.emplace_back(bounds_[i].middle(axis), ids_[i]);
  }
  const auto middle = along.begin() + whole.count() / 2;
  std::nth_element(along.begin(), middle, along.end());
  return partition(whole, [&](std::uint32_t i) { return std::pair(bounds_[i].middle(axis), ids_[i]) < *middle; });
}

/// Brings the primitives for which is_first(place) holds to the front, and says where the others begin.
template <class IsFirst>
std::uint32_t Cutter::partition(const Group& whole, const IsFirst& is_first) {
  std::uint32_t middle = whole.first;
  for (std::uint32_t i = whole.first; i < whole.last; ++i) {
    if (is_first(i)) {
      std::swap(ids_[i], ids_[middle]);
      std::swap(bounds_[i], bounds_[middle]);
      ++middle;
    }
  }
  return middle;
}

}  // namespace dmpc::core
