#include "apps/paper_claims.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/figures.h"
#include "apps/paper_tables.h"

namespace dmpc::apps {
namespace {

void add_claim(Table& table, const std::string& claim, bool is_held, const std::string& found) {
  table.add_row({claim, is_held ? "held" : "not held", found});
}

void claim_efficiency(Table& table, const Catalogue& catalogue, const PaperResults& results) {
  const std::vector<CellOfTable3> cells = cells_of_table_3(catalogue, results);
  if (cells.empty()) {
    return;
  }
  double least = 100;
  for (const CellOfTable3& cell : cells) {
    least = std::min(least, cell.efficiency);
  }
  add_claim(table, "With up to 64 nodes the efficiency is almost always above 78 %", least > 78,
            "the least is " + fixed(least, 1) + " %");
}

void claim_rays_fall(Table& table, const Catalogue& catalogue, const PaperResults& results) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& first = results[catalogue.rings_by_pages[scene][0]];
    const auto& few = results[catalogue.rings_by_rays[scene][2]];
    const auto& many = results[catalogue.rings_by_rays[scene].back()];
    const auto& pages = results[catalogue.rings_by_pages[scene].back()];
    if (first && few && many && pages) {
      const double at_4 = efficiency(first->seconds(), 1, few->seconds(), 4);
      const double at_64 = efficiency(first->seconds(), 1, many->seconds(), 64);
      const double by_pages = efficiency(first->seconds(), 1, pages->seconds(), 64);
      add_claim(
          table,
          std::string("The efficiency of travelling rays falls with the nodes, and is below travelling pages', ") + rings[scene],
          at_64 < at_4 && at_64 < by_pages,
          fixed(at_4, 1) + " % on 4 nodes, " + fixed(at_64, 1) + " % on 64; pages " + fixed(by_pages, 1) + " %");
    }
  }
}

/// Of one scene's caches: size, efficiency and traffic.
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

/// The smallest cache with more than 50 %; nothing if none has.
std::optional<CachePoint> cache_for_half(const std::vector<CachePoint>& points) {
  const auto found = std::find_if(points.begin(), points.end(), [](const CachePoint& point) { return point.efficiency > 50; });
  return found == points.end() ? std::nullopt : std::optional(*found);
}

std::string from_cache(const std::optional<CachePoint>& cache) {
  return cache ? "from " + fixed(100 * cache->share, 2) + " % of the database on (" + std::to_string(cache->pages) +
                     " pages of the article's)"
               : "with none";
}

std::string to_text(const CachePoint& point) { return std::to_string(point.pages) + (point.pages == 1 ? " page" : " pages"); }

/// Pages that a node receives, of what messages of 1 KB allow.
double share_of_network(const CachePoint& point) { return point.page_rate / 0.9e6; }

void claim_caches(Table& table, const Catalogue& catalogue, const PaperResults& results) {
  const std::vector<CachePoint> of_rings = points_of(catalogue, results, 0), of_tetra = points_of(catalogue, results, 1);
  if (of_rings.empty() || of_tetra.empty()) {
    return;
  }
  const std::optional<CachePoint> for_rings = cache_for_half(of_rings), for_tetra = cache_for_half(of_tetra);
  add_claim(table, "Rings4 needs larger caches than Tetra9 to stay above 50 %, as a share of the database",
            for_tetra && (!for_rings || for_rings->share > for_tetra->share),
            "Rings4 " + from_cache(for_rings) + ", Tetra9 " + from_cache(for_tetra));
  const auto peak = std::max_element(of_rings.begin(), of_rings.end(),
                                     [](const CachePoint& a, const CachePoint& b) { return a.page_rate < b.page_rate; });
  add_claim(table, "The communication rate of Rings4 peaks (theirs at 204 pages) and falls for smaller caches",
            peak != of_rings.begin() && peak->pages < of_rings.back().pages, "the peak is at " + to_text(*peak));
  const double share = share_of_network(*peak);
  add_claim(table, "At the peak the network carries about 70 % of the 0.9 MB/s that messages of 1 KB allow",
            share > 0.6 && share < 0.8, "a node receives " + fixed(100 * share, 0) + " %, and sends as much");
}

void claim_faster_machine(Table& table, const Catalogue& catalogue, const PaperResults& results) {
  const auto& slow = results[catalogue.timed[2][5]];
  const auto& fast = results[catalogue.faster_machine];
  if (slow && fast) {
    const double ratio = slow->seconds() / fast->seconds();
    add_claim(table, "The iPSC/860 is about 7 times faster (Rings4, 32 nodes)", ratio > 6 && ratio < 8,
              fixed(ratio, 2) + " times; its processor is modelled as 7 times faster, so this tests the network alone");
  }
}

}  // namespace

Table claims(const Catalogue& catalogue, const PaperResults& results) {
  Table table("What the text claims", {{"claim"}, {"verdict"}, {"found"}});
  claim_efficiency(table, catalogue, results);
  claim_rays_fall(table, catalogue, results);
  claim_caches(table, catalogue, results);
  claim_faster_machine(table, catalogue, results);
  return table;
}

}  // namespace dmpc::apps
