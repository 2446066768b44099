#include "core/database/tree/cutter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/units.h"

namespace dmpc::core {
namespace {

/// Groups up to this size are sorted and cut at the best of all positions, larger ones between bins.
constexpr std::uint32_t sorted_count_max = 64;
constexpr std::size_t bin_count = 32;

float leaves_for(std::uint32_t count) { return static_cast<float>(ceil_divide<std::uint32_t>(count, leaf_lanes)); }

/// A position for a cut, and the cost of the two parts for a ray that meets the whole, except for a factor.
struct Cut {
  float cost = std::numeric_limits<float>::infinity();
  std::size_t axis = 0;
  std::uint32_t place = 0;  ///< number of primitives, or bins, before it
};

using Four = float __attribute__((vector_size(16)));
using FourCounts = std::int32_t __attribute__((vector_size(16)));

/// Bounds that grow in two registers. They are named because GCC handles numbers gathered in a loop one by one.
class Gathering {
 public:
  void include(const Bounds& bounds) { include(four(bounds.low), four(bounds.high)); }
  /// Twice the centre of the bounds: Bounds::middle().
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

/// The bounds of the doubled centres of a group's primitives: Bounds::middle().
Bounds middles_of(std::span<const Bounds> items) {
  Gathering middles;
  for (const Bounds& item : items) {
    middles.include_middle(item);
  }
  return middles.bounds();
}

void exchange_if(bool condition, Bounds& a, Bounds& b) {
  const FourCounts mask = FourCounts{} - (condition ? 1 : 0);
  const auto exchange = [&](std::array<float, 4>& one, std::array<float, 4>& other) {
    const Four first = std::bit_cast<Four>(one), second = std::bit_cast<Four>(other);
    one = std::bit_cast<std::array<float, 4>>(mask ? second : first);
    other = std::bit_cast<std::array<float, 4>>(mask ? first : second);
  };
  exchange(a.low, b.low);
  exchange(a.high, b.high);
}

std::size_t longest_axis(const Bounds& bounds) {
  const float x = bounds.high[0] - bounds.low[0], y = bounds.high[1] - bounds.low[1], z = bounds.high[2] - bounds.low[2];
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Slices of equal width over the extent of the centres along each axis.
struct Bins {
  struct Bin {
    Gathering bounds;
    std::uint32_t count = 0;
  };
  Four low{}, scale{};
  std::array<std::array<Bin, bin_count>, 3> bins{};

  explicit Bins(const Bounds& middles) : low(std::bit_cast<Four>(middles.low)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float slices = static_cast<float>(bin_count) / (middles.high[axis] - middles.low[axis]);
      scale[axis] = std::isfinite(slices) ? slices : 0.0F;
    }
  }
  std::int32_t of(const Bounds& item, std::size_t axis) const {
    const auto slice = static_cast<std::int32_t>((item.middle(axis) - low[axis]) * scale[axis]);
    return std::min(slice, static_cast<std::int32_t>(bin_count - 1));
  }
  /// The bin numbers along all axes.
  FourCounts of(const Bounds& item) const {
    const Four along = (std::bit_cast<Four>(item.low) + std::bit_cast<Four>(item.high) - low) * scale;
    const FourCounts slices = __builtin_convertvector(along, FourCounts),
                     last = FourCounts{} + static_cast<std::int32_t>(bin_count - 1);
    return slices < last ? slices : last;
  }
  void add(const Bounds& item) {
    const FourCounts slices = of(item);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][static_cast<std::size_t>(slices[axis])];
      bin.bounds.include(item);
      ++bin.count;
    }
  }
  /// Alternates between items of the two halves: neighbours often share a bin, and each would wait for the one before it.
  [[gnu::always_inline]] void add_all(std::span<const Bounds> items) {
    const std::size_t half = items.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
      add(items[i]);
      add(items[half + i]);
    }
    if (items.size() % 2 != 0) {
      add(items.back());
    }
  }
  Cut best_cut(std::uint32_t count) const;
  /// The bounds of the bins [first, last) of an axis.
  Bounds bounds_of(std::size_t axis, std::uint32_t first, std::uint32_t last) const {
    Gathering all;
    for (std::uint32_t i = first; i < last; ++i) {
      all.include(bins[axis][i].bounds.bounds());
    }
    return all.bounds();
  }
};

/// One entry of a list for each axis, one axis per lane.
struct Slices {
  std::array<Four, 3> low, high;  ///< by coordinate

  static Slices of(const Bounds& x, const Bounds& y, const Bounds& z) {
    return {turned(x.low, y.low, z.low), turned(x.high, y.high, z.high)};
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

/// Growing bounds of several slices along each axis.
class Sweep {
 public:
  void include(const Slices& slices) {
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = slices.low[i] < low_[i] ? slices.low[i] : low_[i];
      high_[i] = high_[i] < slices.high[i] ? slices.high[i] : high_[i];
    }
  }
  /// As Bounds::area().
  Four area() const {
    const Four x = high_[0] - low_[0], y = high_[1] - low_[1], z = high_[2] - low_[2];
    return x * y + y * z + z * x;
  }

 private:
  static constexpr Four infinity{Bounds::infinity, Bounds::infinity, Bounds::infinity, Bounds::infinity};

  std::array<Four, 3> low_{infinity, infinity, infinity}, high_{-infinity, -infinity, -infinity};
};

/// The best cut along each axis; among equal ones the first of the first axis.
class LeastCuts {
 public:
  void take(const Four& cost, std::uint32_t place) { take(cost, place, FourCounts{-1, -1, -1, -1}); }
  void take(const Four& cost, std::uint32_t place, const FourCounts& is_possible) {
    const FourCounts is_better = is_possible & (cost < cost_);
    cost_ = is_better ? cost : cost_;
    place_ = is_better ? FourCounts{} + static_cast<std::int32_t>(place) : place_;
  }
  /// `usual` if none costs less.
  Cut best(Cut usual) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      usual = cost_[axis] < usual.cost ? Cut{cost_[axis], axis, static_cast<std::uint32_t>(place_[axis])} : usual;
    }
    return usual;
  }

 private:
  Four cost_{Cut{}.cost, Cut{}.cost, Cut{}.cost, Cut{}.cost};
  FourCounts place_{};
};

/// The best cut between two bins of an axis (I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007), for
/// the three axes in parallel.
Cut Bins::best_cut(std::uint32_t count) const {
  const auto slices_of = [&](std::size_t i) {
    return Slices::of(bins[0][i].bounds.bounds(), bins[1][i].bounds.bounds(), bins[2][i].bounds.bounds());
  };
  const auto counts_of = [&](std::size_t i) {
    const auto in = [&](std::size_t axis) { return static_cast<std::int32_t>(bins[axis][i].count); };
    return FourCounts{in(0), in(1), in(2), 0};
  };
  const auto cost_of = [](const Sweep& sweep, const FourCounts& counts) {
    return counts > 0 ? sweep.area() * __builtin_convertvector(counts, Four) : Four{};
  };
  std::array<Four, bin_count> rest;
  Sweep behind;
  FourCounts counts{};
  for (std::size_t i = bin_count; i-- > 1;) {
    behind.include(slices_of(i));
    counts += counts_of(i);
    rest[i] = cost_of(behind, counts);
  }
  LeastCuts least;
  Sweep before;
  counts = FourCounts{};
  for (std::size_t i = 1; i < bin_count; ++i) {
    before.include(slices_of(i - 1));
    counts += counts_of(i - 1);
    least.take(cost_of(before, counts) + rest[i], static_cast<std::uint32_t>(i),
               (counts > 0) & (counts < static_cast<std::int32_t>(count)));
  }
  return least.best({});
}

/// The best cut between primitives in their order along each axis, which item(axis, i) returns: `usual` if none costs less.
template <class Item>
[[gnu::always_inline]] inline Cut best_sorted_cut(std::uint32_t count, const Item& item, const Cut& usual) {
  const auto slices_at = [&](std::uint32_t i) { return Slices::of(item(0, i), item(1, i), item(2, i)); };
  std::array<Four, sorted_count_max> rest;
  Sweep behind;
  for (std::uint32_t i = count; i-- > 1;) {
    behind.include(slices_at(i));
    rest[i] = behind.area() * leaves_for(count - i);
  }
  LeastCuts least;
  Sweep before;
  for (std::uint32_t i = 1; i < count; ++i) {
    before.include(slices_at(i - 1));
    least.take(before.area() * leaves_for(i) + rest[i], i);
  }
  return least.best(usual);
}

/// The centres of a few primitives along an axis.
struct Middles {
  alignas(64) std::array<float, sorted_count_max> along{};
  std::array<std::int32_t, sorted_count_max> before{};  ///< number of centres before it; equal ones are in list order

  /// The loops have a form that compilers vectorise.
  [[gnu::always_inline]] void count_before(std::int32_t count) {
    constexpr std::int32_t lanes = 16;
    const std::int32_t end = ceil_divide(count, lanes) * lanes;
    const float* const all = along.data();
    std::int32_t* const sums = before.data();
    for (std::int32_t other = 0; other < count; ++other) {
      const float at = all[other];
      for (std::int32_t i = 0; i < end; ++i) {
        const std::int32_t is_less = at < all[i] ? 1 : 0, is_equal = at == all[i] ? 1 : 0, is_listed_before = other < i ? 1 : 0;
        sums[i] += is_less | (is_equal & is_listed_before);
      }
    }
  }
};

}  // namespace

Cutter::Cutter(std::size_t count, std::span<const PrimitiveValues> primitives, VectorWidth width)
    : primitives_(primitives), width_(width) {
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
  if (whole.needs_plane && whole.count() <= leaf_lanes && !balanced && !lies_in_one(whole)) {
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

/// The item at a position of a group, in order along the axis if the group is sorted.
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

/// Counts for each item how many precede it: fastest for so few, since it has no unpredictable branches.
void Cutter::sort(Group& group) {
  group.base = group.first;
  group.is_sorted = true;
  const std::uint32_t count = group.count();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Middles middles;
    for (std::uint32_t i = 0; i < count; ++i) {
      middles.along[i] = bounds_[group.base + i].middle(axis);
    }
    run_by(width_, [&] { middles.count_before(static_cast<std::int32_t>(count)); });
    for (std::uint32_t i = 0; i < count; ++i) {
      orders_[axis][group.base + static_cast<std::uint32_t>(middles.before[i])] = static_cast<std::uint8_t>(i);
    }
  }
}

/// The best cut between primitives in their order along each axis.
std::uint32_t Cutter::cut_sorted(const Group& whole, bool balanced) {
  Cut best{.axis = longest_axis(whole.bounds), .place = whole.count() / 2};
  if (!balanced) {
    const auto item = [&](std::size_t axis, std::uint32_t i) -> const Bounds& {
      return bounds_[whole.base + orders_[axis][whole.first + i]];
    };
    run_by(width_, [&] { best = best_sorted_cut(whole.count(), item, best); });
  }
  std::uint64_t is_first = 0;
  for (std::uint32_t place = whole.first; place < whole.first + best.place; ++place) {
    is_first |= std::uint64_t{1} << orders_[best.axis][place];
  }
  divide(whole, is_first);
  return whole.first + best.place;
}

/// Separates the primitives in the plane of the first one from the others.
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

/// Moves the items whose bit is set to the front of all orders.
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

/// The bins determine the bounds of both parts.
std::pair<Group, Group> Cutter::cut_between_bins(const Group& whole) {
  const auto items = std::span(bounds_).subspan(whole.first, whole.count());
  Bins bins(middles_of(items));
  run_by(width_, [&] { bins.add_all(items); });
  const Cut best = bins.best_cut(whole.count());
  if (best.place == 0) {
    return halves(whole, cut_in_the_middle(whole));
  }
  std::pair<Group, Group> both{whole, whole};
  both.first.last = both.second.first =
      partition(whole, [&, items = bounds_.data(), axis = best.axis, place = static_cast<std::int32_t>(best.place)](
                           std::uint32_t i) { return bins.of(items[i], axis) < place; });
  both.first.bounds = bins.bounds_of(best.axis, 0, best.place);
  both.second.bounds = bins.bounds_of(best.axis, best.place, bin_count);
  return both;
}

/// Cuts into equal numbers along the axis with the largest extent of centres.
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

/// Moves the primitives for which is_first(place) holds to the front, and returns where the others begin. It has no branches,
/// half of which would be mispredicted.
template <class IsFirst>
std::uint32_t Cutter::partition(const Group& whole, const IsFirst& is_first) {
  std::uint32_t middle = whole.first;
  run_by(width_, [&] {
    std::uint32_t* const ids = ids_.data();
    Bounds* const bounds = bounds_.data();
    std::uint32_t end = whole.first;
    for (std::uint32_t i = whole.first; i < whole.last; ++i) {
      const bool belongs = is_first(i);
      const std::uint32_t id = ids[i], other = ids[end];
      ids[i] = belongs ? other : id;
      ids[end] = belongs ? id : other;
      exchange_if(belongs, bounds[i], bounds[end]);
      end += belongs ? 1 : 0;
    }
    middle = end;
  });
  return middle;
}

}  // namespace dmpc::core
