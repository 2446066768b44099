#include "apps/frontend/show/page/view_tables.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/geometric_sizes.h"
#include "core/base/ranges.h"

namespace dmpc::apps::html {

namespace {

using svm::Fetch;
using svm::Fetches;

constexpr std::size_t pages_listed = 20;
constexpr std::size_t part_count = svm::fetch_part_names.size();

double microseconds(double ns) { return ns / 1000; }

std::size_t node_count_of(const nodes::ActivitySteps& steps) { return steps.nodes.size() - 1; }  // the host is the last
std::size_t step_count_of(const nodes::ActivitySteps& steps) { return steps.nodes.front().size(); }

/// The time of all nodes but the host, which is the last, with work or waits of one kind.
template <class Times>
std::uint64_t sum_ns(const std::vector<std::vector<Times>>& nodes, std::size_t step, std::size_t kind) {
  return std::accumulate(nodes.begin(), nodes.end() - 1, std::uint64_t{0},
                         [&](std::uint64_t sum, const std::vector<Times>& node) { return sum + node[step][kind]; });
}

/// The kinds, of those that have names, of which there are any.
template <class Times>
std::vector<std::size_t> kinds_found(const std::vector<std::vector<Times>>& nodes, std::span<const std::string> names) {
  std::vector<std::size_t> found;
  for (std::size_t kind = 0; kind < names.size(); ++kind) {
    for (std::size_t step = 0; step < nodes.front().size(); ++step) {
      if (sum_ns(nodes, step, kind) > 0) {
        found.push_back(kind);
        break;
      }
    }
  }
  return found;
}

/// As columns and series: the parts of which any fetch has some.
std::vector<std::size_t> parts_found(const Fetches& fetches) {
  std::vector<std::size_t> found;
  for (std::size_t part = 0; part < part_count; ++part) {
    if (std::any_of(fetches.sample.begin(), fetches.sample.end(),
                    [part](const Fetch& fetch) { return fetch.part_ns[part] > 0; })) {
      found.push_back(part);
    }
  }
  return found;
}

/// The mean of fetches that are sorted by their length.
double mean_ns(std::span<const Fetch> fetches, std::size_t part) {
  const double sum = std::accumulate(fetches.begin(), fetches.end(), 0.0, [part](double before, const Fetch& fetch) {
    return before + static_cast<double>(fetch.part_ns[part]);
  });
  return fetches.empty() ? 0 : sum / static_cast<double>(fetches.size());
}

std::vector<Fetch> sorted(const Fetches& fetches) {
  std::vector<Fetch> all = fetches.sample;
  std::stable_sort(all.begin(), all.end(), [](const Fetch& a, const Fetch& b) { return a.total_ns() < b.total_ns(); });
  return all;
}

/// The hundredth of all around the one of which `share` are shorter; at least one.
std::span<const Fetch> around(std::span<const Fetch> all, double share) {
  const std::size_t width = std::max<std::size_t>(1, all.size() / 100);
  const auto middle = static_cast<std::size_t>(share * static_cast<double>(all.size()));
  const std::size_t first = std::min(middle - std::min(middle, width / 2), all.size() - width);
  return all.subspan(first, width);
}

void add_fetch_row(Table& table, const std::string& name, std::span<const Fetch> fetches, std::span<const std::size_t> parts) {
  std::vector<Cell> row = {name};
  double whole = 0;
  for (const std::size_t part : parts) {
    const double mean = microseconds(mean_ns(fetches, part));
    row.emplace_back(mean);
    whole += mean;
  }
  row.emplace_back(whole);
  table.add_row(std::move(row));
}

/// The nearest rank of sorted values.
double quantile(std::span<const double> values, double share) {
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void add_distribution(Table& table, const std::string& name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  table.add_row({name, mean, quantile(values, 0.5), quantile(values, 0.95), quantile(values, 0.99), values.back()});
}

template <class ValueOf>
std::vector<double> values_of(const Fetches& fetches, const ValueOf& value_of) {
  return core::mapped<double>(fetches.sample,
                              [&](const Fetch& fetch) { return microseconds(static_cast<double>(value_of(fetch))); });
}

std::string sample_note(const Fetches& fetches) {
  const std::string count = grouped(fetches.sample.size()) + (fetches.sample.size() == 1 ? " fetch" : " fetches");
  return fetches.every == 1 ? "All " + count : "One fetch in " + std::to_string(fetches.every) + ", " + count;
}

/// Numbers of the pages, the most fetched first.
std::vector<std::uint32_t> by_heat(const Fetches& fetches) {
  std::vector<std::uint32_t> pages(fetches.by_page.size());
  std::iota(pages.begin(), pages.end(), 0U);
  std::stable_sort(pages.begin(), pages.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return fetches.by_page[a] > fetches.by_page[b]; });
  return pages;
}

double total_fetches(const Fetches& fetches) {
  return static_cast<double>(std::accumulate(fetches.by_page.begin(), fetches.by_page.end(), std::uint64_t{0}));
}

}  // namespace

Table step_table(const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
                 std::span<const std::string> wait_names) {
  const std::vector<std::size_t> waits = kinds_found(steps.waits, wait_names);
  const int digits = steps.step_ns < 10'000 ? 3 : steps.step_ns < 100'000 ? 2 : steps.step_ns < 1'000'000 ? 1 : 0;
  std::vector<Column> columns = {{"since the start", "ms", digits}};
  for (const std::string& name : work_names) {
    columns.push_back({name, "%", 1});
  }
  for (const std::size_t wait : waits) {
    columns.push_back({wait_names[wait], "%", 1});
  }
  Table table("What the nodes were busy with over time", std::move(columns));
  for (std::size_t step = 0; step < step_count_of(steps); ++step) {
    const auto whole_ns = static_cast<double>(steps.length_ns(step) * node_count_of(steps));
    std::vector<Cell> row = {static_cast<double>(step * steps.step_ns) / 1e6};
    for (std::size_t work = 0; work < work_names.size(); ++work) {
      row.emplace_back(percent_of(static_cast<double>(sum_ns(steps.nodes, step, work)), whole_ns));
    }
    for (const std::size_t wait : waits) {
      row.emplace_back(percent_of(static_cast<double>(sum_ns(steps.waits, step, wait)), whole_ns));
    }
    table.add_row(std::move(row));
  }
  table.add_note("Of all nodes' time." + std::string(wait_names.empty() ? " What is left they waited." : ""));
  return table;
}

Plot step_plot(const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
               std::span<const std::string> wait_names) {
  Plot plot = curves("steps", "What the nodes were busy with over time", "since the start", {.label = "since the start"},
                     {.label = "of the nodes' time (%)", .least = 0}, {});
  const auto add = [&plot](const std::string& name) { plot.series.push_back({name, name, PlotMark::bars, plot.series.size()}); };
  for (const std::size_t work : kinds_found(steps.nodes, work_names)) {
    add(work_names[work]);
  }
  for (const std::size_t wait : kinds_found(steps.waits, wait_names)) {
    add(wait_names[wait]);
  }
  plot.bar_width = static_cast<double>(steps.step_ns) / 1e6;
  plot.is_stacked = true;
  return plot;
}

NumberMap step_map(const nodes::ActivitySteps& steps) {
  NumberMap map{.title = "How busy each node was over time",
                .row_label = "node",
                .column_label = "since the start",
                .value_label = "busy (%)",
                .unit = "%",
                .rows = node_count_of(steps),
                .columns = step_count_of(steps),
                .column_ns = static_cast<double>(steps.step_ns),
                .most = 100};
  for (std::size_t node = 0; node < map.rows; ++node) {
    for (std::size_t step = 0; step < map.columns; ++step) {
      const nodes::WorkTimes& times = steps.nodes[node][step];
      const auto busy_ns = static_cast<double>(std::accumulate(times.begin(), times.end(), std::uint64_t{0}));
      map.values.push_back(percent_of(busy_ns, static_cast<double>(steps.length_ns(step))));
    }
  }
  return map;
}

NumberMap pair_map(std::span<const std::uint64_t> counts, const std::string& title, const std::string& row_label,
                   const std::string& column_label, const std::string& value_label) {
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(counts.size())) + 0.5);
  return {.title = title,
          .row_label = row_label,
          .column_label = column_label,
          .value_label = value_label,
          .unit = {},
          .rows = side,
          .columns = side,
          .values = std::vector<double>(counts.begin(), counts.end())};
}

Table fetch_table(const Fetches& fetches) {
  const std::vector<std::size_t> parts = parts_found(fetches);
  std::vector<Column> columns = {{"fetches", "", 0}};
  for (const std::size_t part : parts) {
    columns.push_back({std::string(svm::fetch_part_names[part]), "us", 1});
  }
  columns.push_back({"in all", "us", 1});
  Table table("What fetching a page takes", std::move(columns));
  const std::vector<Fetch> all = sorted(fetches);
  if (!all.empty()) {
    add_fetch_row(table, "mean", all, parts);
    add_fetch_row(table, "p50", around(all, 0.5), parts);
    add_fetch_row(table, "p95", around(all, 0.95), parts);
    add_fetch_row(table, "p99", around(all, 0.99), parts);
  }
  table.add_note(sample_note(fetches) +
                 ". From the start of the request until the page is taken; p95: means of the hundredth of the fetches around the "
                 "95th percentile.");
  return table;
}

Plot fetch_plot(const Fetches& fetches) {
  Plot plot = curves("fetches", "What fetching a page takes", "fetches", {}, {.label = "", .least = 0}, {});
  for (const std::size_t part : parts_found(fetches)) {
    const std::string name(svm::fetch_part_names[part]);
    plot.series.push_back({name, name, PlotMark::bars, part});
  }
  plot.is_stacked = true;
  return plot;
}

Table fetch_part_table(const Fetches& fetches) {
  Table table("Each part of a fetch by itself",
              {{"part", "", 0}, {"mean", "us", 1}, {"p50", "us", 1}, {"p95", "us", 1}, {"p99", "us", 1}, {"most", "us", 1}});
  if (fetches.sample.empty()) {
    return table;
  }
  for (const std::size_t part : parts_found(fetches)) {
    add_distribution(table, std::string(svm::fetch_part_names[part]),
                     values_of(fetches, [part](const Fetch& fetch) { return fetch.part_ns[part]; }));
  }
  add_distribution(table, "in all", values_of(fetches, [](const Fetch& fetch) { return fetch.total_ns(); }));
  add_distribution(table, "of it waiting for links", values_of(fetches, [](const Fetch& fetch) { return fetch.links_ns; }));
  table.add_note("Only the means of the parts add up to the mean of the whole.");
  return table;
}

Table page_table(const Fetches& fetches) {
  Table table("The hottest pages",
              {{"page", "", 0}, {"home", "", 0}, {"fetched", "", 0}, {"of all fetches", "%", 2}, {"nodes' mean", "", 2}});
  const double whole = total_fetches(fetches);
  const std::vector<std::uint32_t> pages = by_heat(fetches);
  for (std::size_t i = 0; i < std::min(pages_listed, pages.size()); ++i) {
    const std::uint64_t count = fetches.by_page[pages[i]];
    if (count > 0) {
      table.add_row({std::uint64_t{pages[i]}, std::uint64_t{fetches.home_of(pages[i])}, count,
                     percent_of(static_cast<double>(count), whole),
                     static_cast<double>(count) / std::max(1.0, static_cast<double>(fetches.requester_count()))});
    }
  }
  if (are_at_host(fetches.where)) {
    table.add_note("Home " + std::to_string(fetches.requester_count()) + " is the host.");
  }
  table.add_note("Nodes' mean: how often each of the other nodes fetched the page, on average.");
  return table;
}

Table page_share_table(const Fetches& fetches) {
  Table table("What the hottest pages have of all fetches",
              {{"pages", "", 0}, {"of all pages", "%", 2}, {"of all fetches", "%", 1}});
  const std::vector<std::uint32_t> pages = by_heat(fetches);
  const double whole = total_fetches(fetches);
  std::uint64_t sum = 0;
  std::size_t next = 1;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    sum += fetches.by_page[pages[i]];
    if (i + 1 == next || i + 1 == pages.size()) {
      table.add_row({std::uint64_t{i + 1}, percent_of(static_cast<double>(i + 1), static_cast<double>(pages.size())),
                     percent_of(static_cast<double>(sum), whole)});
      next = next + (next + 1) / 2;
    }
  }
  return table;
}

Plot page_share_plot() {
  return curves("page_shares", "What the hottest pages have of all fetches", "pages",
                {.label = "hottest pages", .scale = PlotScale::powers_of_10}, percent_axis("of all fetches"),
                {{"of all fetches", "of all fetches"}});
}

Table miss_table(const MissEstimate& estimate, std::uint32_t page_count, std::uint64_t references, std::uint32_t cache_pages,
                 std::uint64_t faults) {
  Table table("Faults by the size of the caches",
              {{"cache", "pages", 0}, {"faults", "", 0}, {"of all look-ups", "%", 3}, {"this run", "%", 3}});
  const std::uint32_t size_min = estimate.cache_pages_min();
  std::vector<std::uint32_t> sizes = geometric_sizes(page_count, 24);
  std::erase_if(sizes, [&](std::uint32_t size) { return size < size_min; });
  sizes.push_back(cache_pages);
  std::sort(sizes.begin(), sizes.end());
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  for (const std::uint32_t size : sizes) {
    const double whole = static_cast<double>(references), misses = std::min(estimate.misses(size), whole);
    std::vector<Cell> row = {std::uint64_t{size}};
    row.resize(table.columns().size());
    if (size >= size_min) {
      row[1] = static_cast<std::uint64_t>(misses);
      row[2] = percent_of(misses, whole);
    }
    if (size == cache_pages) {
      row.back() = percent_of(static_cast<double>(faults), whole);
    }
    table.add_row(std::move(row));
  }
  table.add_note("LRU, from the stack distances of this run's references in their own order. This run: pages that it fetched.");
  if (estimate.every > 1) {
    table.add_note("Estimated from the references of one page in " + std::to_string(estimate.every) +
                   " (SHARDS), which say nothing about caches of less than " + std::to_string(size_min) + " pages.");
  }
  return table;
}

Plot miss_plot() {
  return curves("misses", "Faults by the size of the caches", "cache",
                {.label = "cache of a node (pages)", .scale = PlotScale::powers_of_10},
                {.label = "of all look-ups (%)", .least = 0},
                {{"by stack distances", "of all look-ups"}, {"this run", "this run", PlotMark::points, 1}});
}

}  // namespace dmpc::apps::html
