#include "apps/edge/run/option_words.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace dmpc::apps {

namespace {

struct FieldName {
  std::string_view field, option;
};
/// Of svm::PlanRequest and dataflow::PlanRequest.
constexpr std::array<FieldName, 21> field_names = {
    {{"node_count=", "--nodes="},         {"node_memory_bytes=", "--node-memory="}, {"page_size_bytes=", "--page-size="},
     {"cache_pages=", "--cache-pages="},  {"replacement=", "--replacement="},       {"homes=", "--homes="},
     {"tree_arity=", "--tree-arity="},    {"resident_percent=", "--resident="},     {"in_flight=", "--in-flight="},
     {"work_item_side=", "--work-item="}, {"work_giver=", "--work-giver="},         {"pixel_shares=", "--pixels="},
     {"worker_count=", "--workers="},     {"ray_batch=", "--ray-batch="},           {"ray_credits=", "--ray-credits="},
     {"ray_places=", "--ray-places="},    {"queue_packets=", "--ray-queue="},       {"tested_objects=", "--tested-objects="},
     {"strategy=", "--strategy="},        {"structure=", "--structure="},           {"record_order=", "--record-order="}}};

bool is_within_word(const std::string& text, std::size_t at) {
  return at > 0 && (text[at - 1] == '-' || text[at - 1] == '_' || (text[at - 1] >= 'a' && text[at - 1] <= 'z'));
}

}  // namespace

std::string in_options(const std::string& message) {
  std::string text = message;
  for (const FieldName& name : field_names) {
    for (std::size_t at = text.find(name.field); at != std::string::npos; at = text.find(name.field, at + name.option.size())) {
      if (!is_within_word(text, at)) {
        text.replace(at, name.field.size(), name.option);
      }
    }
  }
  return text;
}

}  // namespace dmpc::apps
