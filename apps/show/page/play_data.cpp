#include "apps/show/page/play_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "apps/edge/run/run_view.h"
#include "apps/edge/run/work.h"
#include "apps/run/report.h"
#include "apps/show/heat/field.h"
#include "apps/show/page/play_cells.h"
#include "apps/show/page/typed_array.h"
#include "core/base/expect.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps::html {

namespace {

using core::HeatKind;
using nlohmann::json;
using Counts = std::vector<std::uint64_t>;

constexpr std::size_t pages_max = 256;  ///< the hottest that are listed

std::uint64_t largest(std::span<const std::uint64_t> values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

std::uint64_t sum_of(std::span<const std::uint64_t> values) {
  return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
}

/// By the clock of the run, of whatever is told of it the end.
std::uint64_t total_ns(const RenderRecord& record, const Account& account) {
  std::uint64_t total = std::max<std::uint64_t>(1, largest(record.heat->values(HeatKind::done)));
  if (account.virtual_time) {
    return std::max(total, account.virtual_time->total_ns);
  }
  for (const NodeAccount& node : account.nodes) {
    total = std::max(total, node.counters.wall_ns);
  }
  return total;
}

/// Rounded up, so that nothing is lit before it is done.
Counts parts_of_run(std::span<const std::uint64_t> done_ns, std::uint64_t total) {
  Counts parts;
  for (const std::uint64_t ns : done_ns) {
    const double part = std::ceil(static_cast<double>(ns) / static_cast<double>(total) * static_cast<double>(done_parts));
    parts.push_back(std::min(done_parts, static_cast<std::uint64_t>(part)));
  }
  return parts;
}

/// Values as they are sent, and what each is worth in the unit of the field.
struct Scaled {
  Counts values;
  double scale = 1;
};

Scaled scaled(HeatKind kind, std::span<const std::uint64_t> values) {
  if (kind != HeatKind::time) {
    return {{values.begin(), values.end()}};
  }
  Scaled nanoseconds{.values = {}, .scale = 1e-3};  // of picoseconds, in microseconds
  for (const std::uint64_t picoseconds : values) {
    nanoseconds.values.push_back((picoseconds + 500) / 1000);
  }
  return nanoseconds;
}

json fields_of(const RenderRecord& record, const PlayCells& cells) {
  json fields = json::array();
  const std::span<const std::uint64_t> done = record.heat->values(HeatKind::done);
  for (std::size_t number = 0; number < core::heat_kind_names.size(); ++number) {
    const auto kind = static_cast<HeatKind>(number);
    if (!record.heat->has(kind) || kind == HeatKind::done || kind == HeatKind::samples) {
      continue;
    }
    const std::span<const std::uint64_t> values = record.heat->values(kind);
    const Scaled sent = scaled(kind, kind == HeatKind::node    ? cells.of_last(values, done)
                                     : kind == HeatKind::depth ? cells.largest(values)
                                                               : cells.sums(values));
    const HeatMeaning meaning = meaning_of(kind, record.options.strategy);
    fields.push_back({{"name", core::name_of(kind)},
                      {"meaning", meaning.text},
                      {"unit", meaning.unit},
                      {"scale", sent.scale},
                      {"values", typed_array(sent.values)}});
  }
  return fields;
}

/// What a node did in each step, in 255ths of it; what is rounded off comes to the next step.
void append_shares(Counts& shares, const std::vector<nodes::WorkTimes>& steps, std::size_t work, std::uint64_t step_ns) {
  double due = 0;
  for (const nodes::WorkTimes& times : steps) {
    due += 255 * static_cast<double>(times[work]) / static_cast<double>(step_ns);
    const double given = std::clamp(std::round(due), 0.0, 255.0);
    shares.push_back(static_cast<std::uint64_t>(given));
    due -= given;
  }
}

/// The host, which is the last, is left out.
json works_of(const nodes::ActivitySteps& steps) {
  json works = json::array();
  const std::span all(steps.nodes.data(), steps.nodes.size() - 1);
  for (std::size_t work = 0; work < work_names.size(); ++work) {
    Counts shares;
    std::uint64_t ns = 0;
    for (const std::vector<nodes::WorkTimes>& node : all) {
      append_shares(shares, node, work, steps.step_ns);
      for (const nodes::WorkTimes& times : node) {
        ns += times[work];
      }
    }
    if (ns > 0) {
      works.push_back({{"name", work_names[work]}, {"ns", ns}, {"shares", typed_array(shares)}});
    }
  }
  return works;
}

/// All counts, or where they are not 0 and what they are there, whichever takes less.
json pairs_of(std::span<const std::uint64_t> counts, json head) {
  Counts places, there;
  for (std::size_t place = 0; place < counts.size(); ++place) {
    if (counts[place] > 0) {
      places.push_back(place);
      there.push_back(counts[place]);
    }
  }
  json all = typed_array(counts), where = typed_array(places), some = typed_array(there);
  const auto size = [](const json& array) { return array["data"].get_ref<const std::string&>().size(); };
  head["side"] = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(counts.size()))));
  if (size(where) + size(some) < size(all)) {
    head["places"] = std::move(where);
    head["counts"] = std::move(some);
  } else {
    head["counts"] = std::move(all);
  }
  return head;
}

json links_of(const Account& account) {
  json links = json::array();
  if (account.virtual_time) {
    for (const nodes::LinkUse& link : account.virtual_time->busiest_links) {
      links.push_back({link.from, link.to, link.messages, link.bytes, link.busy_ns, link.wait_ns});
    }
  }
  return links;
}

json pages_of(const svm::Fetches& fetches) {
  std::vector<std::uint32_t> numbers(fetches.by_page.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::erase_if(numbers, [&](std::uint32_t page) { return fetches.by_page[page] == 0; });
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return fetches.by_page[a] > fetches.by_page[b]; });
  numbers.resize(std::min(numbers.size(), pages_max));
  json pages = json::array();
  for (const std::uint32_t page : numbers) {
    pages.push_back({page, fetches.home_of(page), fetches.by_page[page]});
  }
  return pages;
}

void add_exchange(json& head, const RenderRecord& record) {
  if (const auto& fetches = record.view->fetches) {
    head["pairs"] = pairs_of(fetches->by_pair, {{"what", "pages"}, {"row", "node that asks"}, {"column", "home of the page"}});
    head["pages"] = pages_of(*fetches);
    head["fetched"] = sum_of(fetches->by_page);
  } else if (const auto* const rays = std::get_if<dataflow::Report>(&record.report)) {
    head["pairs"] =
        pairs_of(rays->ray_matrix(), {{"what", "rays"}, {"row", "node that sends"}, {"column", "owner that receives"}});
  }
}

}  // namespace

std::string play_data(const RenderRecord& record, const Origin& origin) {
  core::expect(record.view != nullptr && record.heat != nullptr && record.heat->has(HeatKind::done),
               "what is played was recorded");
  const Account account = account_of(record.report);
  const PlayCells cells(account.film.width(), account.film.height(), play_cells_max);
  const std::uint64_t total = total_ns(record, account);
  const nodes::ActivitySteps& steps = record.view->steps;
  json head = {{"format", play_format},
               {"scene", record.options.picture.scene},
               {"computer", computer_text(record)},
               {"clock", account.virtual_time ? "virtual time" : "wall clock"},
               {"total_ns", total},
               {"words", origin.words},
               {"nodes", account.nodes.size()},
               {"step_ns", steps.step_ns},
               {"steps", steps.nodes.front().size()},
               {"width", account.film.width()},
               {"height", account.film.height()},
               {"cell", cells.side()},
               {"wide", cells.wide()},
               {"high", cells.high()},
               {"done", typed_array(parts_of_run(cells.largest(record.heat->values(HeatKind::done)), total))},
               {"fields", fields_of(record, cells)},
               {"works", works_of(steps)},
               {"links", links_of(account)},
               {"pages", json::array()}};
  add_exchange(head, record);
  return head.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace dmpc::apps::html
