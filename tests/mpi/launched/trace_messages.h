// What a trace of several ranks has of messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

namespace dmpc::tests {

/// Messages whose beginning and end stand in the file, in that order of time.
inline std::size_t messages_in_order(const nlohmann::json& trace) {
  std::map<std::uint64_t, double> sent_us;
  std::size_t count = 0;
  for (const nlohmann::json& event : trace["traceEvents"]) {
    if (event["ph"] == "s") {
      sent_us[event["id"].get<std::uint64_t>()] = event["ts"].get<double>();
    } else if (event["ph"] == "f") {
      const auto sent = sent_us.find(event["id"].get<std::uint64_t>());
      count += sent != sent_us.end() && sent->second <= event["ts"].get<double>() ? 1 : 0;
    }
  }
  return count;
}

}  // namespace dmpc::tests
