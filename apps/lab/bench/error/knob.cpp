#include "apps/lab/bench/error/knob.h"

#include <algorithm>
#include <array>
#include <vector>

#include "apps/edge/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, 12> names = {
    "samples", "adaptive", "cutoff",   "depth",    "tessellation",        "arithmetic",
    "quality", "bounces",  "roulette", "emitters", "adaptive and cutoff", "adaptive and depth"};
/// So many of these the command line knows.
constexpr std::size_t single_count = 10;
constexpr const char *whitted_knobs = "samples,adaptive,cutoff,depth,tessellation,arithmetic,quality",
                     *path_knobs = "samples,adaptive,bounces,roulette,emitters";

Knob knob_of(const std::string& word, const std::string& text) {
  const auto* const end = names.begin() + single_count;
  const auto* const found = std::find(names.begin(), end, word);
  if (found == end) {
    const std::vector<std::string> all(names.begin(), end);
    const std::string meant = core::did_you_mean(word, all);
    throw core::UsageError("--knobs=" + text + ": expected some of " + whitted_knobs + ", or by paths of " + path_knobs +
                           ", with commas between them" + (meant.empty() ? "" : ".") + meant);
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

std::set<Knob> all_knobs(bool are_by_paths) { return parse_knobs(are_by_paths ? path_knobs : whitted_knobs); }

void check_knobs(const std::set<Knob>& knobs, bool are_by_paths) {
  const std::set<Knob> all = all_knobs(are_by_paths);
  for (const Knob knob : knobs) {
    if (!all.contains(knob)) {
      throw core::UsageError(std::string("--knobs=") + name_of(knob) + (are_by_paths ? " does not go" : " goes") +
                             " with --transport=paths: expected some of " + (are_by_paths ? path_knobs : whitted_knobs));
    }
  }
}

}  // namespace dmpc::apps
