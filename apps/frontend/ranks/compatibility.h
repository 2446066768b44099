// What all ranks must have in common, so that one result comes of them.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// What is compared, and what one rank has of it, as text.
using Compatibility = std::vector<std::pair<std::string, std::string>>;

/// This process's version, build and byte order.
Compatibility build_compatibility();

/// That, and the words that this process was called with.
Compatibility call_compatibility();

/// As it travels: a line for each.
std::string text_of(const Compatibility& compatibility);

/// Throws core::InputError with what differs first and on whom, if not all texts are those of rank 0. `names` are for messages,
/// by rank as well.
void expect_alike(std::span<const std::string> texts, std::span<const std::string> names);

}  // namespace dmpc::apps
