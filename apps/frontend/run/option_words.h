// Messages of a plan about its fields, in the words of the command line.
#pragma once

#include <span>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "core/base/refusal.h"
#include "nodes/computer_request.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// The option that sets a field.
struct OptionWord {
  core::Field field;
  const char* option;
};

/// The options that every program on the computer has.
inline constexpr OptionWord nodes_word{core::field_of<&nodes::ComputerRequest::node_count>(), "--nodes"};
inline constexpr OptionWord node_memory_word{core::field_of<&nodes::ComputerRequest::node_memory_bytes>(), "--node-memory"};
inline constexpr OptionWord computer_words[] = {nodes_word, node_memory_word};

/// Topologies of a machine, by name.
OptionSet::Choices<nodes::TopologyKind> topology_choices();

/// The sentence with options instead of the fields that they set; any other field by its own name.
std::string in_options(const core::Sentence& sentence, std::span<const OptionWord> words);

/// Calls `make`; a refusal that it throws becomes a core::UsageError or core::CapacityError with in_options() as its text.
template <class Make>
auto with_options_named(std::span<const OptionWord> words, const Make& make) {
  try {
    return make();
  } catch (const core::Refusal<core::UsageError>& refusal) {
    throw core::UsageError(in_options(refusal.sentence, words));
  } catch (const core::Refusal<core::CapacityError>& refusal) {
    throw core::CapacityError(in_options(refusal.sentence, words));
  }
}

}  // namespace dmpc::apps
