// The pages that every node keeps permanently in addition to those at home: what a small picture uses most.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

/// The `count` pages that the rays of a subsampled picture, a sample of one pixel of 8x8, look up most often, in descending
/// order; equal counts in the order of the database. After Green and Paddon (1989), as described in the article: a node's memory
/// is split beforehand into a resident part and a cache. Takes as long as rendering that picture on one thread; after a stop is
/// requested the rest of it is left out. Nothing is rendered for a `count` of 0.
std::vector<PageId> most_used_pages(const core::Database& database, const core::RenderSettings& settings, std::uint32_t count,
                                    const std::stop_token& stop = {});

}  // namespace dmpc::svm
