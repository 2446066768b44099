// The page of --report: settings, picture, costs and losses of a render.
#pragma once

#include <string>

#include "apps/frontend/show/page/origin.h"
#include "apps/run/render_record.h"

namespace dmpc::apps::html {

/// Returns the whole document. Throws core::InputError if no temporary file can be written.
std::string render_page(const RenderRecord& record, const Origin& origin);

}  // namespace dmpc::apps::html
