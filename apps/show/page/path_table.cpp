#include "apps/show/page/path_table.h"

#include <algorithm>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/time_parts.h"
#include "apps/frontend/show/page/shares.h"

namespace dmpc::apps::html {

namespace {

using Part = std::pair<std::string, std::uint64_t>;

void drop_empty(std::vector<Part>& parts) {
  std::erase_if(parts, [](const Part& part) { return part.second == 0; });
}

/// Returns the times of messages by kind; the largest first.
std::vector<Part> kinds_of(const nodes::PathTimes& path, std::span<const char* const> kind_names) {
  std::vector<Part> kinds;
  for (std::size_t kind = 0; kind < kind_names.size(); ++kind) {
    kinds.emplace_back(packet_text(kind_names[kind]), path.by_kind_ns[kind]);
  }
  drop_empty(kinds);
  std::stable_sort(kinds.begin(), kinds.end(), [](const Part& a, const Part& b) { return a.second > b.second; });
  return kinds;
}

void add_rows(Table& table, const std::vector<Part>& parts, std::uint64_t total_ns) {
  for (const auto& [name, ns] : parts) {
    table.add_row({name, static_cast<double>(ns) / 1e6, percent_of(static_cast<double>(ns), static_cast<double>(total_ns))});
  }
}

}  // namespace

std::string packet_text(const std::string& kind_name) {
  std::string text = kind_name;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::vector<Part> path_parts(const nodes::PathTimes& path) {
  std::vector<Part> parts = {{"computing", path.computing_ns},     {std::string(service_busy_words), path.service_busy_ns},
                             {"sending", path.sending_ns},         {"on the way", path.travelling_ns},
                             {"waiting for links", path.links_ns}, {"receiving", path.receiving_ns},
                             {"serving", path.serving_ns}};
  drop_empty(parts);
  return parts;
}

Table path_table(const nodes::PathTimes& path, std::span<const char* const> kind_names) {
  Table table("What the critical path was made of", {{"part", "", 0}, {"time", "ms", 3}, {"of the run", "%", 1}});
  add_rows(table, path_parts(path), path.total_ns());
  std::vector<Part> kinds = kinds_of(path, kind_names);
  for (Part& kind : kinds) {
    kind.first = "of it for " + kind.first;
  }
  add_rows(table, kinds, path.total_ns());
  table.add_note(
      "The chain of causes from the start to the end, each of which begins when the one before ends: the run would have ended no "
      "earlier if all else had taken no time. It crossed between nodes by " +
      counted(path.messages, "message") + ".");
  return table;
}

std::string path_conclusion(const nodes::PathTimes& path, std::span<const char* const> kind_names) {
  const auto total = static_cast<double>(path.total_ns());
  if (total == 0) {
    return "";
  }
  std::string text = "Along the critical path, over " + counted(path.messages, "message") + ", nodes computed for " +
                     share_text(static_cast<double>(path.computing_ns) / total) + " of the run";
  if (const std::vector<Part> kinds = kinds_of(path, kind_names); !kinds.empty()) {
    text += "; of what messages took most was for \"" + kinds.front().first + "\", " +
            share_text(static_cast<double>(kinds.front().second) / total);
  }
  return text + ".";
}

}  // namespace dmpc::apps::html
