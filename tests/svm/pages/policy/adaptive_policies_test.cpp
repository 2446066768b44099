// The policies that remember what has left, beside their definitions on lists of pages.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "svm/pages/cache.h"
#include "tests/support/small_pages.h"

namespace adaptive_policies_test {

using namespace dmpc;
using svm::Replacement;

namespace {

using Page = std::uint32_t;
/// The newest in front.
using List = std::list<Page>;

bool take(List& list, Page page) {
  const auto place = std::find(list.begin(), list.end(), page);
  const bool is_there = place != list.end();
  if (is_there) {
    list.erase(place);
  }
  return is_there;
}

Page take_oldest(List& list) {
  const Page oldest = list.back();
  list.pop_back();
  return oldest;
}

/// What a reference does.
struct Step {
  bool is_hit = false;
  std::optional<Page> evicted = std::nullopt;
  bool operator==(const Step&) const = default;
};

/// A policy as its paper defines it.
struct Model {
  explicit Model(std::size_t frames) : c(frames) {}
  virtual ~Model() = default;
  virtual Step refer(Page page) = 0;
  std::size_t c;
};

/// Megiddo and Modha (2003), figure 4.
struct AdaptiveModel : Model {
  using Model::Model;
  List t1, t2, b1, b2;
  std::size_t p = 0;

  Page replace(bool was_in_b2) {
    const bool first = !t1.empty() && ((was_in_b2 && t1.size() == p) || t1.size() > p);
    List& from = first || t2.empty() ? t1 : t2;
    const Page page = take_oldest(from);
    (&from == &t1 ? b1 : b2).push_front(page);
    return page;
  }
  Step refer(Page page) override {
    if (take(t1, page) || take(t2, page)) {
      t2.push_front(page);
      return {.is_hit = true};
    }
    const std::size_t b1_size = b1.size(), b2_size = b2.size();
    if (take(b1, page)) {
      p = std::min(c, p + std::max<std::size_t>(b2_size / b1_size, 1));
      const Page evicted = replace(false);
      t2.push_front(page);
      return {.evicted = evicted};
    }
    if (take(b2, page)) {
      const std::size_t less = std::max<std::size_t>(b1_size / b2_size, 1);
      p = p > less ? p - less : 0;
      const Page evicted = replace(true);
      t2.push_front(page);
      return {.evicted = evicted};
    }
    std::optional<Page> evicted;
    const std::size_t all = t1.size() + t2.size() + b1.size() + b2.size();
    if (t1.size() + b1.size() == c) {
      if (t1.size() < c) {
        b1.pop_back();
        evicted = replace(false);
      } else {
        evicted = take_oldest(t1);
      }
    } else if (all >= c) {
      if (all == 2 * c) {
        b2.pop_back();
      }
      evicted = replace(false);
    }
    t1.push_front(page);
    return {.evicted = evicted};
  }
};

/// Johnson and Shasha (1994), the full version.
struct TwoQueuesModel : Model {
  using Model::Model;
  List in, out, kept;

  Step refer(Page page) override {
    if (std::find(in.begin(), in.end(), page) != in.end()) {
      return {.is_hit = true};
    }
    if (take(kept, page)) {
      kept.push_front(page);
      return {.is_hit = true};
    }
    const bool comes_back = take(out, page);
    std::optional<Page> evicted;
    if (in.size() + kept.size() == c) {
      if (in.size() > std::max<std::size_t>(c / 4, 1) || kept.empty()) {
        evicted = take_oldest(in);
        out.push_front(*evicted);
        if (out.size() > std::max<std::size_t>(c / 2, 1)) {
          out.pop_back();
        }
      } else {
        evicted = take_oldest(kept);
      }
    }
    (comes_back ? kept : in).push_front(page);
    return {.evicted = evicted};
  }
};

/// Yang and others (2023), algorithm 1.
struct SmallAndMainModel : Model {
  using Model::Model;
  struct Entry {
    Page page;
    int hits;
  };
  std::list<Entry> small, main;
  List ghosts;

  std::size_t small_max() const { return std::max<std::size_t>(c / 10, 1); }
  Page leave_main() {
    while (true) {
      Entry last = main.back();
      main.pop_back();
      if (last.hits == 0) {
        return last.page;
      }
      main.push_front({last.page, last.hits - 1});
    }
  }
  Page leave() {
    if (small.size() < small_max()) {
      return leave_main();
    }
    while (true) {
      const Entry last = small.back();
      small.pop_back();
      if (last.hits <= 1) {
        ghosts.push_front(last.page);
        if (ghosts.size() > std::max<std::size_t>(c - small_max(), 1)) {
          ghosts.pop_back();
        }
        return last.page;
      }
      main.push_front({last.page, 0});
      if (main.size() > c - small_max()) {
        return leave_main();
      }
    }
  }
  Step refer(Page page) override {
    for (std::list<Entry>* queue : {&small, &main}) {
      for (Entry& entry : *queue) {
        if (entry.page == page) {
          entry.hits = std::min(entry.hits + 1, 3);
          return {.is_hit = true};
        }
      }
    }
    const bool comes_back = take(ghosts, page);
    std::optional<Page> evicted;
    if (small.size() + main.size() == c) {
      evicted = leave();
    }
    (comes_back ? main : small).push_front({page, 0});
    return {.evicted = evicted};
  }
};

std::unique_ptr<Model> model_of(Replacement replacement, std::size_t frames) {
  switch (replacement) {
    case Replacement::adaptive:
      return std::make_unique<AdaptiveModel>(frames);
    case Replacement::two_queues:
      return std::make_unique<TwoQueuesModel>(frames);
    default:
      return std::make_unique<SmallAndMainModel>(frames);
  }
}

/// A cache in a memory of exactly the size that it says it needs.
struct SmallCache {
  SmallCache(Replacement replacement, std::uint32_t frames)
      : shape{frames, tests::page_size, replacement}, memory(svm::Cache::layout(shape)), cache(memory, shape, 0) {}
  Step refer(Page page) {
    const std::uint32_t frame = cache.frame_of(svm::PageId{page});
    if (frame != svm::Cache::no_frame) {
      cache.touch(frame);
      return {.is_hit = true};
    }
    const svm::PageId evicted = cache.install(svm::PageId{page}, std::vector<std::byte>(tests::page_size));
    cache.touch(cache.frame_of(svm::PageId{page}));
    return {.evicted = evicted == svm::no_page ? std::nullopt : std::optional(svm::index_of(evicted))};
  }

  svm::CacheShape shape;
  nodes::LocalMemory memory;
  svm::Cache cache;
};

constexpr auto remembering = {Replacement::two_queues, Replacement::adaptive, Replacement::small_and_main};

std::vector<bool> hits(Replacement replacement, std::uint32_t frames, const std::vector<Page>& references) {
  SmallCache small(replacement, frames);
  std::vector<bool> hits;
  for (const Page page : references) {
    hits.push_back(small.refer(page).is_hit);
  }
  return hits;
}

}  // namespace

TEST_CASE("2q, arc and s3-fifo find and evict what their definitions on lists do") {
  for (const Replacement replacement : remembering) {
    for (const std::uint32_t frames : {1U, 2U, 3U, 4U, 7U, 16U, 64U, 100U}) {
      for (const std::uint32_t seed : {1U, 2U, 3U}) {
        SmallCache small(replacement, frames);
        const std::unique_ptr<Model> model = model_of(replacement, frames);
        std::mt19937 generator(seed);
        Page last = 0;
        for (int i = 0; i < 6000; ++i) {
          // Small pages often, and now and then a stretch of new ones: ghosts of both lists come back.
          const std::uint32_t reach = (i / 500) % 3 == 2 ? 20 * frames : 2 * frames + 2;
          const Page page = static_cast<Page>(generator()) % reach / (1U + static_cast<Page>(generator()) % 4U);
          if (i > 0 && page == last) {
            continue;  // several in a row are one
          }
          last = page;
          INFO(svm::name_of(replacement), ", frames ", frames, ", seed ", seed, ", reference ", i, " of page ", page);
          const Step expected = model->refer(page);
          REQUIRE(small.refer(page) == expected);
        }
      }
    }
  }
}

TEST_CASE("pages referenced again and again outlive a scan of new ones under arc and s3-fifo, not under lru") {
  std::vector<Page> references;
  for (int i = 0; i < 4; ++i) {
    for (Page page = 0; page < 40; ++page) {
      references.push_back(page % 8);  // eight pages again and again, so often that all policies know them
    }
    for (Page page = 0; page < 40; ++page) {
      references.push_back(1000U + 40U * static_cast<Page>(i) + page);  // then 40 that never come back
    }
  }
  const auto count_late = [&](Replacement replacement) {
    const std::vector<bool> all = hits(replacement, 20, references);
    // The first eight after each scan but the first two rounds.
    return std::count(all.begin() + 160, all.begin() + 168, true) + std::count(all.begin() + 240, all.begin() + 248, true);
  };
  CHECK(count_late(Replacement::lru) == 0);
  CHECK(count_late(Replacement::adaptive) == 16);
  CHECK(count_late(Replacement::small_and_main) == 16);
}

TEST_CASE("under 2q a page that comes back while it is remembered outlives a scan, and one that was hit in the queue does not") {
  const std::vector<Page> references = {1, 2, 3, 2, 4, 5, 1, 6, 7, 8, 9, 10, 1, 2};
  CHECK(hits(Replacement::two_queues, 4, references) ==
        std::vector<bool>{false, false, false, true, false, false, false, false, false, false, false, false, true, false});
}

TEST_CASE("references in a row are one, and those in turn with others are hits") {
  // Under arc a page that is hit goes to the pages seen again; the one seen once leaves first.
  SmallCache small(Replacement::adaptive, 2);
  small.refer(1);
  small.refer(2);
  small.refer(2);
  CHECK(small.refer(1) == Step{.is_hit = true});
  CHECK(small.refer(3) == Step{.evicted = 2});
  CHECK(small.refer(4) == Step{.evicted = 3});
  CHECK(small.refer(1) == Step{.is_hit = true});
}

}  // namespace adaptive_policies_test
