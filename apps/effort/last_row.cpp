#include "apps/effort/last_row.h"

#include <ostream>

namespace dmpc::apps {

void show_last_row(const Table& table, std::ostream& messages) {
  constexpr const char* back_and_clear = "\r\x1b[K";
  messages << back_and_clear << last_row_text(table) << std::endl;
}

}  // namespace dmpc::apps
