#include "apps/lab/study/conclusions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "apps/edge/line/amount.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/run/time_parts.h"

namespace dmpc::apps {

namespace {

using Row = std::vector<Cell>;

/// Within so much of the best lru is as good as any policy.
constexpr double as_good = 1.1;

/// The last row that has a number in each of these columns; nullptr if none has.
const Row* last_with(const Table& table, std::initializer_list<std::string_view> names) {
  const auto has_all = [&](const Row& row) {
    return std::all_of(names.begin(), names.end(),
                       [&](std::string_view name) { return number_in(table, row, name).has_value(); });
  };
  const auto found = std::find_if(table.rows().rbegin(), table.rows().rend(), has_all);
  return found == table.rows().rend() ? nullptr : &*found;
}

std::string nodes_text(const Table& table, const Row& row) {
  return counted(static_cast<std::uint64_t>(number_in(table, row, "nodes").value_or(0)), "node");
}

/// The row of the same number of nodes with the other regions.
const Row* row_of_regions(const Table& table, double node_count, const std::string& regions) {
  const auto found = std::find_if(table.rows().rbegin(), table.rows().rend(), [&](const Row& row) {
    const auto* const kind = std::get_if<std::string>(&row[1]);
    return kind != nullptr && *kind == regions && number_in(table, row, "nodes") == node_count &&
           number_in(table, row, "average load achieved");
  });
  return found == table.rows().rend() ? nullptr : &*found;
}

}  // namespace

std::string conclusion_of(const BalanceStudy&, const Table& table) {
  const Row* const last = last_with(table, {"nodes", "average load achieved"});
  if (last == nullptr) {
    return "";
  }
  const double node_count = *number_in(table, *last, "nodes");
  const Row* const sampled = row_of_regions(table, node_count, "subsampled");
  const Row* const equal = row_of_regions(table, node_count, "equal size");
  if (sampled == nullptr || equal == nullptr) {
    return "";
  }
  const auto load_of = [&](const Row& row) { return percent_text(*number_in(table, row, "average load achieved")); };
  return "On " + nodes_text(table, *last) + " the average load is " + load_of(*sampled) +
         " with regions by the subsampled picture, and " + load_of(*equal) + " with regions of equal size.";
}

std::string conclusion_of(const TrafficStudy&, const Table& table) {
  const Row* const last = last_with(table, {"nodes", "ray traffic", "page traffic"});
  if (last == nullptr) {
    return "";
  }
  const double rays = *number_in(table, *last, "ray traffic"), pages = *number_in(table, *last, "page traffic");
  if (rays == 0 || pages == 0) {
    return "On " + nodes_text(table, *last) +
           (rays == pages ? " nothing travels."
            : rays == 0   ? " no ray travels."
                          : " no page travels.");
  }
  const bool rays_are_less = rays < pages;
  return "On " + nodes_text(table, *last) + " rays move " + amount_text(rays, "bytes") + " and pages " +
         amount_text(pages, "bytes") + ": " + (rays_are_less ? "rays" : "pages") + " are " +
         fixed(rays_are_less ? pages / rays : rays / pages, 1) + " times cheaper here.";
}

std::string conclusion_of(const SpeedupStudy&, const Table& table) {
  const Row* const last = last_with(table, {"nodes", "speedup", "efficiency"});
  if (last == nullptr) {
    return "";
  }
  std::string text = "On " + nodes_text(table, *last) + " the speedup is " + fixed(*number_in(table, *last, "speedup"), 1) +
                     ", an efficiency of " + percent_text(*number_in(table, *last, "efficiency"));
  std::string largest;
  double share = 0;
  for (const char* const part : time_part_names) {
    const double percent = number_in(table, *last, part).value_or(0);
    if (std::string_view(part) != "computing" && percent > share) {
      largest = part;
      share = percent;
    }
  }
  std::replace(largest.begin(), largest.end(), '_', ' ');
  return text +
         (largest.empty() ? "." : "; the largest loss is " + largest + ", " + percent_text(share) + " of the nodes' time.");
}

std::string conclusion_of(const CacheStudy&, const Table& table) {
  for (const Row& row : table.rows()) {
    const auto pages = number_in(table, row, "cache pages"), share = number_in(table, row, "share of database"),
               lru = number_in(table, row, "faults lru"), optimum = number_in(table, row, "faults optimum");
    const Row& first = table.rows().front();
    const double most = number_in(table, first, "faults lru").value_or(0);
    if (pages && share && lru && optimum && *pages > 1 && most > 0 && *lru <= as_good * *optimum) {
      return "From caches of " + counted(static_cast<std::uint64_t>(*pages), "page") + " on (" + percent_text(*share) +
             " of the database) lru is within 10 % of the best that any policy could do; it faults " +
             percent_text(100 * *lru / most) + " as often as with " +
             counted(static_cast<std::uint64_t>(number_in(table, first, "cache pages").value_or(0)), "page") + ".";
    }
  }
  return "";
}

std::string conclusion_of(const SystemsStudy&, const Table& table) {
  const Row* fastest = nullptr;
  double seconds = 0;
  for (const Row& row : table.rows()) {
    const auto time = number_in(table, row, "virtual time");
    const bool is_copy = std::get<std::string>(row[0]).starts_with("replicated");
    if (time && !is_copy && (fastest == nullptr || *time < seconds)) {
      fastest = &row;
      seconds = *time;
    }
  }
  return fastest == nullptr ? ""
                            : "Of the systems whose nodes do not hold the whole scene " + std::get<std::string>((*fastest)[0]) +
                                  " is the fastest: " + amount_text(seconds, "s") + " on " + nodes_text(table, *fastest) +
                                  ", memory " + std::get<std::string>((*fastest)[1]) + ".";
}

}  // namespace dmpc::apps
