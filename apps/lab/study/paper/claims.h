// The claims of the article's text, each held against our runs.
#pragma once

#include "apps/edge/table/table.h"
#include "apps/lab/study/paper/catalogue.h"

namespace dmpc::apps {

/// A row a claim whose runs have ended: the claim, "held" or "not held", and what was found. Of pictures that are not of the
/// article's resolution none is judged.
Table claims(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
