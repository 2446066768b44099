// What Table 3 owes to the sizes of memories and to the order of records.
#pragma once

#include "apps/edge/table/table.h"
#include "apps/lab/study/paper/catalogue.h"

namespace dmpc::apps {

/// Efficiencies of the scenes that miss pages: with caches of the article's share of the database, as in Table 3, the same with
/// records without an order in space, with the share that the article's Figures 8 to 10 speak for, and with memories of its 4 MB;
/// each beside what is printed.
Table memories(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
