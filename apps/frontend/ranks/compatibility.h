// Checks that all ranks are compatible, so that they compute one result.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// The properties to compare, each with this rank's value as text.
using Compatibility = std::vector<std::pair<std::string, std::string>>;

/// This process's version, build and byte order.
Compatibility build_compatibility();

/// build_compatibility(), and the command line of this process.
Compatibility call_compatibility();

/// As a message: a line for each property.
std::string text_of(const Compatibility& compatibility);

/// Throws core::InputError with the first difference and its rank, if not all texts equal rank 0's. `names`, by rank, are for
/// messages.
void expect_alike(std::span<const std::string> texts, std::span<const std::string> names);

}  // namespace dmpc::apps
