#include "apps/show/page/conclusions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/shares.h"
#include "apps/run/memory_categories.h"
#include "core/base/ranges.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps::html {

namespace {

std::string node_text(std::size_t node) { return "node " + std::to_string(node); }

template <class ValueOf>
std::vector<double> by_node(const Account& account, const ValueOf& value_of) {
  std::vector<double> values;
  for (std::size_t node = 0; node < account.nodes.size(); ++node) {
    values.push_back(static_cast<double>(value_of(node)));
  }
  return values;
}

}  // namespace

std::string ray_conclusion(std::span<const std::uint64_t> rays, std::uint64_t shot) {
  const std::vector<double> sent(rays.begin(), rays.end());
  const double all = sum_of(sent);
  if (all == 0) {
    return "No ray left the node on which it began.";
  }
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(rays.size())) + 0.5);
  const std::size_t at = largest_at(sent);
  return "A ray went to another node " + times_text(all / static_cast<double>(std::max<std::uint64_t>(shot, 1))) +
         " on average. Most went from " + node_text(at / side) + " to " + node_text(at % side) + ": " +
         share_text(sent[at] / all) + " of all, where an even share were " +
         share_text(1.0 / static_cast<double>(side * (side - 1))) + ".";
}

std::string node_conclusion(const Account& account) {
  const std::vector<double> rays = by_node(account, [&](std::size_t node) { return account.nodes[node].operations.ray_count(); });
  if (rays.size() == 1) {
    return "The one node traced all " + counted(account.operations.ray_count(), "ray") + ".";
  }
  const std::string even = evenness(rays, "shot");
  if (even.empty()) {
    return "No ray was traced.";
  }
  const auto least = static_cast<std::size_t>(std::min_element(rays.begin(), rays.end()) - rays.begin());
  const double mean = sum_of(rays) / static_cast<double>(rays.size());
  return even + " number of rays, " + node_text(least) + " " + times_text(rays[least] / mean) + ".";
}

std::string memory_conclusion(const Account& account, std::size_t database_bytes) {
  const std::vector<double> used = by_node(account, [&](std::size_t node) { return account.nodes[node].memory_used.total(); });
  const std::size_t fullest = largest_at(used);
  const nodes::MemoryPlan& memory = account.nodes[fullest].memory_used;
  const std::vector<double> parts = core::mapped<double>(
      memory_categories, [&](const NamedCategory& part) { return static_cast<double>(memory[part.category]); });
  const std::size_t part = largest_at(parts);
  return "The fullest node, " + node_text(fullest) + ", used " + bytes_text(memory.total()) + ", " +
         share_text(share_of(parts[part], used[fullest])) + " of it for " + memory_categories.at(part).name +
         "; the database has " + bytes_text(database_bytes) + ".";
}

std::string heat_conclusion(const HeatField& field) {
  if (field.kind == core::HeatKind::node || field.kind == core::HeatKind::depth || field.kind == core::HeatKind::done ||
      field.sum() == 0) {
    return "";
  }
  return "The tenth of the pixels with the most " + std::string(core::name_of(field.kind)) + " had " +
         share_text(top_tenth_share(field.values)) + " of all.";
}

}  // namespace dmpc::apps::html
