// Columns for the parts of the nodes' time.
#pragma once

#include <algorithm>
#include <string>

#include "apps/frontend/run/time_parts.h"
#include "apps/frontend/table/filled_columns.h"

namespace dmpc::apps {

/// Adds a column for each part of time, in percent of parts(subject), which is TimeParts or nothing.
template <class Subject, class Parts>
void add_time_parts(int digits, const Parts& parts, FilledColumns<Subject>& columns) {
  for (std::size_t part = 0; part < time_part_count; ++part) {
    columns.push_back({{time_part_names[part], "%", digits}, [parts, part](const Subject& subject) {
                         const std::optional<TimeParts> all = parts(subject);
                         return all ? Cell(all->percent()[part]) : Cell();
                       }});
  }
}

/// Returns "data wait" for the column "data_wait".
inline std::string time_part_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace dmpc::apps
