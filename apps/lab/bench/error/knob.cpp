#include "apps/lab/bench/error/knob.h"

#include <algorithm>
#include <array>
#include <vector>

#include "apps/edge/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, 9> names = {"samples",           "adaptive",   "cutoff",  "depth",
                                              "tessellation",      "arithmetic", "quality", "adaptive and cutoff",
                                              "adaptive and depth"};
/// So many of these the command line knows.
constexpr std::size_t single_count = 7;

Knob knob_of(const std::string& word, const std::string& text) {
  const auto* const end = names.begin() + single_count;
  const auto* const found = std::find(names.begin(), end, word);
  if (found == end) {
    const std::vector<std::string> all(names.begin(), end);
    const std::string meant = core::did_you_mean(word, all);
    throw core::UsageError(
        "--knobs=" + text +
        ": expected some of samples,adaptive,cutoff,depth,tessellation,arithmetic,quality with commas between them" +
        (meant.empty() ? "" : ".") + meant);
  }
  return static_cast<Knob>(found - names.begin());
}

void add_pairs(std::set<Knob>& knobs) {
  if (knobs.contains(Knob::adaptive) && knobs.contains(Knob::cutoff)) {
    knobs.insert(Knob::adaptive_and_cutoff);
  }
  if (knobs.contains(Knob::adaptive) && knobs.contains(Knob::depth)) {
    knobs.insert(Knob::adaptive_and_depth);
  }
}

}  // namespace

const char* name_of(Knob knob) { return names[static_cast<std::size_t>(knob)]; }

std::set<Knob> parse_knobs(const std::string& text) {
  std::set<Knob> knobs;
  for (const std::string& word : words_between_commas(text, "--knobs")) {
    knobs.insert(knob_of(word, text));
  }
  add_pairs(knobs);
  return knobs;
}

std::set<Knob> all_knobs() { return parse_knobs("samples,adaptive,cutoff,depth,tessellation,arithmetic,quality"); }

}  // namespace dmpc::apps
