// The claims of the article's text, each compared with our runs.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/lab/study/paper/claim_rows.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

void claim_efficiency(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  double least = 100;
  const std::vector<TimedCell> cells = cells_of(catalogue.article, results);
  for (const TimedCell& cell : cells) {
    least = std::min({least, cell.efficiency.value_or(100), cell.efficiency_by_worker().value_or(100)});
  }
  if (!cells.empty()) {
    rows.add("With up to 64 nodes the efficiency is almost always above 78 %", least > 78,
             "the least is " + fixed(least, 1) + " %");
  }
}

/// Returns percent against one node, by node count; nothing if a run is missing.
std::optional<std::vector<double>> efficiencies_of(const std::optional<PaperResult>& first, const PaperResults& results,
                                                   const RunsByNodeCount& runs) {
  std::vector<double> efficiencies;
  for (std::size_t column = 0; column < runs.size(); ++column) {
    const auto& result = results[runs[column]];
    if (!first || !result) {
      return std::nullopt;
    }
    efficiencies.push_back(efficiency(first->seconds(), 1, result->seconds(), paper_node_counts[column]));
  }
  return efficiencies;
}

/// Each value must be below the one before; it is a tie if two are the same to the digits shown, and none rises.
const char* verdict_of_fall(const std::vector<double>& values) {
  double least_fall = values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    least_fall = std::min(least_fall, values[i - 1] - values[i]);
  }
  constexpr double shown = 0.05;  // half of the last digit
  return least_fall > shown ? held : least_fall >= -shown ? tie : not_held;
}

/// "100.0, 97.5, 96.0".
std::string listed(const std::vector<double>& values) {
  return joined(values, ", ", [&](const double value) { return fixed(value, 1); });
}

void claim_rays_fall(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& first = results[catalogue.rings_by_pages[scene][0]];
    const auto by_rays = efficiencies_of(first, results, catalogue.rings_by_rays[scene]);
    const auto by_pages = efficiencies_of(first, results, catalogue.rings_by_pages[scene]);
    if (by_rays && by_pages) {
      rows.add(
          std::string("The efficiency of travelling rays falls with the nodes, and is below travelling pages', ") + rings[scene],
          by_rays->back() < by_pages->back() ? verdict_of_fall(*by_rays) : not_held,
          listed(*by_rays) + " % on 1 to 64 nodes; pages " + fixed(by_pages->back(), 1) + " % on 64",
          "two numbers of nodes differ by less than the cuts that the subsampled picture happens to make");
    }
  }
}

/// A point of one scene's caches: size, efficiency and traffic.
struct CachePoint {
  std::uint32_t pages = 0;  ///< of 1 KB
  double share = 0;         ///< of the article's database
  double efficiency = 0;
  double traffic = 0;  ///< of the network's, both ways
};
/// Returns nothing unless all sizes are known.
std::vector<CachePoint> points_of(const Catalogue& catalogue, const PaperResults& results, std::size_t scene) {
  std::vector<CachePoint> points;
  const auto& base = results[catalogue.cache_base[scene]];
  for (std::size_t size = 0; size < cache_size_count; ++size) {
    if (const auto& result = results[catalogue.cached[scene][size]]; base && result) {
      points.push_back({cache_scenes[scene].pages[size], cache_scenes[scene].share(size),
                        efficiency(base->seconds(), 1, result->seconds(), cache_node_count),
                        network_share(*result, cache_node_count)});
    }
  }
  return points.size() == cache_size_count ? points : std::vector<CachePoint>();
}

/// Returns the smallest cache from which on all have more than 50 %; nothing if there is none. `points` are sorted by size.
std::optional<CachePoint> cache_for_half(const std::vector<CachePoint>& points) {
  const auto largest_without =
      std::find_if(points.rbegin(), points.rend(), [](const CachePoint& point) { return point.efficiency <= 50; });
  return largest_without == points.rbegin() ? std::nullopt : std::optional(*largest_without.base());
}

std::string from_cache(const std::optional<CachePoint>& cache) {
  return cache ? "from " + std::to_string(cache->pages) + " pages on, " + fixed(100 * cache->share, 2) + " % of the database"
               : "with none";
}

/// "204 pages 30 %, 102 pages 56 %": down to the smallest.
std::string traffic_text(const std::vector<CachePoint>& points) {
  std::string text;
  for (auto point = points.rbegin(); point != points.rend(); ++point) {
    if (point->pages <= peak_pages) {
      text += (text.empty() ? "" : ", ") + counted(point->pages, "page") + " " + fixed(100 * point->traffic, 0) + " %";
    }
  }
  return text;
}

void claim_caches(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const std::vector<CachePoint> of_rings = points_of(catalogue, results, 0), of_tetra = points_of(catalogue, results, 1);
  if (of_rings.empty() || of_tetra.empty()) {
    return;
  }
  const std::optional<CachePoint> for_rings = cache_for_half(of_rings), for_tetra = cache_for_half(of_tetra);
  rows.add("Rings4 needs larger caches than Tetra9 to stay above 50 %, as a share of the database",
           for_tetra && (!for_rings || for_rings->share > for_tetra->share),
           "Rings4 " + from_cache(for_rings) + "; Tetra9 " + from_cache(for_tetra));
  const auto peak = std::max_element(of_rings.begin(), of_rings.end(),
                                     [](const CachePoint& a, const CachePoint& b) { return a.traffic < b.traffic; });
  rows.add("The communication rate of Rings4 peaks (theirs at 204 pages) and falls for smaller caches",
           peak != of_rings.begin() && peak->pages < of_rings.back().pages,
           "the most travels with " + counted(peak->pages, "page"),
           "open: a node waits for each page, so it asks no faster than pages come, and nothing modelled slows them");
  const auto at_peak = std::find_if(of_rings.begin(), of_rings.end(), [](const auto& one) { return one.pages == peak_pages; });
  rows.add("At the peak the network carries about 70 % of the 0.9 MB/s that messages of 1 KB allow",
           at_peak->traffic > peak_share - 0.1 && at_peak->traffic < peak_share + 0.1, "both ways with " + traffic_text(of_rings),
           "the level is reached by smaller caches; what slows theirs with 204 pages is open");
}

void claim_faster_machine(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& slow = results[catalogue.article.timed[rings_row][cache_column]];
  const auto& fast = results[catalogue.faster_machine];
  if (slow && fast) {
    const double ratio = slow->seconds() / fast->seconds();
    rows.add("The iPSC/860 is about 7 times faster (Rings4, 32 nodes)", ratio > 6 && ratio < 8,
             fixed(ratio, 2) + " times; its processor is modelled as 7 times faster, so this tests the network alone");
  }
}

/// Returns "92.4, 89.8, 87.6"; nothing if a run is missing.
std::optional<std::string> loads_text(const PaperResults& results,
                                      const std::array<std::size_t, loaded_node_counts.size()>& runs) {
  std::string text;
  for (const std::size_t run : runs) {
    if (!results[run]) {
      return std::nullopt;
    }
    text += (text.empty() ? "" : ", ") + fixed(100 * results[run]->average_load, 1);
  }
  return text;
}

/// Judged at one of the numbers of nodes, as the article does not say which.
void claim_loads(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  std::array<std::size_t, loaded_node_counts.size()> by_loads{};
  std::copy_n(catalogue.rings_by_rays[0].begin() + loaded_column, by_loads.size(), by_loads.begin());
  const auto subsampled = loads_text(results, by_loads), equal = loads_text(results, catalogue.equal_sizes);
  if (!subsampled || !equal) {
    return;
  }
  bool is_held = false;
  for (std::size_t i = 0; i < by_loads.size(); ++i) {
    const double load = 100 * results[by_loads[i]]->average_load,
                 of_equal = 100 * results[catalogue.equal_sizes[i]]->average_load;
    is_held = is_held || (load > 77.5 && load < 87.5 && of_equal < 20);
  }
  rows.add("Subsampled regions load nodes to about 82.5 % (Rings3), regions of equal size to less than 20 %", is_held,
           *subsampled + " % and " + *equal + " % on 16, 32 and 64 nodes; the article does not say on how many",
           "a plain grid spreads a ray's work along its way, so regions are loaded more evenly than theirs");
}

void claim_overflow(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  bool is_held = false;
  std::string by_usual_queues, by_long_ones;
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto &usual = results[catalogue.by_way(scene, RayWay::as_in_1994)],
               &long_queue = results[catalogue.by_way(scene, RayWay::long_queue)];
    if (!usual || !long_queue) {
      return;
    }
    for (const auto& result : {usual, long_queue}) {
      is_held = is_held || (result->overflowed > 0.0025 && result->overflowed < 0.01);
    }
    by_usual_queues += (scene == 0 ? "" : " and ") + fixed(100 * usual->overflowed, 2);
    by_long_ones += (scene == 0 ? "" : ", ") + std::string(rings[scene]) + " " + fixed(100 * long_queue->overflowed, 2) + " %";
  }
  rows.add("About 0.5 % of the messages of some pictures go by way of the host", is_held,
           by_long_ones + " by queues that fill the memories, otherwise " + by_usual_queues + " %, on 64 nodes",
           "the length of their queues and the rays of a message are not printed");
}

/// On these numbers of nodes Rings4 did not fit.
void claim_misfit(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  if (results[catalogue.rings_by_rays[1][1]] && results[catalogue.rings_by_rays[1][2]]) {
    rows.add("On 2 and 4 nodes Rings4 does not fit into 4 MB by travelling rays", false, "it fits",
             "open: half of the scene's 4.6 MB and the queues fit into 4 MB");
  }
}

/// Twice the mean counts as a flood, a quarter above it does not.
void claim_lights(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& rays = results[catalogue.lit_by_rays];
  const auto& pages = results[catalogue.lit_by_pages];
  if (rays && pages) {
    rows.add("A light inside floods its region with shadow rays; where pages travel it is cached (Rings4)",
             rays->flood > 2 && pages->flood < 1.25,
             "its region gets " + fixed(rays->flood, 1) + " times the mean of shadow rays; no node sends over " +
                 fixed(pages->flood, 2) + " times the mean of pages; 64 nodes");
  }
}

void claim_tests(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& one = results[catalogue.rings_by_rays[1].front()];
  const auto& many = results[catalogue.rings_by_rays[1].back()];
  if (one && many && one->tests > 0) {
    const double ratio = static_cast<double>(many->tests) / static_cast<double>(one->tests);
    rows.add("An object in several regions is intersected again in each (Rings4)", ratio > 1,
             fixed(ratio, 2) + " times the tests on 64 nodes as on one");
  }
}

void claim_items(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto is_known = [&](std::size_t run) { return results[run].has_value(); };
  if (!std::all_of(catalogue.items.begin(), catalogue.items.end(), is_known)) {
    return;
  }
  const auto seconds = [&](std::size_t size) { return results[catalogue.items[size]]->seconds(); };
  double least = seconds(0);
  std::string found;
  for (std::size_t size = 0; size < item_sides.size(); ++size) {
    least = std::min(least, seconds(size));
    found += (size > 0 ? ", " : "") + item_text(item_sides[size]) + " " + fixed(seconds(size), 0);
  }
  rows.add("Work items of about 3x3 pixels are the good compromise (Rings4, 64 nodes)",
           seconds(article_item) <= (1 + tie_share) * least, "seconds: " + found);
}

/// Static and on-demand assignment are compared with the article's method, which is both.
void claim_scheduling(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& none = results[catalogue.items.front()];
  const auto& ring = results[catalogue.items[article_item]];
  const auto& host = results[catalogue.assigned_items];
  const auto& pixels = results[catalogue.assigned_pixels];
  if (none && ring && host && pixels) {
    const double ratio = ring->seconds() / std::min({none->seconds(), host->seconds(), pixels->seconds()});
    rows.add("Submaps and then items on request do better than either alone (Rings4, 64 nodes)",
             ratio < 1 - tie_share   ? held
             : ratio > 1 + tie_share ? not_held
                                     : tie,
             "seconds: both " + fixed(ring->seconds(), 0) + ", submaps " + fixed(none->seconds(), 0) +
                 ", items asked of the host " + fixed(host->seconds(), 0) + ", pixels " + fixed(pixels->seconds(), 0),
             "the host answers at once here, and takes no time of a node's; submaps have fewer faults");
  }
}

/// The cost of pages for a small scene is the look-up of cached pages, whose price is fitted to the article's own cells: the
/// result proves nothing.
void claim_copies(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& pages = results[catalogue.article.timed[small_row].back()];
  const auto& copies = results[catalogue.copies];
  if (pages && copies) {
    const double ratio = pages->seconds() / copies->seconds();
    rows.add("A small scene ends up copied to all nodes at negligible cost (Teapot, 64 nodes)", not_judged,
             "pages take " + fixed(ratio, 2) + " times as long as copies made beforehand",
             "the difference is the price of a look-up, which is fitted to the article's own cells");
  }
}

}  // namespace

Table claims(const Catalogue& catalogue, const PaperResults& results) {
  Claims rows(catalogue.resolution);
  claim_efficiency(rows, catalogue, results);
  claim_rays_fall(rows, catalogue, results);
  claim_misfit(rows, catalogue, results);
  claim_caches(rows, catalogue, results);
  claim_faster_machine(rows, catalogue, results);
  claim_loads(rows, catalogue, results);
  claim_overflow(rows, catalogue, results);
  claim_lights(rows, catalogue, results);
  claim_tests(rows, catalogue, results);
  claim_items(rows, catalogue, results);
  claim_scheduling(rows, catalogue, results);
  claim_copies(rows, catalogue, results);
  claim_extents(rows, results, catalogue.counted, catalogue.extents);
  return std::move(rows).table();
}

}  // namespace dmpc::apps
