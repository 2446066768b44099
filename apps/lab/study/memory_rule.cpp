#include "apps/lab/study/memory_rule.h"

#include <string_view>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "nodes/size_text.h"

namespace dmpc::apps {

namespace {

constexpr double percent = 0.01, most_share = 10;

MemoryRule parse_rule(std::string_view text) {
  if (text == "rays") {
    return {};
  }
  if (!text.ends_with('%')) {
    return {.bytes = parse_size_bytes(text, "--node-memory")};
  }
  const double share = percent * finite_number(text.substr(0, text.size() - 1));
  if (!(share > 0 && share <= most_share)) {
    throw core::UsageError("--node-memory=" + std::string(text) + ": expected more than 0% and at most 1000%");
  }
  return {.share = share};
}

}  // namespace

std::string MemoryRule::text() const {
  return bytes ? nodes::size_text(*bytes) : share ? rounded(*share / percent) + "%" : "rays";
}

std::size_t MemoryRule::bytes_of(std::size_t database_bytes, std::size_t rays_bytes) const {
  return bytes ? *bytes : share ? static_cast<std::size_t>(*share * static_cast<double>(database_bytes)) : rays_bytes;
}

std::vector<MemoryRule> parse_memory_rules(const std::string& text) {
  return core::mapped<MemoryRule>(words_between(text, ','), [&](const std::string& word) { return parse_rule(word); });
}

}  // namespace dmpc::apps
