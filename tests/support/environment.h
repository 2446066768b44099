// Numbers by which who calls a test asks for more or less of it.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

namespace dmpc::tests {

/// A whole number from the environment, or `standard`.
inline std::uint64_t number_from_environment(const char* name, std::uint64_t standard) {
  const char* const text = std::getenv(name);
  return text == nullptr ? standard : std::stoull(text);
}

}  // namespace dmpc::tests
