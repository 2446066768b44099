// What the words on the page of a program of somebody's own mean.
#pragma once

#include <span>

#include "apps/edge/help/glossary.h"

namespace dmpc::apps {

/// By alphabet. Thread-safe.
std::span<const GlossaryEntry> page_words();

}  // namespace dmpc::apps
