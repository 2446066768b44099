// The claims of the article's text, each compared with our runs.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/claim_rows.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

void claim_efficiency(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const std::vector<CellOfTable3> cells = cells_of_table_3(catalogue, results);
  if (cells.empty()) {
    return;
  }
  double least = 100;
  for (const CellOfTable3& cell : cells) {
    least = std::min({least, cell.efficiency, cell.efficiency_by_worker().value_or(100)});
  }
  rows.add("With up to 64 nodes the efficiency is almost always above 78 %", least > 78,
           "the least is " + fixed(least, 1) + " %");
}

/// Returns percent against one node, by node count; nothing if a run is missing.
std::optional<std::vector<double>> efficiencies_of(const std::optional<PaperResult>& first, const PaperResults& results,
                                                   const Catalogue::ByNodeCount& runs) {
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
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : ", ") + fixed(value, 1);
  }
  return text;
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
          listed(*by_rays) + " % on 1 to 64 nodes; pages " + fixed(by_pages->back(), 1) + " % on 64");
    }
  }
}

/// A point of one scene's caches: size, efficiency and traffic.
struct CachePoint {
  std::uint32_t pages = 0;  ///< in the article
  double share = 0;         ///< of the database
  double efficiency = 0, page_rate = 0;
};
std::vector<CachePoint> points_of(const Catalogue& catalogue, const PaperResults& results, std::size_t scene) {
  std::vector<CachePoint> points;
  const auto& base = results[catalogue.cache_base[scene]];
  for (std::size_t size = 0; size < cache_size_count; ++size) {
    const std::size_t number = catalogue.cached[scene][size];
    if (base && results[number]) {
      points.push_back({cache_scenes[scene].pages[size], cache_scenes[scene].share(size),
                        efficiency(base->seconds(), 1, results[number]->seconds(), cache_node_count),
                        results[number]->page_rate(cache_node_count)});
    }
  }
  return points;
}

/// Returns the smallest cache from which on all have more than 50 %; nothing if there is none. `points` are sorted by size.
std::optional<CachePoint> cache_for_half(const std::vector<CachePoint>& points) {
  const auto largest_without =
      std::find_if(points.rbegin(), points.rend(), [](const CachePoint& point) { return point.efficiency <= 50; });
  return largest_without == points.rbegin() ? std::nullopt : std::optional(*largest_without.base());
}

std::string from_cache(const std::optional<CachePoint>& cache) {
  return cache ? "from " + fixed(100 * cache->share, 2) + " % of the database on (" + std::to_string(cache->pages) +
                     " pages of the article's)"
               : "with none";
}

std::string to_text(const CachePoint& point) { return std::to_string(point.pages) + (point.pages == 1 ? " page" : " pages"); }

/// Returns the pages that a node receives as a share of what messages of 1 KB allow.
double share_of_network(const CachePoint& point) { return point.page_rate / 0.9e6; }

void claim_caches(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const std::vector<CachePoint> of_rings = points_of(catalogue, results, 0), of_tetra = points_of(catalogue, results, 1);
  if (of_rings.empty() || of_tetra.empty()) {
    return;
  }
  const std::optional<CachePoint> for_rings = cache_for_half(of_rings), for_tetra = cache_for_half(of_tetra);
  rows.add("Rings4 needs larger caches than Tetra9 to stay above 50 %, as a share of the database",
           for_tetra && (!for_rings || for_rings->share > for_tetra->share),
           "Rings4 " + from_cache(for_rings) + ", Tetra9 " + from_cache(for_tetra));
  const auto peak = std::max_element(of_rings.begin(), of_rings.end(),
                                     [](const CachePoint& a, const CachePoint& b) { return a.page_rate < b.page_rate; });
  rows.add("The communication rate of Rings4 peaks (theirs at 204 pages) and falls for smaller caches",
           peak != of_rings.begin() && peak->pages < of_rings.back().pages, "the peak is at " + to_text(*peak));
  const double share = share_of_network(*peak);
  rows.add("At the peak the network carries about 70 % of the 0.9 MB/s that messages of 1 KB allow", share > 0.6 && share < 0.8,
           "a node receives " + fixed(100 * share, 0) + " %, and sends as much");
}

void claim_faster_machine(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& slow = results[catalogue.timed[rings_row][faster_column]];
  const auto& fast = results[catalogue.faster_machine];
  if (slow && fast) {
    const double ratio = slow->seconds() / fast->seconds();
    rows.add("The iPSC/860 is about 7 times faster (Rings4, 32 nodes)", ratio > 6 && ratio < 8,
             fixed(ratio, 2) + " times; its processor is modelled as 7 times faster, so this tests the network alone");
  }
}

/// On fewer nodes than 16, any regions are loaded well.
constexpr std::size_t fewest_balanced = 4;

void claim_balance(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& subsampled = results[catalogue.rings_by_rays[0].back()];
  const auto& equal = results[catalogue.by_way(0, RayWay::equal_size)];
  if (subsampled && equal) {
    const double load = 100 * subsampled->average_load, of_equal = 100 * equal->average_load;
    std::string of_fewer;
    for (std::size_t column = paper_node_counts.size() - 1; column-- > fewest_balanced;) {
      if (const auto& fewer = results[catalogue.rings_by_rays[0][column]]) {
        of_fewer += ", " + fixed(100 * fewer->average_load, 1) + " % on " + std::to_string(paper_node_counts[column]);
      }
    }
    rows.add("Subsampled regions load nodes to about 82.5 % (Rings3), regions of equal size to less than 20 %",
             load > 77.5 && load < 87.5 && of_equal < 20,
             fixed(load, 1) + " and " + fixed(of_equal, 1) + " % on 64 nodes" +
                 (of_fewer.empty() ? "" : "; subsampled" + of_fewer.substr(1)) + "; the article does not say on how many");
  }
}

/// Uses the article's own cuts, which alternate.
void claim_cuts(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& longer = results[catalogue.rings_by_rays[0].back()];
  const auto& alternating = results[catalogue.by_way(0, RayWay::alternating)];
  if (longer && alternating) {
    const double load = 100 * alternating->average_load;
    rows.add("The same by cuts in alternating directions, as the article made them", load > 77.5 && load < 87.5,
             fixed(load, 1) + " %, and the picture takes " + fixed(alternating->seconds() / longer->seconds(), 2) +
                 " times as long as by cuts across the longer side");
  }
}

void claim_overflow(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  bool is_held = false;
  std::string found;
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& result = results[catalogue.by_way(scene, RayWay::unchecked_long)];
    if (!result) {
      return;
    }
    const double percent = 100 * result->overflowed;
    is_held = is_held || (percent > 0.25 && percent < 1);
    found += std::string(rings[scene]) + " " + fixed(percent, 2) + " %, ";
  }
  rows.add("About 0.5 % of the messages of some pictures go by way of the host", is_held,
           found + "on 64 nodes without backpressure, whose queues fill their memories");
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
  const auto& host = results[catalogue.items_assigned[article_item]];
  const auto& pixels = results[catalogue.items_assigned[1]];
  if (none && ring && host && pixels) {
    const double ratio = ring->seconds() / std::min({none->seconds(), host->seconds(), pixels->seconds()});
    rows.add("Submaps and then items on request do better than either alone (Rings4, 64 nodes)",
             ratio < 1 - tie_share   ? held
             : ratio > 1 + tie_share ? not_held
                                     : tie,
             "seconds: both " + fixed(ring->seconds(), 0) + ", submaps " + fixed(none->seconds(), 0) +
                 ", items asked of the host " + fixed(host->seconds(), 0) + ", pixels " + fixed(pixels->seconds(), 0));
  }
}

/// The cost of pages for a small scene is the look-up of cached pages, whose price is fitted to the article's own cells: the
/// result proves nothing.
void claim_copies(Claims& rows, const Catalogue& catalogue, const PaperResults& results) {
  const auto& pages = results[catalogue.timed[small_row].back()];
  const auto& copies = results[catalogue.copies];
  if (pages && copies) {
    const double ratio = pages->seconds() / copies->seconds();
    rows.add("A small scene ends up copied to all nodes at negligible cost (Teapot, 64 nodes)", not_judged,
             "pages take " + fixed(ratio, 2) + " times as long as copies made beforehand, by a price fitted to Mountain's cells");
  }
}

}  // namespace

Table claims(const Catalogue& catalogue, const PaperResults& results) {
  Claims rows("What the text claims", catalogue.resolution);
  claim_efficiency(rows, catalogue, results);
  claim_rays_fall(rows, catalogue, results);
  claim_caches(rows, catalogue, results);
  claim_faster_machine(rows, catalogue, results);
  claim_balance(rows, catalogue, results);
  claim_cuts(rows, catalogue, results);
  claim_overflow(rows, catalogue, results);
  claim_lights(rows, catalogue, results);
  claim_tests(rows, catalogue, results);
  claim_items(rows, catalogue, results);
  claim_scheduling(rows, catalogue, results);
  claim_copies(rows, catalogue, results);
  claim_extents(rows, results, catalogue.counted, catalogue.extents, "; our grid's cells have trees, too");
  return std::move(rows).table();
}

}  // namespace dmpc::apps
