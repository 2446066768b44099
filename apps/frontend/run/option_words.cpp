#include "apps/frontend/run/option_words.h"

#include <algorithm>

namespace dmpc::apps {

OptionSet::Choices<nodes::TopologyKind> topology_choices() {
  using nodes::TopologyKind;
  OptionSet::Choices<TopologyKind> choices;
  for (const TopologyKind kind :
       {TopologyKind::hypercube, TopologyKind::mesh, TopologyKind::torus, TopologyKind::fat_tree, TopologyKind::crossbar}) {
    choices.emplace_back(name_of(kind), kind);
  }
  return choices;
}

std::string in_options(const core::Sentence& sentence, std::span<const OptionWord> words) {
  return sentence.text([&](const core::Field& field) {
    const auto word = std::find_if(words.begin(), words.end(), [&](const OptionWord& each) { return each.field == field; });
    return word == words.end() ? field.name() : std::string_view(word->option);
  });
}

}  // namespace dmpc::apps
