// What there is to choose from, by the words that the command line takes: scenes, machines, policies and others.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// A word, and what it stands for in a line.
struct Choice {
  std::string name;
  std::string meaning;
};

/// One kind of things.
struct ChoiceList {
  std::string kind;   ///< "scenes"
  std::string where;  ///< what takes such a word: "--machine="
  std::vector<Choice> entries;
};

inline constexpr std::array<std::string_view, 9> choice_kinds = {"scenes",     "machines", "strategies", "systems", "policies",
                                                                 "topologies", "heatmaps", "skips",      "formats"};
/// One list for each of choice_kinds.
std::vector<ChoiceList> all_choices();

}  // namespace dmpc::apps
