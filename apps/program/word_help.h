// What a word means that tables, pages and closing lines show, or that an option takes.
#pragma once

#include <string>
#include <string_view>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// A paragraph for each meaning: of the glossary, as a value such as a strategy or machine, and as the name of an option. A
/// plural is taken for its singular, capitals for small letters. Empty for a word that has none.
std::string word_help(std::string_view word, const CommandDescription& program);

}  // namespace dmpc::apps
