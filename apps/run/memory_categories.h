// Names of the memory categories of a render's nodes, in display order.
#pragma once

#include <array>

#include "core/picture/memory_use.h"
#include "nodes/local_memory.h"

namespace dmpc::apps {

struct NamedCategory {
  nodes::Category category;
  const char* name;
};
inline constexpr std::array<NamedCategory, nodes::category_count> memory_categories = {{
    {core::MemoryUse::home_pages, "home pages"},
    {core::MemoryUse::cache_frames, "cache frames"},
    {core::MemoryUse::page_table, "page table"},
    {core::MemoryUse::ray_stacks, "ray stacks"},
    {nodes::Category::mailbox, "mailbox"},
    {nodes::Category::queues, "queues"},
    {core::MemoryUse::film_tiles, "film tiles"},
    {core::MemoryUse::constants, "constants"},
    {nodes::Category::reserve, "reserve"},
}};

}  // namespace dmpc::apps
