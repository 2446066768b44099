#include "svm/pages/observers/miss_curve.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <optional>

#include "core/base/expect.h"

namespace dmpc::svm {
namespace {

/// Counts the marked times up to t, where marks come and go (P. M. Fenwick, "A New Data Structure for Cumulative Frequency
/// Tables", 1994). Times count from 1.
class Marks {
 public:
  explicit Marks(std::uint32_t time_max) : sums_(time_max + 1) {}

  void add(std::uint32_t time, std::int32_t change) {
    for (; time < sums_.size(); time += lowest_bit(time)) {
      sums_[time] += static_cast<std::uint32_t>(change);
    }
  }
  std::uint32_t count_up_to(std::uint32_t time) const {
    std::uint32_t count = 0;
    for (; time > 0; time -= lowest_bit(time)) {
      count += sums_[time];
    }
    return count;
  }
  /// Marks exactly the times from 1 to `count`.
  void mark_first(std::uint32_t count) {
    for (std::uint32_t time = 1; time < sums_.size(); ++time) {
      sums_[time] = std::min(time, count) - std::min(time - lowest_bit(time), count);
    }
  }

 private:
  static std::uint32_t lowest_bit(std::uint32_t time) { return std::uint32_t{1} << std::countr_zero(time); }

  std::vector<std::uint32_t> sums_;
};

/// The pages in the order of their last references. Each page's last time is marked; when times run out, the marked ones are
/// renumbered.
class LruStack {
 public:
  /// For pages below `page_bound`.
  explicit LruStack(std::uint32_t page_bound)
      : time_max_(std::max(2 * page_bound, time_max_least)), marks_(time_max_), last_times_(page_bound), pages_(time_max_ + 1) {}

  /// Refers to `page`: returns its stack distance; nothing if this is the first reference.
  std::optional<std::uint32_t> refer(std::uint32_t page) {
    if (now_ == time_max_) {
      compact();
    }
    const std::uint32_t last = last_times_[page];
    const std::uint32_t younger = last == 0 ? 0 : distinct_ - marks_.count_up_to(last);
    if (last != 0) {
      marks_.add(last, -1);
    } else {
      ++distinct_;
    }
    marks_.add(++now_, 1);
    last_times_[page] = now_;
    pages_[now_] = page;
    return last == 0 ? std::nullopt : std::optional(younger);
  }

  std::uint32_t distinct() const { return distinct_; }

 private:
  /// With few pages, renumbering would otherwise be frequent.
  static constexpr std::uint32_t time_max_least = 1024;

  /// At most half of the times are marked, so this is rare.
  void compact() {
    std::uint32_t kept = 0;
    for (std::uint32_t time = 1; time <= now_; ++time) {
      const std::uint32_t page = pages_[time];
      if (last_times_[page] == time) {
        last_times_[page] = ++kept;
        pages_[kept] = page;
      }
    }
    core::expect(kept == distinct_, "every page has one last reference");
    marks_.mark_first(kept);
    now_ = kept;
  }

  std::uint32_t time_max_;
  std::uint32_t now_ = 0;
  std::uint32_t distinct_ = 0;
  Marks marks_;
  std::vector<std::uint32_t> last_times_;  ///< by page; 0: never
  std::vector<std::uint32_t> pages_;       ///< by time
};

}  // namespace

MissCurve::MissCurve(std::span<const PageId> references) : references_(references.size()) {
  LruStack stack(page_bound_of(references));
  for (const PageId page : references) {
    if (const auto distance = stack.refer(index_of(page))) {
      at_distance_.resize(std::max<std::size_t>(at_distance_.size(), *distance + 1));
      ++at_distance_[*distance];
    } else {
      ++cold_misses_;
    }
  }
  distinct_pages_ = stack.distinct();
}

MissCurve& MissCurve::operator+=(const MissCurve& more) {
  references_ += more.references_;
  cold_misses_ += more.cold_misses_;
  distinct_pages_ = std::max(distinct_pages_, more.distinct_pages_);
  at_distance_.resize(std::max(at_distance_.size(), more.at_distance_.size()));
  for (std::size_t distance = 0; distance < more.at_distance_.size(); ++distance) {
    at_distance_[distance] += more.at_distance_[distance];
  }
  return *this;
}

std::uint64_t MissCurve::misses(std::uint32_t cache_pages) const {
  const auto first = at_distance_.begin() + std::min<std::ptrdiff_t>(cache_pages, std::ssize(at_distance_));
  return std::accumulate(first, at_distance_.end(), cold_misses_);
}

}  // namespace dmpc::svm
