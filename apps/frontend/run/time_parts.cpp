#include "apps/frontend/run/time_parts.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {
namespace {

TimePart wait_part(std::size_t kind, const WaitKinds& waits) {
  const auto is_one_of = [kind](std::uint32_t kinds) { return (kinds >> kind & 1U) != 0; };
  const std::array parts = {
      std::pair(waits.data_kinds, TimePart::data_wait),   std::pair(waits.work_kinds, TimePart::starvation),
      std::pair(waits.token_kinds, TimePart::token_wait), std::pair(waits.credit_kinds, TimePart::credit_wait),
      std::pair(waits.film_kinds, TimePart::film_wait),   std::pair(waits.end_kinds, TimePart::idle_at_end)};
  const auto* const found = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return is_one_of(part.first); });
  return found == parts.end() ? TimePart::other_wait : found->second;
}

}  // namespace

nodes::WaitOf wait_of(const WaitKinds& waits) {
  nodes::WaitOf numbers{};
  for (std::size_t kind = 0; kind < numbers.size(); ++kind) {
    const auto* const at = std::find(wait_parts.begin(), wait_parts.end(), wait_part(kind, waits));
    numbers[kind] = static_cast<std::uint8_t>(at - wait_parts.begin());
  }
  return numbers;
}

std::string words_of(TimePart part, const WaitKinds& waits) {
  switch (part) {
    case TimePart::data_wait:
      return std::string(waits.data) + " wait";
    case TimePart::starvation:
      return "starvation";
    case TimePart::token_wait:
      return "token wait";
    case TimePart::credit_wait:
      return "credit wait";
    case TimePart::film_wait:
      return "film wait";
    case TimePart::other_wait:
      return "other waits";
    case TimePart::service_busy:
      return std::string(service_busy_words);
    case TimePart::service_idle:
      return std::string(service_idle_words);
    case TimePart::idle_at_end:
      return "idle at the end";
    default:
      return time_part_names[static_cast<std::size_t>(part)];
  }
}

std::uint64_t TimeParts::total_ns() const { return std::accumulate(ns.begin(), ns.end(), std::uint64_t{0}); }

std::array<double, time_part_count> TimeParts::percent() const {
  std::array<double, time_part_count> percent{};
  const std::uint64_t whole_ns = total_ns();
  if (whole_ns == 0) {
    percent[static_cast<std::size_t>(TimePart::computing)] = 100;
    return percent;
  }
  for (std::size_t part = 0; part < time_part_count; ++part) {
    percent[part] = 100 * static_cast<double>(ns[part]) / static_cast<double>(whole_ns);
  }
  return percent;
}

TimeParts parts_of(const nodes::VirtualTimes& times, const WaitKinds& waits) {
  TimeParts parts;
  const auto add = [&parts](TimePart part, std::uint64_t ns) { parts.ns[static_cast<std::size_t>(part)] += ns; };
  add(TimePart::computing, times.computing_ns);
  add(TimePart::service_busy, times.service_busy_ns);
  add(TimePart::service_idle, times.service_idle_ns);
  add(TimePart::messages, times.sending_ns + times.receiving_ns);
  add(TimePart::idle_at_end, times.end_ns);
  for (std::size_t kind = 0; kind < times.waiting_ns.size(); ++kind) {
    add(wait_part(kind, waits), times.waiting_ns[kind]);
  }
  return parts;
}

void add_times(nodes::VirtualTimes& sum, const nodes::VirtualTimes& more) {
  sum.computing_ns += more.computing_ns;
  sum.sending_ns += more.sending_ns;
  sum.receiving_ns += more.receiving_ns;
  sum.service_busy_ns += more.service_busy_ns;
  sum.service_idle_ns += more.service_idle_ns;
  std::transform(sum.waiting_ns.begin(), sum.waiting_ns.end(), more.waiting_ns.begin(), sum.waiting_ns.begin(), std::plus());
  sum.end_ns += more.end_ns;
}

nodes::VirtualTimes sum_of_nodes(const nodes::VirtualReport& report) {
  nodes::VirtualTimes sum;
  for (std::size_t node = 0; node + 1 < report.nodes.size(); ++node) {  // the host is the last
    add_times(sum, report.nodes[node]);
  }
  return sum;
}

std::string parts_text(const TimeParts& parts, const WaitKinds& waits) {
  if (parts.total_ns() == 0) {
    return words_of(TimePart::computing, waits) + " 100.0 %";
  }
  std::string text;
  const std::vector<double> percent = percent_parts(parts.ns);
  for (std::size_t part = 0; part < time_part_count; ++part) {
    if (parts.ns[part] > 0) {
      text += (text.empty() ? "" : ", ") + words_of(static_cast<TimePart>(part), waits) + " " + fixed(percent[part], 1) + " %";
    }
  }
  return text;
}

}  // namespace dmpc::apps
