// What there is to choose from, by the words that the command line takes: scenes, machines, policies and others.
#pragma once

#include <string>
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

/// scenes, machines, strategies, systems, policies, topologies, heatmaps, skips, formats.
std::vector<ChoiceList> all_choices();

}  // namespace dmpc::apps
