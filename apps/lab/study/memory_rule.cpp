#include "apps/lab/study/memory_rule.h"

#include <algorithm>
#include <string_view>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "nodes/size_text.h"

namespace dmpc::apps {

namespace {

constexpr double percent = 0.01;

/// At least 1, as a cache always has a page.
std::uint32_t pages_of(double share, const core::Database& database) {
  return std::max(1U, static_cast<std::uint32_t>(share * static_cast<double>(database.page_count())));
}

MemoryRule parse_rule(std::string_view text) {
  if (text == "auto") {
    return {};
  }
  if (!text.ends_with('%')) {
    return {.bytes = parse_size_bytes(text, "--node-memory")};
  }
  const double share = percent * finite_number(text.substr(0, text.size() - 1));
  if (!(share > 0 && share <= 1)) {
    throw core::UsageError("--node-memory=" + std::string(text) + ": expected more than 0% and at most 100%");
  }
  return {.share = share};
}

}  // namespace

std::string MemoryRule::text() const {
  return bytes ? nodes::size_text(*bytes) : share ? rounded(*share / percent) + "%" : "auto";
}

void MemoryRule::apply(StrategyOptions& options, const core::Database& database) const {
  options.computer.node_memory_bytes = bytes;
  if (options.strategy == Strategy::svm && !bytes) {
    // If the host is the home of all pages, a node's part is cache, too.
    const auto pages = static_cast<std::uint32_t>(database.page_count());
    const bool has_part = options.pages.homes == svm::PageHomes::spread;
    const std::uint32_t part = (pages + options.computer.node_count - 1) / options.computer.node_count;
    const std::uint32_t of_others = has_part ? pages - pages / options.computer.node_count : pages;
    options.pages.cache_pages = std::min(pages_of(share.value_or(1), database) + (has_part ? 0 : part), std::max(1U, of_others));
  }
}

bool MemoryRule::allows(std::size_t held, const core::Database& database, std::uint32_t node_count) const {
  if (!share) {
    return true;
  }
  const std::size_t own_pages = (database.page_count() + node_count - 1) / node_count;
  const std::size_t slack = database.page_size();  // rounding of the rest after the last page
  return held <= (own_pages + pages_of(*share, database)) * database.page_size() + slack;
}

std::size_t held_bytes(const nodes::MemoryPlan& plan) {
  return plan[core::MemoryUse::home_pages] + plan[core::MemoryUse::cache_frames];
}

std::vector<MemoryRule> parse_memory_rules(const std::string& text) {
  std::vector<MemoryRule> rules;
  for (const std::string& word : words_between(text, ',')) {
    rules.push_back(parse_rule(word));
  }
  return rules;
}

}  // namespace dmpc::apps
